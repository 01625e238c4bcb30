#include "io/validate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string_view>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/vector.hpp>

#include "motion.hpp"
#include "surfaces/reflectance.hpp"
#include "triangle.hpp"

namespace render {
namespace {

using lightcuts::is_finite;

std::string text(float value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string text(const glm::vec3& v) { return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")"; }

bool is_finite_and_not_negative(const glm::vec3& v) {
    return is_finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
}

/// Throws messages that begin with the scene's name.
struct Checker {
    const Scene& scene;

    [[noreturn]] void fail(const std::string& message) const {
        throw lightcuts::invalid_input(scene.name + ": " + message);
    }

    void sizes() const {
        if (scene.triangles.empty()) {
            std::string why = "the scene has no triangles; there is nothing to render";
            for (const LeftOut& item : scene.left_out) why += "; left out: " + item.what;
            fail(why);
        }
        if (scene.triangle_material.size() != scene.triangles.size()) fail("not one material index per triangle");
        if (!scene.normals.empty() && scene.normals.size() != scene.positions.size()) {
            fail("not one normal per vertex; give all vertices a normal or none");
        }
        for (const auto& uvs : scene.uv_sets) {
            if (!uvs.empty() && uvs.size() != scene.positions.size()) {
                fail("not one uv per vertex; give all vertices a uv or none");
            }
        }
        const bool colored = scene.colors.empty() || scene.colors.size() == scene.positions.size();
        const bool tangent = scene.tangents.empty() || scene.tangents.size() == scene.positions.size();
        if (!colored || !tangent) fail("not one color or tangent per vertex; give all vertices one or none");
    }

    void vertices() const {
        for (std::size_t i = 0; i < scene.positions.size(); ++i) {
            if (!is_finite(scene.positions[i])) {
                fail("vertex " + std::to_string(i) + " at " + text(scene.positions[i]) +
                     " is not finite; correct its coordinates");
            }
        }
        for (std::size_t i = 0; i < scene.normals.size(); ++i) {
            if (!is_finite(scene.normals[i])) {
                fail("the normal of vertex " + std::to_string(i) + " is not finite; correct or remove the normals");
            }
        }
        for (const auto& uvs : scene.uv_sets) {
            for (std::size_t i = 0; i < uvs.size(); ++i) {
                if (!is_finite(glm::vec3(uvs[i], 0.0f))) {
                    fail("the uv of vertex " + std::to_string(i) + " is not finite; correct or remove the uvs");
                }
            }
        }
        for (std::size_t i = 0; i < scene.tangents.size(); ++i) {
            if (!is_finite(glm::vec3(scene.tangents[i]))) {
                fail("the tangent of vertex " + std::to_string(i) + " is not finite; correct or remove the tangents");
            }
        }
        for (std::size_t i = 0; i < scene.colors.size(); ++i) {
            const glm::vec4& color = scene.colors[i];
            if (!is_finite_and_not_negative(glm::vec3(color)) || !(color.a >= 0.0f) || !std::isfinite(color.a)) {
                fail("the color of vertex " + std::to_string(i) + " is negative or not finite; correct it");
            }
        }
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            const glm::uvec3 corner = scene.triangles[t];
            if (std::max({corner.x, corner.y, corner.z}) >= scene.positions.size()) {
                fail("triangle " + std::to_string(t) + " has a vertex that does not exist; correct its indices");
            }
            if (scene.triangle_material[t] >= scene.materials.size()) {
                fail("triangle " + std::to_string(t) + " has a material that does not exist; correct its index");
            }
        }
    }

    /// What moves has all of it at all steps, and no triangle moves with but some of its corners.
    void motion() const {
        for (const MovingVertices& part : scene.moving) {
            const std::size_t size = static_cast<std::size_t>(part.count) * part.steps;
            if (part.steps < 2 || part.positions.size() != size ||
                part.normals.size() != (scene.normals.empty() ? 0 : size) ||
                part.tangents.size() != (scene.tangents.empty() ? 0 : size)) {
                fail("what moves from vertex " + std::to_string(part.first) +
                     " on has not one position, normal or tangent for each vertex at each step");
            }
            const auto bad = std::find_if(part.positions.begin(), part.positions.end(),
                                          [](const glm::vec3& p) { return !is_finite(p); });
            if (bad != part.positions.end()) {
                const auto place = static_cast<std::size_t>(bad - part.positions.begin()) % part.count;
                fail("vertex " + std::to_string(part.first + place) + " moves to " + text(*bad) +
                     ", which is not finite; correct its animation");
            }
        }
        for (std::size_t t = 0; !scene.moving.empty() && t < scene.triangles.size(); ++t) {
            const glm::uvec3& corner = scene.triangles[t];
            const MovingVertices* part = motion_of(scene, corner.x);
            if (motion_of(scene, corner.y) != part || motion_of(scene, corner.z) != part) {
                fail("triangle " + std::to_string(t) + " moves with some of its corners only; separate its vertices");
            }
        }
    }

    void materials() const {
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            const Material& m = scene.materials[i];
            const auto require = [&](bool good, const char* what) {
                if (!good) {
                    fail("material " + std::to_string(i) + " '" + m.name + "': " + what +
                         " is negative, too large or not a number; correct it");
                }
            };
            const auto within = [](float v, float low, float high) { return v >= low && v <= high; };
            require(is_finite_and_not_negative(m.base_color), "the base color");
            require(is_finite_and_not_negative(m.specular), "the specular color");
            require(is_finite_and_not_negative(m.emission), "the emission");
            require(is_finite_and_not_negative(m.diffuse_transmission_color), "the diffuse transmission color");
            require(within(m.metallic, 0.0f, 1.0f), "metallic");
            require(within(m.roughness, 0.0f, 1.0f), "roughness");
            require(within(m.transmission, 0.0f, 1.0f), "transmission");
            require(within(m.diffuse_transmission, 0.0f, 1.0f), "diffuse transmission");
            require(within(m.base_alpha, 0.0f, 1.0f), "alpha");
            require(std::isfinite(m.alpha_cutoff), "the alpha cutoff");
            require(within(m.exponent, 0.0f, 1e9f), "the specular exponent");
            const bool is_infinite_ior = m.model == Material::Model::microfacet && m.ior == 0.0f;
            require(is_infinite_ior || within(m.ior, 0.1f, 100.0f), "the index of refraction");
            require(is_finite_and_not_negative(m.specular_tint), "the specular color");
            require(within(m.specular_weight, 0.0f, 1.0f), "the specular factor");
            require(std::isfinite(m.normal_scale), "the scale of the normal map");
            for (const TextureUse* use : textures_of(m)) {
                const UvTransform& t = use->uv;
                require(is_finite(glm::vec3(t.offset + t.u_axis + t.v_axis, 0.0f)), "a texture transform");
                if (use->is_there() &&
                    (use->texture < 0 || static_cast<std::size_t>(use->texture) >= scene.textures.size())) {
                    fail("material '" + m.name + "' has a texture that is not there; add it");
                }
            }
        }
        for (const Texture& t : scene.textures) {
            const auto pixels = static_cast<std::size_t>(std::max(t.width, 0)) *
                                static_cast<std::size_t>(std::max(t.height, 0));
            if (pixels == 0 || t.texels.size() != pixels) fail("texture '" + t.name + "' has no pixels; replace it");
        }
    }

