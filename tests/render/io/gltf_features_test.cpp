#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/surfaces/surface.hpp>
#include <render/surfaces/surface_colors.hpp>

#include "render/bitmap.hpp"
#include "render/gltf_builder.hpp"
#include "render/refusal.hpp"

namespace {

using Json = nlohmann::json;
using render::Material;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

bool leaves_out(const Scene& s, const std::string& what) {
    for (const render::LeftOut& item : s.left_out) {
        if (item.what.find(what) != std::string::npos) return true;
    }
    return false;
}

/// What an eye above (x, z) sees: the surface's parameters and shading normal.
struct Seen {
    render::SurfaceColors colors;
    glm::vec3 normal{0.0f};
    glm::vec3 emitted{0.0f};
    bool is_there = false;
};

Seen look_down(const Scene& s, float x, float z) {
    const render::RayScene rays(s);
    Seen seen;
    const glm::vec3 down(0.0f, -1.0f, 0.0f);
    const glm::vec3 from = glm::vec3(glm::dvec3(x, 10.0, z) - s.origin);
    const auto hit = rays.nearest(from, down);
    if (!hit) return seen;
    seen.is_there = true;
    seen.colors = render::colors_at(s, hit->triangle, hit->u, hit->v);
    std::vector<render::SurfacePoint> points;
    seen.emitted = render::EyePathTracer(s, rays, render::Shade::full).follow({from, down}, 0, 0, points).emitted;
    seen.normal = render::surface_at(s, *hit, down).shading_normal;
    return seen;
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " not " << b.x << " " << b.y << " " << b.z;
}

TEST(GltfVertexColors, MultiplyBaseColorAndAlpha) {
    for (int kind = 0; kind < 4; ++kind) {
        SCOPED_TRACE(kind);
        GltfBuilder file;
        Json attributes = file.square();
        // Half red, a quarter green, no blue; of alpha three quarters.
        switch (kind) {
            case 0:
                attributes["COLOR_0"] = file.add(
                    std::vector<float>{.5f, .25f, 0, .5f, .25f, 0, .5f, .25f, 0, .5f, .25f, 0}, "VEC3", 3);
                break;
            case 1:
                attributes["COLOR_0"] = file.add(
                    std::vector<float>{.5f, .25f, 0, .75f, .5f, .25f, 0, .75f, .5f, .25f, 0, .75f, .5f, .25f, 0, .75f},
                    "VEC4", 4);
                break;
            case 2: {
                std::vector<std::uint8_t> bytes;
                for (int v = 0; v < 4; ++v) bytes.insert(bytes.end(), {128, 64, 0, 191});
                attributes["COLOR_0"] = file.add(bytes, "VEC4", 4, true);
                break;
            }
            default: {
                std::vector<std::uint16_t> words;
                for (int v = 0; v < 4; ++v) words.insert(words.end(), {32768, 16384, 0, 49151});
                attributes["COLOR_0"] = file.add(words, "VEC4", 4, true);
            }
        }
        const std::size_t material = file.add_material({{"alphaMode", "BLEND"}},
                                                       {{"baseColorFactor", {1.0, 0.5, 0.5, 0.5}}});
        file.add_node({{"mesh", file.add_mesh(attributes, {{"material", material}})}});
        const Seen seen = look_down(file.load(), -0.3f, 0.2f);
        expect_near(seen.colors.base, {0.5f, 0.125f, 0.0f}, 3e-3f);
        EXPECT_NEAR(seen.colors.opacity, kind == 0 ? 0.5f : 0.375f, 2e-3f);
    }
    GltfBuilder plain;
    plain.add_node({{"mesh", plain.add_mesh(plain.square())}});
    EXPECT_TRUE(plain.load().colors.empty());
    GltfBuilder bright;
    Json attributes = bright.square();
    attributes["COLOR_0"] = bright.add(std::vector<float>(12, 2.0f), "VEC3", 3);
    bright.add_node({{"mesh", bright.add_mesh(attributes)}});
    EXPECT_TRUE(leaves_out(bright.load(), "vertex colors"));
}

/// A square of one bone; `joint` and `holder` are the nodes of the bone and of the mesh.
GltfBuilder skinned(const Json& joint, const Json& holder, bool inverse = true) {
    GltfBuilder file;
    Json attributes = file.square();
    attributes["JOINTS_0"] = file.add(std::vector<std::uint8_t>(16, 0), "VEC4", 4);
    attributes["WEIGHTS_0"] = file.add(std::vector<float>{1, 0, 0, 0, .5f, 0, .5f, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4",
                                       4);
    Json skin = {{"joints", {0}}};
    if (inverse) {
        skin["inverseBindMatrices"] = file.add(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1},
                                               "MAT4", 16);
    }
    file.append("skins", skin);
    file.add_node(joint);
    Json node = holder;
    node["mesh"] = file.add_mesh(attributes);
    node["skin"] = 0;
    file.add_node(node);
    return file;
}

TEST(GltfSkin, PosesByItsJointsAndNotByItsNode) {
    // The inverse bind matrix moves by 5, the joint back by 5.
    const Json rest = {{"translation", {-5, 0, 0}}};
    EXPECT_TRUE(look_down(skinned(rest, Json::object()).load(), -0.5f, 0.0f).is_there);
    EXPECT_TRUE(look_down(skinned(rest, {{"translation", {50, 0, 0}}}).load(), -0.5f, 0.0f).is_there);
    const Scene moved = skinned({{"translation", {-4, 0, 0}}}, {{"scale", {0.1, 1, 1}}}).load();
    EXPECT_TRUE(look_down(moved, 0.5f, 0.0f).is_there);
    EXPECT_FALSE(look_down(moved, -0.5f, 0.0f).is_there);
    EXPECT_TRUE(look_down(skinned(Json::object(), Json::object(), false).load(), -0.5f, 0.0f).is_there);
    // A mirroring joint turns no face inside out.
    const Scene mirrored = skinned({{"scale", {-1, 1, 1}}, {"translation", {5, 0, 0}}}, Json::object()).load();
    const glm::uvec3 t = mirrored.triangles[0];
    EXPECT_GT(
        glm::cross(mirrored.positions[t.y] - mirrored.positions[t.x], mirrored.positions[t.z] - mirrored.positions[t.x])
            .y,
        0.0f);
}

TEST(GltfSkin, RefusesJointsAndWeightsThatAreNotThere) {
    GltfBuilder file = skinned(Json::object(), Json::object());
    file.json["skins"][0]["joints"] = {7};
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("node 7"));
    file.json["skins"][0]["joints"] = Json::array();
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("joint 0"));
    file = skinned(Json::object(), Json::object());
    file.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = file.add(std::vector<float>(16, 1e30f), "VEC4",
                                                                                 4);
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("a joint is no index"));
    file = skinned(Json::object(), Json::object());
    file.json["nodes"][1]["skin"] = 3;
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("skin 3"));
    file = skinned(Json::object(), Json::object());
    file.json["accessors"][3]["count"] = 0;  // of the inverse bind matrices
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("inverseBindMatrices"));
}

