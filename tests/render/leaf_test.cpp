// Thin surfaces lit from behind, through the whole renderer.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/picture.hpp>
#include <render/lights/indirect.hpp>
#include <render/shader.hpp>

#include "programs.hpp"

namespace {

using render::Material;
using render::Options;
using render::Picture;
using render::RayScene;
using render::Scene;
using render::Shade;
using render::Shading;
using render::SurfacePoint;

constexpr double pi = std::numbers::pi;

class LeafFile : public Programs {
protected:
    /// A leaf of 2 x 2 in the plane y = 0, black but for what it transmits.
    void write_leaf() {
        folder.write("leaf.gltf", R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_diffuse_transmission"],
            "buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)" +
                                      std::string(positions_and_indices) + R"("}],
            "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
            {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
            "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.4,0.3,1],"metallicFactor":0},
            "extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.75,
            "diffuseTransmissionColorFactor":[0.2,0.8,0.4]}}}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],"nodes":[{"mesh":0}]})");
    }

private:
    /// (-1 0 -1) (1 0 -1) (1 0 1) (-1 0 1), as floats; 0 2 1 0 3 2, as 16-bit numbers.
    static constexpr const char* positions_and_indices =
        "AACAvwAAAAAAAIC/AACAPwAAAAAAAIC/AACAPwAAAAAAAIA/AACAvwAAAAAAAIA/AAACAAEAAAADAAIA";
};

TEST_F(LeafFile, LitFromBehindIsTransmittanceOverPiTimesIrradiance) {
    write_leaf();
    folder.write("behind.csv",
                 "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0.75,-1.5,0.25,,,,3,2,1\ndirectional,,,,0,0.6,0.8,1,2,3\n");
    const double d2 = 0.75 * 0.75 + 1.5 * 1.5 + 0.25 * 0.25, omni = 1.5 / (d2 * std::sqrt(d2));
    const glm::dvec3 irradiance = omni * glm::dvec3(3, 2, 1) + 0.6 * glm::dvec3(1, 2, 3);
    const glm::dvec3 expected = 0.75 * glm::dvec3(0.2, 0.8, 0.4) / pi * irradiance;
    for (const std::string method : {"lightcuts", "exhaustive", "ward"}) {
        const auto result = render(
            "leaf.gltf --quiet --lights behind.csv --size 1x1 --eye 0,3,0 --target 0,0,0 --method " + method);
        ASSERT_EQ(result.status, 0) << result.err;
        const glm::vec3 pixel = render::read_exr(folder / "render.exr").pixels[0];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-5 * expected[c]) << method;
        EXPECT_EQ(report("render.json").at("shadow_rays"), 2);
    }
}

TEST(Leaf, ReflectsWhatItDoesNotTransmitByItsTextures) {
    Scene scene;
    scene.positions = {{-1, 0, -1}, {-1, 0, 3}, {3, 0, -1}};
    scene.uv_sets = {std::vector<glm::vec2>(3, glm::vec2(0.5f))};
    scene.triangles = {{0, 1, 2}};
    scene.triangle_material = {0};
    scene.textures.resize(2);
    scene.textures[0] = {"share", 1, 1, {glm::vec4(0.1f, 0.2f, 0.3f, 0.5f)}};
    scene.textures[1] = {"tint", 1, 1, {glm::vec4(0.5f, 1.0f, 0.25f, 0.9f)}};
    Material leaf;
    leaf.base_color = glm::vec3(0.8f);
    leaf.diffuse_transmission = 0.5f;
    leaf.diffuse_transmission_texture.texture = 0;
    leaf.diffuse_transmission_color = glm::vec3(0.4f);
    leaf.diffuse_transmission_color_texture.texture = 1;
    leaf.metallic = 0.5f;
    scene.materials = {leaf};
    const RayScene rays(scene);
    std::vector<SurfacePoint> points;
    const render::EyeRay down{{0, 1, 0}, {0, -1, 0}};
    render::EyePathTracer(scene, rays, Shade::full).follow(down, 0, 0, points);
    ASSERT_EQ(points.size(), 1u);
    const auto expect = [](const glm::vec3& a, const glm::vec3& b) {
        for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(a[c], b[c]);
    };
    expect(points[0].transmitted, 0.5f * 0.25f * 0.4f * glm::vec3(0.5f, 1.0f, 0.25f));
    expect(points[0].diffuse, 0.5f * 0.75f * glm::vec3(0.8f));
    points.clear();
    render::EyePathTracer(scene, rays, Shade::diffuse).follow(down, 0, 0, points);
    expect(points[0].diffuse, glm::vec3(0.8f));
    expect(points[0].transmitted, glm::vec3(0.0f));
}