    /// Where a texture looks must be a number, with room for what interpolation adds.
    void texture_places() const {
        constexpr double most = static_cast<double>(std::numeric_limits<float>::max()) / 4.0;
        const auto reach = [](const UvTransform& t, const glm::dvec2& uv) {
            const glm::dvec2 sum = glm::abs(glm::dvec2(t.offset)) + std::abs(uv.x) * glm::abs(glm::dvec2(t.u_axis)) +
                                   std::abs(uv.y) * glm::abs(glm::dvec2(t.v_axis));
            return std::max(sum.x, sum.y);
        };
        std::vector<glm::dvec2> farthest;  // of each set
        for (const auto& uvs : scene.uv_sets) {
            glm::vec2 end(0.0f);
            for (const glm::vec2& uv : uvs) end = glm::max(end, glm::abs(uv));
            farthest.emplace_back(end);
        }
        const auto goes_too_far = [&](const TextureUse* use) {
            return use->is_there() && use->uv_set < farthest.size() && reach(use->uv, farthest[use->uv_set]) > most;
        };
        std::vector<bool> suspect(scene.materials.size());
        for (std::size_t i = 0; i < suspect.size(); ++i) {
            const auto uses = textures_of(scene.materials[i]);
            suspect[i] = std::any_of(uses.begin(), uses.end(), goes_too_far);
        }
        if (std::find(suspect.begin(), suspect.end(), true) == suspect.end()) return;
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            if (!suspect[scene.triangle_material[t]]) continue;
            const Material& m = scene.materials[scene.triangle_material[t]];
            for (const TextureUse* use : textures_of(m)) {
                if (!goes_too_far(use)) continue;
                for (int c = 0; c < 3; ++c) {
                    const std::uint32_t v = scene.triangles[t][c];
                    if (reach(use->uv, glm::dvec2(scene.uv_sets[use->uv_set][v])) <= most) continue;
                    fail("the uv of vertex " + std::to_string(v) + ", as the texture transform of material '" + m.name +
                         "' moves it, is too large; correct either");
                }
            }
        }
    }