TEST(GltfSkin, AsksNothingOfWhatNoTriangleOrSkinUses) {
    // A fifth vertex that no triangle has, without a weight, of a joint that does not exist.
    GltfBuilder file;
    const Json attributes = {
        {"POSITION", file.add(std::vector<float>{-1, 0, 1, 0, 0, 1, 0, 0, -1, -1, 0, -1, 0, 0, 0}, "VEC3", 3)},
        {"JOINTS_0",
         file.add(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 9, 9, 9}, "VEC4", 4)},
        {"WEIGHTS_0",
         file.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4)}};
    const auto mesh_of = [&](const std::vector<std::uint8_t>& indices) {
        return file.add_mesh(attributes, {{"indices", file.add(indices, "SCALAR", 1)}});
    };
    file.append("skins", {{"joints", {0}}});
    file.add_node({{"translation", {1, 0, 0}}});
    file.add_node({{"mesh", mesh_of({0, 1, 2, 0, 2, 3})}, {"skin", 0}});
    EXPECT_TRUE(look_down(file.load(), 0.5f, 0.0f).is_there);
    file.json["nodes"][1]["mesh"] = mesh_of({0, 1, 4});
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("a vertex that no joint moves"));
    // Without a skin, joints mean nothing.
    for (const char* gone : {"WEIGHTS_0", "JOINTS_0"}) {
        GltfBuilder bare = skinned(Json::object(), Json::object());
        bare.json["meshes"][0]["primitives"][0]["attributes"].erase(gone);
        bare.json["nodes"][1].erase("skin");
        EXPECT_TRUE(look_down(bare.load(), -0.5f, 0.0f).is_there) << gone;
    }
    GltfBuilder lost = skinned(Json::object(), Json::object());
    lost.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_THAT(refusal([&] { lost.load(); }), HasSubstr("joints without weights"));
}

TEST(GltfAccessors, HoldFiniteNumbers) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinite, -infinite}) {
        SCOPED_TRACE(bad);
        const auto refused = [](const GltfBuilder& file) { return refusal([&] { file.load(); }); };
        // Where an instance stands.
        for (const auto& [name, good] : {std::pair{"ROTATION", std::vector<float>{0, 0, 0, 1}},
                                         {"TRANSLATION", {0, 0, 0}},
                                         {"SCALE", {1, 1, 1}}}) {
            std::vector<float> values = good;
            values[1] = bad;
            GltfBuilder file;
            const Json attributes = {{name, file.add(values, values.size() == 4 ? "VEC4" : "VEC3", values.size())}};
            file.add_node({{"mesh", file.add_mesh(file.square())},
                           {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
            EXPECT_THAT(refused(file), testing::AllOf(HasSubstr(name), HasSubstr("element 0 is not finite")));
        }
        // What an animation begins with; what comes later is not looked at.
        for (const bool first : {true, false}) {
            for (const auto& [path, size] : {std::pair{"rotation", std::size_t(4)}, {"translation", 3}, {"scale", 3}}) {
                std::vector<float> values(2 * size, 1.0f);
                values[first ? 1 : size] = bad;
                GltfBuilder file;
                file.add_node({{"mesh", file.add_mesh(file.square())}});
                const std::size_t input = file.add(std::vector<float>{0, 1}, "SCALAR", 1);
                const std::size_t output = file.add(values, size == 4 ? "VEC4" : "VEC3", size);
                file.append("animations",
                            {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                             {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})}});
                if (first) {
                    EXPECT_THAT(refused(file), HasSubstr("is not finite")) << path;
                } else {
                    EXPECT_EQ(file.load().triangles.size(), 2u) << path;
                }
            }
        }
        // Attributes of vertices, and what moves them.
        for (const char* name : {"POSITION", "NORMAL", "COLOR_0"}) {
            GltfBuilder file;
            Json attributes = file.square();
            std::vector<float> values{0, 0, 1, 1, 0, 1, 1, 0, 0.5f, 0, 0, 0.5f};
            values[7] = bad;
            attributes[name] = file.add(values, "VEC3", 3);
            file.add_node({{"mesh", file.add_mesh(attributes)}});
            EXPECT_THAT(refused(file), testing::AllOf(HasSubstr(name), HasSubstr("vertex 2 is not finite")));
        }
        GltfBuilder file = skinned(Json::object(), Json::object());
        std::vector<float> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        matrix[5] = bad;
        file.json["skins"][0]["inverseBindMatrices"] = file.add(matrix, "MAT4", 16);
        EXPECT_THAT(refused(file), HasSubstr("element 0 is not finite"));
    }
}

