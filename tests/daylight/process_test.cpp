#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <csignal>

#include <render/process.hpp>
#include "support/temporary_folder.hpp"

#include "daylight/sky_matrices.hpp"
#include "daylight/synthetic_weather.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Program : public ::testing::Test {
protected:
    TemporaryFolder folder;
    TemporaryFolder streams;

    void SetUp() override {
        folder.write("shed.obj",
                     "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nv -4 3 -4\nv 4 3 -4\nv 4 3 4\nv -4 3 4\n"
                     "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 1 5 8 4\nf 2 3 7 6\n");
        folder.write("two.pts", "0 1 0  0 1 0\n0 1 3  0 0 1\n");
        folder.write("week.epw", text_of(std::string(LIGHTCUTS_TEST_DIRECTORY) + "/daylight/week.epw"));
    }
    static std::string text_of(const std::string& path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
    static std::vector<std::string> words(const std::string& text) {
        std::vector<std::string> found;
        std::istringstream stream(text);
        for (std::string word; stream >> word;) found.push_back(word);
        return found;
    }
    std::unique_ptr<Process> start(const std::string& arguments) {
        return std::make_unique<Process>(LIGHTCUTS_DAYLIGHT_EXECUTABLE, words(arguments), folder.path(),
                                         streams.path());
    }
    Process::Result run(const std::string& arguments) { return start(arguments)->wait(); }
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }
};

const std::string trace_grid = "trace shed.obj --grid -4,1,-4,4,1,4 --spacing 2 --directions 1024 -o a.cuts";

TEST_F(Program, traces_and_lights_a_year) {
    const Process::Result traced = run(trace_grid);
    ASSERT_EQ(traced.status, 0) << traced.err;
    EXPECT_THAT(traced.err, HasSubstr("16 sensors, 1024 directions"));
    EXPECT_EQ(traced.out, "");
    const std::set<std::string> before = files();
    EXPECT_EQ(before.count("a.resume"), 0u);
    const Process::Result lit = run(
        "year a.cuts --weather week.epw -o h.csv --matrix m.mtx --annual a.csv --picture p.png");
    ASSERT_EQ(lit.status, 0) << lit.err;
    EXPECT_THAT(lit.err, HasSubstr("16 sensors, 168 hours"));
    EXPECT_THAT(folder.read("h.csv"), StartsWith("month,day,hour,0,1,2,"));
    EXPECT_THAT(folder.read("m.mtx"), HasSubstr("NROWS=16\nNCOLS=168\nNCOMP=1\nFORMAT=ascii\n\n"));
    EXPECT_THAT(folder.read("a.csv"), StartsWith("sensor,x,y,z,dx,dy,dz,mean_lux,autonomy_300,"));
    EXPECT_THAT(folder.read("p.png"), StartsWith("\x89PNG"));
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    EXPECT_EQ(lines(folder.read("h.csv")), 169);
    EXPECT_EQ(lines(folder.read("a.csv")), 17);
    EXPECT_EQ(lines(folder.read("m.mtx")), 7 + 16);
    EXPECT_EQ(files().size(), before.size() + 4);
}

TEST_F(Program, is_quiet_if_asked_and_the_same_on_any_number_of_threads) {
    ASSERT_EQ(run("trace shed.obj --sensors two.pts -o one.cuts --quiet --threads 1").err, "");
    ASSERT_EQ(run("trace shed.obj --sensors two.pts -o two.cuts --quiet --threads 2").err, "");
    EXPECT_EQ(folder.read("one.cuts"), folder.read("two.cuts"));
    ASSERT_EQ(run("year one.cuts --weather week.epw -o 1.csv --quiet --threads 1").err, "");
    ASSERT_EQ(run("year one.cuts --weather week.epw -o 2.csv --quiet --threads 2").err, "");
    EXPECT_EQ(folder.read("1.csv"), folder.read("2.csv"));
}

