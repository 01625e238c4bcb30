#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <render/adaptation.hpp>
#include <render/io/picture.hpp>

#include "programs.hpp"

namespace {

using render::geometric_mean;

TEST(GeometricMean, IsThatOfTheLuminancesWithAFloor) {
    EXPECT_EQ(geometric_mean({}), 0.0);
    EXPECT_EQ(geometric_mean(std::vector{0.0, 0.0}), 0.0);
    EXPECT_NEAR(geometric_mean(std::vector{3.0, 3.0, 3.0}), 3.0003, 1e-12);
    // m = 5: sqrt((0.0005 + 2) (0.0005 + 8)).
    EXPECT_NEAR(geometric_mean(std::vector{2.0, 8.0}), std::sqrt(2.0005 * 8.0005), 1e-12);
    // A black half: sqrt(5e-5 (1 + 5e-5)) rather than 0.
    EXPECT_NEAR(geometric_mean(std::vector{0.0, 1.0}), std::sqrt(5e-5 * 1.00005), 1e-12);
    EXPECT_NEAR(geometric_mean(std::vector{1e-40, 3e-40}) / 1.7320508075e-40, 1.0, 1e-3);
}

class Adaptation : public Programs {
protected:
    double measured(const std::string& arguments) {
        const auto result = render("--quiet --adaptation auto --aov depth " + arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return report("render.json").at("options").at("adaptation").get<double>();
    }

    /// From the picture itself, where it has as many pixels as the coarse one and shows no emission: pixels without a
    /// surface are left out, and those that are brighter than `brightest`.
    double from_picture(double brightest = std::numeric_limits<double>::infinity()) const {
        const render::Picture picture = render::read_exr(folder / "render.exr");
        std::vector<double> luminances;
        double mean = 0.0;
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const glm::dvec3 p(picture.pixels[i]);
            const double l = 0.2126 * p.x + 0.7152 * p.y + 0.0722 * p.z;
            if (!std::isfinite(picture.find("depth")->values[i]) || l > brightest) continue;
            luminances.push_back(l);
            mean += l;
        }
        mean /= static_cast<double>(luminances.size());
        double logarithms = 0.0;
        for (const double l : luminances) logarithms += std::log(1e-4 * mean + l);
        return std::exp(logarithms / static_cast<double>(luminances.size()));
    }
};

TEST_F(Adaptation, IsTheGeometricMeanOfWhatIsSeen) {
    // With much background, and the shadow of a block.
    folder.write("block.obj",
                 "mtllib floor.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                 "v -0.5 1 -0.5\nv 0.5 1 -0.5\nv 0.5 1 0.5\nv -0.5 1 0.5\nusemtl gray\nf 4 3 2 1\nf 8 7 6 5\n");
    for (const std::string method : {"exhaustive", "lightcuts"}) {
        const std::string size = method == "exhaustive" ? "32x32" : "32x20";
        const double value = measured("block.obj --lights one.csv --size " + size + " --method " + method + view);
        EXPECT_GT(value, 0.0);
        EXPECT_NEAR(value / from_picture(), 1.0, 1e-5) << method;
    }
}

TEST_F(Adaptation, DoesNotSeeEmitters) {
    // From below the lamp, which shines at the camera with a luminance of 19 and reflects nothing.
    const double value = measured(
        "room.obj --size 32x32 --method exhaustive --eye 2.5,0.4,2.5 --target 0,1.5,0 --fov 80");
    const double without = from_picture(15.0);
    EXPECT_NEAR(value / without, 1.0, 1e-5);
    EXPECT_GT(from_picture(), 1.01 * without) << "the lamp is in the picture";
}

TEST_F(Adaptation, IsProportionalToTheLight) {
    const std::string scene = "floor.obj --size 64x48 --method exhaustive" + view;
    const double once = measured(scene + "--lights one.csv");
    folder.write("more.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0.5,2,-0.25,,,,3072,2048,1024\n");
    const double more = measured(scene + "--lights more.csv");
    EXPECT_NEAR(more / once, 1024.0, 1e-3);
}

TEST_F(Adaptation, IsNothingInTheDark) {
    // The light is below the floor, which is seen from above.
    folder.write("below.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0.5,-2,-0.25,,,,3,2,1\n");
    EXPECT_EQ(measured("floor.obj --lights below.csv --size 16x12 --eye 0,3,0.1 --target 0,0,0"), 0.0);
    // And where there is only background.
    EXPECT_EQ(measured("floor.obj --lights one.csv --size 16x12 --eye 0,3,0 --target 0,9,0.1"), 0.0);
}

}  // namespace
