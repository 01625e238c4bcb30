#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/load_gltf.hpp>
#include <render/io/load_scene.hpp>
#include <render/surfaces/texture.hpp>

#include "render/bitmap.hpp"
#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace {

using render::load_gltf;
using render::load_scene;
using render::Material;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

template <class T>
std::string bytes(const std::vector<T>& values) {
    std::string text(values.size() * sizeof(T), '\0');
    std::memcpy(text.data(), values.data(), text.size());
    return text;
}

/// One triangle: positions, normals, uvs, 16-bit indices.
std::string triangle_data(float first_x = 0.0f) {
    return bytes<float>({first_x, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}) +
           bytes<float>({0, 0, 1, 0, 0, 1}) + bytes<std::uint16_t>({0, 1, 2, 0});
}

/// A file with that triangle as mesh 0, buffer given by `buffer`, and `members` besides.
std::string gltf(const std::string& members, const std::string& buffer = R"({"byteLength":104,"uri":"data.bin"})",
                 const std::string& material = "") {
    return R"({"asset":{"version":"2.0"},"buffers":[)" + buffer + R"(],"bufferViews":[
        {"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
        {"buffer":0,"byteOffset":72,"byteLength":24},{"buffer":0,"byteOffset":96,"byteLength":8}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
        {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
        {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},
        {"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"}],
        "meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3)" +
           material + "}]}]," + members + "}";
}

std::uint32_t padded(std::size_t size) { return static_cast<std::uint32_t>((size + 3) / 4 * 4); }

std::string glb(std::string json, std::string data) {
    json.resize(padded(json.size()), ' ');
    data.resize(padded(data.size()), '\0');
    const auto json_size = static_cast<std::uint32_t>(json.size());
    const auto data_size = static_cast<std::uint32_t>(data.size());
    return "glTF" + bytes<std::uint32_t>({2, 28 + json_size + data_size, json_size, 0x4E4F534A}) + json +
           bytes<std::uint32_t>({data_size, 0x004E4942}) + data;
}

/// Writes data.bin and the file; loads it.
struct GltfFile : testing::Test {
    TemporaryFolder folder;

    std::string write(const std::string& members, const std::string& material = "") {
        folder.write("data.bin", triangle_data());
        return folder.write("scene.gltf", gltf(members, R"({"byteLength":104,"uri":"data.bin"})", material));
    }
    Scene load(const std::string& members, const std::string& material = "") {
        return load_gltf(write(members, material));
    }
};

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " not " << b.x << " " << b.y << " " << b.z;
}

glm::vec3 face_normal(const Scene& s, std::size_t t) {
    const glm::uvec3 i = s.triangles[t];
    return glm::normalize(glm::cross(s.positions[i.y] - s.positions[i.x], s.positions[i.z] - s.positions[i.x]));
}

TEST_F(GltfFile, InstancesWithTransforms) {
    // A parent moves two instances; one is mirrored, which must not turn its faces inside out.
    const Scene s = load(R"("scenes":[{"nodes":[0]}],"nodes":[{"translation":[10,0,0],"children":[1,2]},
        {"mesh":0,"scale":[2,3,1],"translation":[0,0,5]},
        {"mesh":0,"scale":[-1,1,1],"rotation":[0,0,0,1]}])");
    ASSERT_EQ(s.triangles.size(), 2u);
    ASSERT_EQ(s.positions.size(), 6u);
    expect_near(s.positions[1], {12, 0, 5});
    expect_near(s.positions[2], {10, 3, 5});
    expect_near(s.positions[4], {9, 0, 0});
    expect_near(face_normal(s, 0), {0, 0, 1});
    expect_near(face_normal(s, 1), {0, 0, 1});
    ASSERT_EQ(s.normals.size(), 6u);
    expect_near(s.normals[0], {0, 0, 1});
    EXPECT_TRUE(s.uv_sets.empty()) << "no texture asks for them";
}

