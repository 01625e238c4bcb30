#include "scene_hash.hpp"

#include <render/io/content_hash.hpp>

namespace daylighting {

std::uint64_t scene_hash(const render::Scene& scene) {
    render::ContentHash hash;
    for (int c = 0; c < 3; ++c) hash.add(scene.origin[c]);
    hash.add(scene.positions).add(scene.triangles).add(scene.triangle_material).add(scene.colors);
    for (const auto& uvs : scene.uv_sets) hash.add(uvs);
    for (const render::Material& m : scene.materials) {
        hash.add(m.base_color).add(m.transmission).add(m.alpha).add(m.alpha_cutoff).add(m.base_alpha).add(m.model);
        for (const render::TextureUse* use : render::textures_of(m)) hash.add(use->texture).add(use->uv_set);
    }
    for (const render::Texture& t : scene.textures) hash.add(t.width).add(t.texels);
    return hash.value();
}

}  // namespace daylighting