TEST(GltfAnimation, OfAnUnknownPathIsNamed) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    const std::size_t time = file.add(std::vector<float>{0, 1}, "SCALAR", 1);
    file.append("animations",
                {{"samplers", Json::array({{{"input", time}, {"output", time}}})},
                 {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "hue"}}}}})}});
    EXPECT_TRUE(leaves_out(file.load(), "an animation of 'hue'"));
    file.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("one rotation for each key"));
}

TEST(GltfScenes, ThatAreNotShownAreNamed) {
    GltfBuilder file;
    const std::size_t mesh = file.add_mesh(file.square());
    file.add_node({{"mesh", mesh}});
    EXPECT_TRUE(file.load().left_out.empty());
    file.append("nodes", {{"mesh", mesh}, {"name", "attic"}});
    file.append("nodes", {{"name", "nothing to see"}});
    file.append("nodes", {{"mesh", mesh}, {"name", "cellar"}});
    file.append("scenes", {{"name", "below"}, {"nodes", {3}}});
    file.append("scenes", Json::object());
    const Scene s = file.load();
    EXPECT_EQ(s.triangles.size(), 2u);
    ASSERT_EQ(s.left_out.size(), 3u);
    EXPECT_EQ(s.left_out[0].what, "scene 'below'");
    EXPECT_EQ(s.left_out[1].what, "scene 2");
    EXPECT_EQ(s.left_out[2].what, "node 'attic'");
    // Of the other scene the first is left out, and said to be.
    file.json["scene"] = 1;
    EXPECT_TRUE(leaves_out(file.load(), "scene 0"));
}