    /// Power and intensity of what shines must be numbers.
    void emitters() const {
        if (std::none_of(scene.materials.begin(), scene.materials.end(),
                         [](const Material& m) { return m.emission != glm::vec3(0.0f); })) {
            return;
        }
        std::vector<double> areas(scene.materials.size());
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            const std::uint32_t material = scene.triangle_material[t];
            if (scene.materials[material].emission == glm::vec3(0.0f)) continue;
            areas[material] += Triangle(scene, static_cast<std::uint32_t>(t)).area();
        }
        std::map<int, glm::vec3> brightest{{no_texture, glm::vec3(1.0f)}};  // of each texture, at least 1
        for (std::size_t i = 0; i < areas.size(); ++i) {
            const Material& m = scene.materials[i];
            if (areas[i] == 0.0) continue;
            const auto [texel, is_new] = brightest.try_emplace(m.emission_texture.texture, glm::vec3(1.0f));
            if (is_new) {
                for (const glm::vec4& t : scene.textures[static_cast<std::size_t>(texel->first)].texels) {
                    texel->second = glm::max(texel->second, glm::vec3(t));
                }
            }
            const glm::dvec3 radiance = glm::dvec3(m.emission) * glm::dvec3(texel->second);
            const double power = 2.0 * std::numbers::pi * areas[i] * std::max({radiance.x, radiance.y, radiance.z});
            if (power > static_cast<double>(std::numeric_limits<float>::max())) {
                fail("material " + std::to_string(i) + " '" + m.name +
                     "': the light of its surfaces is more than a float can hold; correct its emission");
            }
        }
    }

    template <class L>
    void lights(const std::vector<L>& all, const char* kind) const {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string problem = problem_of(all[i]);
            if (!problem.empty()) fail(std::string(kind) + " light " + std::to_string(i) + ": " + problem);
        }
    }

    /// Empty if there is none.
    template <class L>
    static std::string problem_of(const L& light) {
        if (!is_finite_and_not_negative(light.intensity)) {
            return "the intensity " + text(light.intensity) + " is negative or not finite; correct it";
        }
        if constexpr (requires { light.position; }) {
            if (!is_finite(light.position))
                return "the position " + text(light.position) + " is not finite; correct it";
        }
        if constexpr (requires { light.radius; }) {
            if (!is_finite(light.center)) return "the center " + text(light.center) + " is not finite; correct it";
            if (!(light.radius > 0.0f && std::isfinite(light.radius))) {
                return "the radius " + text(light.radius) + " is not positive and finite; correct it";
            }
        }
        if constexpr (requires { light.axis; }) return axis_problem(light.axis);
        if constexpr (requires { light.direction; }) return axis_problem(light.direction);
        return {};
    }

    static std::string axis_problem(const glm::vec3& v) {
        if (!is_finite(v) || v == glm::vec3(0.0f)) {
            return "the direction " + text(v) + " has no length or is not finite; correct it";
        }
        if (std::abs(glm::length(v) - 1.0f) > 1e-3f) return "the direction " + text(v) + " is not a unit vector";
        return {};
    }
};

