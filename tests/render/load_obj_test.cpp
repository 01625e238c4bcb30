#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/load_obj.hpp>
#include <render/load_scene.hpp>

#include "bitmap.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace {

using render::load_obj;
using render::load_scene;
using render::Material;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

struct ObjFile : testing::Test {
    TemporaryFolder folder;

    Scene load(const std::string& text) { return load_obj(folder.write("scene.obj", text)); }

    /// The message without the folder: "scene.obj:3: ...".
    std::string refused(const std::string& text) {
        const std::string path = folder.write("scene.obj", text);
        const std::string message = refusal([&] { load_scene(path); });
        const std::string prefix = folder.path().string() + "/";
        EXPECT_THAT(message, StartsWith(prefix));
        return message.substr(prefix.size());
    }
};

constexpr const char* square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ObjFile, PolygonsAndNegativeIndices) {
    const Scene s = load(std::string(square) + "f 1 2 3 4\nf -4 -3 -2\nv 0 0 1\nf -1 1 2\n");
    EXPECT_EQ(s.triangles.size(), 4u);
    EXPECT_EQ(s.positions.size(), 5u);
    EXPECT_TRUE(s.normals.empty());
    EXPECT_TRUE(s.uv_sets.empty());
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].base_color, glm::vec3(0.8f));
    EXPECT_EQ(s.materials[0].specular, glm::vec3(0.0f));
}

TEST_F(ObjFile, FlatFacesWhereNormalsAreMissing) {
    const Scene s = load(std::string(square) + "vn 0 0 1\nvt 0.25 0.25\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n");
    ASSERT_EQ(s.normals.size(), s.positions.size());
    EXPECT_EQ(s.normals[s.triangles[0].x], glm::vec3(0, 0, 1));
    EXPECT_EQ(s.normals[s.triangles[1].x], glm::vec3(0.0f));
    EXPECT_EQ(s.uv_sets.at(0)[s.triangles[0].x], glm::vec2(0.25f, 0.75f));  // v runs downwards here
}

TEST_F(ObjFile, MaterialsPerFace) {
    folder.write("m.mtl",
                 "newmtl matte\nKd 0.1 0.2 0.3\nKs 0 0 0\nNs 10\nillum 2\n"
                 "newmtl shiny\nKd 0.1 0.1 0.1\nKs 0.5 0.4 0.3\nNs 50\nillum 2\n"
                 "newmtl mirror\nKd 0.01 0.01 0.01\nKs 0.95 0.9 0.85\nNs 1000\nillum 5\n"
                 "newmtl glass\nKd 0 0 0\nTf 0.1 0.2 0.3\nNi 2.5\nillum 7\n"
                 "newmtl lamp\nKd 0.7 0.7 0.7\nKe 17 12 4\n"
                 "newmtl leaf\nKd 0 1 0\nd 0.25\n");
    const Scene s = load("mtllib m.mtl\n" + std::string(square) +
                         "usemtl lamp\nf 1 2 3\nusemtl matte\nf 1 3 4\nusemtl shiny\nf 1 2 4\nusemtl mirror\nf 2 3 4\n"
                         "usemtl glass\nf 1 2 3\nusemtl leaf\nf 1 2 3\n");
    ASSERT_EQ(s.triangles.size(), 6u);
    const auto material = [&](std::size_t t) { return s.materials[s.triangle_material[t]]; };
    EXPECT_EQ(material(0).emission, glm::vec3(17, 12, 4));
    EXPECT_EQ(material(1).model, Material::Model::phong);
    EXPECT_EQ(material(1).base_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material(1).specular, glm::vec3(0.0f));
    EXPECT_EQ(material(2).specular, glm::vec3(0.5f, 0.4f, 0.3f));
    EXPECT_EQ(material(2).exponent, 50.0f);
    EXPECT_EQ(material(3).model, Material::Model::mirror);
    EXPECT_EQ(material(3).base_color, glm::vec3(0.95f, 0.9f, 0.85f));
    EXPECT_EQ(material(4).model, Material::Model::glass);
    EXPECT_EQ(material(4).base_color, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material(4).ior, 2.5f);
    EXPECT_EQ(material(4).transmission, 1.0f);
    EXPECT_EQ(material(5).alpha, Material::Alpha::blend);
    EXPECT_EQ(material(5).base_alpha, 0.25f);
}