GltfBuilder morphing(const Json& mesh_weights, const Json& node_weights) {
    GltfBuilder file;
    const Json target = {{"POSITION", file.add(std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3", 3)}};
    const std::size_t mesh = file.add_mesh(file.square(), {{"targets", Json::array({target, target})}});
    if (!mesh_weights.is_null()) file.json["meshes"][mesh]["weights"] = mesh_weights;
    Json node = {{"mesh", mesh}};
    if (!node_weights.is_null()) node["weights"] = node_weights;
    file.add_node(node);
    return file;
}

TEST(GltfMorph, WeightsOfTheNodeStandInForTheMeshs) {
    const auto x = [](const Json& mesh, const Json& node) {
        const Scene s = morphing(mesh, node).load();
        return static_cast<double>(s.positions[0].x) + s.origin.x + 1.0;
    };
    EXPECT_NEAR(x(nullptr, nullptr), 0.0, 1e-6);
    EXPECT_NEAR(x({1, 0}, nullptr), 1.0, 1e-6);
    EXPECT_NEAR(x({1, 0.5}, nullptr), 1.5, 1e-6);
    EXPECT_NEAR(x({1, 1}, {0, 0.25}), 0.25, 1e-6);
    EXPECT_NEAR(x(nullptr, {0.5, -0.25}), 0.25, 1e-6);
    EXPECT_NEAR(x({1}, nullptr), 1.0, 1e-6) << "fewer weights than targets";
}

TEST(GltfAnimation, ShowsTheBeginningOfTheFirst) {
    struct Way {
        const char* path;
        const char* type;
        std::vector<float> step;    ///< two keys
        std::vector<float> spline;  ///< the same between tangents
        glm::vec3 first;            ///< where the point (-1, 0, 1) is then
    };
    const Way ways[] = {
        {"translation", "VEC3", {1, 2, 3, 9, 9, 9}, {7, 7, 7, 1, 2, 3, 7, 7, 7, 7, 7, 7, 9, 9, 9, 7, 7, 7}, {0, 2, 4}},
        {"scale", "VEC3", {2, 1, 1, 9, 9, 9}, {7, 7, 7, 2, 1, 1, 7, 7, 7, 7, 7, 7, 9, 9, 9, 7, 7, 7}, {-2, 0, 1}},
        {"rotation",
         "VEC4",
         {0, 1, 0, 0, 0, 0, 0, 1},
         {7, 7, 7, 7, 0, 1, 0, 0, 7, 7, 7, 7, 7, 7, 7, 7, 0, 0, 0, 1, 7, 7, 7, 7},
         {1, 0, -1}},
    };
    for (const Way& way : ways) {
        for (const char* interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
            SCOPED_TRACE(std::string(way.path) + " " + interpolation);
            GltfBuilder file;
            file.add_node({{"mesh", file.add_mesh(file.square())}, {"name", "part"}});
            const bool spline = std::string(interpolation) == "CUBICSPLINE";
            const std::size_t input = file.add(std::vector<float>{0.5f, 1.0f}, "SCALAR", 1);
            const std::size_t output = file.add(spline ? way.spline : way.step, way.type,
                                                std::string(way.type) == "VEC4" ? 4 : 3);
            const Json animation = {
                {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
                {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", way.path}}}}})}};
            file.append("animations", animation);
            const Scene s = file.load();
            expect_near(glm::vec3(glm::dvec3(s.positions[0]) + s.origin), way.first);
            EXPECT_TRUE(leaves_out(s, "animation"));
        }
    }
    GltfBuilder file = morphing({0, 0}, nullptr);
    const std::size_t input = file.add(std::vector<float>{0, 1}, "SCALAR", 1);
    const std::size_t output = file.add(std::vector<float>{1, 0.5f, 9, 9}, "SCALAR", 1);
    file.append("animations",
                {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                 {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
    const Scene s = file.load();
    EXPECT_NEAR(static_cast<double>(s.positions[0].x) + s.origin.x, 0.5, 1e-6);
    file.json["animations"][0]["channels"][0]["sampler"] = 4;
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("sampler does not exist"));
}

TEST(GltfInstancing, StandsAtEachPlace) {
    GltfBuilder file;
    const Json attributes = {{"TRANSLATION", file.add(std::vector<float>{0, 0, 0, 2, 0, 0}, "VEC3", 3)},
                             {"SCALE", file.add(std::vector<float>{1, 1, 1, 1, 1, 0.5f}, "VEC3", 3)},
                             {"ROTATION", file.add(std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}, "VEC4", 4)}};
    file.add_node({{"mesh", file.add_mesh(file.square())},
                   {"translation", {0, 1, 0}},
                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    const Scene s = file.load();
    EXPECT_EQ(s.triangles.size(), 4u);
    EXPECT_TRUE(look_down(s, -0.5f, 0.9f).is_there);
    EXPECT_TRUE(look_down(s, 2.5f, 0.4f).is_there);
    EXPECT_FALSE(look_down(s, 2.5f, 0.6f).is_there) << "half as deep";
    EXPECT_FALSE(look_down(s, 1.5f, 0.0f).is_there) << "turned";
    EXPECT_TRUE(s.left_out.empty());
    file.json["accessors"][0]["count"] = 1;
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("differ in length"));
}

TEST(GltfAccessors, MayBeSparseOrZero) {
    GltfBuilder file;
    Json attributes = file.square();
    const std::size_t places = file.add_view(std::vector<std::uint16_t>{1, 2});
    const std::size_t values = file.add_view(std::vector<float>{3, 0, 1, 3, 0, -1});
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                         {"values", {{"bufferView", values}}}};
    file.json["accessors"][0]["sparse"] = sparse;
    file.add_node({{"mesh", file.add_mesh(attributes)}});
    const Scene wide = file.load();
    EXPECT_TRUE(look_down(wide, 2.9f, 0.0f).is_there);
    EXPECT_EQ(glm::vec3(glm::dvec3(wide.positions[0]) + wide.origin), glm::vec3(-1, 0, 1)) << "the rest is as it was";

    // Of zeros but for two.
    file.json["accessors"][0].erase("bufferView");
    const Scene thin = [&] {
        GltfBuilder copy = file;
        copy.json["accessors"][0]["sparse"] = sparse;
        return render::load_gltf("scene/scene.gltf", render::MemoryFiles(copy.files()));
    }();
    EXPECT_EQ(thin.positions[0], glm::vec3(0.0f));
    EXPECT_EQ(thin.positions[1], glm::vec3(3, 0, 1));

    GltfBuilder zeros;
    zeros.add_file("t.bmp", bitmap({{10, 20, 30}}));
    Json with_uvs = zeros.square();
    with_uvs["TEXCOORD_0"] = zeros.append("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    zeros.append("images", {{"uri", "t.bmp"}});
    zeros.append("textures", {{"source", 0}});
    const std::size_t material = zeros.add_material(Json::object(), {{"baseColorTexture", {{"index", 0}}}});
    zeros.add_node({{"mesh", zeros.add_mesh(with_uvs, {{"material", material}})}});
    EXPECT_TRUE(look_down(zeros.load(), -0.5f, 0.0f).is_there);

    const auto refused = [&](const Json& change) {
        GltfBuilder copy = file;
        copy.json["accessors"][0]["sparse"] = sparse;
        copy.json["accessors"][0]["sparse"].merge_patch(change);
        return refusal([&] { copy.load(); });
    };
    EXPECT_THAT(refused({{"count", 9}}), HasSubstr("count"));
    EXPECT_THAT(refused({{"indices", {{"componentType", 5126}}}}), HasSubstr("unsigned"));
    EXPECT_THAT(refused({{"indices", {{"byteOffset", 3}}}}), HasSubstr("cut off"));
    EXPECT_THAT(refused({{"values", {{"byteOffset", 4}}}}), HasSubstr("cut off"));
}

struct Textured {
    GltfBuilder file;
    std::size_t material = 0;

    /// One row of texels across the square, in x.
    explicit Textured(const std::vector<std::array<std::uint8_t, 3>>& texels, const Json& sampler = Json::object(),
                      const Json& info = Json::object()) {
        file.add_file("t.bmp", bitmap(texels));
        file.append("images", {{"uri", "t.bmp"}});
        file.append("samplers", sampler);
        file.append("textures", {{"source", 0}, {"sampler", 0}});
        Json texture = {{"index", 0}};
        texture.update(info);
        material = file.add_material(Json::object(), {{"baseColorTexture", texture}});
        Json attributes = file.square();
        attributes["TEXCOORD_0"] = file.add(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
        attributes["TEXCOORD_1"] = file.add(std::vector<float>{1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 2);
        file.add_node({{"mesh", file.add_mesh(attributes, {{"material", material}})}});
    }

    float red(float u) const { return look_down(file.load(), u - 1.0f, 0.0f).colors.base.r; }
};

TEST(GltfSampler, NearestMixesNothing) {
    const Textured nearest({{255, 0, 0}, {0, 0, 0}, {255, 0, 0}, {0, 0, 0}}, {{"magFilter", 9728}});
    for (const float u : {0.01f, 0.24f, 0.51f, 0.74f}) EXPECT_EQ(nearest.red(u), 1.0f) << u;
    for (const float u : {0.26f, 0.49f, 0.76f, 0.99f}) EXPECT_EQ(nearest.red(u), 0.0f) << u;
    const Textured linear({{255, 0, 0}, {0, 0, 0}}, {{"magFilter", 9729}, {"wrapS", 33071}});
    EXPECT_NEAR(linear.red(0.5f), 0.5f, 1e-3f);
    EXPECT_NEAR(linear.red(0.05f), 1.0f, 1e-3f) << "the edge is clamped";
    EXPECT_NEAR(Textured({{255, 0, 0}, {0, 0, 0}}).red(0.001f), 0.5f, 0.01f) << "the edge wraps around";
    EXPECT_THAT(refusal([&] { Textured({{255, 0, 0}}, {{"wrapS", 7}}).file.load(); }), HasSubstr("wrapS"));
}

TEST(GltfTexture, LooksIntoTheSetOfCoordinatesThatItNames) {
    const std::vector<std::array<std::uint8_t, 3>> texels{{255, 0, 0}, {0, 0, 0}};
    EXPECT_GT(Textured(texels).red(0.25f), 0.9f);
    EXPECT_LT(Textured(texels, Json::object(), {{"texCoord", 1}}).red(0.25f), 0.1f);
    const Scene lost = Textured(texels, Json::object(), {{"texCoord", 2000000000}}).file.load();
    EXPECT_FALSE(lost.left_out.empty());
    EXPECT_THAT(lost.left_out[0].why, HasSubstr("TEXCOORD_2000000000"));
}

TEST(GltfTexture, TakesTheImageThatItCanRead) {
    Textured file({{255, 0, 0}});
    file.file.append("images", {{"uri", "t.webp"}, {"name", "better"}});
    file.file.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
    file.file.json["extensionsUsed"] = {"EXT_texture_webp"};
    EXPECT_EQ(file.red(0.5f), 1.0f);
    EXPECT_TRUE(leaves_out(file.file.load(), "EXT_texture_webp"));
    EXPECT_TRUE(leaves_out(file.file.load(), "t.webp"));
    file.file.json["textures"][0].erase("source");
    EXPECT_THAT(refusal([&] { file.file.load(); }), HasSubstr("kind that cannot be read"));
    file.file.json["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_THAT(refusal([&] { file.file.load(); }), HasSubstr("EXT_texture_webp"));
}

TEST(GltfTexture, WhatNothingUsesIsNotReadButNamed) {
    Textured file({{255, 0, 0}});
    file.file.append("images", {{"uri", "gone.png"}});
    file.file.append("textures", {{"source", 1}});
    file.file.add_material({{"emissiveTexture", {{"index", 1}}}, {"emissiveFactor", {1, 1, 1}}});
    const Scene s = file.file.load();
    EXPECT_EQ(s.textures.size(), 1u);
    EXPECT_TRUE(leaves_out(s, "gone.png"));
    // Used, it is missed.
    file.file.json["meshes"][0]["primitives"][0]["material"] = 1;
    EXPECT_THAT(refusal([&] { file.file.load(); }), HasSubstr("gone.png"));
}

TEST(GltfUri, IsDecodedAsUrisAre) {
    // What the file on the disk is called, and how it may be written.
    const std::pair<const char*, const char*> names[] = {{"my data.bmp", "my%20data.bmp"},
                                                         {"my data.bmp", "my data.bmp"},
                                                         {"a+b.bmp", "a+b.bmp"},
                                                         {"a%b.bmp", "a%25b.bmp"},
                                                         {"a%zz.bmp", "a%zz.bmp"},
                                                         {"d\xC3\xA9.bmp", "d%C3%A9.bmp"},
                                                         {"d\xC3\xA9.bmp", "d\xC3\xA9.bmp"},
                                                         {"sub/x.bmp", "sub/x.bmp"},
                                                         {"sub/x.bmp", "sub\\x.bmp"},
                                                         {"X.bmp", "x.BMP"}};
    for (const auto& [name, uri] : names) {
        SCOPED_TRACE(uri);
        Textured file({{0, 0, 0}});
        file.file.add_file(name, bitmap({{255, 0, 0}}));
        file.file.json["images"][0]["uri"] = uri;
        EXPECT_EQ(file.red(0.5f), 1.0f);
    }
    // Damaged data is not quoted, as it may be long.
    Textured file({{0, 0, 0}});
    file.file.json["images"][0]["uri"] = "data:image/png;base64," + std::string(100000, '!');
    EXPECT_LT(refusal([&] { file.file.load(); }).size(), 200u);
    // Nor is what cannot be a name.
    file.file.json["images"][0]["uri"] = std::string(100000, '!');
    EXPECT_LT(refusal([&] { file.file.load(); }).size(), 250u);
    file.file.json["images"][0]["uri"] = "a%0Ab%00c.png";
    EXPECT_THAT(refusal([&] { file.file.load(); }), AllOf(HasSubstr("'a%0Ab%00c.png'"), Not(HasSubstr("\n"))));
    file.file.json["images"][0]["uri"] = "a%0Ab.png";
    EXPECT_THAT(refusal([&] { file.file.load(); }), AllOf(HasSubstr("'a%0Ab.png'"), Not(HasSubstr("\n"))));
}

TEST(GltfNormalMap, BendsTheShadingNormal) {
    // Straight up is blue; a map that leans along u.
    const float lean = 0.6f;
    const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(127.5f * (v + 1.0f))); };
    for (const bool with_tangents : {false, true}) {
        for (const bool along_u : {true, false}) {
            SCOPED_TRACE(with_tangents ? "of the file" : "of the uvs");
            Textured file({{255, 255, 255}});
            file.file.add_file("n.bmp",
                               bitmap({{byte(along_u ? lean : 0.0f), byte(along_u ? 0.0f : lean), byte(0.8f)}}));
            file.file.append("images", {{"uri", "n.bmp"}});
            file.file.append("textures", {{"source", 1}});
            file.file.json["materials"][0]["normalTexture"] = {{"index", 1}};
            if (with_tangents) {
                Json& attributes = file.file.json["meshes"][0]["primitives"][0]["attributes"];
                attributes["NORMAL"] = file.file.add(std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3", 3);
                attributes["TANGENT"] = file.file.add(
                    std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
            }
            // u runs along +x; v, which runs down the picture, along +z; so green leans towards -z.
            const glm::vec3 expected = along_u ? glm::vec3(lean, 0.8f, 0.0f) : glm::vec3(0.0f, 0.8f, -lean);
            expect_near(look_down(file.file.load(), -0.4f, 0.3f).normal, expected, 0.02f);
            file.file.json["materials"][0]["normalTexture"]["scale"] = 0.0;
            expect_near(look_down(file.file.load(), -0.4f, 0.3f).normal, {0, 1, 0}, 0.01f);
        }
    }
}

TEST(GltfNormalMap, ThatCannotBeReadIsLeftOut) {
    Textured file({{255, 255, 255}});
    file.file.json["materials"][0]["normalTexture"] = {{"index", 1}};
    file.file.append("images", {{"uri", "gone.png"}});
    file.file.append("textures", {{"source", 1}});
    const Scene s = file.file.load();
    EXPECT_TRUE(leaves_out(s, "normal map"));
    expect_near(look_down(s, -0.5f, 0.0f).normal, {0, 1, 0});
}

TEST(GltfMaterial, UnlitEmitsWhatItShows) {
    Textured file({{255, 0, 0}});
    file.file.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    file.file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    file.file.json["materials"][0]["emissiveFactor"] = {0, 1, 0};
    const Seen seen = look_down(file.file.load(), -0.5f, 0.0f);
    expect_near(seen.emitted, {0.5f, 0, 0});
}

TEST(GltfMaterial, SpecularAndIndexSetTheReflectance) {
    const auto look = [](const Json& extensions, float metallic = 0.0f) {
        GltfBuilder file;
        const std::size_t material = file.add_material(
            {{"extensions", extensions}}, {{"metallicFactor", metallic}, {"baseColorFactor", {.2, .4, .6, 1}}});
        file.add_node({{"mesh", file.add_mesh(file.square(), {{"material", material}})}});
        return look_down(file.load(), -0.5f, 0.0f).colors;
    };
    const auto expect = [](const render::SurfaceColors& c, const glm::vec3& facing, float grazing) {
        expect_near(c.specular, facing);
        EXPECT_NEAR(c.grazing, grazing, 1e-6f);
    };
    expect(look(Json::object()), glm::vec3(0.04f), 1.0f);
    expect(look({{"KHR_materials_ior", {{"ior", 2.0}}}}), glm::vec3(1.0f / 9.0f), 1.0f);
    expect(look({{"KHR_materials_ior", {{"ior", 1.0}}}}), glm::vec3(0.0f), 1.0f);
    expect(look({{"KHR_materials_ior", {{"ior", 0.0}}}}), glm::vec3(1.0f), 1.0f);
    expect(look({{"KHR_materials_specular", {{"specularFactor", 0.25}}}}), glm::vec3(0.01f), 0.25f);
    expect(look({{"KHR_materials_specular", {{"specularColorFactor", {2, 1, 100}}}}}), {0.08f, 0.04f, 1.0f}, 1.0f);
    expect(look({{"KHR_materials_specular", {{"specularFactor", 0.0}}}}, 1.0f), {0.2f, 0.4f, 0.6f}, 1.0f);
    expect(look({{"KHR_materials_specular", {{"specularFactor", 0.5}}}}, 0.5f), {0.11f, 0.21f, 0.31f}, 0.75f);
}

TEST(GltfMaterial, SpecularGlossinessIsTheOlderWay) {
    GltfBuilder file;
    const Json extension = {
        {"diffuseFactor", {0.8, 0.4, 0.2, 0.5}}, {"specularFactor", {0.1, 0.5, 0.3}}, {"glossinessFactor", 0.7}};
    const std::size_t material = file.add_material(
        {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}, {"alphaMode", "BLEND"}});
    file.add_node({{"mesh", file.add_mesh(file.square(), {{"material", material}})}});
    const render::SurfaceColors c = look_down(file.load(), -0.5f, 0.0f).colors;
    expect_near(c.base, {0.4f, 0.2f, 0.1f});  // what is not reflected at the surface: half
    expect_near(c.specular, {0.1f, 0.5f, 0.3f});
    EXPECT_NEAR(c.roughness, 0.3f, 1e-6f);
    EXPECT_NEAR(c.opacity, 0.5f, 1e-6f);
}

TEST(GltfCamera, OfTwoNodesIsTwo) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    file.append("cameras", {{"name", "lens"}, {"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1}}}});
    file.add_node({{"camera", 0}, {"name", "near"}, {"translation", {0, 1, 0}}});
    file.add_node({{"camera", 0}, {"name", "far"}, {"translation", {0, 9, 0}}});
    file.add_node({{"camera", 0}, {"translation", {0, 11, 0}}});
    const Scene s = file.load();
    ASSERT_EQ(s.cameras.size(), 3u);
    EXPECT_EQ(s.cameras[0].name, "near");
    EXPECT_EQ(s.cameras[1].name, "far");
    EXPECT_EQ(s.cameras[2].name, "lens");
    EXPECT_EQ(s.cameras[1].eye.y, 9.0);
    EXPECT_EQ(s.cameras[1].other_name, "lens");
}

TEST(GltfCamera, MayBeOrthographic) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    const Json lens = {{"xmag", 3}, {"ymag", 2}, {"znear", 1}, {"zfar", 9}};
    file.append("cameras", {{"type", "orthographic"}, {"orthographic", lens}});
    file.add_node({{"camera", 0}});
    EXPECT_EQ(file.load().cameras.at(0).height, 4.0);
    file.json["cameras"][0]["orthographic"]["ymag"] = 0;
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("ymag"));
    file.json["cameras"][0]["type"] = "fisheye";
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("type"));
}

TEST(GltfLight, IgnoresScales) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    const Json lights = Json::array({{{"type", "directional"}}, {{"type", "point"}, {"extras", "bright"}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    const auto light = [](int i) { return Json{{"KHR_lights_punctual", {{"light", i}}}}; };
    const std::vector<double> down{-0.70710678, 0, 0, 0.70710678};
    file.add_node({{"extensions", light(0)}, {"rotation", down}, {"scale", {0, 0, 0}}});
    file.add_node({{"extensions", light(0)}, {"rotation", down}, {"scale", {1, 1, 0.001}}});
    file.add_node({{"extensions", light(1)}, {"scale", {0, 0, 0}}, {"translation", {1, 2, 3}}});
    const Scene s = file.load();
    ASSERT_EQ(s.directional.size(), 2u);
    for (const auto& each : s.directional) expect_near(each.direction, {0, -1, 0});
    ASSERT_EQ(s.omni.size(), 1u);
    expect_near(s.omni[0].position, {1, 2, 3});
    EXPECT_TRUE(leaves_out(s, "extras"));
}

TEST(GltfLight, IsNoBrighterThanAFloatHolds) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array(
        {{{"type", "point"}, {"name", "flare"}, {"intensity", 3e38}, {"color", {1, 2, 1}}}});
    file.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("light 'flare': its intensity times its color is too large"));
    file.json["extensions"]["KHR_lights_punctual"]["lights"][0]["color"] = {1, 1, 1};
    EXPECT_EQ(file.load().omni.at(0).intensity, glm::vec3(3e38f));
}

TEST(GltfNodes, AreATree) {
    GltfBuilder file;
    const std::size_t mesh = file.add_mesh(file.square());
    file.add_node({{"mesh", mesh}, {"children", {1, 2}}});
    file.append("nodes", {{"mesh", mesh}, {"children", {2}}});
    file.append("nodes", {{"mesh", mesh}});
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("two parents"));
    file.json["nodes"][0].erase("children");
    file.json["nodes"][2]["children"] = {1};
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("ancestor"));
    file.json["nodes"][2].erase("children");
    EXPECT_EQ(file.load().triangles.size(), 2u);
    file.json["scenes"][0]["nodes"] = {2};
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("no root"));
    file.json["scenes"][0]["nodes"] = {0, 0};
    EXPECT_EQ(file.load().triangles.size(), 2u) << "named twice, shown once";
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
    file.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(file.load().triangles.size(), 2u) << "what is hidden hides what is below it";
}

TEST(GltfNodes, MayBeAsDeepAsTheyAre) {
    GltfBuilder file;
    const std::size_t mesh = file.add_mesh(file.square());
    constexpr int depth = 50000;
    Json nodes = Json::array();
    for (int i = 0; i < depth; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", mesh}, {"translation", {0, 0, 1}}});
    file.json["nodes"] = nodes;
    file.json["scenes"][0]["nodes"] = {0};
    std::string deep;
    for (int i = 0; i < depth; ++i) deep += "[";
    for (int i = 0; i < depth; ++i) deep += "]";
    std::string text = file.text();
    text.insert(1, "\"extras\":" + deep + ",");
    auto files = file.files();
    files["scene/scene.gltf"] = text;
    EXPECT_EQ(render::load_gltf("scene/scene.gltf", render::MemoryFiles(files)).triangles.size(), 2u);
}

TEST(GltfFileFormat, IsNamedWhenItIsAnother) {
    GltfBuilder file;
    file.add_node({{"mesh", file.add_mesh(file.square())}});
    for (const Json& version : {Json("1.0"), Json(1.0), Json("0.8")}) {
        file.json["asset"]["version"] = version;
        EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("convert it to glTF 2.0"));
    }
    file.json["asset"] = Json::object();
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("asset.version"));
    file.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("needs glTF 2.1"));
}

TEST(GltfFileFormat, IsStrict) {
    GltfBuilder file;
    file.add_material();
    file.add_node({{"mesh", file.add_mesh(file.square(), {{"material", 0}})}});
    const std::pair<Json, const char*> changes[] = {
        {{{"nodes", Json::array({{{"matrix", std::vector<int>(15, 1)}, {"mesh", 0}}})}},
         "matrix is not an array of 16"},
        {{{"nodes", Json::array({{{"rotation", {0, 0, 1}}, {"mesh", 0}}})}}, "rotation is not an array of four"},
        {{{"nodes", Json::array({{{"mesh", -1}}})}}, "mesh is not a whole number"},
        {{{"nodes", Json::array({{{"mesh", 0.5}}})}}, "mesh is not a whole number"},
        {{{"nodes", Json::array({7})}}, "is not an object"},
        {{{"nodes", 7}}, "nodes is not an array"},
        {{{"scene", "first"}}, "scene is not a whole number"},
        {{{"materials", Json::array({{{"alphaMode", "MAYBE"}}})}}, "alphaMode"},
        {{{"materials", Json::array({{{"emissiveFactor", {1, 2}}}})}}, "emissiveFactor is not an array of three"},
        {{{"materials",
           Json::array({{{"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", "strong"}}}}}}})}},
         "emissiveStrength is not a number"},
        {{{"materials", Json::array({{{"doubleSided", 1}}})}}, "doubleSided is not true or false"},
        {{{"materials", Json::array({{{"extensions", "none"}}})}}, "extensions is not an object"},
        {{{"extensionsRequired", {"KHR_draco_mesh_compression"}}}, "KHR_draco_mesh_compression"},
        {{{"extensionsRequired", {1}}}, "extensionsRequired"},
    };
    for (const auto& [change, says] : changes) {
        GltfBuilder copy = file;
        copy.json.update(change);
        EXPECT_THAT(refusal([&] { copy.load(); }), HasSubstr(says)) << change.dump();
    }
    for (const Json& material : {Json(-7), Json(3), Json("red"), Json(1.5)}) {
        GltfBuilder copy = file;
        copy.json["meshes"][0]["primitives"][0]["material"] = material;
        EXPECT_THAT(refusal([&] { copy.load(); }), HasSubstr("material")) << material.dump();
    }
    GltfBuilder copy = file;
    copy.json["bufferViews"][0]["byteLength"] = 1000000;
    EXPECT_THAT(refusal([&] { copy.load(); }), HasSubstr("past the end of its buffer"));
    copy = file;
    copy.json["accessors"][0]["count"] = 4503599627370496;
    EXPECT_THAT(refusal([&] { copy.load(); }), HasSubstr("cut off"));
}

