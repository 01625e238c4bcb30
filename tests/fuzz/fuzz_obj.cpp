// An OBJ file; behind lines `%% NAME` the files beside it.

#include <map>
#include <string>

#include <render/io/load_obj.hpp>
#include <render/io/validate.hpp>

#include "fuzz_target.hpp"

namespace {

std::map<std::string, std::string> split(std::string_view bytes) {
    constexpr std::string_view mark = "%% ";
    std::map<std::string, std::string> files;
    std::string name = "s.obj";
    while (!bytes.empty()) {
        const std::size_t next = std::min(bytes.find(mark), bytes.size());
        files.emplace(name, bytes.substr(0, next));
        bytes.remove_prefix(next);
        if (bytes.empty()) break;
        bytes.remove_prefix(mark.size());
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        name = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
    }
    return files;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        render::Scene scene = render::load_obj("s.obj", render::MemoryFiles(split(bytes)));
        render::validate(scene);
    });
}
