#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/load_obj.hpp>
#include <render/io/load_scene.hpp>

#include "render/bitmap.hpp"
#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

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

    // The same file as color and as mask is two textures.
    EXPECT_EQ(mask.alpha, Material::Alpha::blend);
    EXPECT_EQ(mask.alpha_texture.texture, leaf.alpha_texture.texture);
    EXPECT_EQ(texture(mask.base_color_texture.texture).texels[0], glm::vec4(0, 0, 0, 1));

    EXPECT_EQ(s.materials[2].alpha, Material::Alpha::opaque) << "a mask without holes";
    folder.write("m.mtl", "newmtl a\nmap_d gone.png\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"),
                testing::AllOf(StartsWith("m.mtl:2: "), HasSubstr("/gone.png: ")));
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
    EXPECT_THAT(refused("mtllib gone.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"),
                StartsWith("scene.obj:1: "));
    folder.write("m.mtl", "newmtl a\nKd 0.1 -0.2 0.3\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"), StartsWith("m.mtl:2: '-0.2'"));
    folder.write("m.mtl", "newmtl a\nKe 1 nan 1\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"), StartsWith("m.mtl:2: 'nan'"));
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl b\nf 1 2 3\n"),
                StartsWith("scene.obj:6: the material 'b'"));
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd gone.png\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"),
                testing::AllOf(StartsWith("m.mtl:3: "), HasSubstr("/gone.png: ")));
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

/// Two squares beside each other, the left of material A, the right of B.
std::string halves(const std::string& a, const std::string& b) {
    return "v -1 0 1\nv 0 0 1\nv 0 0 -1\nv -1 0 -1\nv 1 0 1\nv 1 0 -1\n" + a + "\nf 1 2 3 4\n" + b + "\nf 2 5 6 3\n";
}

constexpr const char* red_and_green = "newmtl red\nKd 0.8 0.1 0.1\nnewmtl green\nKd 0.1 0.8 0.1\n";

void expect_red_and_green(const Scene& s) {
    ASSERT_EQ(s.triangles.size(), 4u);
    const auto color = [&](std::size_t t) { return s.materials[s.triangle_material[t]].base_color; };
    EXPECT_EQ(color(0), glm::vec3(0.8f, 0.1f, 0.1f));
    EXPECT_EQ(color(1), glm::vec3(0.8f, 0.1f, 0.1f));
    EXPECT_EQ(color(2), glm::vec3(0.1f, 0.8f, 0.1f));
    EXPECT_EQ(color(3), glm::vec3(0.1f, 0.8f, 0.1f));
}

TEST_F(ObjFile, NamesOfMaterialsAreWholeLines) {
    struct Names {
        const char* in_library[2];
        const char* in_use[2];
    };
    const Names all[] = {
        {{"deep red", "deep green"}, {"deep red", "deep green"}},
        {{"paint", "paint green"}, {"paint", "paint green"}},  // one is the other's beginning
        {{"  red", "green\t"}, {"\tred ", "  green"}},         // blanks around
        {{"a  b", "a b"}, {"a  b", "a b"}},                    // blanks within count
        {{"red#1", "red #2"}, {"red#1", "red #2"}},            // a number sign may be part of a name
        {{"red # of the door", "green"}, {"red", "green # of the lawn"}},
        {{"rot/grün", "\"green\""}, {"rot/grün", "\"green\""}},
        {{"", "green"}, {"", "green"}},
    };
    for (const Names& names : all) {
        SCOPED_TRACE(names.in_library[0]);
        folder.write("m.mtl", std::string("newmtl ") + names.in_library[0] + "\nKd 0.8 0.1 0.1\nnewmtl " +
                                  names.in_library[1] + "\nKd 0.1 0.8 0.1\n");
        expect_red_and_green(load("mtllib m.mtl\n" + halves(std::string("usemtl ") + names.in_use[0],
                                                            std::string("usemtl ") + names.in_use[1])));
    }
}

