#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/surfaces/surface.hpp>

namespace {

using render::EyePathTracer;
using render::EyeRay;
using render::EyeRaySeen;
using render::Material;
using render::RayScene;
using render::Scene;
using render::Shade;
using render::SurfacePoint;

/// Squares of side 2 with the normal +z, one above the other.
struct Stack {
    Scene scene;

    Material& add(float z) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (const glm::vec3 p : {glm::vec3(-1, -1, z), glm::vec3(1, -1, z), glm::vec3(1, 1, z), glm::vec3(-1, 1, z)}) {
            scene.positions.push_back(p);
        }
        scene.triangles.push_back({first, first + 1, first + 2});
        scene.triangles.push_back({first, first + 2, first + 3});
        const auto material = static_cast<std::uint32_t>(scene.materials.size());
        scene.triangle_material.insert(scene.triangle_material.end(), 2, material);
        scene.materials.emplace_back();
        scene.materials.back().base_color = glm::vec3(0.5f);
        return scene.materials.back();
    }
};

const EyeRay from_above{{0.2f, 0.1f, 10.0f}, {0.0f, 0.0f, -1.0f}};
const EyeRay from_below{{0.2f, 0.1f, -10.0f}, {0.0f, 0.0f, 1.0f}};

struct Found {
    EyeRaySeen seen;
    std::vector<SurfacePoint> points;
};

Found follow(const Scene& scene, const EyeRay& ray, Shade shade = Shade::full) {
    const RayScene rays(scene);
    Found found;
    found.seen = EyePathTracer(scene, rays, shade).follow(ray, 3, 2, found.points);
    return found;
}

TEST(Surface, TurnsBothNormalsToTheViewer) {
    Stack stack;
    stack.add(0.0f);
    stack.scene.normals.assign(4, glm::normalize(glm::vec3(0.3f, 0.0f, 1.0f)));
    for (const EyeRay& ray : {from_above, from_below}) {
        const Found found = follow(stack.scene, ray);
        ASSERT_EQ(found.points.size(), 1u);
        const SurfacePoint& p = found.points[0];
        EXPECT_GT(glm::dot(p.geometric_normal, p.to_viewer), 0.99f);
        EXPECT_GT(glm::dot(p.shading_normal, p.to_viewer), 0.9f);
        EXPECT_GT(glm::dot(p.ray_origin - p.position, p.geometric_normal), 0.0f);
        EXPECT_LT(glm::length(p.ray_origin - p.position), 1e-4f);
        EXPECT_FLOAT_EQ(p.distance, 10.0f);
        EXPECT_FLOAT_EQ(found.seen.depth, 10.0f);
        EXPECT_EQ(p.pixel, 3u);
        EXPECT_EQ(p.sample, 2u);
    }
}

TEST(Surface, BendsASmoothNormalThatFacesAway) {
    Stack stack;
    stack.add(0.0f);
    stack.scene.normals.assign(4, glm::normalize(glm::vec3(1.0f, 0.0f, 0.2f)));
    const glm::vec3 direction = glm::normalize(glm::vec3(1.0f, 0.0f, -0.1f));
    const Found found = follow(stack.scene, {glm::vec3(0.0f) - 5.0f * direction, direction});
    ASSERT_EQ(found.points.size(), 1u);
    const SurfacePoint& p = found.points[0];
    EXPECT_GT(glm::dot(p.shading_normal, p.to_viewer), 0.0f);
    EXPECT_GT(glm::dot(p.shading_normal, p.geometric_normal), 0.0f);
    EXPECT_NEAR(glm::length(p.shading_normal), 1.0f, 1e-5f);
}

TEST(Surface, OffsetsShadowRaysByTheCoordinatesSize) {
    for (const float scale : {1e-6f, 1.0f, 1e6f}) {
        Stack stack;
        stack.add(0.0f);
        for (glm::vec3& p : stack.scene.positions) p = scale * (p + glm::vec3(0.0f, 0.0f, 3.0f));
        const Found found = follow(stack.scene, {scale * glm::vec3(0.2f, 0.1f, 8.0f), {0.0f, 0.0f, -1.0f}});
        ASSERT_EQ(found.points.size(), 1u);
        const float offset = glm::length(found.points[0].ray_origin - found.points[0].position);
        EXPECT_GT(offset, 1e-6f * scale);
        EXPECT_LT(offset, 1e-4f * scale);
    }
}