TEST_F(GltfFile, NormalsUnderUnevenScale) {
    // Rotated by 90 degrees about x and stretched: normals go by the inverse transpose.
    const Scene s = load(R"("scenes":[{"nodes":[0]}],"nodes":[{"scale":[1,1,4],"children":[1]},
        {"mesh":0,"rotation":[0.38268343,0,0,0.92387953]}])");
    const glm::vec3 n = s.normals[0];
    expect_near(n, face_normal(s, 0), 1e-5f);
}

TEST_F(GltfFile, OnlyTheDefaultScene) {
    const Scene s = load(R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],
        "nodes":[{"mesh":0},{"mesh":0,"translation":[0,0,7]}])");
    ASSERT_EQ(s.triangles.size(), 1u);
    EXPECT_EQ(s.positions[0].z, 7.0f);
}

TEST_F(GltfFile, AllRootsWithoutScenes) {
    const Scene s = load(R"("nodes":[{"mesh":0},{"children":[2]},{"mesh":0,"translation":[0,0,7]}])");
    EXPECT_EQ(s.triangles.size(), 2u);
}

TEST_F(GltfFile, Cameras) {
    const Scene s = load(R"("scenes":[{"nodes":[0,1,2]}],"nodes":[{"mesh":0},
        {"name":"door","camera":0,"translation":[1,2,3],"rotation":[0,0.70710678,0,0.70710678]},{"camera":1}],
        "cameras":[{"type":"perspective","perspective":{"yfov":0.5235988,"znear":0.1}},
        {"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}])");
    ASSERT_EQ(s.cameras.size(), 2u);
    EXPECT_EQ(s.cameras[1].height, 2.0);
    EXPECT_EQ(s.cameras[0].height, 0.0);
    EXPECT_EQ(s.cameras[0].name, "door");
    EXPECT_NEAR(s.cameras[0].vertical_fov, 30.0f, 1e-4f);
    expect_near(glm::vec3(s.cameras[0].eye), {1, 2, 3});
    expect_near(glm::vec3(glm::normalize(s.cameras[0].target - s.cameras[0].eye)), {-1, 0, 0}, 1e-5f);
    expect_near(s.cameras[0].up, {0, 1, 0});
}

TEST_F(GltfFile, PunctualLights) {
    const Scene s = load(R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","color":[1,0.5,0.25],"intensity":8},
        {"type":"spot","intensity":3,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.6}},
        {"type":"directional","intensity":2}]}},
        "scenes":[{"nodes":[0,1,2,3]}],"nodes":[{"mesh":0},
        {"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"scale":[5,5,5],"rotation":[0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":1}}},
        {"rotation":[-0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":2}}}])");
    ASSERT_EQ(s.omni.size(), 1u);
    expect_near(s.omni[0].position, {1, 2, 3});
    expect_near(s.omni[0].intensity, {8, 4, 2});
    ASSERT_EQ(s.spots.size(), 1u);
    expect_near(s.spots[0].axis, {0, 1, 0}, 1e-5f);
    expect_near(s.spots[0].intensity, {3, 3, 3});
    EXPECT_NEAR(s.spots[0].profile.cos_inner, std::cos(0.2f), 1e-6f);
    EXPECT_NEAR(s.spots[0].profile.cos_outer, std::cos(0.6f), 1e-6f);
    ASSERT_EQ(s.directional.size(), 1u);
    expect_near(s.directional[0].direction, {0, -1, 0}, 1e-5f);
}

TEST_F(GltfFile, PointLightsWithARadiusAreSpheres) {
    const Scene s = load(R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","intensity":8,"extras":{"radius":0.25}},
        {"type":"point","intensity":2,"extras":{"radius":0,"color":"red"}},
        {"type":"spot","intensity":3,"spot":{"outerConeAngle":0.6},"extras":{"radius":0.25}}]}},
        "scenes":[{"nodes":[0,1,2,3]}],"nodes":[{"mesh":0},
        {"translation":[1,2,3],"scale":[5,5,5],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}}])");
    ASSERT_EQ(s.spheres.size(), 1u);
    expect_near(s.spheres[0].center, {1, 2, 3});
    EXPECT_EQ(s.spheres[0].radius, 0.25f);
    expect_near(s.spheres[0].intensity, {8, 8, 8});
    EXPECT_EQ(s.omni.size(), 1u);
    EXPECT_EQ(s.spots.size(), 1u);
}

