#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "support/temporary_folder.hpp"

/// A folder with a small scene, in which the programs run. Their streams are caught in another.
class Programs : public ::testing::Test {
protected:
    TemporaryFolder folder;
    TemporaryFolder streams;

    void SetUp() override {
        folder.write("room.mtl",
                     "newmtl gray\nKd 0.5 0.4 0.3\n"
                     "newmtl lamp\nKd 0 0 0\nKe 20 20 10\n");
        // A floor of 8 x 8 under a block, with a lamp of 1 x 1 that faces down.
        folder.write("room.obj",
                     "mtllib room.mtl\n"
                     "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                     "v -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n"
                     "v -0.5 3 -0.5\nv 0.5 3 -0.5\nv 0.5 3 0.5\nv -0.5 3 0.5\n"
                     "usemtl gray\nf 4 3 2 1\nf 8 7 6 5\n"
                     "usemtl lamp\nf 9 10 11 12\n");
        folder.write("floor.mtl", "newmtl gray\nKd 0.5 0.4 0.3\n");
        folder.write("floor.obj", "mtllib floor.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl gray\nf 4 3 2 1\n");
        folder.write("one.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0.5,2,-0.25,,,,3,2,1\n");
        folder.write("dark.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0.5,2,-0.25,,,,0,0,0\n");
    }

    Process::Result render(const std::string& arguments) { return run(LIGHTCUTS_RENDER_EXECUTABLE, arguments); }
    Process::Result compare(const std::string& arguments) { return run(LIGHTCUTS_COMPARE_EXECUTABLE, arguments); }

    Process::Result run(const std::string& program, const std::string& arguments) {
        return Process(program, words(arguments), folder.path(), streams.path()).wait();
    }

    /// Of a program that inherits what `prepare` does.
    Process::Result render(const std::string& arguments, const std::function<void()>& prepare) {
        return Process(LIGHTCUTS_RENDER_EXECUTABLE, words(arguments), folder.path(), streams.path(), prepare).wait();
    }

    /// A renderer that goes on while the test does.
    std::unique_ptr<Process> start(const std::string& arguments, const std::function<void()>& prepare = {}) {
        return std::make_unique<Process>(LIGHTCUTS_RENDER_EXECUTABLE, words(arguments), folder.path(), streams.path(),
                                         prepare);
    }

    /// Bytes of a file; 0 if there is none.
    std::uintmax_t size_of(const std::string& name) const {
        std::error_code absent;
        const std::uintmax_t size = std::filesystem::file_size(folder / name, absent);
        return absent ? 0 : size;
    }

    static std::vector<std::string> words(const std::string& text) {
        std::vector<std::string> found;
        std::istringstream stream(text);
        for (std::string word; stream >> word;) found.push_back(word);
        return found;
    }

    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }

    nlohmann::json report(const std::string& name) const { return nlohmann::json::parse(folder.read(name)); }
};

/// A camera for the scenes above.
inline const std::string view = " --eye 1,5,7 --target 0,0.5,0 ";

inline bool is_one_line(const std::string& text) { return text.size() > 1 && text.find('\n') == text.size() - 1; }

/// What must be refused: arguments, exit status, and a part of the message that says where or what.
struct Refusal {
    const char* arguments;
    int status;
    const char* says;
};