TEST(GltfLeftOut, IsNamedOnce) {
    GltfBuilder file;
    const Json material = {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}},
                           {"occlusionTexture", {{"index", 0}}}};
    file.add_material(material);
    file.add_material(material);
    const std::size_t mesh = file.add_mesh(file.square(), {{"material", 0}});
    file.json["meshes"][mesh]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    file.json["meshes"][mesh]["primitives"].push_back(
        {{"attributes", {{"POSITION", 0}}}, {"material", 1}, {"indices", 1}});
    file.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_ior", "ACME_secret"};
    file.add_node({{"mesh", mesh}});
    const Scene s = file.load();
    std::vector<std::string> names;
    for (const render::LeftOut& item : s.left_out) names.push_back(item.what);
    EXPECT_THAT(names,
                testing::UnorderedElementsAre("occlusion textures", "points and lines", "the extension ACME_secret",
                                              "the extension KHR_materials_clearcoat"));
}

TEST(GltfLeftOut, CompressedMeshesNeedTheirFallback) {
    GltfBuilder file;
    const std::size_t mesh = file.add_mesh(file.square());
    file.json["meshes"][mesh]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    file.add_node({{"mesh", mesh}});
    EXPECT_TRUE(leaves_out(file.load(), "KHR_draco_mesh_compression"));
    file.json["accessors"][0].erase("bufferView");
    EXPECT_THAT(refusal([&] { file.load(); }), HasSubstr("KHR_draco_mesh_compression"));
}