TEST(Surface, MissesIntoNothing) {
    Stack stack;
    stack.add(0.0f);
    const Found found = follow(stack.scene, {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}});
    EXPECT_TRUE(found.points.empty());
    EXPECT_TRUE(std::isinf(found.seen.depth));
    EXPECT_EQ(found.seen.emitted, glm::vec3(0.0f));
}

TEST(Surface, EmitsAlongTheWindingOnly) {
    Stack stack;
    stack.add(0.0f).emission = glm::vec3(3.0f);
    EXPECT_EQ(follow(stack.scene, from_above).seen.emitted, glm::vec3(3.0f));
    EXPECT_EQ(follow(stack.scene, from_below).seen.emitted, glm::vec3(0.0f));
    stack.scene.materials[0].double_sided = true;
    EXPECT_EQ(follow(stack.scene, from_below).seen.emitted, glm::vec3(3.0f));
}

TEST(Surface, FollowsMirrorsToDepthEight) {
    Stack stack;
    Material& lower = stack.add(0.0f);
    lower.model = Material::Model::mirror;
    lower.base_color = glm::vec3(0.5f);
    stack.add(1.0f).emission = glm::vec3(1.0f);
    // Seen from between the squares the lower mirrors the upper one's dark back, which reflects diffusely.
    const Found found = follow(stack.scene, {{0.0f, 0.0f, 0.5f}, {0.0f, 0.0f, -1.0f}});
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(found.points[0].weight, glm::vec3(0.5f));
    EXPECT_FLOAT_EQ(found.points[0].position.z, 1.0f);
    EXPECT_NEAR(found.points[0].distance, 1.5f, 1e-4f);

    // Two facing mirrors, the upper of which also glows: every other bounce sees it.
    stack.scene.materials[1].model = Material::Model::mirror;
    stack.scene.materials[1].base_color = glm::vec3(1.0f);
    stack.scene.materials[0].base_color = glm::vec3(1.0f);
    stack.scene.materials[1].double_sided = true;
    const Found trapped = follow(stack.scene, {{0.0f, 0.0f, 0.5f}, {0.0f, 0.0f, -1.0f}});
    EXPECT_TRUE(trapped.points.empty());
    EXPECT_FLOAT_EQ(trapped.seen.emitted.x, 4.0f);
}

TEST(Surface, SplitsLightAtGlassByFresnel) {
    Stack stack;
    Material& pane = stack.add(1.0f);
    pane.model = Material::Model::glass;
    pane.base_color = glm::vec3(1.0f, 0.5f, 0.25f);
    pane.transmission = 1.0f;
    pane.ior = 1.5f;
    stack.add(0.0f);
    stack.add(20.0f).emission = glm::vec3(0.0f);
    const Found found = follow(stack.scene, from_above);
    ASSERT_EQ(found.points.size(), 2u);
    const bool mirrored_first = found.points[0].position.z > 10.0f;
    const SurfacePoint& mirrored = found.points[mirrored_first ? 0 : 1];
    const SurfacePoint& refracted = found.points[mirrored_first ? 1 : 0];
    EXPECT_NEAR(mirrored.weight.x, 0.04f, 1e-5f);
    EXPECT_NEAR(refracted.weight.x, 0.96f, 1e-5f);
    EXPECT_NEAR(refracted.weight.y, 0.48f, 1e-5f);
    EXPECT_NE(mirrored.vertex, refracted.vertex);
}

TEST(Surface, RefractsBySnell) {
    Stack stack;
    Material& pane = stack.add(0.0f);
    pane.model = Material::Model::glass;
    pane.base_color = glm::vec3(1.0f);
    pane.ior = 1.5f;
    stack.add(-1.0f);
    const float sine = 0.6f;
    const Found found = follow(stack.scene, {{-sine, 0.0f, 0.8f}, {sine, 0.0f, -0.8f}});
    ASSERT_EQ(found.points.size(), 1u);
    const float inside = sine / 1.5f;
    EXPECT_NEAR(found.points[0].position.x, inside / std::sqrt(1.0f - inside * inside), 1e-4f);
}

