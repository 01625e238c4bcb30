// A command line, its words separated by line ends.

#include <string>
#include <vector>

#include <render/options.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        std::vector<std::string> words{"lightcuts-render"};
        while (!bytes.empty()) {
            const std::size_t end = std::min(bytes.find('\n'), bytes.size());
            // What a system hands over ends at a zero.
            words.emplace_back(bytes.substr(0, std::min(end, bytes.find('\0'))));
            bytes.remove_prefix(std::min(end + 1, bytes.size()));
        }
        std::vector<const char*> arguments;
        for (const std::string& word : words) arguments.push_back(word.c_str());
        try {
            render::parse_options(static_cast<int>(arguments.size()), arguments.data());
        } catch (const render::usage_error& problem) {
            if (std::string(problem.what()).find('\n') != std::string::npos) std::terminate();
        }
    });
}
