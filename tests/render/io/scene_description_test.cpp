#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <render/io/scene_description.hpp>

#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace {

const std::string camera = R"({"eye": [1, 2.5, 3], "target": [0, 0, -1], "up": [0, 1, 0], "vfov_deg": 40.5,
                               "resolution": [640, 400]})";

std::string description(const std::string& rest) { return "{\n\"file\": \"room.glb\",\n" + rest + "}\n"; }

/// `text` with the first `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(SceneDescription, HasTheFileAndItsCameras) {
    const TemporaryFolder folder;
    const std::string second = replaced(camera, "640", "100");
    folder.write("scene.json", description(R"("up_axis": "+Y", "notes": ["what", {"ever": 1}], "cameras": [)" + camera +
                                           "," + second + "]"));
    const auto read = render::description_beside(folder / "room.glb");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->file, "room.glb");
    ASSERT_EQ(read->cameras.size(), 2u);
    EXPECT_EQ(read->cameras[0].camera.eye, glm::dvec3(1.0, 2.5, 3.0));
    EXPECT_EQ(read->cameras[0].camera.target, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(read->cameras[0].camera.up, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(read->cameras[0].camera.vertical_fov, 40.5f);
    EXPECT_EQ(read->cameras[0].height, 400);
    EXPECT_EQ(read->cameras[1].width, 100);
    EXPECT_EQ(read->cameras[1].camera.name, "1");
}

TEST(SceneDescription, IsAboutOneFile) {
    const TemporaryFolder folder;
    EXPECT_FALSE(render::description_beside(folder / "room.glb"));
    folder.write("scene.json", description("\"cameras\": [" + camera + "]"));
    EXPECT_TRUE(render::description_beside(folder / "room.glb"));
    EXPECT_FALSE(render::description_beside(folder / "other.glb"));
}

TEST(SceneDescription, RefusesWithFileAndPlace) {
    const TemporaryFolder folder;
    const auto with = [](const std::string& from, const std::string& to) {
        return description("\"cameras\": [" + camera + "," + replaced(camera, from, to) + "]");
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {description("\"cameras\": [" + camera + "], \"lamps\": 3"), ": unknown key 'lamps'"},
        {description("\"cameras\": []"), ": cameras: "},
        {description("\"cameras\": 3"), ": cameras: "},
        {description("\"cameras\": [3]"), ": cameras[0]: "},
        {description("\"name\": \"room\""), ": 'cameras' is missing"},
        {description("\"up_axis\": \"+Z\", \"cameras\": [" + camera + "]"), ": up_axis: "},
        {replaced(description("\"cameras\": [" + camera + "]"), "\"room.glb\"", "7"), ": file: "},
        {with("\"eye\": [1, 2.5, 3]", "\"eye\": [1, 2.5]"), ": cameras[1].eye: expected three numbers"},
        {with("\"eye\": [1, 2.5, 3]", "\"eye\": [1, \"x\", 3]"), ": cameras[1].eye[1]: expected a finite number"},
        {with("\"eye\": [1, 2.5, 3]", "\"eye\": [1, 1e300, 3]"), ": cameras[1].eye[1]: expected a finite number"},
        {with("40.5", "null"), ": cameras[1].vfov_deg: "},
        {with("40.5", "190"), ": cameras[1]"},
        {with("[640, 400]", "[640]"), ": cameras[1].resolution: "},
        {with("640", "0"), ": cameras[1].resolution[0]: "},
        {with("640", "1.5"), ": cameras[1].resolution[0]: "},
        {with("640", "99999999999"), ": cameras[1].resolution[0]: "},
        {with("\"up\": [0, 1, 0],", ""), ": cameras[1]: 'up' is missing"},
        {with("\"up\"", "\"roll\": 0, \"up\""), ": cameras[1]: unknown key 'roll'"},
        {with("\"target\": [0, 0, -1]", "\"target\": [1, 2.5, 3]"), ": cameras[1]"},
        {"[]", ": expected an object"},
        {"{\n\"file\": \"room.glb\",\n\"cameras\": [}", ":3: not JSON"},
        {"", ":1: not JSON"},
    };
    for (const auto& [text, wanted] : cases) {
        const std::string path = folder.write("scene.json", text);
        const std::string message = refusal([&] { render::read_scene_description(path); });
        EXPECT_EQ(message.rfind(path + wanted, 0), 0u) << message << "\nfor " << text;
    }
    EXPECT_EQ(
        refusal([&] { render::read_scene_description(folder / "none.json"); }).rfind(folder / "none.json" + ": ", 0),
        0u);
}

}  // namespace
