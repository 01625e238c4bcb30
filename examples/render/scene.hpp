#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <lightcuts/light/clamped.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/source/sphere.hpp>

#include "background.hpp"
#include "lighting.hpp"

namespace render {

/// Pixels in linear light; u to the right, v downwards.
struct Texture {
    enum class Wrap { repeat, clamp, mirror };  ///< what lies outside [0, 1)

    std::string name;
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;  ///< row by row from the top
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;

    glm::vec4 sample(glm::vec2 uv) const;  ///< bilinear
};

inline constexpr int no_texture = -1;

/// Where in a texture a surface's uv looks: an affine map, the identity unless the scene file says otherwise.
struct UvTransform {
    glm::vec2 offset{0.0f};
    glm::vec2 u_axis{1.0f, 0.0f};
    glm::vec2 v_axis{0.0f, 1.0f};

    glm::vec2 operator()(glm::vec2 uv) const { return offset + uv.x * u_axis + uv.y * v_axis; }
};

/// What a surface does with light, as the scene file states it. Colours are linear.
struct Material {
    enum class Model { microfacet, phong, mirror, glass };  ///< microfacet: glTF; the others: OBJ's illum and Ks
    enum class Alpha { opaque, mask, blend };

    std::string name;
    Model model = Model::microfacet;
    glm::vec3 base_color{0.8f};  ///< microfacet: base colour; phong: Kd; mirror: reflectance; glass: tint
    int base_color_texture = no_texture;
    UvTransform base_color_uv;
    float metallic = 0.0f;
    float roughness = 1.0f;
    int metallic_roughness_texture = no_texture;
    UvTransform metallic_roughness_uv;
    glm::vec3 specular{0.0f};           ///< phong: Ks
    float exponent = 0.0f;              ///< phong: Ns
    float ior = 1.5f;                   ///< glass
    float transmission = 0.0f;          ///< share of light that a shadow ray keeps, times base_color (1 for glass)
    float diffuse_transmission = 0.0f;  ///< share of the diffuse part that takes light from behind
    int diffuse_transmission_texture = no_texture;  ///< in its alpha
    UvTransform diffuse_transmission_uv;
    glm::vec3 diffuse_transmission_color{1.0f};  ///< that share's
    int diffuse_transmission_color_texture = no_texture;
    UvTransform diffuse_transmission_color_uv;
    glm::vec3 emission{0.0f};  ///< emitted radiance
    int emission_texture = no_texture;
    UvTransform emission_uv;
    bool double_sided = false;  ///< an emitter emits on both sides
    bool only_seen = false;     ///< its emission lights nothing: other lights of the scene stand for it
    Alpha alpha = Alpha::opaque;
    float alpha_cutoff = 0.5f;
    float base_alpha = 1.0f;
    int alpha_texture = no_texture;  ///< its alpha stands in for the base colour texture's, where there is one
};

struct Camera {
    std::string name;
    glm::vec3 eye{0.0f};
    glm::vec3 target{0.0f, 0.0f, -1.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vertical_fov = 45.0f;  ///< degrees
};

/// A triangle mesh with everything that lights it and looks at it. Per-vertex arrays have one entry a position, or
/// none at all: a scene without uvs has no uv array.
struct Scene {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< empty, or per vertex; a zero normal asks for the flat face's
    std::vector<glm::vec2> uvs;      ///< empty, or per vertex
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
    std::vector<lightcuts::SpherePointLight<>> sphere_points;  ///< in `spheres`
    std::vector<lightcuts::VirtualLight<>> virtual_lights;
    std::size_t environment_lights = 0;  ///< of `directional`: those of the environment map
    std::size_t sun_lights = 0;          ///< likewise
    std::size_t sky_lights = 0;
    std::size_t ground_lights = 0;

    Lighting lighting;
    Background background;

    std::size_t dropped_triangles = 0;  ///< of zero area, left out when the scene was checked
    std::size_t dropped_lights = 0;     ///< of zero intensity, left out likewise

    /// Those that are added up at a point, of all kinds: spheres count by their points.
    std::size_t light_count() const {
        return omni.size() + oriented.size() + spots.size() + directional.size() + sphere_points.size() +
               virtual_lights.size();
    }
};

}  // namespace render