TEST_F(GltfFile, Materials) {
    folder.write("t.bmp", bitmap({{188, 0, 255}, {0, 128, 255}}));
    const Scene s = load(R"("images":[{"uri":"t.bmp"}],"textures":[{"source":0,"sampler":0}],
        "samplers":[{"wrapS":33071,"wrapT":33648}],
        "materials":[{"name":"lamp","emissiveFactor":[1,0.5,0],"doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.3,
        "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.5],"metallicFactor":0.4,"roughnessFactor":0.6,
        "baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}},
        "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":30},
        "KHR_materials_transmission":{"transmissionFactor":0.7},"KHR_materials_ior":{"ior":1.33}}}],
        "scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])",
                         R"(,"material":0)");
    ASSERT_EQ(s.materials.size(), 1u);
    const Material& m = s.materials[0];
    EXPECT_EQ(m.name, "lamp");
    EXPECT_EQ(m.model, Material::Model::microfacet);
    expect_near(m.emission, {30, 15, 0});
    expect_near(m.base_color, {0.1f, 0.2f, 0.3f});
    EXPECT_FLOAT_EQ(m.base_alpha, 0.5f);
    EXPECT_FLOAT_EQ(m.metallic, 0.4f);
    EXPECT_FLOAT_EQ(m.roughness, 0.6f);
    EXPECT_FLOAT_EQ(m.transmission, 0.7f);
    EXPECT_FLOAT_EQ(m.ior, 1.33f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.alpha, Material::Alpha::mask);
    EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.3f);

    // The same image once as sRGB color, once as plain numbers.
    ASSERT_EQ(s.textures.size(), 2u);
    const auto& color = s.textures[static_cast<std::size_t>(m.base_color_texture.texture)];
    const auto& data = s.textures[static_cast<std::size_t>(m.metallic_roughness_texture.texture)];
    EXPECT_EQ(color.wrap_u, render::Texture::Wrap::clamp);
    EXPECT_EQ(color.wrap_v, render::Texture::Wrap::mirror);
    EXPECT_NEAR(color.texels[0].r, 0.5029f, 1e-4f);
    EXPECT_NEAR(color.texels[1].g, 0.2159f, 1e-4f);
    EXPECT_NEAR(data.texels[1].g, 128.0f / 255.0f, 1e-6f);
}

