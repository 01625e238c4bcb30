#include "output_file.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

namespace {

using lightcuts::invalid_input;

[[noreturn]] void refuse(const std::filesystem::path& target, const std::string& reason) {
    throw invalid_input(target.string() + ": cannot be written (" + reason + "); choose another place");
}

/// Creates an empty file of an unused name beside `target`, with the rights that any new file gets.
std::filesystem::path create_beside(const std::filesystem::path& target) {
    for (int attempt = 0;; ++attempt) {
        std::filesystem::path path = target;
        path.concat(".part").concat(std::to_string(::getpid())).concat("-").concat(std::to_string(attempt));
        const int file = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        if (file >= 0) {
            ::close(file);
            return path;
        }
        if (errno != EEXIST || attempt == 100) refuse(target, std::strerror(errno));
    }
}

}  // namespace

void require_writable(const std::filesystem::path& path) { const OutputFile probe(path); }

OutputFile::OutputFile(std::filesystem::path target) : target_(std::move(target)) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(target_, ignored);
    if (std::filesystem::exists(status)) {
        if (!std::filesystem::is_regular_file(status)) refuse(target_, "not a regular file");
        if (::access(target_.c_str(), W_OK) != 0) refuse(target_, std::strerror(errno));
        // A link's target is replaced, not the link.
        target_ = std::filesystem::canonical(target_, ignored);
    }
    temporary_ = create_beside(target_);
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) refuse(target_, error.message());
    temporary_.clear();
}

}  // namespace render