TEST_F(Program, adds_light_that_bounces) {
    const auto mean = [&](const std::string& options) {
        EXPECT_EQ(run(trace_grid + options + " --quiet").status, 0);
        EXPECT_EQ(run("year a.cuts --weather week.epw --annual a.csv --quiet").status, 0);
        std::istringstream table(folder.read("a.csv"));
        std::string line;
        double sum = 0.0;
        int count = -1;
        for (; std::getline(table, line); ++count) {
            if (count < 0) continue;
            std::size_t at = 0;
            for (int i = 0; i < 7; ++i) at = line.find(',', at) + 1;
            sum += std::stod(line.substr(at));
        }
        EXPECT_EQ(count, 16);
        return sum / count;
    };
    const double direct = mean(""), with_bounce = mean(" --bounce 0.5");
    EXPECT_GT(with_bounce, 1.1 * direct);
    EXPECT_LT(with_bounce, 3.0 * direct);
}

TEST_F(Program, takes_rays_to_suns_in_the_scene_that_was_traced) {
    ASSERT_EQ(run(trace_grid).status, 0);
    ASSERT_EQ(run("year a.cuts --weather week.epw -o near.csv --quiet").status, 0);
    const Process::Result rays = run("year a.cuts --weather week.epw -o rays.csv --scene shed.obj --quiet");
    ASSERT_EQ(rays.status, 0) << rays.err;
    EXPECT_NE(folder.read("near.csv"), folder.read("rays.csv"));
    folder.write("other.obj", "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nf 3 2 1\n");
    const Process::Result refused = run("year a.cuts --weather week.epw -o other.csv --scene other.obj");
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.err, HasSubstr("other.obj: is not the scene that a.cuts was traced in"));
    EXPECT_FALSE(folder.has("other.csv"));
}

TEST_F(Program, takes_standard_skies) {
    ASSERT_EQ(run(trace_grid).status, 0);
    const auto year = [&](const std::string& options) {
        const Process::Result lit = run("year a.cuts --weather week.epw -o h.csv --quiet " + options);
        EXPECT_EQ(lit.status, 0) << lit.err;
        return folder.read("h.csv");
    };
    const std::string perez = year("");
    EXPECT_EQ(year("--sky perez"), perez);
    std::set<std::string> all{perez};
    for (int type = 1; type <= 16; ++type) all.insert(year("--sky cie:" + std::to_string(type)));
    EXPECT_EQ(all.size(), 17u);
}

TEST_F(Program, takes_a_sky_matrix_with_weather_and_without) {
    ASSERT_EQ(run(trace_grid).status, 0);
    const auto even = [](std::size_t, std::size_t hour, int) { return hour % 24 < 12 ? 0.0 : 5.0; };
    folder.write("year.smx", sky_matrix_text(146, 8760, "float", even));
    folder.write("week.smx", sky_matrix_text(578, 168, "ascii", even));
    const Process::Result alone = run("year a.cuts --skies year.smx -o h.csv --annual a.csv --picture p.png");
    ASSERT_EQ(alone.status, 0) << alone.err;
    EXPECT_THAT(alone.err, HasSubstr("16 sensors, 8760 hours, 4380 of them lit"));
    EXPECT_THAT(folder.read("h.csv"), HasSubstr("\n12,31,24,"));
    // Where suns are is not known, and there are no hours of sun to name.
    EXPECT_THAT(folder.read("a.csv"), HasSubstr(",\n"));
    const Process::Result with_suns = run("year a.cuts --skies week.smx --weather week.epw -o w.csv --annual b.csv");
    ASSERT_EQ(with_suns.status, 0) << with_suns.err;
    EXPECT_THAT(with_suns.err, HasSubstr("168 hours"));
    EXPECT_EQ(folder.read("b.csv").find(",\n"), std::string::npos);
}

TEST_F(Program, says_what_it_is) {
    EXPECT_THAT(run("--help").out, HasSubstr("trace"));
    EXPECT_THAT(run("trace --help").out, HasSubstr("--sensors"));
    EXPECT_THAT(run("year --help").out, HasSubstr("--weather"));
    EXPECT_THAT(run("--version").out, StartsWith("lightcuts-daylight "));
}

