#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/picture.hpp>

#include "programs.hpp"

namespace {

using render::Picture;

constexpr double radius = 2.0;
const glm::dvec3 albedo(0.5, 0.25, 0.6);

class IndirectLight : public Programs {
protected:
    /// A closed ball around the origin, of flat quadrilaterals.
    void write_ball() {
        constexpr int rows = 24, columns = 48;
        std::string text = "mtllib ball.mtl\nusemtl paint\n";
        for (int i = 0; i <= rows; ++i) {
            for (int j = 0; j < columns; ++j) {
                const double down = std::numbers::pi * i / rows, around = 2.0 * std::numbers::pi * j / columns;
                text += "v " + std::to_string(radius * std::sin(down) * std::cos(around)) + " " +
                        std::to_string(radius * std::cos(down)) + " " +
                        std::to_string(radius * std::sin(down) * std::sin(around)) + "\n";
            }
        }
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < columns; ++j) {
                const int a = i * columns + j + 1, b = i * columns + (j + 1) % columns + 1;
                text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + columns) + " " +
                        std::to_string(a + columns) + "\n";
            }
        }
        folder.write("ball.obj", text);
        folder.write("ball.mtl", "newmtl paint\nKd 0.5 0.25 0.6\n");
    }
    Picture rendered(const std::string& arguments) {
        const auto result = render("--quiet --clamp off " + arguments);
        EXPECT_EQ(result.status, 0) << arguments << ": " << result.err;
        return render::read_exr(folder / "render.exr");
    }
};

TEST_F(IndirectLight, OfAllBouncesFillsABall) {
    // Each bounce lights a ball evenly: radiance is direct / (1 - albedo). Over seeds the means of channels spread by
    // at most 0.6 %, so that one run in some thousands fails for another seed; this one's is fixed.
    write_ball();
    folder.write("omni.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0,0,0,,,,4,4,4\n");
    folder.write("sphere.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nsphere,0,0,0,0.2,,,4,4,4\n");
    for (const std::string light : {"omni", "sphere"}) {
        for (const std::string method : {"exhaustive", "lightcuts"}) {
            const Picture picture = rendered("ball.obj --indirect 20000 --size 8x6 --eye 0.9,0.5,0 --target -2,0,0 " +
                                             ("--lights " + light + ".csv --method " + method));
            const auto lights = report("render.json").at("lights");
            EXPECT_NEAR(lights.at("virtual").get<double>(), 20000.0, 1000.0);
            EXPECT_EQ(lights.at(light), light == "omni" ? 1 : 64);
            glm::dvec3 sum(0.0);
            for (const glm::vec3& pixel : picture.pixels)
                sum += glm::dvec3(pixel) / static_cast<double>(picture.size());
            for (int c = 0; c < 3; ++c) {
                const double expected = albedo[c] / std::numbers::pi * 4.0 / (radius * radius) / (1.0 - albedo[c]);
                EXPECT_NEAR(sum[c] / expected, 1.0, 0.03) << light << " " << method << " channel " << c;
            }
        }
    }
}

TEST_F(IndirectLight, DoesNotFallBackOnAPlane) {
    Picture map(16, 8);
    for (glm::vec3& pixel : map.pixels) pixel = glm::vec3(1.0f);
    write_exr(folder / "one.exr", map);
    for (const std::string source : {"--env one.exr --env-lights 500", "--sun-sky 40,10 --sky-lights 500"}) {
        const std::string scene = "floor.obj --size 16x12 --method exhaustive " + source + view;
        const Picture direct = rendered(scene);
        const Picture both = rendered(scene + "--indirect 1000");
        EXPECT_GT(report("render.json").at("lights").at("virtual"), 800);
        for (std::size_t i = 0; i < direct.size(); ++i) {
            EXPECT_NEAR(both.pixels[i].g, direct.pixels[i].g, 1e-3f * direct.pixels[i].g);
        }
    }
}

TEST_F(IndirectLight, IsTheSameWithAnyNumberOfThreads) {
    const std::string scene = "room.obj --size 40x30 --indirect 10000 --aov cut_size" + view;
    rendered(scene + "--threads 1");
    const std::string one = folder.read("render.exr");
    rendered(scene + "--threads 2");
    EXPECT_EQ(folder.read("render.exr"), one);
    rendered(scene + "--threads 2 --seed 2");
    EXPECT_NE(folder.read("render.exr"), one);
    rendered("room.obj --size 40x30" + view);
    EXPECT_EQ(report("render.json").at("lights").at("virtual"), 0);
}

TEST_F(IndirectLight, RefusesWhatCannotBe) {
    folder.write("up.csv", "kind,x,y,z,dx,dy,dz,r,g,b\noriented,0,2,0,0,1,0,1,1,1\n");
    folder.write("mirror.mtl", "newmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 5\n");
    folder.write("mirror.obj", "mtllib mirror.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl mirror\nf 4 3 2 1\n");
    const Refusal refusals[] = {
        {"floor.obj --clamp off --indirect 100 --lights up.csv", 1, "floor.obj: virtual lights: none of"},
        {"floor.obj --clamp off --indirect 100 --lights dark.csv", 1, "floor.obj: virtual lights: no light emits"},
        {"mirror.obj --clamp off --indirect 100 --lights one.csv", 1, "mirror.obj: virtual lights: of"},
        {"room.obj --clamp off --indirect some", 2, "--indirect"},
        {"room.obj --indirect 100", 2, "--clamp off"},
        {"room.obj --indirect 100 --clamp auto", 2, "--clamp off"},
        {"room.obj --indirect 100 --clamp 0.5", 2, "--clamp off"},
    };
    const auto before = files();
    for (const Refusal& refusal : refusals) {
        const auto result = render("--size 4x4 " + std::string(refusal.arguments) + view);
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
        EXPECT_EQ(files(), before) << refusal.arguments;
    }
}

}  // namespace
