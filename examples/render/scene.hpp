#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <lightcuts/light/clampable.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/product/timed_light.hpp>
#include <lightcuts/source/sphere.hpp>

#include "fog.hpp"
#include "io/left_out.hpp"
#include "lights/background.hpp"
#include "lights/lighting.hpp"
#include "moving_vertices.hpp"

namespace render {

/// Pixels in linear light; u to the right, v downwards.
struct Texture {
    enum class Wrap { repeat, clamp, mirror };  ///< what lies outside [0, 1)
    enum class Filter { linear, nearest };      ///< what lies between texels

    std::string name;
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;  ///< row by row from the top
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Filter filter = Filter::linear;

    glm::vec4 sample(glm::vec2 uv) const;
};

inline constexpr int no_texture = -1;

/// Where in a texture a surface's uv looks: an affine map, the identity unless the scene file says otherwise.
struct UvTransform {
    glm::vec2 offset{0.0f};
    glm::vec2 u_axis{1.0f, 0.0f};
    glm::vec2 v_axis{0.0f, 1.0f};

    glm::vec2 operator()(glm::vec2 uv) const { return offset + uv.x * u_axis + uv.y * v_axis; }
};

/// How a material looks a value up in a texture.
struct TextureUse {
    int texture = no_texture;  ///< in Scene::textures
    std::uint32_t uv_set = 0;  ///< in Scene::uv_sets
    UvTransform uv;

    bool is_there() const { return texture != no_texture; }
};

/// What a surface does with light, as the scene file states it. Colors are linear.
struct Material {
    /// microfacet: glTF; specular_glossiness: its older extension; unlit: emits its base color and reflects nothing;
    /// the others: OBJ's illum and Ks.
    enum class Model { microfacet, specular_glossiness, unlit, phong, mirror, glass };
    enum class Alpha { opaque, mask, blend };

    std::string name;
    Model model = Model::microfacet;
    /// microfacet: base color; specular_glossiness: diffuse albedo; phong: Kd; mirror: reflectance; glass: tint. Times
    /// the vertex color.
    glm::vec3 base_color{0.8f};
    TextureUse base_color_texture;
    float metallic = 0.0f;   ///< microfacet
    float roughness = 1.0f;  ///< microfacet; specular_glossiness: 1 - glossiness
    TextureUse metallic_roughness_texture;
    glm::vec3 specular{0.0f};       ///< phong: Ks; specular_glossiness: reflectance at normal incidence
    glm::vec3 specular_tint{1.0f};  ///< microfacet: of what `ior` says that a dielectric reflects at normal incidence
    TextureUse specular_texture;    ///< times these; specular_glossiness: and, in its alpha, times 1 - roughness
    float specular_weight = 1.0f;   ///< microfacet: times a dielectric's reflection at all angles
    TextureUse specular_weight_texture;  ///< in its alpha
    float exponent = 0.0f;               ///< phong: Ns
    float ior = 1.5f;                    ///< glass; microfacet, where 0 means infinite
    float transmission = 0.0f;           ///< share of light that a shadow ray keeps, times base_color (1 for glass)
    float diffuse_transmission = 0.0f;   ///< share of the diffuse part that takes light from behind
    TextureUse diffuse_transmission_texture;     ///< in its alpha
    glm::vec3 diffuse_transmission_color{1.0f};  ///< that share's
    TextureUse diffuse_transmission_color_texture;
    TextureUse normal_texture;  ///< bends the shading normal
    float normal_scale = 1.0f;
    glm::vec3 emission{0.0f};  ///< emitted radiance
    TextureUse emission_texture;
    bool double_sided = false;  ///< an emitter emits on both sides
    bool only_seen = false;     ///< its emission lights nothing: other lights of the scene stand for it
    Alpha alpha = Alpha::opaque;
    float alpha_cutoff = 0.5f;
    float base_alpha = 1.0f;
    TextureUse alpha_texture;  ///< its alpha stands in for the base color texture's, where there is one
};

/// All places in which a material may name a texture.
inline std::array<const TextureUse*, 9> textures_of(const Material& m) {
    return {&m.base_color_texture,
            &m.metallic_roughness_texture,
            &m.specular_texture,
            &m.specular_weight_texture,
            &m.diffuse_transmission_texture,
            &m.diffuse_transmission_color_texture,
            &m.normal_texture,
            &m.emission_texture,
            &m.alpha_texture};
}

/// Where a camera stands and looks.
struct CameraPose {
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0, 0.0, -1.0};
    glm::vec3 up{0.0f, 1.0f, 0.0f};

    bool operator==(const CameraPose&) const = default;
};

