#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>

#include "render/refusal.hpp"
#include "small_world.hpp"

namespace {

TEST(RelightFile, DamageIsRefused) {
    const SmallWorld world(block_over_floor, {}, 64);
    const auto opened = [&](std::vector<char> content) {
        render::write_file(world.folder / "damaged.relight", content);
        const relight::RelightFile file(world.folder / "damaged.relight");
        lightcuts::PiecewiseConstant<float> cut;
        for (std::size_t i = 0; i < file.preparation().sites; ++i) file.read(i, cut);
    };
    opened(world.content);
    for (std::size_t i = 0; i < world.content.size(); i += 1 + world.content.size() / 150) {
        std::vector<char> content = world.content;
        content[i] = static_cast<char>(content[i] ^ 0x10);
        const std::string message = refusal([&] { opened(content); });
        EXPECT_NE(message.find("damaged.relight"), std::string::npos) << i << ": " << message;
        content = world.content;
        content.resize(i);
        refusal([&] { opened(content); });
    }
    std::vector<char> longer = world.content;
    longer.push_back('x');
    EXPECT_NE(refusal([&] { opened(longer); }).find("1 bytes too many"), std::string::npos);
}

TEST(RelightFile, AnotherMeshIsRefused) {
    const SmallWorld world(block_over_floor, {}, 64);
    render::Scene scene = relight::load_still_scene(world.folder / "scene.obj");
    world.file->require_scene(scene);
    scene.positions[3].y += 0.5f;
    EXPECT_NE(refusal([&] { world.file->require_scene(scene); }).find("another mesh"), std::string::npos);
}

TEST(RelightFile, MaterialsMayChange) {
    const SmallWorld world(block_over_floor, {}, 64);
    render::Scene scene = relight::load_still_scene(world.folder / "scene.obj");
    scene.materials[0].base_color = glm::vec3(0.1f, 0.9f, 0.2f);
    world.file->require_scene(scene);
    // But not what lets light pass.
    scene.materials[0].transmission = 0.5f;
    EXPECT_NE(render::occlusion_hash(scene), world.file->preparation().fingerprint);
}

}  // namespace
