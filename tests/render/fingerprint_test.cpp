#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <render/fingerprint.hpp>

namespace {

using render::Camera;
using render::Fingerprint;
using render::Options;
using render::Scene;

struct Pictured {
    Options options;
    Scene scene;
    Camera camera;
};

Pictured usual() {
    Pictured p;
    p.scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.scene.triangles = {{0, 1, 2}};
    p.scene.triangle_material = {0};
    p.scene.materials.resize(1);
    p.scene.textures.push_back({"t", 1, 1, {glm::vec4(0.5f)}});
    p.scene.omni.push_back({{0, 0, 1}, glm::vec3(1.0f)});
    return p;
}

Fingerprint print_of(const Pictured& p) {
    const render::RayScene rays(p.scene);
    return fingerprint_of(p.options, p.scene, p.camera, rays, "1.0");
}

TEST(Fingerprint, SurvivesItsText) {
    const Fingerprint print = print_of(usual());
    EXPECT_EQ(Fingerprint::parse(print.text()).text(), print.text());
    EXPECT_EQ(Fingerprint::parse(print.text()).difference(print), "");
    EXPECT_NE(Fingerprint::parse("no fingerprint").difference(print), "");
}

TEST(Fingerprint, NamesWhateverChangesThePicture) {
    const Fingerprint before = print_of(usual());
    const std::pair<const char*, std::function<void(Pictured&)>> changes[] = {
        {"--size (640x480, now 641x480)", [](Pictured& p) { p.options.width = 641; }},
        {"--error-ratio (0.02, now 0.020000001)", [](Pictured& p) { p.options.error_ratio = 0.020000001f; }},
        {"--method (lightcuts, now ward)", [](Pictured& p) { p.options.method = "ward"; }},
        {"--adaptation (0, now auto)", [](Pictured& p) { p.options.adaptation.reset(); }},
        {"--clamp (auto, now inf), --clamp-ratio (0.01, now inf)", [](Pictured& p) { p.options.clamp = {}; }},
        {"--method (lightcuts, now multidimensional)", [](Pictured& p) { p.options.method = "multidimensional"; }},
        {"--method (lightcuts, now multidimensional), --clamp (auto, now auto, by share)",
         [](Pictured& p) {
             p.options.method = "multidimensional";
             p.options.given = {"--clamp"};
         }},
        {"--aov (none, now depth)", [](Pictured& p) { p.options.aovs = {"depth"}; }},
        {"--later (not given, now 3)",
         [](Pictured& p) {
             p.options.given = {"--threads", "--later"};
             p.options.given_texts = {"7", "3"};
         }},
        {"--time (0, now 2)", [](Pictured& p) { p.options.shutter.opens = 2.0; }},
        {"--shutter (0, now 0.5)", [](Pictured& p) { p.options.shutter.seconds = 0.5; }},
        {"--instants (1, now 8)", [](Pictured& p) { p.options.shutter.instants = 8; }},
        {"--shutter-shape (gaussian, now box)",
         [](Pictured& p) { p.options.shutter.shape = render::ShutterShape::box; }},
        {"the camera", [](Pictured& p) { p.camera.at_instants.resize(2); }},
        {"the camera", [](Pictured& p) { p.camera.up.x = 0.1f; }},
        {"the scene's triangles", [](Pictured& p) { p.scene.positions[1].x = 1.0000001f; }},
        {"the scene's triangles", [](Pictured& p) { p.scene.normals.resize(3); }},
        {"the scene's triangles",
         [](Pictured& p) {
             p.scene.moving.push_back({0, 3, 2, std::vector<glm::vec3>(6, glm::vec3(1.0f)), {}, {}});
         }},
        {"the lights", [](Pictured& p) { p.scene.at_instants.spots.resize(1); }},
        {"the scene's materials", [](Pictured& p) { p.scene.materials[0].roughness = 0.9f; }},
        {"the scene's materials", [](Pictured& p) { p.scene.materials[0].emission_texture.uv.offset.y = 0.1f; }},
        {"the scene's materials", [](Pictured& p) { p.scene.textures[0].texels[0].w = 0.4f; }},
        {"the lights", [](Pictured& p) { p.scene.omni[0].intensity.z = 2.0f; }},
        {"the lights", [](Pictured& p) { p.scene.virtual_lights.resize(1); }},
        {"the lights", [](Pictured& p) { p.scene.volume_lights.resize(1); }},
        {"the lights", [](Pictured& p) { p.scene.at_instants.volume_lights.resize(1); }},
        {"the surroundings",
         [](Pictured& p) { p.scene.background.environment = render::Environment{render::Picture(2, 1)}; }},
        {"the surroundings", [](Pictured& p) { p.scene.background.daylight.emplace(lightcuts::SunPosition{}); }},
    };
    for (const auto& [told, change] : changes) {
        Pictured changed = usual();
        change(changed);
        EXPECT_EQ(before.difference(print_of(changed)), told);
    }
}

TEST(Fingerprint, LeavesOutWhatChangesNoPicture) {
    const Fingerprint before = print_of(usual());
    Pictured changed = usual();
    changed.options.threads = 3;
    changed.options.quiet = true;
    changed.options.output = "other.exr";
    changed.options.reference = "reference.exr";
    changed.options.resume = true;
    changed.options.scene = "other.glb";
    changed.options.given = {"SCENE", "--threads", "--quiet", "--output", "--reference", "--resume", "--spp"};
    changed.options.given_texts = {"other.glb", "3", "true", "other.exr", "reference.exr", "true", "1"};
    changed.scene.name = "other";
    changed.camera.name = "north";
    EXPECT_EQ(before.difference(print_of(changed)), "");
}

/// Triangles, and what those are made of that let light pass; nothing else.
TEST(OcclusionHash, IsOfAllThatShadowRaysDependOn) {
    const auto pane = [] {
        Scene s = usual().scene;
        s.uv_sets = {{{0, 0}, {1, 0}, {0, 1}}};
        s.colors = {glm::vec4(1.0f), glm::vec4(1.0f), glm::vec4(1.0f)};
        s.materials.resize(2);
        s.materials[0].transmission = 0.5f;
        s.materials[0].base_color_texture.texture = 0;
        return s;
    };
    const std::uint64_t before = occlusion_hash(pane());
    const std::function<void(Scene&)> changes[] = {
        [](Scene& s) { s.positions[1].x = 2.0f; },
        [](Scene& s) { s.origin.y = 1.0; },
        [](Scene& s) {
            s.triangles[0] = {0, 2, 1};
        },
        [](Scene& s) { s.triangle_material[0] = 1; },
        [](Scene& s) { s.colors[2].w = 0.5f; },
        [](Scene& s) { s.uv_sets[0][1].x = 0.5f; },
        [](Scene& s) { s.materials[0].transmission = 0.6f; },
        [](Scene& s) { s.materials[0].base_color.y = 0.1f; },
        [](Scene& s) { s.materials[0].base_color_texture.uv.u_axis.x = 2.0f; },
        [](Scene& s) { s.materials[1].transmission = 0.1f; },
        [](Scene& s) { s.textures[0].texels[0].x = 0.25f; },
        [](Scene& s) { s.textures[0].wrap_u = render::Texture::Wrap::clamp; },
    };
    for (const auto& change : changes) {
        Scene changed = pane();
        change(changed);
        EXPECT_NE(occlusion_hash(changed), before) << &change - changes;
    }
    Scene repainted = pane();
    repainted.name = "other";
    repainted.materials[1].base_color.x = 0.1f;
    repainted.omni.clear();
    EXPECT_EQ(occlusion_hash(repainted), before);
    // Where nothing lets light pass, materials do not count.
    Scene wall = pane();
    wall.materials[0].transmission = 0.0f;
    const std::uint64_t of_wall = occlusion_hash(wall);
    wall.materials[0].base_color.y = 0.1f;
    wall.triangle_material[0] = 1;
    EXPECT_EQ(occlusion_hash(wall), of_wall);
}

}  // namespace