TEST_F(GltfFile, DiffuseTransmission) {
    folder.write("t.bmp", bitmap({{188, 0, 255}, {0, 128, 255}}));
    const auto material = [](const std::string& members) {
        return R"("images":[{"uri":"t.bmp"}],"textures":[{"source":0}],
            "extensionsRequired":["KHR_materials_diffuse_transmission"],"materials":[{"name":"leaf","extensions":{
            "KHR_materials_diffuse_transmission":{)" +
               members + R"(}}}],"nodes":[{"mesh":0}])";
    };
    const auto read = [&](const std::string& members) { return load(material(members), R"(,"material":0)"); };
    Scene s = read(R"("diffuseTransmissionFactor":0.4,"diffuseTransmissionColorFactor":[0.1,0.8,0.2],
        "diffuseTransmissionTexture":{"index":0},"diffuseTransmissionColorTexture":{"index":0,
        "extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}})");
    const Material& m = s.materials[0];
    EXPECT_FLOAT_EQ(m.diffuse_transmission, 0.4f);
    expect_near(m.diffuse_transmission_color, {0.1f, 0.8f, 0.2f});
    ASSERT_EQ(s.textures.size(), 2u);
    ASSERT_TRUE(m.diffuse_transmission_texture.is_there());
    ASSERT_TRUE(m.diffuse_transmission_color_texture.is_there());
    EXPECT_NEAR(s.textures[static_cast<std::size_t>(m.diffuse_transmission_color_texture.texture)].texels[0].r, 0.5029f,
                1e-4f);
    expect_near(glm::vec3(m.diffuse_transmission_color_texture.uv({0, 0}), 0.0f), {0.5f, 0, 0});
    expect_near(glm::vec3(m.diffuse_transmission_texture.uv({0, 0}), 0.0f), {0, 0, 0});

    s = read(R"("diffuseTransmissionFactor":1)");
    expect_near(s.materials[0].diffuse_transmission_color, {1, 1, 1});
    EXPECT_FALSE(s.materials[0].diffuse_transmission_texture.is_there());
    s = read(R"("diffuseTransmissionTexture":{"index":0})");
    EXPECT_EQ(s.materials[0].diffuse_transmission, 0.0f);
    EXPECT_TRUE(s.textures.empty()) << "what has no effect is not loaded";
    const auto refused = [&](const std::string& members) {
        return refusal([&] { load_scene(write(material(members), R"(,"material":0)")); });
    };
    EXPECT_THAT(refused(R"("diffuseTransmissionFactor":1.5)"), HasSubstr("'leaf': diffuse transmission"));
    EXPECT_THAT(refused(R"("diffuseTransmissionFactor":1,"diffuseTransmissionColorFactor":[-1,1,1])"),
                HasSubstr("'leaf': the diffuse transmission color"));
    EXPECT_THAT(refused(R"("diffuseTransmissionFactor":1,"diffuseTransmissionTexture":{"index":7})"),
                HasSubstr("texture 7"));
    const std::pair<const char*, const char*> malformed[] = {
        {R"("diffuseTransmissionFactor":"all")", "diffuseTransmissionFactor is not a number"},
        {R"("diffuseTransmissionColorFactor":[1,1])", "diffuseTransmissionColorFactor is not an array of three"},
        {R"("diffuseTransmissionColorFactor":0.5)", "diffuseTransmissionColorFactor is not an array of three"},
        {R"("diffuseTransmissionColorFactor":[1,"1",1])", "diffuseTransmissionColorFactor is not an array of three"},
        {R"("diffuseTransmissionTexture":{"texCoord":0})", "diffuseTransmissionTexture: its index"},
        {R"("diffuseTransmissionTexture":{"index":-1})", "diffuseTransmissionTexture: its index"},
        {R"("diffuseTransmissionColorTexture":{"index":0.5})", "diffuseTransmissionColorTexture: its index"},
        {R"("diffuseTransmissionTexture":{"index":0,"texCoord":"0"})", "diffuseTransmissionTexture: its texCoord"},
        {R"("diffuseTransmissionTexture":0)", "diffuseTransmissionTexture: its index"},
    };
    for (const auto& [members, says] : malformed) {
        EXPECT_THAT(refused(members), HasSubstr(std::string("material 'leaf': ") + says)) << members;
    }
}

TEST_F(GltfFile, TextureTransforms) {
    folder.write("t.bmp", bitmap({{255, 255, 255}}));
    const auto material = [&](const std::string& info) {
        return R"("images":[{"uri":"t.bmp"}],"textures":[{"source":0}],"extensionsRequired":["KHR_texture_transform"],
            "materials":[{"name":"tiled","emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorTexture":{"index":0},
            "metallicRoughnessTexture":{"index":0)" +
               info + R"(}},"emissiveTexture":{"index":0)" + info + R"(}}],"nodes":[{"mesh":0}])";
    };
    const auto read = [&](const std::string& info) { return load(material(info), R"(,"material":0)"); };
    const auto expect_at = [](const render::UvTransform& transform, glm::vec2 uv, glm::vec2 expected) {
        expect_near(glm::vec3(transform(uv), 0.0f), glm::vec3(expected, 0.0f));
    };

    // The extension's own example: the lower left quadrant, turned by 90 degrees clockwise.
    Scene s = read(R"(,"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1.57079632679,
        "scale":[0.5,0.5]}})");
    for (const auto& transform : {s.materials[0].metallic_roughness_texture.uv, s.materials[0].emission_texture.uv}) {
        expect_at(transform, {0, 0}, {0, 1});
        expect_at(transform, {1, 0}, {0, 0.5f});
        expect_at(transform, {0, 1}, {0.5f, 1});
        expect_at(transform, {1, 1}, {0.5f, 0.5f});
    }
    expect_at(s.materials[0].base_color_texture.uv, {0.3f, 0.7f}, {0.3f, 0.7f});

    s = read(R"(,"extensions":{"KHR_texture_transform":{"scale":[3,-1]}})");
    expect_at(s.materials[0].emission_texture.uv, {0.5f, 0.25f}, {1.5f, -0.25f});

    // Its texCoord overrides the texture's own, which would be another one than the base color's.
    s = read(R"(,"texCoord":1,"extensions":{"KHR_texture_transform":{"texCoord":0}})");
    ASSERT_EQ(s.uv_sets.size(), 1u);
    EXPECT_EQ(s.uv_sets[0].size(), 3u);
    EXPECT_EQ(s.uv_sets[0][1], glm::vec2(1, 0));
    const auto refused = [&](const std::string& members) {
        return refusal([&] { read(R"(,"extensions":{"KHR_texture_transform":{)" + members + "}}"); });
    };
    // Two sets go together; what is not there is named.
    s = read(R"(,"texCoord":1)");
    ASSERT_EQ(s.uv_sets.size(), 2u);
    EXPECT_EQ(s.materials[0].base_color_texture.uv_set, 0u);
    EXPECT_EQ(s.materials[0].emission_texture.uv_set, 1u);
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_THAT(s.left_out[0].why, HasSubstr("TEXCOORD_1"));
    EXPECT_THAT(refused(R"("texCoord":"a")"), HasSubstr("texCoord"));
    EXPECT_THAT(refused(R"("offset":[1])"), HasSubstr("'tiled': KHR_texture_transform: offset"));
    EXPECT_THAT(refused(R"("scale":2)"), HasSubstr("scale"));
    EXPECT_THAT(refused(R"("rotation":"half")"), HasSubstr("rotation"));
}

TEST_F(GltfFile, DefaultMaterialIsTheFormats) {
    const Scene s = load(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])");
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].metallic, 1.0f);
    EXPECT_EQ(s.materials[0].roughness, 1.0f);
    expect_near(s.materials[0].base_color, {1, 1, 1});
}

TEST_F(GltfFile, StripsAndFans) {
    folder.write("data.bin", bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
    const auto file = [&](int mode) {
        return folder.write("s.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":48,"uri":"data.bin"}],
            "bufferViews":[{"buffer":0,"byteLength":48}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                                          std::to_string(mode) + R"(}]}],"nodes":[{"mesh":0}]})");
    };
    const Scene strip = load_gltf(file(5));
    ASSERT_EQ(strip.triangles.size(), 2u);
    expect_near(face_normal(strip, 0), {0, 0, 1});
    expect_near(face_normal(strip, 1), {0, 0, 1});
    EXPECT_TRUE(strip.normals.empty());
    EXPECT_TRUE(strip.uv_sets.empty());
    const Scene fan = load_gltf(file(6));
    ASSERT_EQ(fan.triangles.size(), 2u);
    EXPECT_EQ(fan.triangles[1], glm::uvec3(0, 2, 3));
    EXPECT_TRUE(load_gltf(file(1)).triangles.empty());
}

TEST_F(GltfFile, BinaryFile) {
    const std::string text = gltf(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])", R"({"byteLength":104})");
    const Scene s = load_scene(folder.write("scene.glb", glb(text, triangle_data())));
    EXPECT_EQ(s.triangles.size(), 1u);
}

