#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/surfaces/surface_colors.hpp>

#include "render/bitmap.hpp"
#include "render/exr_pixel.hpp"
#include "render/gltf_builder.hpp"
#include "render/refusal.hpp"

namespace {

using Json = nlohmann::json;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

/// A square of one material; texture i shows image i.
struct Painted {
    GltfBuilder file;
    std::size_t images = 0;

    Json texture(const std::string& bytes) {
        const std::string name = "t" + std::to_string(images);
        file.add_file(name, bytes);
        return named(name);
    }
    Json named(const std::string& name) {
        file.append("images", {{"uri", name}});
        file.append("textures", {{"source", images}});
        return {{"index", images++}};
    }

    void show(const Json& material, const Json& pbr = Json::object(), const std::vector<float>& uvs = {}) {
        Json attributes = file.square();
        attributes["TEXCOORD_0"] = file.add(uvs.empty() ? std::vector<float>(8, 0.5f) : uvs, "VEC2", 2);
        file.add_node({{"mesh", file.add_mesh(attributes, {{"material", file.add_material(material, pbr)}})}});
    }

    std::vector<std::string> left_out() const {
        std::vector<std::string> all;
        for (const render::LeftOut& item : file.load().left_out) all.push_back(item.what + ": " + item.why);
        return all;
    }
};

const Json none = Json::object();
const std::string bright = exr_pixel({5, 3, 0.5f, 1});

TEST(GltfBrightImage, ReflectsNoMoreThanItGets) {
    const auto colors = [](const Json& material, const Json& pbr) {
        Painted painted;
        painted.texture(bright);
        painted.show(material, pbr);
        const Scene scene = painted.file.load();
        EXPECT_THAT(scene.left_out, testing::ElementsAre(testing::Field(&render::LeftOut::what,
                                                                        HasSubstr("above 1 of the texture 't0'"))));
        return render::colors_at(scene, 0, 0.3f, 0.3f);
    };
    const Json map = {{"index", 0}};
    const glm::vec3 clipped(1.0f, 1.0f, 0.5f);
    EXPECT_EQ(colors(none, {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", map}}).base, clipped);
    EXPECT_EQ(colors(none, {{"baseColorFactor", {0.5, 1, 1, 1}}, {"baseColorTexture", map}}).base,
              glm::vec3(0.5f, 1, 0.5f));
    const Json leaf = {{"diffuseTransmissionFactor", 1}, {"diffuseTransmissionColorTexture", map}};
    EXPECT_EQ(colors({{"extensions", {{"KHR_materials_diffuse_transmission", leaf}}}}, none).diffuse_transmission_color,
              clipped);
    const Json tint = {{"specularColorTexture", map}};
    const glm::vec3 facing = colors({{"extensions", {{"KHR_materials_specular", tint}}}}, none).specular;
    EXPECT_NEAR(facing.r, 0.04f, 1e-6f);
    EXPECT_NEAR(facing.b, 0.02f, 1e-6f);
    const Json old = {{"specularGlossinessTexture", map}, {"specularFactor", {1, 1, 1}}};
    const render::SurfaceColors glossy = colors({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", old}}}}, none);
    EXPECT_EQ(glossy.specular, clipped);
    EXPECT_EQ(glossy.base, glm::vec3(0.0f)) << "nothing gets below the surface, and no less than nothing";
}

TEST(GltfBrightImage, EmitsWhatItHolds) {
    const auto emitted = [](const Json& material, const Json& pbr, const glm::vec4& texel) {
        Painted painted;
        painted.texture(exr_pixel(texel));
        painted.show(material, pbr);
        const Scene scene = painted.file.load();
        EXPECT_TRUE(scene.left_out.empty());
        return render::emitted_radiance(scene, 0, 0.3f, 0.3f, true);
    };
    const Json map = {{"index", 0}};
    const Json lamp = {{"emissiveTexture", map}, {"emissiveFactor", {1, 1, 1}}};
    EXPECT_EQ(emitted(lamp, none, {5, 3, 0.5f, 1}), glm::vec3(5, 3, 0.5f));
    // OpenEXR's colors are the radiance, whatever its alpha says.
    EXPECT_EQ(emitted(lamp, none, {5, 3, 0.5f, 0.5f}), glm::vec3(5, 3, 0.5f));
    EXPECT_EQ(emitted(lamp, none, {5, 3, 0.5f, 0}), glm::vec3(5, 3, 0.5f));
    const Json unlit = {{"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    EXPECT_EQ(emitted(unlit, {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", map}}, {5, 3, 0.5f, 1}),
              glm::vec3(5, 3, 0.5f));
    // What covers is multiplied by alpha once.
    Json sheer = unlit;
    sheer["alphaMode"] = "BLEND";
    const glm::vec3 seen = emitted(sheer, {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", map}},
                                   {2, 1, 0.5f, 0.25f});
    EXPECT_EQ(seen, glm::vec3(2, 1, 0.5f));
}

TEST(GltfTransform, MayNotMoveUvsBeyondWhatAFloatHolds) {
    const auto load = [](float uv, float scale) {
        Painted painted;
        Json map = painted.texture(bitmap({{255, 0, 0}}));
        map["extensions"] = {{"KHR_texture_transform", {{"scale", {scale, scale}}}}};
        painted.show(none, {{"baseColorTexture", map}}, std::vector<float>(8, uv));
        return painted.file.load();
    };
    for (const auto& [uv, scale] : {std::pair{1e30f, 1e10f}, {-1e30f, 1e10f}, {3e38f, 1.0f}, {1e20f, 3e38f}}) {
        EXPECT_THAT(refusal([&, uv = uv, scale = scale] { load(uv, scale); }), HasSubstr("the uv of vertex 0"));
    }
    for (const auto& [uv, scale] : {std::pair{1e30f, 1e-10f}, {1e18f, 1e18f}, {0.5f, 1e30f}, {0.0f, 3e38f}}) {
        const Scene scene = load(uv, scale);
        EXPECT_EQ(render::colors_at(scene, 0, 0.3f, 0.3f).base.r, 1.0f) << uv << " " << scale;
    }
}

TEST(GltfUnusedImage, IsNamedWithItsReason) {
    const auto why = [](const Json& material, const Json& pbr, const Json& texture = Json::object()) {
        Painted painted;
        painted.named("gone.png");
        painted.file.json["textures"][0].update(texture);
        painted.show(material, pbr);
        const auto all = painted.left_out();
        for (const std::string& line : all) {
            if (line.starts_with("gone.png: ")) return line.substr(10);
        }
        return std::string("nothing");
    };
    const Json map = {{"index", 0}};
    EXPECT_THAT(why({{"emissiveTexture", map}}, none),
                StartsWith("emissiveTexture has no effect where its factor is 0"));
    EXPECT_THAT(why({{"emissiveTexture", map}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}, none),
                StartsWith("emissiveTexture of an unlit material"));
    EXPECT_THAT(why({{"occlusionTexture", map}}, none), StartsWith("occlusionTexture has no effect"));
    EXPECT_THAT(why({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", map}}}}}}, none),
                StartsWith("clearcoatTexture has no effect"));
    EXPECT_THAT(why(none, none), StartsWith("no material that is used refers"));
    // Factors of 0, all kinds.
    EXPECT_THAT(why(none, {{"baseColorTexture", map}, {"baseColorFactor", {0, 0, 0, 1}}}),
                StartsWith("baseColorTexture"));
    EXPECT_THAT(why(none, {{"metallicRoughnessTexture", map}, {"metallicFactor", 0}, {"roughnessFactor", 0}}),
                StartsWith("metallicRoughnessTexture"));
    for (const Json& specular : {Json{{"specularColorTexture", map}, {"specularFactor", 0}},
                                 Json{{"specularTexture", map}, {"specularFactor", 0}},
                                 Json{{"specularColorTexture", map}, {"specularColorFactor", {0, 0, 0}}}}) {
        EXPECT_THAT(why({{"extensions", {{"KHR_materials_specular", specular}}}}, none), StartsWith("specular"));
    }
    // The better one of two.
    Painted pair;
    pair.texture(bitmap({{255, 0, 0}}));
    pair.file.append("images", {{"uri", "better.webp"}});
    pair.file.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
    pair.show(none, {{"baseColorTexture", map}});
    EXPECT_THAT(pair.left_out(), testing::Contains("better.webp: images of EXT_texture_webp cannot be read"));
}

TEST(GltfTexture, ThatCannotBeReadNamesItsMaterial) {
    Painted painted;
    const Json map = painted.named("gone.png");
    painted.show({{"name", "wall"}}, {{"baseColorTexture", map}});
    EXPECT_THAT(refusal([&] { painted.file.load(); }),
                testing::AllOf(HasSubstr("material 'wall': baseColorTexture: "), HasSubstr("gone.png")));
}

}  // namespace