struct Refused {
    const char* arguments;
    int status;
    const char* says;
};

TEST_F(Program, refuses_what_it_cannot_use_in_one_line_and_writes_nothing) {
    ASSERT_EQ(run("trace shed.obj --sensors two.pts --directions 256 -o two.cuts --quiet").status, 0);
    folder.write("bad.pts", "0 0 0 0 0 1\n0 0 0 0 0\n");
    folder.write("bad.epw", "LOCATION,x\n");
    folder.write("bad.cuts", "nothing\n");
    const auto one = [](std::size_t, std::size_t, int) { return 1.0; };
    folder.write("day.smx", sky_matrix_text(146, 24, "ascii", one));
    folder.write("bad.smx", sky_matrix_text(145, 24, "ascii", one));
    std::string sunny = sky_matrix_text(146, 168, "ascii", one);
    folder.write("sunny.smx", sunny.erase(sunny.find(" -s"), 3));
    const std::set<std::string> before = files();
    const Refused all[] = {
        {"", 2, "give what to do"},
        {"dance", 2, "--help"},
        {"trace", 2, "SCENE"},
        {"trace shed.obj", 2, "--output"},
        {"trace shed.obj -o a.cuts", 2, "give either --sensors or --grid"},
        {"trace shed.obj -o a.cuts --sensors two.pts --grid 0,0,0,1,0,1", 2, "give either --sensors or --grid"},
        {"trace shed.obj -o a.cuts --sensors two.pts --spacing 1", 2, "--spacing needs --grid"},
        {"trace shed.obj -o a.cuts --grid 0,0,0,1,0", 2, "two opposite corners"},
        {"trace shed.obj -o a.cuts --grid 0,0,0,1,0,1,2", 2, "two opposite corners"},
        {"trace shed.obj -o a.cuts --grid 0,0,0,1,0,nan", 2, "two opposite corners"},
        {"trace shed.obj -o a.cuts --grid 0,0,0,1,1,1", 1, "its corners differ in y"},
        {"trace shed.obj -o a.cuts --sensors two.pts --up x", 2, "expected y or z"},
        {"trace shed.obj -o a.cuts --sensors two.pts --directions 5", 2, "from 64 to 1048576"},
        {"trace shed.obj -o a.cuts --sensors two.pts --error 2", 2, "from 0 to 1"},
        {"trace shed.obj -o a.resume --sensors two.pts", 2, "extension"},
        {"trace shed.obj -o two.pts --sensors two.pts", 1, "would replace a file that is read"},
        {"trace shed.obj -o shed.obj --sensors two.pts", 1, "would replace a file that is read"},
        {"trace shed.obj -o no/where.cuts --sensors two.pts", 1, "cannot be written"},
        {"trace absent.obj -o a.cuts --sensors two.pts", 1, "no such file"},
        {"trace shed.obj -o a.cuts --sensors absent.pts", 1, "no such file"},
        {"trace shed.obj -o a.cuts --sensors bad.pts", 1, "bad.pts:2: 5 numbers"},
        {"year two.cuts -o a.csv", 2, "--weather"},
        {"year two.cuts --weather week.epw", 2, "nothing is to be written"},
        {"year two.cuts --weather week.epw -o a.csv --sky cie:17", 2, "perez, or cie:1 to cie:16"},
        {"year two.cuts --weather week.epw -o a.csv --sky cie", 2, "perez, or cie:1 to cie:16"},
        {"year two.cuts --skies day.smx -o a.csv --weather week.epw --sky cie:1", 2, "--sky is of no use with --skies"},
        {"year two.cuts --skies sunny.smx -o a.csv --weather week.epw", 1, "has suns, and so has --weather"},
        {"year two.cuts --skies day.smx -o a.csv --ground 0.1", 2, "--ground is of no use with --skies"},
        {"year two.cuts --skies day.smx -o a.csv --scene shed.obj", 2, "--scene needs --weather"},
        {"year two.cuts --skies day.smx --picture a.png --figure sun", 2, "--figure sun needs --weather"},
        {"year two.cuts --skies day.smx -o a.csv", 1, "day.smx: 24 columns, which are no year"},
        {"year two.cuts --skies day.smx -o a.csv --weather week.epw", 1, "day.smx: 24 columns, but week.epw has 168"},
        {"year two.cuts --skies day.smx -o day.smx", 1, "would replace a file that is read"},
        {"year two.cuts --skies bad.smx -o a.csv", 1, "bad.smx:4: NROWS is 145"},
        {"year two.cuts --skies absent.smx -o a.csv", 1, "absent.smx"},
        {"year two.cuts --weather week.epw -o a.csv --figure sun", 2, "--figure needs --picture"},
        {"year two.cuts --weather week.epw -o a.csv --isa avx2", 2, "--isa needs --scene"},
        {"year two.cuts --weather week.epw -o a.csv --hours 18-8", 2, "FROM-TO"},
        {"year two.cuts --weather week.epw -o a.csv --ground 1.5", 2, "from 0 to 1"},
        {"year two.cuts --weather week.epw -o a.csv --north south", 2, "degrees"},
        {"year two.cuts --weather week.epw -o a.csv --annual a.csv", 1, "two files would have this name"},
        {"year two.cuts --weather week.epw -o week.epw", 1, "would replace a file that is read"},
        {"year two.cuts --weather week.epw -o shed.obj --scene shed.obj", 1, "would replace a file that is read"},
        {"year two.cuts --weather week.epw -o a.csv --picture a.png", 1, "are no grid"},
        {"year two.cuts --weather bad.epw -o a.csv", 1, "bad.epw:1: LOCATION has 2 fields"},
        {"year bad.cuts --weather week.epw -o a.csv", 1, "bad.cuts: is no file of lightcuts-daylight trace"},
        {"year absent.cuts --weather week.epw -o a.csv", 1, "absent.cuts"},
    };
    for (const Refused& r : all) {
        const Process::Result result = run(r.arguments);
        EXPECT_EQ(result.status, r.status) << r.arguments << "\n" << result.err;
        EXPECT_THAT(result.err, HasSubstr(r.says)) << r.arguments;
        EXPECT_THAT(result.err, StartsWith("lightcuts-daylight: ")) << r.arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(files(), before) << r.arguments;
    }
}