TEST_F(ObjFile, MapsOfOpacity) {
    folder.write("color.bmp", bitmap({{255, 0, 0}, {0, 255, 0}}));
    folder.write("mask.bmp", bitmap({{0, 0, 0}, {255, 255, 255}}));
    folder.write("full.bmp", bitmap({{255, 255, 255}}));
    folder.write("m.mtl",
                 "newmtl leaf\nKd 1 1 1\nd 0.5\nmap_Kd color.bmp\nmap_d mask.bmp\n"
                 "newmtl mask\nKd 1 1 1\nmap_Kd mask.bmp\nmap_d mask.bmp\n"
                 "newmtl wall\nKd 1 1 1\nmap_d full.bmp\n");
    const Scene s = load("mtllib m.mtl\n" + std::string(square) + "usemtl leaf\nf 1 2 3\nusemtl mask\nf 1 2 3\n" +
                         "usemtl wall\nf 1 3 4\n");
    ASSERT_EQ(s.materials.size(), 3u);
    const Material& leaf = s.materials[0];
    const Material& mask = s.materials[1];
    EXPECT_EQ(leaf.alpha, Material::Alpha::blend);
    EXPECT_EQ(leaf.base_alpha, 0.5f);
    const auto texture = [&](int index) { return s.textures.at(static_cast<std::size_t>(index)); };
    EXPECT_EQ(texture(leaf.alpha_texture.texture).texels[0].a, 0.0f);
    EXPECT_EQ(texture(leaf.alpha_texture.texture).texels[1].a, 1.0f);
    EXPECT_EQ(texture(leaf.base_color_texture.texture).texels[0], glm::vec4(1, 0, 0, 1));

    // The same file as colour and as mask is two textures.
    EXPECT_EQ(mask.alpha, Material::Alpha::blend);
    EXPECT_EQ(mask.alpha_texture.texture, leaf.alpha_texture.texture);
    EXPECT_EQ(texture(mask.base_color_texture.texture).texels[0], glm::vec4(0, 0, 0, 1));

    EXPECT_EQ(s.materials[2].alpha, Material::Alpha::opaque) << "a mask without holes";
    folder.write("m.mtl", "newmtl a\nmap_d gone.png\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"), StartsWith("gone.png: "));
}

TEST_F(ObjFile, ErrorsNameTheLine) {
    EXPECT_THAT(refused("v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n"), StartsWith("scene.obj:2: "));
    EXPECT_THAT(refused("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), StartsWith("scene.obj:2: 'nan'"));
    EXPECT_THAT(refused("v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n"), StartsWith("scene.obj:2: 'inf'"));
    EXPECT_THAT(refused("v 0 0 0\nv 1 0x 0\nv 0 1 0\nf 1 2 3\n"), StartsWith("scene.obj:2: '0x'"));
    EXPECT_THAT(refused("v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n"), StartsWith("scene.obj:2: '1e99'"));
    EXPECT_THAT(refused(std::string(square) + "f 1 2\n"), StartsWith("scene.obj:5: "));
    EXPECT_THAT(refused(std::string(square) + "f 1 2 9\n"), HasSubstr("scene.obj:5: vertex 9"));
    EXPECT_THAT(refused(std::string(square) + "f 1 2 -9\n"), StartsWith("scene.obj:5: '-9'"));
    EXPECT_THAT(refused(std::string(square) + "f 1 2 0\n"), StartsWith("scene.obj:5: '0'"));
    EXPECT_THAT(refused(std::string(square) + "f 1/1 2/1 3/1\n"), HasSubstr("scene.obj:5: uv 1"));
    EXPECT_THAT(refused(std::string(square) + "f 1//1 2//1 3//1\n"), HasSubstr("scene.obj:5: normal 1"));
    EXPECT_THAT(refused("mtllib gone.mtl\n" + std::string(square) + "f 1 2 3\n"), StartsWith("scene.obj:1: "));
    folder.write("m.mtl", "newmtl a\nKd 0.1 -0.2 0.3\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "f 1 2 3\n"), StartsWith("m.mtl:2: '-0.2'"));
    folder.write("m.mtl", "newmtl a\nKe 1 nan 1\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "f 1 2 3\n"), StartsWith("m.mtl:2: 'nan'"));
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl b\nf 1 2 3\n"),
                StartsWith("scene.obj:6: the material 'b'"));
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd gone.png\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"), StartsWith("gone.png: "));
    EXPECT_THAT(refused(""), HasSubstr("no triangles"));
    EXPECT_THAT(refused("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("zero area"));
}

TEST_F(ObjFile, FlatTrianglesAreDroppedAndCounted) {
    const Scene s = load_scene(folder.write("scene.obj", std::string(square) + "v 2 0 0\nf 1 2 3\nf 1 2 5\nf 1 1 2\n"));
    EXPECT_EQ(s.triangles.size(), 1u);
    EXPECT_EQ(s.dropped_triangles, 2u);
}

TEST_F(ObjFile, WindowsLineEndsAndComments) {
    const Scene s = load("# box\r\nv 0 0 0\r\nv 1 0 0 \r\nv 0 1 0\r\nf 1 2 3 \r\n");
    EXPECT_EQ(s.triangles.size(), 1u);
}

}  // namespace