TEST_F(GltfFile, EveryTruncationIsRefused) {
    const std::string whole = glb(gltf(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])", R"({"byteLength":104})"),
                                  triangle_data());
    for (std::size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 7) {
        const std::string path = folder.write("cut.glb", whole.substr(0, size));
        EXPECT_THAT(refusal([&] { load_scene(path); }), StartsWith(path + ": ")) << size;
    }
    const std::string text = gltf(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])");
    folder.write("data.bin", triangle_data());
    for (std::size_t size = 0; size < text.size(); size += 13) {
        const std::string path = folder.write("cut.gltf", text.substr(0, size));
        EXPECT_THAT(refusal([&] { load_scene(path); }), StartsWith(path + ": ")) << size;
    }
}

TEST_F(GltfFile, ChangedBytesNeverCrash) {
    const std::string whole = glb(gltf(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])", R"({"byteLength":104})"),
                                  triangle_data());
    for (std::size_t i = 0; i < whole.size(); i += 3) {
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ (i % 2 == 0 ? 0x10 : 0x01));
        try {
            load_scene(folder.write("changed.glb", changed));
        } catch (const lightcuts::invalid_input&) {}
    }
}

TEST_F(GltfFile, MissingThings) {
    EXPECT_THAT(refusal([&] { load_scene(folder / "none.glb"); }), HasSubstr("no such file"));
    EXPECT_THAT(refusal([&] { load_scene(folder / "none.blend"); }), HasSubstr(".glb"));
    const std::string path = write(R"("images":[{"uri":"gone.png"}],"textures":[{"source":0}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"nodes":[{"mesh":0}])",
                                   R"(,"material":0)");
    EXPECT_THAT(refusal([&] { load_scene(path); }), HasSubstr("gone.png"));
    std::filesystem::remove(folder.path() / "data.bin");
    EXPECT_THAT(refusal([&] { load_scene(path); }), HasSubstr("data.bin"));
}

