#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <render/io/output_file.hpp>

#include "render/refusal.hpp"
#include "render/small_files.hpp"
#include "support/temporary_folder.hpp"

namespace {

using render::OutputFile;

std::set<std::string> names_in(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.insert(entry.path().filename().string());
    }
    return names;
}

TEST(OutputFile, WritesTheTargetOfADanglingLink) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "deep");
    std::filesystem::create_symlink("deep/second", folder / "first");
    std::filesystem::create_symlink("../file", folder / "deep/second");
    render::require_writable(folder / "first");
    render::write_file(folder / "first", std::string("new"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "deep/second"));
    EXPECT_EQ(folder.read("file"), "new");
    EXPECT_EQ(names_in(folder), (std::set<std::string>{"first", "deep", "file"}));
}

TEST(OutputFile, RefusesALoopOfLinks) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("b", folder / "a");
    std::filesystem::create_symlink("a", folder / "b");
    EXPECT_NE(refusal([&] { render::require_writable(folder / "a"); }).find(folder / "a"), std::string::npos);
    EXPECT_EQ(names_in(folder), (std::set<std::string>{"a", "b"}));
}

TEST(OutputFile, TakesTheLongestNames) {
    const TemporaryFolder folder;
    const std::string name(255, 'x');
    render::write_file(folder / name, std::string("new"));
    EXPECT_EQ(folder.read(name), "new");
}

TEST(OutputFile, ErrorsNameTheTarget) {
    const TemporaryFolder folder;
    folder.write("a.txt", "old");
    {
        const SmallFiles small(1000);
        const std::string bytes(2000, 'x');
        const std::string message = refusal([&] { render::write_file(folder / "a.txt", bytes); });
        EXPECT_NE(message.find(folder / "a.txt"), std::string::npos) << message;
        EXPECT_NE(message.find("too large"), std::string::npos) << message;
        EXPECT_EQ(message.find(".tmp"), std::string::npos) << message;
    }
    EXPECT_EQ(folder.read("a.txt"), "old");
    OutputFile file(folder / "a.txt");
    std::filesystem::remove(folder / "a.txt");
    std::filesystem::create_directories(folder / "a.txt/full");
    const std::string message = refusal([&] { file.commit(); });
    EXPECT_NE(message.find(folder / "a.txt"), std::string::npos) << message;
    EXPECT_EQ(message.find(".tmp"), std::string::npos) << message;
}

TEST(OutputFile, ClearsAwayWhatKilledProgramsLeft) {
    const TemporaryFolder folder;
    folder.write(".lightcuts-1-0000000a.tmp", "left behind");
    folder.write(".lightcuts-notes", "the user's");
    const std::string busy = folder.write(".lightcuts-2-0000000b.tmp", "being written");
    const int held = ::open(busy.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    std::filesystem::create_symlink("notes", folder / ".lightcuts-3-0000000c.tmp");
    folder.write("notes", "the user's");
    OutputFile own(folder / "own");
    render::require_writable(folder / "a.txt");
    EXPECT_TRUE(std::filesystem::exists(own.path()));
    own.commit();
    EXPECT_EQ(names_in(folder), (std::set<std::string>{".lightcuts-notes", ".lightcuts-2-0000000b.tmp",
                                                       ".lightcuts-3-0000000c.tmp", "notes", "own"}));
    ::close(held);
    render::require_writable(folder / "a.txt");
    EXPECT_FALSE(folder.has(".lightcuts-2-0000000b.tmp"));
}

TEST(OutputFile, NamesBesideItKeepTheStem) {
    EXPECT_EQ(render::beside("out/my.picture.exr", ".png"), "out/my.picture.png");
    EXPECT_EQ(render::beside("picture", ".json"), "picture.json");
    const std::string stem(251, 'x');
    EXPECT_EQ(render::beside(stem + ".exr", ".png").string(), stem + ".png");
    // One character too many: shortened, and told from that of a name with the same beginning.
    const std::string json = render::beside("out/" + stem + ".exr", ".json").filename().string();
    EXPECT_EQ(json.size(), 255u);
    EXPECT_TRUE(json.ends_with(".json"));
    EXPECT_EQ(render::beside("out/" + stem + ".exr", ".json").filename(), json);
    EXPECT_NE(render::beside("out/" + stem.substr(1) + "y.exr", ".json").filename(), json);
    // A character of several bytes is not cut through.
    std::string wide = "x";
    for (int i = 0; i < 125; ++i) wide += "\xc3\xa9";
    const std::string shortened = render::beside(wide + ".exr", ".partial.exr").string();
    EXPECT_LE(shortened.size(), 255u);
    EXPECT_EQ(shortened.find("\xc3-"), std::string::npos);
}

}  // namespace