TEST_F(ObjFile, LibrariesAreFoundAsTheyAreWritten) {
    std::filesystem::create_directory(folder.path() / "maps");
    for (const char* name : {"my paint.mtl", "maps/paint.mtl", "plain.mtl", "two.mtl words.mtl"}) {
        folder.write(name, red_and_green);
    }
    folder.write("only red.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    folder.write("green.mtl", "newmtl green\nKd 0.1 0.8 0.1\n");
    const std::string body = halves("usemtl red", "usemtl green");
    for (const char* line :
         {"mtllib my paint.mtl", "mtllib my\\ paint.mtl", "mtllib \"my paint.mtl\"", "mtllib maps\\paint.mtl",
          "mtllib ./maps/paint.mtl", "mtllib  plain.mtl  ", "mtllib plain.mtl # of the hall", "mtllib PLAIN.MTL",
          "mtllib only red.mtl green.mtl", "mtllib green.mtl only red.mtl", "mtllib green.mtl\nmtllib only red.mtl",
          "mtllib two.mtl words.mtl", "\xEF\xBB\xBFmtllib plain.mtl", "mtllib plain.mtl plain.mtl"}) {
        SCOPED_TRACE(line);
        expect_red_and_green(load(line + ("\n" + body)));
    }
    folder.write("marked.mtl", std::string("\xEF\xBB\xBF") + red_and_green);
    expect_red_and_green(load("mtllib marked.mtl\n" + body));
    // Wherever the line stands.
    expect_red_and_green(load(body + "mtllib plain.mtl\n"));
    expect_red_and_green(load(halves("usemtl red", "mtllib plain.mtl\nusemtl green")));
    expect_red_and_green(load("g a group\nmtllib plain.mtl\n" + body));
    // The first of a name counts.
    folder.write("again.mtl", std::string(red_and_green) + "newmtl red\nKd 0 0 1\n");
    expect_red_and_green(load("mtllib again.mtl\nmtllib plain.mtl\n" + body));
    // One that has the file's own name stands in for a missing one, which is said.
    folder.write("scene.mtl", red_and_green);
    const Scene s = load("mtllib lost.mat\n" + body);
    expect_red_and_green(s);
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_THAT(s.left_out[0].what, HasSubstr("lost.mat"));
    std::filesystem::remove(folder.path() / "scene.mtl");
    // What is there is used, and a name is missing only if something has it.
    for (const char* lines : {"mtllib plain.mtl lost.mtl", "mtllib lost.mtl plain.mtl", "mtllib a lost.mtl plain.mtl",
                              "mtllib lost.mtl\nmtllib plain.mtl", "mtllib plain.mtl\nmtllib lost.mtl"}) {
        SCOPED_TRACE(lines);
        const Scene part = load(lines + ("\n" + body));
        expect_red_and_green(part);
        ASSERT_EQ(part.left_out.size(), 1u);
        EXPECT_THAT(part.left_out[0].what, HasSubstr("lost.mtl"));
        EXPECT_EQ(part.left_out[0].why, "it is not there");
    }
    EXPECT_THAT(refused("mtllib green.mtl lost.mtl\n" + body),
                StartsWith("scene.obj:1: the material library 'lost.mtl' is not there, and no other has the material "
                           "'red'"));
    EXPECT_EQ(load("mtllib lost.mtl\n" + std::string(square) + "f 1 2 3\n").materials[0].base_color, glm::vec3(0.8f));
    // The file's own name comes last: it does not hide what was found.
    folder.write("scene.mtl", "newmtl red\nKd 0 0 1\nnewmtl green\nKd 0.1 0.8 0.1\n");
    expect_red_and_green(load("mtllib plain.mtl lost.mtl\n" + body));
    expect_red_and_green(load("mtllib only red.mtl lost.mtl\n" + body));
    std::filesystem::remove(folder.path() / "scene.mtl");
    EXPECT_THAT(refused("v 0 0 0\nmtllib lost one.mtl\n" + body), StartsWith("scene.obj:2: "));
    EXPECT_THAT(refused("mtllib\n" + body), StartsWith("scene.obj:1: 'mtllib' names no file"));
}

TEST_F(ObjFile, WithoutALibraryMaterialsAreGrayAndThatIsSaid) {
    const Scene s = load(halves("usemtl red", "usemtl green"));
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].base_color, glm::vec3(0.8f));
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_EQ(s.left_out[0].what, "materials");
}

