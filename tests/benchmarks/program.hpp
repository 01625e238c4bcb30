#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/process.hpp"
#include "support/temporary_folder.hpp"

/// A benchmark that runs in an empty folder. Its streams are caught in another.
class BenchmarkProgram : public testing::Test {
protected:
    TemporaryFolder folder;

    explicit BenchmarkProgram(std::string executable) : executable_(std::move(executable)) {}

    Process::Result run(const std::string& arguments) {
        std::vector<std::string> words;
        std::istringstream text(arguments);
        for (std::string word; text >> word;) words.push_back(word);
        return Process(executable_, words, folder.path(), streams_.path()).wait();
    }
    nlohmann::json figures(const std::string& file) const { return nlohmann::json::parse(folder.read(file)); }

private:
    std::string executable_;
    TemporaryFolder streams_;
};