TEST(Surface, SeesThroughHolesAndLeaves) {
    Stack stack;
    stack.add(0.0f);
    Material& leaf = stack.add(1.0f);
    leaf.alpha = Material::Alpha::blend;
    leaf.base_alpha = 0.25f;
    Material& hole = stack.add(2.0f);
    hole.alpha = Material::Alpha::mask;
    hole.base_alpha = 0.3f;
    const Found found = follow(stack.scene, from_above);
    ASSERT_EQ(found.points.size(), 2u);
    EXPECT_FLOAT_EQ(found.points[0].position.z, 1.0f);
    EXPECT_FLOAT_EQ(found.points[0].weight.x, 0.25f);
    EXPECT_FLOAT_EQ(found.points[1].position.z, 0.0f);
    EXPECT_FLOAT_EQ(found.points[1].weight.x, 0.75f);
    EXPECT_FLOAT_EQ(found.seen.depth, 9.0f);
}

TEST(Surface, ReadsTheStatedMaterials) {
    Stack stack;
    Material& metal = stack.add(0.0f);
    metal.base_color = glm::vec3(0.9f, 0.6f, 0.3f);
    metal.metallic = 0.5f;
    metal.roughness = 0.5f;
    SurfacePoint p = follow(stack.scene, from_above).points.at(0);
    EXPECT_EQ(p.model, SurfacePoint::Model::microfacet);
    EXPECT_FLOAT_EQ(p.diffuse.x, 0.45f);
    EXPECT_FLOAT_EQ(p.specular.y, 0.5f * 0.04f + 0.5f * 0.6f);
    EXPECT_FLOAT_EQ(p.shininess, 0.25f);

    metal.model = Material::Model::phong;
    metal.specular = glm::vec3(0.2f);
    metal.exponent = 30.0f;
    p = follow(stack.scene, from_above).points.at(0);
    EXPECT_EQ(p.model, SurfacePoint::Model::phong);
    EXPECT_EQ(p.diffuse, metal.base_color);
    EXPECT_EQ(p.specular, glm::vec3(0.2f));
    EXPECT_FLOAT_EQ(p.shininess, 30.0f);

    p = follow(stack.scene, from_above, Shade::diffuse).points.at(0);
    EXPECT_EQ(p.model, SurfacePoint::Model::lambert);
    EXPECT_EQ(p.diffuse, metal.base_color);
    EXPECT_EQ(p.specular, glm::vec3(0.0f));
}

TEST(Surface, DiffuseMaterialsMakeMirrorsLambertToo) {
    Stack stack;
    stack.add(0.0f).model = Material::Model::mirror;
    const Found found = follow(stack.scene, from_above, Shade::diffuse);
    ASSERT_EQ(found.points.size(), 1u);
    EXPECT_EQ(found.points[0].model, SurfacePoint::Model::lambert);
    EXPECT_EQ(found.points[0].weight, glm::vec3(1.0f));
}

TEST(Visibility, IsPlainWhereEverythingIsOpaque) {
    Stack stack;
    Material& square = stack.add(0.0f);
    square.alpha = Material::Alpha::mask;  // with nothing that is masked
    const RayScene rays(stack.scene);
    EXPECT_FALSE(rays.transmissive());
    EXPECT_EQ(rays.to_point({0, 0, 1}, {0, 0, -1}), glm::vec3(0.0f));
    EXPECT_EQ(rays.to_point({0, 0, 1}, {3, 0, -1}), glm::vec3(1.0f));
    EXPECT_EQ(rays.to_infinity({0, 0, 1}, {0, 0, -1}), glm::vec3(0.0f));
    EXPECT_EQ(rays.to_infinity({0, 0, 1}, {0, 0, 1}), glm::vec3(1.0f));
    // A light on the surface is not hidden by it, from either side.
    EXPECT_EQ(rays.to_point({0.3f, 0.2f, 5}, {0, 0, 0}), glm::vec3(1.0f));
    EXPECT_EQ(rays.to_point({0.3f, 0.2f, -5}, {0, 0, 0}), glm::vec3(1.0f));
}