/// Exactly collinear in doubles: such a triangle has no normal, cannot be hit and emits nothing. One that moves has an
/// area if it has one at any step.
bool has_area(const Scene& scene, glm::uvec3 corner) {
    if (Triangle(scene, corner).cross() != glm::dvec3(0.0)) return true;
    const MovingVertices* part = motion_of(scene, corner.x);
    for (std::uint32_t step = 0; part && step < part->steps; ++step) {
        const glm::uvec3 there = corner - part->first + step * part->count;
        if (Triangle(part->positions, there).cross() != glm::dvec3(0.0)) return true;
    }
    return false;
}

void drop_flat_triangles(Scene& scene) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        if (!has_area(scene, scene.triangles[t])) continue;
        scene.triangles[kept] = scene.triangles[t];
        scene.triangle_material[kept] = scene.triangle_material[t];
        ++kept;
    }
    scene.dropped_triangles += scene.triangles.size() - kept;
    scene.triangles.resize(kept);
    scene.triangle_material.resize(kept);
}

void clip_reflectances(Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& m = scene.materials[i];
        for (glm::vec3* color : {&m.base_color, &m.specular, &m.diffuse_transmission_color}) {
            if (is_reflectance(*color)) continue;
            clip_reflectance(*color,
                             "a color " + text(*color) + " of material " + std::to_string(i) + " '" + m.name + "'",
                             scene.left_out);
        }
    }
    clip_reflectance(scene.colors, scene.left_out);
}

template <class L>
std::size_t drop_dark(std::vector<L>& lights) {
    return std::erase_if(lights, [](const L& light) { return light.intensity == glm::vec3(0.0f); });
}

}  // namespace

void validate(Scene& scene) {
    const Checker check{scene};
    check.sizes();
    check.vertices();
    check.motion();
    check.materials();
    check.texture_places();
    check.emitters();
    check.lights(scene.omni, "omni");
    check.lights(scene.oriented, "oriented");
    check.lights(scene.spots, "spot");
    check.lights(scene.directional, "directional");
    check.lights(scene.spheres, "spherical");
    check.lights(scene.at_instants.omni, "moving omni");
    check.lights(scene.at_instants.spots, "moving spot");
    check.lights(scene.at_instants.directional, "moving directional");
    check.lights(scene.at_instants.spheres, "moving spherical");
    if (std::none_of(scene.triangles.begin(), scene.triangles.end(),
                     [&](glm::uvec3 corner) { return has_area(scene, corner); })) {
        check.fail("every triangle has zero area; there is nothing to render");
    }

    drop_flat_triangles(scene);
    clip_reflectances(scene);
    scene.dropped_lights += drop_dark(scene.omni) + drop_dark(scene.oriented) + drop_dark(scene.spots) +
                            drop_dark(scene.directional) + drop_dark(scene.spheres) +
                            drop_dark(scene.at_instants.omni) + drop_dark(scene.at_instants.spots) +
                            drop_dark(scene.at_instants.directional) + drop_dark(scene.at_instants.spheres);
}

void require_lights(const Scene& scene) {
    if (scene.light_count() == 0 && scene.dropped_lights == 0) {
        throw lightcuts::invalid_input(
            scene.name +
            ": the scene has no lights; add some with --lights, --env or --sun-sky, or raise --area-points if "
            "it has emissive surfaces");
    }
}

}  // namespace render
