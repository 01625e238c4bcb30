// Shadows of colored glass have its color.

#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <render/io/picture.hpp>

#include "programs.hpp"

namespace {

class StainedGlass : public Programs {};

TEST_F(StainedGlass, TintsWhatItShades) {
    folder.write("church.mtl",
                 "newmtl stone\nKd 0.5 0.4 0.3\nnewmtl red\nillum 7\nTf 0.8 0.1 0.2\nNi 1.5\n"
                 "newmtl blue\nillum 7\nTf 0.5 0.5 1\nNi 1.5\n");
    // A floor under two panes, one above the other; the second covers half of the first.
    folder.write("church.obj",
                 "mtllib church.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                 "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nv 0 1.2 -1\nv 1 1.2 -1\nv 1 1.2 1\nv 0 1.2 1\n"
                 "usemtl stone\nf 4 3 2 1\nusemtl red\nf 5 6 7 8\nusemtl blue\nf 9 10 11 12\n");
    folder.write("sun.csv", "kind,x,y,z,dx,dy,dz,r,g,b\ndirectional,,,,0,-1,0,3,2,1\n");
    struct Spot {
        std::string x;
        glm::dvec3 tint;
    };
    for (const Spot& spot : {Spot{"-0.5", {0.8, 0.1, 0.2}}, Spot{"0.5", {0.4, 0.05, 0.2}}, Spot{"2", {1, 1, 1}}}) {
        for (const std::string method : {"lightcuts", "exhaustive", "ward", "power"}) {
            const auto result = render("church.obj --quiet --lights sun.csv --size 1x1 --eye 3.9,0.5,0 --target " +
                                       spot.x + ",0,0 --method " + method);
            ASSERT_EQ(result.status, 0) << result.err;
            const glm::vec3 pixel = render::read_exr(folder / "render.exr").pixels[0];
            const glm::dvec3 expected = glm::dvec3(0.5, 0.4, 0.3) * glm::dvec3(3, 2, 1) * spot.tint / std::numbers::pi;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-5 * expected[c]) << spot.x << method;
        }
    }
}

}  // namespace
