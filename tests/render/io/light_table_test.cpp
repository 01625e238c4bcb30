#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/light_table.hpp>
#include <render/io/validate.hpp>

#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace {

using render::add_light_table;
using render::Scene;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* header = "kind,x,y,z,dx,dy,dz,r,g,b\n";

struct LightTable : testing::Test {
    TemporaryFolder folder;

    Scene read(const std::string& text) {
        Scene scene;
        add_light_table(folder.write("lights.csv", text), scene);
        return scene;
    }

    /// The message without the folder, for `line` below the header.
    std::string refused(const std::string& line) {
        const std::string path = folder.write("lights.csv", header + line);
        Scene scene;
        const std::string message = refusal([&] { add_light_table(path, scene); });
        EXPECT_TRUE(scene.omni.empty() && scene.oriented.empty() && scene.directional.empty());
        const std::string prefix = folder.path().string() + "/lights.csv:";
        EXPECT_THAT(message, StartsWith(prefix));
        return message.substr(prefix.size());
    }
};

TEST_F(LightTable, ReadsAllKinds) {
    const Scene s = read(std::string(header) +
                         "omni,1,2,3,,,,4,5,6\noriented, 1 ,2,3,0,0,-2,1,1,1\r\n\n"
                         "directional,,,,0,-3,0,+2,2e0,2\nomni,0,0,0,,,,0,0,0\n"
                         "sphere,1,2,3,0.5,,,4,5,6");
    ASSERT_EQ(s.omni.size(), 1u);
    EXPECT_EQ(s.omni[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(s.omni[0].intensity, glm::vec3(4, 5, 6));
    ASSERT_EQ(s.oriented.size(), 1u);
    EXPECT_EQ(s.oriented[0].axis, glm::vec3(0, 0, -1));
    ASSERT_EQ(s.directional.size(), 1u);
    EXPECT_EQ(s.directional[0].direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(s.directional[0].intensity, glm::vec3(2, 2, 2));
    ASSERT_EQ(s.spheres.size(), 1u);
    EXPECT_EQ(s.spheres[0].center, glm::vec3(1, 2, 3));
    EXPECT_EQ(s.spheres[0].radius, 0.5f);
    EXPECT_EQ(s.spheres[0].intensity, glm::vec3(4, 5, 6));
    EXPECT_EQ(s.dropped_lights, 1u);
}

TEST_F(LightTable, ErrorsNameTheLine) {
    const std::string good = "omni,0,0,0,,,,1,1,1\n";
    EXPECT_THAT(refused("lamp,0,0,0,,,,1,1,1\n"), StartsWith("2: the kind 'lamp'"));
    EXPECT_THAT(refused(good + "omni,0,0,0,,,,1,1\n"), StartsWith("3: 9 fields"));
    EXPECT_THAT(refused(good + good + "omni,0,0,0,,,,1,1,1,1\n"), StartsWith("4: 11 fields"));
    EXPECT_THAT(refused("omni,0,zero,0,,,,1,1,1\n"), StartsWith("2: y 'zero'"));
    EXPECT_THAT(refused("omni,0,,0,,,,1,1,1\n"), StartsWith("2: y is missing"));
    EXPECT_THAT(refused("omni,0,inf,0,,,,1,1,1\n"), StartsWith("2: y 'inf'"));
    EXPECT_THAT(refused("omni,0,0,0,,,,1,nan,1\n"), StartsWith("2: g 'nan'"));
    EXPECT_THAT(refused("omni,0,0,0,,,,1,1e60,1\n"), StartsWith("2: g '1e60'"));
    EXPECT_THAT(refused("omni,0,0,0,,,,1,1,-1\n"), StartsWith("2: b '-1'"));
    EXPECT_THAT(refused("omni,0,0,0,1,,,1,1,1\n"), StartsWith("2: dx must be empty"));
    EXPECT_THAT(refused("directional,1,,,0,1,0,1,1,1\n"), StartsWith("2: x must be empty"));
    EXPECT_THAT(refused("sphere,0,0,0,1,,1,1,1,1\n"), StartsWith("2: dz must be empty"));
    EXPECT_THAT(refused("sphere,0,0,0,,,,1,1,1\n"), StartsWith("2: dx is missing"));
    EXPECT_THAT(refused("sphere,0,0,0,0,,,1,1,1\n"), StartsWith("2: the radius dx '0'"));
    EXPECT_THAT(refused("oriented,0,0,0,0,0,0,1,1,1\n"), HasSubstr("zero length"));
    EXPECT_THAT(refused("directional,,,,0,0,0,1,1,1\n"), HasSubstr("zero length"));
}

TEST_F(LightTable, NeedsItsHeader) {
    EXPECT_THAT(refusal([&] { read("omni,0,0,0,,,,1,1,1\n"); }), HasSubstr("lights.csv:1: the header"));
    EXPECT_THAT(refusal([&] { read(""); }), HasSubstr("lights.csv:1: "));
    EXPECT_THAT(refusal([&] {
                    Scene scene;
                    add_light_table(folder / "none.csv", scene);
                }),
                HasSubstr("no such file"));
    EXPECT_TRUE(read("\xEF\xBB\xBF" + std::string(header)).omni.empty());
}

TEST_F(LightTable, DarkLightsAreLights) {
    Scene scene = read(header);
    EXPECT_THAT(refusal([&] { render::require_lights(scene); }), HasSubstr("no lights"));
    scene = read(std::string(header) + "omni,0,0,0,,,,0,0,0\n");
    EXPECT_TRUE(scene.omni.empty());
    render::require_lights(scene);
}

}  // namespace
