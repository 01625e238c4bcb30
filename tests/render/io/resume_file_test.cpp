#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <render/io/resume_file.hpp>

#include "render/refusal.hpp"
#include "render/small_files.hpp"
#include "support/temporary_folder.hpp"

namespace {

using render::Fingerprint;
using render::FinishedTile;
using render::ResumeFile;

const std::vector<std::size_t> counts = {5, 7, 3};

FinishedTile tile(std::uint32_t index) {
    FinishedTile finished;
    finished.tile = index;
    finished.statistics.shadow_rays = 100 + index;
    finished.statistics.error_bound_sum = 0.1 * index;
    for (std::size_t i = 0; i < counts[index]; ++i) finished.values.push_back(static_cast<float>(i) / 3.0f);
    return finished;
}

Fingerprint print_of(const std::string& value) {
    Fingerprint print;
    print.add("--spp", value);
    print.add("the lights", "#" + value);
    return print;
}

void fail_on_warning(const std::string& warning) { ADD_FAILURE() << warning; }

/// A file with the tiles 2 and 0.
std::string write_two(const std::string& path) {
    ResumeFile file(path, fail_on_warning);
    file.begin(print_of("1"));
    file.append(tile(2));
    file.append(tile(0));
    file.flush();
    EXPECT_TRUE(file.is_of_use());
    return path;
}

std::vector<FinishedTile> read_all(const std::string& path) {
    ResumeFile file(path, fail_on_warning);
    EXPECT_TRUE(file.is_there());
    file.go_on(print_of("1"));
    std::vector<FinishedTile> tiles;
    file.read(counts, [&](const FinishedTile& finished) { tiles.push_back(finished); });
    return tiles;
}

TEST(ResumeFile, GivesBackWhatWasAppended) {
    const TemporaryFolder folder;
    const std::string path = write_two(folder / "a.resume");
    const auto tiles = read_all(path);
    ASSERT_EQ(tiles.size(), 2u);
    for (const FinishedTile& found : tiles) {
        const FinishedTile expected = tile(found.tile);
        EXPECT_EQ(found.values, expected.values);
        EXPECT_EQ(found.statistics.shadow_rays, expected.statistics.shadow_rays);
        EXPECT_EQ(found.statistics.error_bound_sum, expected.statistics.error_bound_sum);
    }
    {
        ResumeFile file(path, fail_on_warning);
        file.go_on(print_of("1"));
        file.read(counts, [](const FinishedTile&) {});
        file.append(tile(1));
    }
    EXPECT_EQ(read_all(path).size(), 3u);
}

TEST(ResumeFile, DropsATileThatIsCutOffAnywhere) {
    const TemporaryFolder folder;
    const std::string whole = folder.read(std::filesystem::path(write_two(folder / "a.resume")).filename());
    // The last is tile 0: a header of 16 bytes, 96 of statistics, 5 values, a checksum.
    const std::size_t last = 16 + sizeof(render::RenderStatistics) + 5 * 4 + 8;
    for (std::size_t cut = 1; cut <= last; ++cut) {
        folder.write("a.resume", whole.substr(0, whole.size() - cut));
        ASSERT_EQ(read_all(folder / "a.resume").size(), 1u) << cut;
        // What is appended later follows the last whole tile.
        ASSERT_EQ(folder.read("a.resume").size(), whole.size() - last) << cut;
    }
}

TEST(ResumeFile, RefusesEveryFlippedByteAndLeavesIt) {
    const TemporaryFolder folder;
    const std::string whole = folder.read(std::filesystem::path(write_two(folder / "a.resume")).filename());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        folder.write("a.resume", damaged);
        {
            ResumeFile file(folder / "a.resume", fail_on_warning);
            if (file.obstacle().empty()) {
                const std::string message = refusal([&] {
                    file.go_on(print_of("1"));
                    file.read(counts, [](const FinishedTile&) {});
                });
                EXPECT_NE(message.find(folder / "a.resume"), std::string::npos) << i;
            }
        }
        ASSERT_TRUE(folder.read("a.resume") == damaged) << i;
    }
}

TEST(ResumeFile, RefusesATileTwice) {
    const TemporaryFolder folder;
    const std::string path = write_two(folder / "a.resume");
    const std::string whole = folder.read("a.resume");
    const std::size_t last = 16 + sizeof(render::RenderStatistics) + 5 * 4 + 8;
    folder.write("a.resume", whole + whole.substr(whole.size() - last));
    EXPECT_NE(refusal([&] { read_all(path); }).find("damaged"), std::string::npos);
}

