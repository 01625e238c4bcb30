#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/picture.hpp>
#include <render/lights/spheres.hpp>

#include "render/programs.hpp"

namespace {

using render::Picture;

class SphericalLights : public Programs {
protected:
    void SetUp() override {
        Programs::SetUp();
        folder.write("sphere.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nsphere,0,3,0,0.5,,,9,6,3\n");
        folder.write("omni.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0,3,0,,,,9,6,3\n");
        folder.write("plate.mtl", "newmtl gray\nKd 0.5 0.4 0.3\nnewmtl glass\nKd 1 1 1\nillum 7\nNi 1.5\n");
    }
    /// A floor, with a plate of 2 x `side` across at `height` above it, and glass far away if wanted.
    std::string with_plate(double height, double side, bool glass) {
        const auto corner = [&](double x, double z) {
            return "v " + std::to_string(x * side) + " " + std::to_string(height) + " " + std::to_string(z * side) +
                   "\n";
        };
        folder.write("plate.obj", "mtllib plate.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n" + corner(-1, -1) +
                                      corner(1, -1) + corner(1, 1) + corner(-1, 1) + "v 90 0 0\nv 91 0 0\nv 91 1 0\n" +
                                      "usemtl gray\nf 4 3 2 1\nf 8 7 6 5\nusemtl " + (glass ? "glass" : "gray") +
                                      "\nf 9 10 11\n");
        return "plate.obj ";
    }
    Picture rendered(const std::string& arguments) {
        const auto result = render("--quiet --size 24x18 --eye 1,2,6 --target 0,-0.5,0 --fov 36 " + arguments);
        EXPECT_EQ(result.status, 0) << arguments << ": " << result.err;
        return render::read_exr(folder / "render.exr");
    }
    static double difference(const Picture& a, const Picture& b) {
        double sum = 0.0, of = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            sum += static_cast<double>(glm::distance(a.pixels[i], b.pixels[i]));
            of += static_cast<double>(glm::length(b.pixels[i]));
        }
        return sum / of;
    }
};

TEST_F(SphericalLights, ShineAsTheirCenterFromFarAway) {
    // The irradiance of a sphere that lies above the horizon is that of its center, exactly.
    const Picture sphere = rendered("floor.obj --method exhaustive --area-points 1000 --lights sphere.csv");
    EXPECT_EQ(report("render.json").at("lights").at("sphere"), 1000);
    EXPECT_EQ(report("render.json").at("lights").at("omni"), 0);
    const Picture center = rendered("floor.obj --method exhaustive --lights omni.csv");
    EXPECT_LT(difference(sphere, center), 0.002);
    EXPECT_GT(difference(sphere, center), 0.0);
}

TEST_F(SphericalLights, AreNotShadowedByWhatTheyContain) {
    for (const bool glass : {false, true}) {
        for (const std::string method : {"exhaustive", "lightcuts"}) {
            const std::string options = "--lights sphere.csv --method " + method + " ";
            const Picture bare = rendered(with_plate(50.0, 0.3, glass) + options);
            const Picture inside = rendered(with_plate(2.9, 0.3, glass) + options);
            EXPECT_EQ(difference(inside, bare), 0.0) << method;
            const Picture below = rendered(with_plate(2.4, 0.3, glass) + options);
            EXPECT_GT(difference(below, bare), 0.01) << method;
        }
    }
}

TEST_F(SphericalLights, LightWhatTheyContain) {
    // Seen at a plate within the sphere, from above.
    const auto result = render("--quiet --size 4x4 --fov 1 --eye 0,9,0.1 --target 0,2.9,0 --lights sphere.csv " +
                               with_plate(2.9, 0.3, false));
    ASSERT_EQ(result.status, 0) << result.err;
    for (const glm::vec3& pixel : render::read_exr(folder / "render.exr").pixels) {
        EXPECT_GT(pixel.g, 0.1f);
        EXPECT_TRUE(std::isfinite(pixel.g));
    }
}

TEST_F(SphericalLights, MakeSoftShadows) {
    // The plate's edge casts a hard shadow from the center; from the sphere half of the penumbra lies within it.
    const std::string scene = with_plate(1.5, 1.0, false) + "--method exhaustive ";
    const Picture soft = rendered(scene + "--lights sphere.csv");
    const Picture hard = rendered(scene + "--lights omni.csv");
    int shadow = 0, penumbra = 0, umbra = 0;
    for (std::size_t i = 0; i < hard.size(); ++i) {
        if (hard.pixels[i].r > 0.0f) continue;
        ++shadow;
        penumbra += soft.pixels[i].r > 0.0f ? 1 : 0;
        umbra += soft.pixels[i].r > 0.0f ? 0 : 1;
    }
    EXPECT_GT(penumbra, shadow / 10);
    EXPECT_GT(umbra, shadow / 10);
}

TEST_F(SphericalLights, AreLeftOutWhenAsked) {
    const auto result = render("floor.obj --lights sphere.csv --area-points 0" + view);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("--area-points"), std::string::npos) << result.err;
}

}  // namespace
