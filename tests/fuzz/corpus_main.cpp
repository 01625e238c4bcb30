// Feeds a fuzz target with the files of a folder, and with changes of them: cut short, bytes changed, parts repeated.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <lightcuts/core/random.hpp>

#include "fuzz_target.hpp"

namespace {

constexpr std::uint64_t changes_per_file = 400;

void run(const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string changed(const std::string& bytes, std::uint64_t seed) {
    std::uint64_t drawn = 0;
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(lightcuts::hash_keys(seed, drawn++) % std::max<std::size_t>(n, 1));
    };
    std::string result = bytes;
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
        const std::size_t at = below(result.size());
        switch (below(4)) {
            case 0: result.resize(at); break;
            case 1:
                if (!result.empty()) result[at] = static_cast<char>(below(256));
                break;
            case 2: result.erase(at, below(16)); break;
            default: result.insert(at, result.substr(below(result.size()), below(64)));
        }
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < argc; ++i) {
        for (const auto& entry : std::filesystem::directory_iterator(argv[i])) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& path : files) {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        run(bytes);
        for (std::uint64_t i = 0; i < changes_per_file; ++i) run(changed(bytes, i));
    }
    std::printf("%zu files, %zu inputs\n", files.size(), files.size() * (1 + changes_per_file));
    return files.empty() ? 1 : 0;
}