TEST(ResumeFile, TellsPicturesApart) {
    const TemporaryFolder folder;
    const std::string path = write_two(folder / "a.resume");
    ResumeFile file(path, fail_on_warning);
    const std::string message = refusal([&] { file.go_on(print_of("2")); });
    EXPECT_NE(message.find("--spp (1, now 2), the lights;"), std::string::npos) << message;
}

TEST(ResumeFile, WithoutTilesGoesAway) {
    const TemporaryFolder folder;
    {
        ResumeFile file(folder / "a.resume", fail_on_warning);
        EXPECT_FALSE(file.is_there());
        EXPECT_TRUE(file.obstacle().empty());
        file.begin(print_of("1"));
        EXPECT_FALSE(file.is_of_use());
        EXPECT_TRUE(folder.has("a.resume"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ResumeFile, IsHeldByOneRunAtATime) {
    const TemporaryFolder folder;
    ResumeFile first(folder / "a.resume", fail_on_warning);
    first.begin(print_of("1"));
    ResumeFile second(folder / "a.resume", fail_on_warning);
    EXPECT_NE(second.obstacle().find("in use"), std::string::npos);
    second.begin(print_of("2"));
    second.append(tile(0));
    second.remove();
    EXPECT_TRUE(folder.has("a.resume"));
}

TEST(ResumeFile, WarnsOnceWhenItCannotBeWritten) {
    const TemporaryFolder folder;
    int warnings = 0;
    ResumeFile file(folder / "no/folder/a.resume", [&](const std::string& warning) {
        EXPECT_NE(warning.find("a.resume"), std::string::npos);
        ++warnings;
    });
    file.begin(print_of("1"));
    file.append(tile(0));
    file.flush();
    EXPECT_EQ(warnings, 1);
    EXPECT_FALSE(file.is_of_use());
}

TEST(ResumeFile, GoesOnWhenThereIsRoomAgain) {
    const TemporaryFolder folder;
    int warnings = 0;
    {
        ResumeFile file(folder / "a.resume", [&](const std::string&) { ++warnings; });
        file.begin(print_of("1"));
        {
            const SmallFiles full(folder.read("a.resume").size() + 50);
            for (const std::uint32_t index : {0u, 1u}) {
                file.append(tile(index));
                file.flush();
            }
        }
        file.append(tile(2));
    }
    EXPECT_EQ(warnings, 1);
    const auto tiles = read_all(folder / "a.resume");
    ASSERT_EQ(tiles.size(), 1u);
    EXPECT_EQ(tiles[0].values, tile(2).values);
}

TEST(ResumeFile, LendsItsRoomAndGetsItBackIfThatIsInVain) {
    const TemporaryFolder folder;
    const std::string path = write_two(folder / "a.resume");
    const std::string whole = folder.read("a.resume");
    ResumeFile file(path, fail_on_warning);
    file.go_on(print_of("1"));
    file.read(counts, [](const FinishedTile&) {});
    const auto in_vain = [&] {
        file.lend_room([&] {
            EXPECT_EQ(std::filesystem::file_size(path), 0u);
            throw lightcuts::invalid_input("in vain");
        });
    };
    EXPECT_THROW(in_vain(), lightcuts::invalid_input);
    EXPECT_TRUE(folder.read("a.resume") == whole);
    file.lend_room([] {});
    EXPECT_EQ(std::filesystem::file_size(path), 0u);
    file.remove();
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ResumeFile, TakesAnEmptyFileForNone) {
    const TemporaryFolder folder;
    ResumeFile file(folder.write("a.resume", ""), fail_on_warning);
    EXPECT_FALSE(file.is_there());
    EXPECT_EQ(file.obstacle(), "");
    file.begin(print_of("1"));
    EXPECT_GT(std::filesystem::file_size(file.path()), 0u);
}

TEST(ResumeFile, DoesNotFollowLinks) {
    const TemporaryFolder folder;
    const std::string target = write_two(folder / "target");
    const std::string before = folder.read("target");
    std::filesystem::create_symlink("target", folder / "a.resume");
    ResumeFile file(folder / "a.resume", fail_on_warning);
    EXPECT_FALSE(file.obstacle().empty());
    file.begin(print_of("1"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.resume"));
    EXPECT_TRUE(folder.read("target") == before);
}

}  // namespace
