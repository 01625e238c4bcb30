#include "fingerprint.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/content_hash.hpp"
#include "io/escape.hpp"
#include "surfaces/surface_colors.hpp"

namespace render {

namespace {

/// Options that change no picture, and those whose whole effect is in the hashes of the scene and the camera.
constexpr std::string_view not_compared[] = {"SCENE",    "--output", "--threads", "--quiet", "--reference",
                                             "--resume", "--eye",    "--target",  "--up",    "--camera",
                                             "--fov",    "--lights", "--env",     "--isa"};

std::string text_of(const std::string& value) { return value; }
/// The shortest that is read as the same number.
template <class Number>
std::string text_of(Number value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
}

std::string text_of(const ContentHash& hash) {
    char text[17] = {};
    std::to_chars(text, text + sizeof text, hash.value(), 16);
    return std::string("#") + text;
}

void add_options(Fingerprint& print, const Options& o) {
    std::vector<std::string_view> known(std::begin(not_compared), std::end(not_compared));
    const auto add = [&](const char* name, const auto& value) {
        known.push_back(name);
        print.add(name, text_of(value));
    };
    add("--size", text_of(o.width) + "x" + text_of(o.height));
    add("--spp", o.spp);
    add("--seed", o.seed);
    add("--time", o.shutter.opens);
    add("--shutter", o.shutter.seconds);
    add("--instants", o.shutter.instants);
    add("--shutter-shape", name_of(o.shutter.shape));
    add("--method", o.method);
    add("--error-ratio", o.error_ratio);
    add("--max-cut", o.max_cut);
    add("--representatives", o.representatives);
    add("--adaptation", o.adaptation ? text_of(*o.adaptation) : "auto");
    add("--learn-visibility", std::string(o.learn_visibility ? "yes" : "no"));
    add("--samples", o.samples);
    add("--ward-threshold", o.ward_threshold);
    add("--candidates", o.candidates);
    add("--splitting-threshold", o.splitting_threshold);
    add("--builder", o.builder);
    add("--visibility-bounds", o.visibility_bounds);
    add("--pair-sides", o.pair_sides);
    add("--area-points", o.area_points);
    add("--area-lights", o.area_lights ? text_of(*o.area_lights) : "usual");
    add("--env-lights", o.env_lights);
    add("--env-scale", o.env_scale);
    add("--env-rotate", o.env_rotate);
    add("--sun-sky", o.sun_sky ? text_of(o.sun_sky->elevation) + "," + text_of(o.sun_sky->azimuth) : "no");
    add("--turbidity", o.turbidity);
    add("--sky-lights", o.sky_lights);
    add("--ground", o.ground);
    add("--indirect", o.indirect);
    const bool by_share = o.sums_pixels() && o.clamping().is_automatic();
    add("--clamp", by_share ? "auto, by share" : o.clamp.is_automatic() ? "auto" : text_of(o.clamp.radiance));
    add("--clamp-ratio", o.clamp.ratio);
    add("--fog", o.fog);
    add("--fog-albedo", o.fog_albedo);
    add("--fog-anisotropy", o.fog_anisotropy);
    add("--aperture", o.aperture);
    add("--focus", o.focus ? text_of(*o.focus) : "target");
    add("--filter", o.filter);
    add("--materials", std::string(o.diffuse_materials ? "diffuse" : "full"));
    add("--aov", listed(o.aovs));
    // An option that is not among these may change the picture: it is part of the fingerprint.
    for (std::size_t i = 0; i < o.given.size() && i < o.given_texts.size(); ++i) {
        const bool is_known = std::find(known.begin(), known.end(), o.given[i]) != known.end();
        if (!is_known) print.add(o.given[i], as_utf8(o.given_texts[i]));
    }
}

// Each of these takes its object apart into all of its members, so that a member that is added and left out here is a
// compile error.

void add_to(ContentHash& hash, const TextureUse& use) {
    const auto& [texture, uv_set, uv] = use;
    const auto& [offset, u_axis, v_axis] = uv;
    hash.add(texture).add(uv_set).add(offset).add(u_axis).add(v_axis);
}

void add_to(ContentHash& hash, const Material& material) {
    const auto& [name, model, base_color, base_color_texture, metallic, roughness, metallic_roughness_texture, specular,
                 specular_tint, specular_texture, specular_weight, specular_weight_texture, exponent, ior, transmission,
                 diffuse_transmission, diffuse_transmission_texture, diffuse_transmission_color,
                 diffuse_transmission_color_texture, normal_texture, normal_scale, emission, emission_texture,
                 double_sided, only_seen, alpha, alpha_cutoff, base_alpha, alpha_texture] = material;
    hash.add(model).add(base_color).add(metallic).add(roughness).add(specular).add(specular_tint);
    hash.add(specular_weight).add(exponent).add(ior).add(transmission).add(diffuse_transmission);
    hash.add(diffuse_transmission_color).add(normal_scale).add(emission).add(double_sided).add(only_seen);
    hash.add(alpha).add(alpha_cutoff).add(base_alpha);
    for (const TextureUse* use : textures_of(material)) add_to(hash, *use);
}

void add_to(ContentHash& hash, const Texture& texture) {
    const auto& [name, width, height, texels, wrap_u, wrap_v, filter] = texture;
    hash.add(width).add(height).add(texels).add(wrap_u).add(wrap_v).add(filter);
}

void add_to(ContentHash& hash, const MovingVertices& part) {
    const auto& [first, count, steps, positions, normals, tangents] = part;
    hash.add(first).add(count).add(steps).add(positions).add(normals).add(tangents);
}

void add_to(ContentHash& hash, const Environment& environment) {
    const auto& [picture, scale, rotation] = environment;
    hash.add(picture.width).add(picture.height).add(picture.pixels).add(scale).add(rotation);
}

void add_to(ContentHash& hash, const Background& background) {
    const auto& [environment, daylight] = background;
    if (environment) add_to(hash, *environment);
    // The sky's parameters are not stored; its radiance in a few directions differs wherever they do.
    if (!daylight) return;
    hash.add(glm::vec3(daylight->towards_sun())).add(daylight->sun_radiance()).add(daylight->ground_radiance());
    for (const float height : {0.1f, 0.5f, 0.9f}) hash.add(daylight->sky_radiance(glm::dvec3(0.3, height, 0.2)));
}

void add_scene(Fingerprint& print, const Scene& scene) {
    // Left out: names, counts and messages, and `lighting`, from which the lights and the background were made.
    const auto& [name, origin, positions, normals, tangents, colors, uv_sets, triangles, triangle_material, materials,
                 textures, cameras, omni, oriented, spots, directional, spheres, sphere_points, virtual_lights,
                 volume_lights, environment_lights, sun_lights, sky_lights, ground_lights, moving, rigid_motions,
                 at_instants, instants, lighting, background, fog, dropped_triangles, dropped_lights, left_out,
                 files] = scene;
    ContentHash surfaces, matter, lights, around;
    surfaces.add(origin).add(positions).add(normals).add(tangents).add(colors).add(uv_sets.size());
    for (const std::vector<glm::vec2>& uvs : uv_sets) surfaces.add(uvs);
    surfaces.add(triangles).add(triangle_material);
    for (const MovingVertices& part : moving) add_to(surfaces, part);
    for (const Material& material : materials) add_to(matter, material);
    for (const Texture& texture : textures) add_to(matter, texture);
    lights.add(omni).add(oriented).add(spots).add(directional).add(spheres).add(sphere_points).add(virtual_lights);
    lights.add(volume_lights);
    const auto& [moving_omni, moving_oriented, moving_spots, moving_directional, moving_spheres, moving_sphere_points,
                 moving_virtual_lights, moving_volume_lights] = at_instants;
    lights.add(moving_omni).add(moving_oriented).add(moving_spots).add(moving_directional).add(moving_spheres);
    lights.add(moving_sphere_points).add(moving_virtual_lights).add(moving_volume_lights);
    add_to(around, background);
    print.add("the scene's triangles", text_of(surfaces));
    print.add("the scene's materials", text_of(matter));
    print.add("the lights", text_of(lights));
    print.add("the surroundings", text_of(around));
}

void add_camera(Fingerprint& print, const Camera& camera) {
    const auto& [name, eye, target, up, vertical_fov, height, other_name, at_instants] = camera;
    ContentHash hash;
    hash.add(eye).add(target).add(up).add(vertical_fov).add(height);
    for (const CameraPose& pose : at_instants) hash.add(pose.eye).add(pose.target).add(pose.up);
    print.add("the camera", text_of(hash));
}

/// Version and kinds of instructions: rays may differ by a rounding between them.
std::string ray_tracer(const RayScene& rays) {
    std::string text = "Embree " + rays.tracer().version() + " by " + rays.tracer().isa();
#if defined(__x86_64__)
    // The C library chooses among its functions by these.
    if (__builtin_cpu_supports("avx2")) text += ", AVX2";
    if (__builtin_cpu_supports("avx512f")) text += ", AVX-512";
#endif
    return text;
}

std::string told(const std::string& name, const std::string* before, const std::string* now) {
    const auto value = [](const std::string* v) { return v ? v->empty() ? "none" : *v : "not given"; };
    const bool is_hash = (before && before->starts_with('#')) || (now && now->starts_with('#'));
    return is_hash ? name : name + " (" + value(before) + ", now " + value(now) + ")";
}

}  // namespace

std::string Fingerprint::text() const { return nlohmann::json(items_).dump(); }

Fingerprint Fingerprint::parse(const std::string& text) {
    Fingerprint print;
    try {
        nlohmann::json::parse(text).get_to(print.items_);
    } catch (const nlohmann::json::exception&) { print.add("everything", "#"); }
    return print;
}

std::string Fingerprint::difference(const Fingerprint& now) const {
    const auto value_in = [](const Fingerprint& print, const std::string& name) -> const std::string* {
        const auto at = std::find_if(print.items_.begin(), print.items_.end(),
                                     [&](const auto& item) { return item.first == name; });
        return at == print.items_.end() ? nullptr : &at->second;
    };
    std::string text;
    const auto add = [&](const std::string& name, const std::string* before, const std::string* after) {
        if (before && after && *before == *after) return;
        text += (text.empty() ? "" : ", ") + told(name, before, after);
    };
    for (const auto& [name, value] : items_) add(name, &value, value_in(now, name));
    for (const auto& [name, value] : now.items_) {
        if (!value_in(*this, name)) add(name, nullptr, &value);
    }
    return text;
}

Fingerprint fingerprint_of(const Options& options, const Scene& scene, const Camera& camera, const RayScene& rays,
                           const std::string& program) {
    Fingerprint print;
    print.add("lightcuts-render", program);
    print.add("the ray tracer", ray_tracer(rays));
    add_options(print, options);
    add_camera(print, camera);
    add_scene(print, scene);
    return print;
}

std::uint64_t occlusion_hash(const Scene& scene) {
    ContentHash hash;
    hash.add(scene.origin).add(scene.positions).add(scene.triangles);
    const std::vector<bool> passes = transmissive_materials(scene);
    if (std::find(passes.begin(), passes.end(), true) == passes.end()) return hash.value();
    hash.add(scene.triangle_material).add(scene.colors);
    for (const std::vector<glm::vec2>& uvs : scene.uv_sets) hash.add(uvs);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!passes[i]) continue;
        const Material& material = scene.materials[i];
        hash.add(i);
        add_to(hash, material);
        for (const TextureUse* use : textures_of(material)) {
            if (use->is_there()) add_to(hash, scene.textures[static_cast<std::size_t>(use->texture)]);
        }
    }
    return hash.value();
}

}  // namespace render