TEST(Visibility, MultipliesTints) {
    Stack stack;
    Material& pane = stack.add(0.0f);
    pane.transmission = 0.5f;
    pane.base_color = glm::vec3(1.0f, 0.5f, 0.0f);
    Material& leaf = stack.add(1.0f);
    leaf.alpha = Material::Alpha::blend;
    leaf.base_alpha = 0.25f;
    const RayScene rays(stack.scene);
    EXPECT_TRUE(rays.transmissive());
    const glm::vec3 tint = 0.75f * 0.5f * glm::vec3(1.0f, 0.5f, 0.0f);
    const auto expect = [](const glm::vec3& found, const glm::vec3& expected) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-6f);
    };
    expect(rays.to_point({0.2f, 0, 2}, {0.1f, 0, -1}), tint);
    expect(rays.to_infinity({0.2f, 0.1f, -2}, {0, 0, 1}), tint);
    expect(rays.to_infinity({0.2f, 0.1f, 0.5f}, {0, 0, 1}), glm::vec3(0.75f));

    stack.add(0.5f);  // opaque, between the two
    const RayScene blocked(stack.scene);
    EXPECT_EQ(blocked.to_point({0, 0, 2}, {0.1f, 0, -1}), glm::vec3(0.0f));
}

TEST(Visibility, HonoursTheMaskOfATexture) {
    Stack stack;
    Material& leaf = stack.add(0.0f);
    leaf.alpha = Material::Alpha::mask;
    leaf.base_color_texture.texture = 0;
    render::Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = {glm::vec4(1.0f, 1.0f, 1.0f, 0.0f), glm::vec4(1.0f)};
    stack.scene.textures.push_back(texture);
    stack.scene.uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const RayScene rays(stack.scene);
    EXPECT_TRUE(rays.transmissive());
    EXPECT_EQ(rays.to_point({-0.5f, 0.1f, 1}, {-0.5f, 0.1f, -1}), glm::vec3(1.0f));
    EXPECT_EQ(rays.to_point({0.5f, 0.1f, 1}, {0.5f, 0.1f, -1}), glm::vec3(0.0f));
    EXPECT_FALSE(rays.nearest({-0.5f, 0.1f, 1}, {0, 0, -1}).has_value());
    EXPECT_TRUE(rays.nearest({0.5f, 0.1f, 1}, {0, 0, -1}).has_value());
}

TEST(Visibility, HonorsAMaskApartFromTheColor) {
    Stack stack;
    Material& leaf = stack.add(0.0f);
    leaf.alpha = Material::Alpha::blend;
    leaf.base_alpha = 0.5f;
    leaf.base_color_texture.texture = 0;
    leaf.alpha_texture.texture = 1;
    render::Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = {glm::vec4(1.0f, 1.0f, 1.0f, 0.0f), glm::vec4(1.0f)};
    stack.scene.textures.push_back(texture);
    std::swap(texture.texels[0], texture.texels[1]);
    stack.scene.textures.push_back(texture);
    stack.scene.uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const RayScene rays(stack.scene);
    EXPECT_TRUE(rays.transmissive());
    EXPECT_EQ(rays.to_point({-0.5f, 0.1f, 1}, {-0.5f, 0.1f, -1}), glm::vec3(0.5f));
    EXPECT_EQ(rays.to_point({0.5f, 0.1f, 1}, {0.5f, 0.1f, -1}), glm::vec3(1.0f));
}

TEST(Surface, LooksWhereTheTextureTransformSays) {
    Stack stack;
    Material& material = stack.add(0.0f);
    material.model = Material::Model::phong;
    material.base_color = glm::vec3(1.0f);
    material.base_color_texture.texture = 0;
    render::Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = {glm::vec4(0.25f), glm::vec4(0.75f)};
    stack.scene.textures.push_back(texture);
    stack.scene.uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto seen_at = [&](float x) {
        return follow(stack.scene, {{x, 0.1f, 10.0f}, {0.0f, 0.0f, -1.0f}}).points.at(0).diffuse.x;
    };
    EXPECT_FLOAT_EQ(seen_at(-0.5f), 0.25f);
    EXPECT_FLOAT_EQ(seen_at(0.5f), 0.75f);
    material.base_color_texture.uv.offset = {0.5f, 0.0f};
    EXPECT_FLOAT_EQ(seen_at(-0.5f), 0.75f);
    EXPECT_FLOAT_EQ(seen_at(0.5f), 0.25f);
    material.base_color_texture.uv = {{0.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.0f}};  // u and v swapped
    EXPECT_FLOAT_EQ(seen_at(-0.5f), seen_at(0.5f));
}

}  // namespace