TEST_F(ObjFile, LinesEndInAnyWay) {
    const std::string text = "# a square\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n";
    const auto with = [&](const std::string& end) {
        std::string changed;
        for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
        return changed;
    };
    for (const char* end : {"\n", "\r\n", "\r", "\n\n", " \n", "\t\r\n", "\n# \n"}) {
        EXPECT_EQ(load(with(end)).triangles.size(), 2u) << end;
    }
    EXPECT_EQ(load(text.substr(0, text.size() - 1)).triangles.size(), 2u) << "no end at the end";
    // A line is the same line for the count, the parser and the message.
    EXPECT_THAT(refused("# a comment\rf 1 2 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), StartsWith("scene.obj:2: vertex 9"));
    EXPECT_THAT(refused("v 0 0 0\r\nv 1 0 0\r\nv nan 1 0\r\n"), StartsWith("scene.obj:3: 'nan'"));
    EXPECT_THAT(refused("v 0 0 0\rv 1 0 0\rv nan 1 0\r"), StartsWith("scene.obj:3: 'nan'"));
    folder.write("m.mtl", "newmtl a\n# x\rKe nan 1 1\n");
    EXPECT_THAT(refused("mtllib m.mtl\n" + std::string(square) + "usemtl a\nf 1 2 3\n"), StartsWith("m.mtl:3: 'nan'"));
    EXPECT_THAT(refused("\xFF\xFEv\0 "), HasSubstr("UTF-16"));
}

TEST_F(ObjFile, AcceptsWhatTheFormatAllows) {
    const char* const faces[] = {
        "f 1 2 3 4 # a comment",
        "f 1 2 \\\n3 4",
        "f \\\n 1 \\\n 2 3 4",
        "f 1// 2// 3// 4//",
        "f 1/ 2/ 3/ 4/",
        "f 1/1/ 2/1/ 3/1/ 4/1/",
        "f 1/1 2/1 3/1 4/1",
        "f 1//1 2//1 3//1 4//1",
        "f 1/1/1 2/1/1 3/1/1 4/1/1",
        "f -4/-1/-1 -3/-1/-1 -2/-1/-1 -1/-1/-1",
        "fo 1 2 3 4",
        "f 1 2 3 3 4 1",
        "s off\nf 1 2 3 4",
        "f 1 2\nf 1 2 3 4",
    };
    for (const char* face : faces) {
        SCOPED_TRACE(face);
        const Scene s = load_scene(
            folder.write("scene.obj", std::string(square) + "vt 0.5\nvn 0 0 250\n" + face + "\n"));
        double area = 0.0;
        for (const glm::uvec3& t : s.triangles) {
            area += 0.5 * static_cast<double>(glm::length(
                              glm::cross(s.positions[t.y] - s.positions[t.x], s.positions[t.z] - s.positions[t.x])));
        }
        EXPECT_NEAR(area, 1.0, 1e-6);
    }
    const Scene numbers = load("v -1.0E+00 0. 1.e0 2\nv +1 0 1 # first\nv .1e1 -0 -1\nv 1e-400 0 0\nf 1 2 3\n");
    EXPECT_EQ(numbers.positions[0], glm::vec3(-1, 0, 1));
    const Scene rest = load(std::string(square) +
                            "p 1\nl 1 2\ncstype bezier\nsurf 0 1\nend\nfoo 1\nbar 2\nfoo 3\nf 1 2 3\n");
    EXPECT_EQ(rest.triangles.size(), 1u);
    ASSERT_EQ(rest.left_out.size(), 4u) << "each unknown keyword once";
    EXPECT_THAT(rest.left_out[2].what, HasSubstr("'foo' in line 10"));
    EXPECT_THAT(rest.left_out[3].what, HasSubstr("'bar' in line 11"));
}

TEST_F(ObjFile, RefusesWhatItDoesNotAllow) {
    const std::string text = std::string(square) + "vt 0 0\nvn 0 0 1\n";
    EXPECT_THAT(refused(text + "f 1/ 2/ 3\n"), StartsWith("scene.obj:7: '1/' and '3'"));
    EXPECT_THAT(refused(text + "f 1// 2// 3//1\n"), StartsWith("scene.obj:7: "));
    EXPECT_THAT(refused(text + "f 1/1 2 3\n"), StartsWith("scene.obj:7: "));
    EXPECT_THAT(refused(text + "f 1/1/1/1 2/1/1 3/1/1\n"), StartsWith("scene.obj:7: '1/1/1/1'"));
    EXPECT_THAT(refused(text + "f /1 /1 /1\n"), StartsWith("scene.obj:7: ''"));
    EXPECT_THAT(refused(text + "f 1 2 99999999999\n"), StartsWith("scene.obj:7: '99999999999'"));
    EXPECT_THAT(refused(text + "f 1 2 -9223372036854775808\n"), StartsWith("scene.obj:7: "));
    EXPECT_THAT(refused(text + "f 1 2 \\"), StartsWith("scene.obj:7: "));
    EXPECT_THAT(refused("v 1,5 0 0\n"), StartsWith("scene.obj:1: '1,5'"));
    EXPECT_THAT(refused("v 1.0D+00 0 0\n"), StartsWith("scene.obj:1: '1.0D+00'"));
    EXPECT_THAT(refused("vn -1.#IND 0 0\n"), StartsWith("scene.obj:1: '-1.#IND'"));
    EXPECT_THAT(refused("vt nan\n"), StartsWith("scene.obj:1: 'nan'"));
    EXPECT_THAT(refused("v 1 2 3 0.5 x 0.5\n"), StartsWith("scene.obj:1: 'x'"));
    EXPECT_THAT(refused("v 1 2 3 0.5 -1 0.5\n"), StartsWith("scene.obj:1: "));
    EXPECT_THAT(refused("f 1 2 \x1b[31m\n"), StartsWith("scene.obj:1: '")) << "in one line that controls no terminal";
}

TEST_F(ObjFile, VertexColorsTintTheMaterial) {
    const std::string text = "v 0 0 0 0.8 0.1 0.1\nv 1 0 0 0.8 0.1 0.1\nv 1 1 0 0.8 0.1 0.1\nv 0 1 0\n";
    Scene s = load_scene(folder.write("scene.obj", text + "f 1 2 3\nf 1 3 4\n"));
    ASSERT_EQ(s.colors.size(), 4u);
    EXPECT_EQ(s.colors[s.triangles[0].y], glm::vec4(0.8f, 0.1f, 0.1f, 1.0f));
    EXPECT_EQ(s.colors[s.triangles[1].z], glm::vec4(1.0f)) << "white where there is none";
    EXPECT_EQ(s.materials[0].base_color, glm::vec3(1.0f)) << "the color is the albedo";
    s = load_scene(folder.write("scene.obj", "v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n"));
    EXPECT_EQ(s.colors[0], glm::vec4(1.0f, 0.0f, 0.2f, 1.0f)) << "bytes";
    s = load_scene(folder.write("scene.obj", "v 0 0 0 1.5 0 0.5\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n"));
    EXPECT_EQ(s.colors[0], glm::vec4(1.0f, 0.0f, 0.5f, 1.0f));
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_THAT(s.left_out[0].what, HasSubstr("vertex colors"));
    EXPECT_TRUE(load(std::string(square) + "f 1 2 3\n").colors.empty());
}

struct MtlFile : ObjFile {
    /// The one material of an MTL file.
    Material read(const std::string& statements, Scene* scene = nullptr) {
        folder.write("m.mtl", "newmtl m\n" + statements + "\n");
        Scene s = load("mtllib m.mtl\nvt 0.25 0.75\n" + std::string(square) + "usemtl m\nf 1/1 2/1 3/1\n");
        if (scene) *scene = s;
        return s.materials.at(0);
    }
    std::string refused_material(const std::string& statements) {
        folder.write("m.mtl", "newmtl m\n" + statements + "\n");
        return refused("mtllib m.mtl\n" + std::string(square) + "usemtl m\nf 1 2 3\n");
    }
};

TEST_F(MtlFile, AbsentFactorsMultiplyByOne) {
    folder.write("t.bmp", bitmap({{255, 255, 255}}));
    EXPECT_EQ(read("map_Kd t.bmp").base_color, glm::vec3(1.0f));
    EXPECT_EQ(read("map_Ke t.bmp").emission, glm::vec3(1.0f));
    EXPECT_EQ(read("map_Ks t.bmp\nNs 5").specular, glm::vec3(1.0f));
    EXPECT_EQ(read("Kd 0 0 0\nmap_Kd t.bmp").base_color, glm::vec3(0.0f));
    EXPECT_EQ(read("Ke 0 0 0\nmap_Ke t.bmp").emission, glm::vec3(0.0f));
    EXPECT_EQ(read("Ns 5").base_color, glm::vec3(0.0f));
    // In any order and case.
    EXPECT_EQ(read("map_Ke t.bmp\nKe 2 3 4").emission, glm::vec3(2, 3, 4));
    EXPECT_EQ(read("MAP_KD t.bmp\nkd 0.5 0.5 0.5").base_color, glm::vec3(0.5f));
}

TEST_F(MtlFile, ColorsMayBeOneNumberOrCie) {
    EXPECT_EQ(read("Kd 0.5").base_color, glm::vec3(0.5f));
    EXPECT_EQ(read("Ke 3").emission, glm::vec3(3.0f));
    const glm::vec3 white = read("Kd xyz 0.475235 0.5 0.544415").base_color;
    EXPECT_NEAR(glm::length(white - glm::vec3(0.5f)), 0.0f, 1e-3f);
    EXPECT_THAT(refused_material("Kd 0.5 0.5"), StartsWith("m.mtl:2: 'Kd' needs 3 numbers"));
    EXPECT_THAT(refused_material("Kd"), StartsWith("m.mtl:2: "));
    EXPECT_THAT(refused_material("Kd spectral gray.rfl 1"), HasSubstr("spectral"));
    EXPECT_THAT(refused_material("Ns -1"), StartsWith("m.mtl:2: '-1'"));
    EXPECT_THAT(refused_material("map_Kd"), StartsWith("m.mtl:2: 'map_Kd' names no file"));
    EXPECT_THAT(refused_material("map_Kd -o x t.bmp"), StartsWith("m.mtl:2: 'x'"));
}

TEST_F(MtlFile, ReflectanceAboveOneIsCutOffAndNamed) {
    Scene s;
    EXPECT_EQ(read("Kd 1.5 0.5 1", &s).base_color, glm::vec3(1.0f, 0.5f, 1.0f));
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_THAT(s.left_out[0].what, HasSubstr("m.mtl:2"));
    EXPECT_EQ(read("Ks 7\nNs 1").specular, glm::vec3(1.0f));
    EXPECT_EQ(read("Ke 7").emission, glm::vec3(7.0f));
}

TEST_F(MtlFile, IlluminationSaysWhichTermsThereAre) {
    const std::string shiny = "Kd 0.5 0.5 0.5\nKs 0.4 0.4 0.4\nNs 10\n";
    EXPECT_EQ(read(shiny).specular, glm::vec3(0.4f));
    EXPECT_EQ(read(shiny + "illum 2").specular, glm::vec3(0.4f));
    for (const char* illum : {"illum 0", "illum 1"}) {
        EXPECT_EQ(read(shiny + illum).specular, glm::vec3(0.0f)) << illum;
        EXPECT_EQ(read(shiny + illum).base_color, glm::vec3(0.5f)) << illum;
    }
    for (const char* illum : {"illum 3", "illum 4", "illum 6", "illum 8", "illum 9"}) {
        Scene s;
        EXPECT_EQ(read(shiny + illum, &s).specular, glm::vec3(0.4f));
        ASSERT_EQ(s.left_out.size(), 1u);
        EXPECT_THAT(s.left_out[0].what, HasSubstr(illum));
    }
    EXPECT_EQ(read(shiny + "illum 5").model, Material::Model::mirror);
    EXPECT_EQ(read(shiny + "illum 7").model, Material::Model::glass);
    EXPECT_EQ(read("Tr 0.75").base_alpha, 0.25f);
    EXPECT_EQ(read("Tr 1\nd 1").base_alpha, 1.0f);
    EXPECT_EQ(read("d 1\nTr 1").base_alpha, 1.0f);
    Scene halo;
    EXPECT_EQ(read("d -halo 0.5", &halo).base_alpha, 0.5f);
    EXPECT_EQ(halo.left_out.size(), 1u);
}

TEST_F(MtlFile, MapOptionsMoveAndChangeTheTexture) {
    // Four texels, from black to white; OBJ's v runs upwards.
    folder.write("ramp.bmp", bitmap({{0, 0, 0}, {85, 85, 85}, {170, 170, 170}, {255, 255, 255}}));
    folder.write("my ramp.bmp", bitmap({{255, 0, 0}}));
    const auto at = [&](const std::string& options, glm::vec2 obj_uv) {
        Scene s;
        const Material m = read("Kd 1\nmap_Kd " + options, &s);
        const glm::vec2 uv(obj_uv.x, 1.0f - obj_uv.y);
        return s.textures.at(static_cast<std::size_t>(m.base_color_texture.texture))
            .sample(m.base_color_texture.uv(uv));
    };
    const auto expect_same = [&](const std::string& options, glm::vec2 uv, glm::vec2 plain) {
        EXPECT_NEAR(at(options + " ramp.bmp", uv).r, at("ramp.bmp", plain).r, 1e-5f) << options;
    };
    expect_same("-s 2", {0.2f, 0.3f}, {0.4f, 0.3f});
    expect_same("-s 2 3 1", {0.2f, 0.3f}, {0.4f, 0.9f});
    expect_same("-o 0.5", {0.2f, 0.3f}, {0.7f, 0.3f});
    expect_same("-s 0.5 -o 0.25 0.5", {0.2f, 0.3f}, {0.35f, 0.8f});
    expect_same("-o 0.25 0 0 -s 2 2 2", {0.2f, 0.3f}, {0.65f, 0.6f});
    expect_same("-blendu on -texres 64 -cc off", {0.2f, 0.3f}, {0.2f, 0.3f});
    EXPECT_NEAR(at("-mm 0 0.5 ramp.bmp", {0.875f, 0.5f}).r, 0.5f, 1e-5f);
    EXPECT_NEAR(at("-mm 0.25 0.5 ramp.bmp", {0.125f, 0.5f}).r, 0.25f, 1e-5f);
    EXPECT_NEAR(at("-clamp on ramp.bmp", {1.5f, 0.5f}).r, 1.0f, 1e-5f);
    EXPECT_LT(at("-clamp off ramp.bmp", {1.3f, 0.5f}).r, 0.5f);
    for (const char* name : {"my ramp.bmp", "\"my ramp.bmp\"", "-s 1 1 1 my ramp.bmp", "MY RAMP.BMP", ".\\my ramp.bmp",
                             "C:\\pictures\\my ramp.bmp", "/home/somebody/my ramp.bmp", "my ramp.bmp # red"}) {
        EXPECT_EQ(at(name, {0.5f, 0.5f}), glm::vec4(1, 0, 0, 1)) << name;
    }
    Scene s;
    read("map_Kd -boost 2 -type cube_top ramp.bmp\nbump ramp.bmp\nmap_Ns ramp.bmp\nKa 1 1 1\nfoo 1", &s);
    ASSERT_EQ(s.left_out.size(), 5u) << "each named once, and ambient light is no part of a surface";
}

TEST_F(MtlFile, ChannelsOfMasksAreChosen) {
    folder.write("mask.bmp", bitmap({{255, 0, 128}}));
    const auto alpha = [&](const std::string& options) {
        Scene s;
        const Material m = read("Kd 1\nmap_d " + options + " mask.bmp", &s);
        return s.textures.at(static_cast<std::size_t>(m.alpha_texture.texture)).texels[0].a;
    };
    EXPECT_EQ(alpha("-imfchan r"), 1.0f);
    EXPECT_EQ(alpha("-imfchan g"), 0.0f);
    EXPECT_NEAR(alpha("-imfchan b"), 128.0f / 255.0f, 1e-6f);
    EXPECT_EQ(alpha("-imfchan m"), 1.0f);
    EXPECT_NEAR(alpha("-imfchan l"), 0.2126f + 0.0722f * 128.0f / 255.0f, 1e-5f);
    EXPECT_EQ(alpha(""), alpha("-imfchan l"));
}

TEST_F(MtlFile, WhatNothingUsesIsNotRead) {
    folder.write("m.mtl", "newmtl a\nKd 0.5\nnewmtl b\nKd 1\nmap_Kd gone.png\n");
    const Scene s = load("mtllib m.mtl\n" + std::string(square) + "usemtl b\nusemtl a\nf 1 2 3\n");
    ASSERT_EQ(s.materials.size(), 1u);
    EXPECT_EQ(s.materials[0].name, "a");
    EXPECT_EQ(read("Kd 0.5\nKe 0 0 0\nmap_Ke gone.png").emission, glm::vec3(0.0f));
}

TEST_F(ObjFile, StandsWhereItIsFarAway) {
    const auto file = [](double x) {
        return "v " + std::to_string(x) + " 0 0\nv " + std::to_string(x + 1) + " 0 0\nv " + std::to_string(x) +
               " 0.25 0\nf 1 2 3\n";
    };
    const Scene near = load(file(0.0));
    EXPECT_EQ(near.origin, glm::dvec3(0.0));
    for (const double x : {1e3, 1e5, 408192.0, 1e9, 4e12}) {
        const Scene far = load(file(x));
        EXPECT_LT(glm::length(far.positions[0]), 4.0f);
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            EXPECT_EQ(glm::dvec3(far.positions[k]) + far.origin, glm::dvec3(near.positions[k]) + glm::dvec3(x, 0, 0));
        }
        EXPECT_TRUE(far.left_out.empty());
    }
    // Small things on a large plane far away lose their shape, which is said.
    const Scene coarse = load(file(4e6) + "v 0 0 0\nv 1e7 0 0\nv 0 0 1e7\nf 4 5 6\n");
    ASSERT_EQ(coarse.left_out.size(), 1u);
    EXPECT_THAT(coarse.left_out[0].why, HasSubstr("step"));
}

TEST_F(ObjFile, StandsWhereMostOfItIs) {
    const auto level = [](double y, double half) {
        std::string text;
        for (const auto& [x, z] : {std::pair{-half, -half}, {-half, half}, {half, half}, {half, -half}}) {
            text += "v " + std::to_string(500000.0 + x) + " " + std::to_string(y) + " " +
                    std::to_string(-4000000.0 + z) + "\n";
        }
        return text + "f -4 -3 -2 -1\n";
    };
    const std::string yard = level(0, 100) + level(10, 50);
    EXPECT_TRUE(load(yard).left_out.empty());
    // A triangle at the origin of coordinates, before or after the rest, loses its shape, not the yard its shadows.
    const std::string stray = "v 0 0 0\nv 0 0 1\nv 1 0 0\nf -3 -2 -1\n";
    for (const std::string& text : {yard + stray, stray + yard, yard + stray + stray}) {
        const Scene s = load(text);
        EXPECT_LT(glm::length(s.origin - glm::dvec3(5e5, 0, -4e6)), 200.0);
        ASSERT_EQ(s.left_out.size(), 1u);
        EXPECT_THAT(s.left_out[0].what, HasSubstr("shadows of"));
        EXPECT_THAT(s.left_out[0].why, HasSubstr("rays leave a surface by"));
    }
    // Also one of very many is said.
    std::string many;
    for (int i = 0; i < 300; ++i) many += level(0.5 * i, 100);
    EXPECT_EQ(load(many + stray).left_out.size(), 1u);
    // What is small and near the origin is not given up for a backdrop.
    std::string house;
    for (int i = 0; i < 20; ++i) house += "v 0 0 " + std::to_string(i) + "\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    EXPECT_EQ(load(house + "v 9000 0 0\nv 9000 500 0\nv 9000 0 500\nf -3 -2 -1\n").origin, glm::dvec3(0.0));
}

}  // namespace
