#include "program.hpp"

#include <charconv>
#include <exception>

#include "io/content_hash.hpp"
#include "io/text_file.hpp"

namespace render {

std::string program_version() { return LIGHTCUTS_VERSION; }

std::string program_build() {
    std::string bytes;
    try {
        bytes = read_file("/proc/self/exe");
    } catch (const std::exception&) { return program_version(); }
    char hash[17] = {};
    std::to_chars(hash, hash + sizeof hash, ContentHash().add(bytes).value(), 16);
    return program_version() + " build " + hash;
}

}  // namespace render
