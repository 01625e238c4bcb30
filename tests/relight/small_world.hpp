#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/piecewise/even_directions.hpp>
#include <relight/bounce.hpp>
#include <relight/exhaustive.hpp>
#include <relight/illumination.hpp>
#include <relight/mesh.hpp>
#include <relight/patches.hpp>
#include <relight/relight_file.hpp>
#include <relight/relit_shader.hpp>
#include <relight/seen_points.hpp>
#include <relight/visibility_cuts.hpp>
#include <render/fingerprint.hpp>
#include <render/io/output_file.hpp>
#include <render/rays/ray_scene.hpp>

#include "support/temporary_folder.hpp"

inline const std::string two_materials =
    "newmtl gray\nKd 0.5 0.4 0.3\n"
    "newmtl shiny\nKd 0.2 0.1 0.1\nKs 0.4 0.5 0.6\nNs 30\nillum 2\n";

/// A floor under a block, in two materials.
inline const std::string block_over_floor =
    "mtllib m.mtl\n"
    "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
    "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n"
    "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
    "usemtl gray\nf 4 3 2 1\n"
    "usemtl shiny\nf 5 6 7 8\nf 12 11 10 9\nf 9 10 6 5\nf 10 11 7 6\nf 11 12 8 7\nf 12 9 5 8\n";

inline const std::string box_alone =
    "mtllib m.mtl\n"
    "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n"
    "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
    "usemtl shiny\nf 1 2 3 4\nf 8 7 6 5\nusemtl gray\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";

/// A closed room about `small_world`'s camera, of one material, seen from inside.
inline const std::string closed_room =
    "mtllib m.mtl\n"
    "v -8 -1 -8\nv 8 -1 -8\nv 8 -1 8\nv -8 -1 8\n"
    "v -8 9 -8\nv 8 9 -8\nv 8 9 8\nv -8 9 8\n"
    "usemtl gray\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A map with a bright spot and a gradient, different in all channels.
inline render::Picture small_map(int width = 32) {
    render::Picture map(width, width / 2);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(map.width);
            const float v = static_cast<float>(y) / static_cast<float>(map.height);
            glm::vec3 radiance(0.2f + u, 1.0f - v, 0.3f + u * v);
            if (x == width / 5 && y == width / 8) radiance = glm::vec3(60.0f, 50.0f, 40.0f);
            map.pixels[static_cast<std::size_t>(y * width + x)] = radiance;
        }
    }
    return map;
}

/// How the bounce of a small scene is prepared.
struct SmallBounce {
    std::size_t points = 0;  ///< 0: without
    double deviation = 0.002;
};

/// A small scene, prepared and looked at.
class SmallWorld {
public:
    SmallWorld(const std::string& obj, const relight::CutOptions& cuts, std::size_t directions, double edge = 0.0,
               int side = 32, const SmallBounce& bounce = {}) {
        folder.write("m.mtl", two_materials);
        folder.write("scene.obj", obj);
        render::Scene scene = relight::load_still_scene(folder / "scene.obj");
        relight::Preparation preparation{scene.name, render::occlusion_hash(scene), edge, cuts.sides, 0};
        mesh = relight::refined(std::move(scene), edge);
        preparation.sites = mesh.sites.sites.size();
        rays = std::make_unique<render::RayScene>(mesh.scene);
        const auto tree = relight::geometric_directions(lightcuts::even_directions(directions));
        const auto bytes = relight::visibility_cuts(tree, mesh.sites.sites, *rays, cuts, statistics);
        relight::Patches patches;
        std::vector<std::byte> of_bounce;
        if (bounce.points > 0) {
            patches = relight::spread_patches(mesh.scene, bounce.points, cuts.sides, 1);
            of_bounce = relight::bounce_cuts(patches, mesh.scene, mesh.sites.sites, *rays, bounce.deviation, cuts.sides,
                                             bounce_statistics);
        }
        const relight::StoredBounce stored{patches, of_bounce};
        content = relight::relight_file(preparation, tree, bytes, bounce.points > 0 ? &stored : nullptr);
        render::write_file(folder / "scene.relight", content);
        file = std::make_unique<relight::RelightFile>(folder / "scene.relight");
        render::Camera camera;
        camera.eye = {1.0, 5.0, 7.0};
        camera.target = {0.0, 0.5, 0.0};
        camera.up = {0.0f, 1.0f, 0.0f};
        seen = relight::see(mesh.scene, *rays, render::View(camera, mesh.scene.origin, side, side), 1, 1,
                            render::Shade::full);
    }

    const relight::Directions& directions() const { return file->directions(); }

    std::vector<glm::vec3> power(const render::Picture& map, double degrees = 0.0) const {
        const relight::NearestDirection nearest(directions().leaves);
        std::vector<glm::vec3> result(directions().size());
        relight::SplitMap(map, 1.0f, result.size(), "map").turn(degrees, nearest, result);
        return result;
    }

    std::vector<glm::vec3> relit(std::span<const glm::vec3> power, const relight::IlluminationOptions& light = {},
                                 const relight::RelitOptions& options = {}) const {
        relight::Illumination illumination(directions());
        illumination.set(power, light);
        std::vector<glm::vec3> radiance(seen.points.size());
        relight::RelitShader(*file, mesh.sites, seen).shade(illumination, options, radiance);
        return radiance;
    }

    std::vector<glm::vec3> exhaustive(std::span<const glm::vec3> power, relight::Truth truth) const {
        std::vector<glm::vec3> radiance(seen.points.size());
        relight::shade_exhaustively(seen, mesh.sites, directions(), power, *rays, file->preparation().sides, truth,
                                    false, radiance);
        return radiance;
    }

    const relight::Patches& patches() const { return file->patches(); }

    /// What the points reflect of light that surfaces reflected once, by cuts and by exhaustive sums.
    std::vector<glm::vec3> bounce(std::span<const glm::vec3> power, const relight::IlluminationOptions& light = {},
                                  const relight::BounceOptions& options = {}) const {
        relight::Illumination illumination(directions());
        illumination.set(power, light);
        std::vector<glm::vec3> radiance(seen.points.size(), glm::vec3(0.0f));
        relight::Bounce(*file, mesh.scene, mesh.sites, seen, render::Shade::full)
            .add(illumination, options, {}, radiance);
        return radiance;
    }

    std::vector<glm::vec3> exhaustive_bounce(std::span<const glm::vec3> power, relight::Truth truth) const {
        const relight::SeenPoints points = relight::points_of(patches(), mesh.scene, render::Shade::full);
        std::vector<glm::vec3> light(points.points.size());
        const relight::Sides sides = file->preparation().sides;
        relight::shade_exhaustively(points, mesh.sites, directions(), power, *rays, sides, truth, false, light);
        std::vector<glm::vec3> radiance(seen.points.size(), glm::vec3(0.0f));
        relight::add_bounce_exhaustively(seen, mesh.sites, patches(), mesh.scene, light, *rays, sides, truth, false,
                                         radiance);
        return radiance;
    }

    TemporaryFolder folder;
    relight::Mesh mesh;
    relight::CutStatistics statistics;
    relight::CutStatistics bounce_statistics;
    std::unique_ptr<render::RayScene> rays;
    std::vector<char> content;
    std::unique_ptr<relight::RelightFile> file;
    relight::SeenPoints seen;
};

/// |a - b| / |b| over all channels.
inline double relative_difference(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double off = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d(glm::dvec3(a[i]) - glm::dvec3(b[i]));
        off += glm::dot(d, d);
        whole += glm::dot(glm::dvec3(b[i]), glm::dvec3(b[i]));
    }
    return std::sqrt(off / whole);
}