/// In world coordinates.
struct Camera {
    std::string name;
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0, 0.0, -1.0};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vertical_fov = 45.0f;             ///< degrees
    double height = 0.0;                    ///< of the view of an orthographic camera; 0: perspective
    std::string other_name{};               ///< by which it can be chosen, too
    std::vector<CameraPose> at_instants{};  ///< at each of the scene's; empty: it does not move
};

/// Lights that exist at one of the scene's instants each, at which alone they light anything: one that moves is one for
/// each instant.
struct LightsAtInstants {
    std::vector<lightcuts::InstantLight<lightcuts::OmniLight<>>> omni;
    std::vector<lightcuts::InstantLight<lightcuts::OrientedPointLight<>>> oriented;
    std::vector<lightcuts::InstantLight<lightcuts::SpotLight<>>> spots;
    std::vector<lightcuts::InstantLight<lightcuts::DistantLight<>>> directional;
    std::vector<lightcuts::InstantLight<lightcuts::SphereLight<>>> spheres;
    std::vector<lightcuts::InstantLight<lightcuts::SpherePointLight<>>> sphere_points;  ///< in `spheres` of these
    std::vector<lightcuts::InstantLight<lightcuts::VirtualPointLight<>>> virtual_lights;
    std::vector<lightcuts::InstantLight<lightcuts::VirtualVolumeLight<>>> volume_lights;

    /// Those that stand for indirect light.
    std::size_t virtual_count() const { return virtual_lights.size() + volume_lights.size(); }
    /// Those that are added up at a point: spheres count by their points.
    std::size_t count() const {
        return omni.size() + oriented.size() + spots.size() + directional.size() + sphere_points.size() +
               virtual_count();
    }
};

/// A triangle mesh with everything that lights it and looks at it. Per-vertex arrays have one entry a position, or
/// none at all: a scene without colors has no array of them. Positions, also those of lights, are world coordinates
/// less `origin`. Of what moves, they show where it is as the shutter opens.
struct Scene {
    std::string name;
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< empty, or per vertex; a zero normal asks for the flat face's
    std::vector<glm::vec4> tangents;  ///< empty, or per vertex: along u, and the sign of the bitangent; 0: from the uvs
    std::vector<glm::vec4> colors;    ///< empty, or per vertex, in [0, 1]: times base color and alpha
    std::vector<std::vector<glm::vec2>> uv_sets;  ///< each empty, or per vertex
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> triangle_material;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Camera> cameras;

    std::vector<lightcuts::OmniLight<>> omni;
    std::vector<lightcuts::OrientedPointLight<>> oriented;
    std::vector<lightcuts::SpotLight<>> spots;
    std::vector<lightcuts::DistantLight<>> directional;
    std::vector<lightcuts::SphereLight<>> spheres;
    std::vector<lightcuts::SpherePointLight<>> sphere_points;    ///< in `spheres`
    std::vector<lightcuts::VirtualPointLight<>> virtual_lights;  ///< on surfaces
    std::vector<lightcuts::VirtualVolumeLight<>> volume_lights;  ///< in fog
    std::size_t environment_lights = 0;                          ///< of `directional`: those of the environment map
    std::size_t sun_lights = 0;                                  ///< likewise
    std::size_t sky_lights = 0;
    std::size_t ground_lights = 0;

    std::vector<MovingVertices> moving;      ///< in ascending order, apart from one another
    std::vector<RigidMotion> rigid_motions;  ///< that are still to be applied
    LightsAtInstants at_instants;
    /// When the instants are, ascending, from 0 as the shutter opens to 1 as it closes; empty if nothing moves.
    std::vector<float> instants;

    Lighting lighting;
    Background background;
    Fog fog;

    std::size_t dropped_triangles = 0;         ///< of zero area, left out when the scene was checked
    std::size_t dropped_lights = 0;            ///< of zero intensity, left out likewise
    LeftOutList left_out;                      ///< of what the files carry
    std::vector<std::filesystem::path> files;  ///< from which it was read

    /// Those that are added up at a point, of all kinds: spheres count by their points.
    std::size_t light_count() const {
        return omni.size() + oriented.size() + spots.size() + directional.size() + sphere_points.size() +
               virtual_lights.size() + volume_lights.size() + at_instants.count();
    }
    /// Those that stand for indirect light, at instants or not.
    std::size_t virtual_count() const {
        return virtual_lights.size() + volume_lights.size() + at_instants.virtual_count();
    }
    /// Nothing moves, neither what is seen nor the camera.
    bool is_still() const { return instants.empty(); }
    /// What light there is differs between instants.
    bool light_moves() const { return !moving.empty() || at_instants.count() > 0; }
};

}  // namespace render