TEST_F(GltfFile, BadContents) {
    const auto refused = [&](const std::string& members) { return refusal([&] { load_scene(write(members)); }); };
    EXPECT_THAT(refused(R"("nodes":[{"mesh":7}])"), HasSubstr("mesh 7"));
    EXPECT_THAT(refused(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[0]}])"), HasSubstr("ancestor"));
    EXPECT_THAT(refused(R"("nodes":[])"), HasSubstr("no triangles"));
    EXPECT_THAT(refused(R"("extensionsRequired":["KHR_draco_mesh_compression"],"nodes":[{"mesh":0}])"),
                HasSubstr("KHR_draco_mesh_compression"));
    EXPECT_THAT(refused(R"("nodes":[{"mesh":0,"scale":[0,0,0]}])"), HasSubstr("zero area"));
    const std::string light =
        R"("extensions":{"KHR_lights_punctual":{"lights":[{"name":"L","type":"point","intensity":-1}]}},
        "nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}])";
    EXPECT_THAT(refused(light), HasSubstr("'L'"));
    for (const char* radius : {"-1", "\"big\"", "1e60"}) {
        const std::string sphere =
            R"("extensions":{"KHR_lights_punctual":{"lights":[{"name":"S","type":"point","extras":{"radius":)" +
            std::string(radius) + R"(}}]}},"nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}])";
        EXPECT_THAT(refused(sphere), HasSubstr("'S': the radius"));
    }
}

TEST_F(GltfFile, BadNumbers) {
    const std::string path = write(R"("nodes":[{"mesh":0}])");
    folder.write("data.bin", triangle_data(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_THAT(refusal([&] { load_scene(path); }), HasSubstr("vertex 0"));
    std::string data = triangle_data();
    data[98] = 9;  // the second index
    folder.write("data.bin", data);
    EXPECT_THAT(refusal([&] { load_scene(path); }), HasSubstr("an index is past"));
}

}  // namespace
