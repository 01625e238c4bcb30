#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/io/load_obj.hpp>
#include <render/io/validate.hpp>
#include <render/surfaces/surface_colors.hpp>

#include "render/bitmap.hpp"
#include "render/exr_pixel.hpp"
#include "render/refusal.hpp"

namespace {

using render::Material;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

/// A square of the material `m`, of library `mtl`, with the files that are beside it.
struct ObjScene {
    std::map<std::string, std::string> files;

    explicit ObjScene(const std::string& mtl) {
        files["s.obj"] = "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.5\nusemtl m\nf 1/1 2/1 3/1 4/1\n";
        files["s.mtl"] = mtl;
        files["red.bmp"] = bitmap({{255, 0, 0}});
        files["hole.bmp"] = bitmap({{0, 0, 0}});
        files["white.bmp"] = bitmap({{255, 255, 255}});
    }

    Scene load() const {
        Scene scene = render::load_obj("s.obj", render::MemoryFiles(files));
        render::validate(scene);
        return scene;
    }
};

Scene load(const std::string& statements) { return ObjScene("newmtl m\n" + statements).load(); }

std::vector<std::string> left_out(const Scene& scene) {
    std::vector<std::string> all;
    for (const render::LeftOut& item : scene.left_out) all.push_back(item.what + ": " + item.why);
    return all;
}

std::vector<std::string> left_out_by(const std::string& statements) { return left_out(load(statements)); }

TEST(ObjMirror, HasOpacityAndAMapOfItsReflectance) {
    const auto colors = [](const std::string& statements) {
        return render::colors_at(load(statements), 0, 0.3f, 0.3f);
    };
    EXPECT_EQ(colors("illum 5\nKs 1").opacity, 1.0f);
    EXPECT_EQ(colors("illum 5\nKs 1\nd 0.25").opacity, 0.25f);
    EXPECT_EQ(colors("illum 5\nKs 1\nmap_d hole.bmp").opacity, 0.0f);
    EXPECT_EQ(colors("illum 5\nKs 1\nd 0.5\nmap_d white.bmp").opacity, 0.5f);
    EXPECT_EQ(colors("illum 5\nKs 0.5\nmap_Ks red.bmp").base, glm::vec3(0.5f, 0, 0));
    EXPECT_EQ(colors("illum 5\nmap_Ks red.bmp").base, glm::vec3(1, 0, 0)) << "a factor that is not there is 1";
    EXPECT_TRUE(left_out_by("illum 5\nKs 1\nd 0.25\nmap_Ks red.bmp\nmap_d white.bmp").empty());
    // Shadow rays pass what is not covered.
    const Scene thin = load("illum 5\nKs 1\nd 0.25");
    EXPECT_EQ(render::tint_at(thin, 0, 0.3f, 0.3f), glm::vec3(0.75f));
    EXPECT_TRUE(render::transmissive_materials(thin)[0]);
    EXPECT_FALSE(render::transmissive_materials(load("illum 5\nKs 1"))[0]);
}

TEST(ObjMaterial, NamesWhatItsModelHasNoUseFor) {
    const auto expect = [](const std::string& statements, const std::string& what) {
        EXPECT_THAT(left_out_by(statements), testing::ElementsAre(HasSubstr(what))) << statements;
    };
    expect("illum 5\nKs 1\nKd 0.5", "Kd and map_Kd of 'm'");
    expect("illum 5\nKs 1\nmap_Kd red.bmp", "Kd and map_Kd of 'm'");
    expect("illum 7\nNi 1.5\nKd 0.5\nd 0.5\nmap_d hole.bmp", "Kd, d, map_d of 'm'");
    expect("illum 7\nNi 1.5\nmap_Kd red.bmp\nmap_Ks red.bmp\nTr 0.5", "map_Kd, map_Ks, Tr of 'm'");
    expect("illum 1\nKd 1\nmap_Ks red.bmp", "map_Ks of 'm'");
    expect("illum 2\nKd 1\nKs 0.5\nNs 0", "Ks of 'm'");
    expect("illum 2\nKd 1\nmap_Ks red.bmp\nNs 0", "Ks of 'm'");
    expect("Kd 1\nTf 0.5 1 0.5", "Tf of 'm'");
    expect("Kd 1\nmap_Kd -imfchan r red.bmp", "-imfchan in s.mtl:3");
    for (const char* plain : {"illum 7\nNi 1.5\nTf 0.5 1 0.5\nKd 0\nd 1\nKs 1", "Kd 1\nTf 1 1 1",
                              "illum 1\nKd 1\nKs 0.5", "Kd 1\nmap_d -imfchan r red.bmp", "illum 5\nKs 1\nKd 0 0 0"}) {
        EXPECT_THAT(left_out_by(plain), testing::IsEmpty()) << plain;
    }
}

TEST(ObjMaterial, MattersOnlyWhereAFaceUsesIt) {
    const std::string unused = "newmtl unused\nKd nan\nTr -1\nmap_Kd\nfoo 1\nnewmtl bright\nKd 1.2\n";
    EXPECT_TRUE(left_out(ObjScene(unused + "newmtl m\nKd 0.5\n").load()).empty());
    EXPECT_THAT(refusal([&] { ObjScene("newmtl m\nKd 0.5\nTr -1\nKd nan\n").load(); }), StartsWith("s.mtl:3: '-1'"));
    EXPECT_THAT(refusal([&] { ObjScene("newmtl m\nKd 0.5 0.5\n").load(); }), StartsWith("s.mtl:2: 'Kd' needs"));
}

TEST(ObjMaterial, NamesEachUnknownKeywordOnce) {
    ObjScene scene("newmtl m\nfoo 1\nmap_Tr h.png\nmap_opacity h.png\nfoo 2\nFOO 3\nnewmtl n\nmap_Tr x.png\nbar 1\n");
    scene.files["s.obj"] += "usemtl n\nf 1/1 2/1 3/1\n";
    EXPECT_THAT(left_out(scene.load()),
                testing::ElementsAre(StartsWith("'foo' in s.mtl:2"), StartsWith("'map_Tr' in s.mtl:3"),
                                     StartsWith("'map_opacity' in s.mtl:4"), StartsWith("'bar' in s.mtl:9")));
}

TEST(ObjTexture, OfOpenExrEmitsWhatItHoldsAndReflectsNoMore) {
    for (const float alpha : {1.0f, 0.5f, 0.0f}) {
        ObjScene scene("newmtl m\nmap_Ke t.exr\nmap_Kd t.exr\n");
        scene.files["t.exr"] = exr_pixel({2, 0.25f, 0.125f, alpha});
        const Scene s = scene.load();
        // The light is what is stored, whatever its alpha, times what the surface covers: the alpha of map_Kd.
        EXPECT_EQ(render::emitted_radiance(s, 0, 0.3f, 0.3f, true), alpha * glm::vec3(2, 0.25f, 0.125f));
        // A reflectance was multiplied by alpha, and is at most 1.
        const glm::vec3 base = alpha == 0.5f ? glm::vec3(1, 0.5f, 0.25f) : glm::vec3(1, 0.25f, 0.125f);
        EXPECT_EQ(render::colors_at(s, 0, 0.3f, 0.3f).base, base);
        EXPECT_THAT(left_out(s), testing::ElementsAre(HasSubstr("above 1 of the texture 't.exr'")));
        scene.files["s.mtl"] = "newmtl m\nmap_Ke t.exr\n";
        EXPECT_EQ(render::emitted_radiance(scene.load(), 0, 0.3f, 0.3f, true), glm::vec3(2, 0.25f, 0.125f));
    }
}

TEST(ObjTexture, FoundElsewhereIsNamed) {
    EXPECT_TRUE(left_out_by("map_Kd red.bmp").empty());
    EXPECT_TRUE(left_out_by("map_Kd RED.BMP").empty());
    for (const char* name : {"wood/red.bmp", "C:\\art\\red.bmp", "../red.bmp"}) {
        EXPECT_THAT(
            left_out_by(std::string("map_Kd ") + name),
            testing::ElementsAre(testing::AllOf(HasSubstr("'" + std::string(name) + "'"), HasSubstr("beside"))));
    }
}

TEST(ObjTexture, ThatCannotBeReadIsNamedByItsLine) {
    EXPECT_THAT(refusal([] { load("Kd 1\nmap_Kd gone.png"); }),
                testing::AllOf(StartsWith("s.mtl:3: "), HasSubstr("gone.png"), HasSubstr("no such file")));
    EXPECT_THAT(refusal([] { load("Kd 1\nmap_Kd s.mtl"); }), StartsWith("s.mtl:3: s.mtl: not an image"));
}

TEST(ObjTexture, NeedsUvs) {
    ObjScene scene("newmtl m\nmap_Kd red.bmp\nnewmtl plain\nKd 0.5\n");
    scene.files["s.obj"] += "f 1 2 3\nf 1 3 4\nusemtl plain\nf 1 2 3\n";
    EXPECT_THAT(left_out(scene.load()),
                testing::ElementsAre("where on some faces of 'm' its textures lie: they have no vt"));
    scene.files["s.obj"] = "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n";
    EXPECT_THAT(left_out(scene.load()), testing::ElementsAre(HasSubstr("of 'm'"))) << "also without any vt";
}

TEST(ObjVertex, IsOfThreeFourOrSixNumbers) {
    const auto vertex = [](const std::string& more) {
        ObjScene scene("newmtl m\nKd 1\n");
        scene.files["s.obj"] += "v 2 0 0" + more + "\nv 3 0 0" + more + "\nf 1/1 2/1 5/1\n";
        return scene.load();
    };
    EXPECT_TRUE(vertex("").colors.empty());
    EXPECT_TRUE(vertex(" 1").colors.empty());
    EXPECT_TRUE(vertex(" 1").left_out.empty());
    EXPECT_EQ(vertex(" .5 .25 0").colors.back(), glm::vec4(0.5f, 0.25f, 0.0f, 1.0f));
    // Of seven, the fourth may be a weight or the last an opacity.
    for (const char* more : {" 1 .5", " 1 .5 .25 0", " 1 .5 .25 0 1"}) {
        const Scene odd = vertex(more);
        EXPECT_TRUE(odd.colors.empty()) << more;
        EXPECT_THAT(left_out(odd), testing::ElementsAre(HasSubstr("line 9"))) << more;
    }
}

}  // namespace