TEST_F(Program, says_what_becomes_of_an_unfinished_run) {
    EXPECT_THAT(run(trace_grid + " --resume").err, HasSubstr("a.resume: there are no finished sensors"));
    folder.write("a.resume", "");
    EXPECT_THAT(run(trace_grid).err, HasSubstr("a.resume: starting over; --resume would have gone on"));
    EXPECT_FALSE(folder.has("a.resume"));
    folder.write("a.resume", "something else");
    const Process::Result refused = run(trace_grid + " --quiet");
    EXPECT_EQ(refused.status, 1);
    EXPECT_THAT(refused.err, HasSubstr("a.resume: is not a file of finished sensors; move it away"));
    EXPECT_EQ(folder.read("a.resume"), "something else");
}

TEST_F(Program, that_is_interrupted_goes_on_to_the_same_file) {
    const std::string arguments = "trace shed.obj --grid -4,1,-4,4,1,4 --spacing 0.1 --threads 1 -o a.cuts --quiet";
    const auto process = start(arguments);
    ASSERT_TRUE(process->wait_until([&] {
        std::error_code absent;
        return std::filesystem::file_size(folder / "a.resume", absent) > 100'000 && !absent;
    }));
    process->send(SIGINT);
    const Process::Result stopped = process->wait();
    EXPECT_EQ(stopped.status, 3);
    EXPECT_THAT(stopped.err, HasSubstr("of 6400 sensors are in a.resume, and --resume goes on with them"));
    EXPECT_FALSE(folder.has("a.cuts"));
    const Process::Result resumed = run(arguments + " --resume");
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_FALSE(folder.has("a.resume"));
    const std::string bytes = folder.read("a.cuts");
    ASSERT_EQ(run(arguments).status, 0);
    EXPECT_EQ(folder.read("a.cuts"), bytes);
}

}  // namespace