/// A hollow ball of radius 1 around the origin whose wall is a leaf.
class Lampion : public testing::Test {
protected:
    static constexpr double albedo = 0.45, transmittance = 0.35;

    Lampion() {
        constexpr std::uint32_t rows = 48, columns = 96;
        for (std::uint32_t i = 0; i <= rows; ++i) {
            for (std::uint32_t j = 0; j < columns; ++j) {
                const double down = pi * i / rows, around = 2.0 * pi * j / columns;
                scene.positions.emplace_back(std::sin(down) * std::cos(around), std::cos(down),
                                             std::sin(down) * std::sin(around));
            }
        }
        for (std::uint32_t i = 0; i < rows; ++i) {
            for (std::uint32_t j = 0; j < columns; ++j) {
                const std::uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns;
                if (i > 0) scene.triangles.push_back({a, b, b + columns});
                if (i + 1 < rows) scene.triangles.push_back({a, b + columns, a + columns});
            }
        }
        scene.triangle_material.assign(scene.triangles.size(), 0);
        Material paper;
        paper.model = Material::Model::microfacet;
        const double share = transmittance / (albedo + transmittance);
        paper.base_color = paper.diffuse_transmission_color = glm::vec3(static_cast<float>(albedo + transmittance));
        paper.diffuse_transmission = static_cast<float>(share);
        scene.materials = {paper};
    }

    /// Mean radiance, without gloss, of what rays from `eye` in several directions see.
    double seen_from(const glm::vec3& eye, const std::vector<glm::vec3>& directions, const std::string& method) {
        const RayScene rays(scene);
        render::add_virtual_lights(scene, rays, 40000, Shade::full, 1);
        Options options;
        options.method = method;
        options.max_cut = 0;
        const auto shader = render::make_shader(scene, rays, options);
        std::vector<SurfacePoint> points;
        for (const glm::vec3& d : directions) {
            render::EyePathTracer(scene, rays, Shade::full).follow({eye, glm::normalize(d)}, 0, 0, points);
        }
        for (SurfacePoint& p : points) {
            p.specular = glm::vec3(0.0f);
            p.model = SurfacePoint::Model::lambert;
        }
        EXPECT_EQ(points.size(), directions.size());
        std::vector<Shading> shadings(points.size());
        shader->shade(points, shadings, *shader->make_scratch());
        double sum = 0.0;
        for (const Shading& s : shadings) sum += static_cast<double>(s.radiance.g);
        return sum / static_cast<double>(shadings.size());
    }

    Scene scene;
};

// Besides, the wall reflects some 1.9 % as gloss, which is all but spread over the ball as well.
constexpr double gloss = 0.019;

TEST_F(Lampion, ShinesThroughItsWall) {
    scene.omni = {{glm::vec3(0.0f), glm::vec3(1.0f), {}}};
    const double least = transmittance / pi / (1.0 - albedo), most = transmittance / pi / (1.0 - albedo - gloss);
    for (const std::string method : {"exhaustive", "lightcuts"}) {
        scene.virtual_lights.clear();
        const double found = seen_from(
            {0.01f, 0.02f, 5}, {{0.02f, 0.01f, -1}, {0.1f, 0, -1}, {-0.05f, 0.1f, -1}, {0, -0.12f, -1}}, method);
        EXPECT_GT(found, 0.985 * least) << method;
        EXPECT_LT(found, 1.015 * most) << method;
    }
}

TEST_F(Lampion, IsLitInsideByALampOutside) {
    // What comes in at the lit side is reflected inside for ever; the dark side shows all but what it gets at first.
    scene.omni = {{glm::vec3(0.0f, 0.0f, 2.5f), glm::vec3(1.0f), {}}};
    const double sine = 1.0 / 2.5, flux = 2.0 * pi * (1.0 - std::sqrt(1.0 - sine * sine));
    const double entering = flux * transmittance / (4.0 * pi);
    const double least = albedo / pi * entering / (1.0 - albedo),
                 most = albedo / pi * entering / (1.0 - albedo - gloss);
    for (const std::string method : {"exhaustive", "lightcuts"}) {
        scene.virtual_lights.clear();
        const double found = seen_from(
            {0.03f, 0.02f, 0.01f}, {{0, 0, -1}, {0.7f, 0, -1}, {-0.5f, 0.7f, -1}, {0, -1, -1}, {1, 0.2f, 0}}, method);
        EXPECT_GT(found, 0.985 * least) << method;
        EXPECT_LT(found, 1.015 * most) << method;
    }
}

}  // namespace