TEST(GltfFarAway, StandsWhereANodePutsIt) {
    for (const double x : {0.0, 1e3, 408192.0, 4e6, 1e9}) {
        GltfBuilder file;
        const std::size_t mesh = file.add_mesh(file.square());
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
        const Json light = {{"KHR_lights_punctual", {{"light", 0}}}};
        file.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1}}}});
        file.append("nodes", {{"mesh", mesh}});
        file.append("nodes", {{"extensions", light}, {"translation", {0, 0.25, 0}}});
        file.append("nodes", {{"camera", 0}, {"translation", {0, 2, 0}}});
        file.add_node({{"children", {0, 1, 2}}, {"translation", {x, 0, -x}}});
        const Scene s = file.load();
        const glm::dvec3 there(x, 0.0, -x);
        EXPECT_EQ(glm::dvec3(s.positions[0]) + s.origin, there + glm::dvec3(-1, 0, 1)) << x;
        EXPECT_LT(glm::length(s.positions[0]), 8.0f * 2.0f) << x;
        EXPECT_EQ(glm::dvec3(s.omni.at(0).position) + s.origin, there + glm::dvec3(0, 0.25, 0)) << x;
        EXPECT_EQ(s.cameras.at(0).eye, there + glm::dvec3(0, 2, 0)) << x;
    }
}

}  // namespace
