#include "io/output_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

#include <lightcuts/core/invalid_input.hpp>

#include "io/content_hash.hpp"

namespace render {

namespace {

/// Bytes of a file's name that all usual file systems take.
constexpr std::size_t longest_name = 255;

[[noreturn]] void refuse(const std::filesystem::path& target, const std::string& reason) {
    throw lightcuts::invalid_input(target.string() + ": cannot be written (" + reason + "); choose another place");
}

/// What `path` leads to through any number of symbolic links; the last one need not exist.
std::filesystem::path behind_links(const std::filesystem::path& path) {
    constexpr int most_links = 40;
    std::filesystem::path at = path;
    for (int i = 0; i < most_links; ++i) {
        std::error_code no_link;
        const std::filesystem::path next = std::filesystem::read_symlink(at, no_link);
        if (no_link) return at;
        at = at.parent_path() / next;
    }
    refuse(path, std::strerror(ELOOP));
}

/// The file that `path` stands for. throws: invalid_input unless there is none yet, or one that may be replaced.
std::filesystem::path replaceable(const std::filesystem::path& path) {
    std::filesystem::path target = behind_links(path);
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(target, ignored);
    if (std::filesystem::exists(status)) {
        if (!std::filesystem::is_regular_file(status)) refuse(path, "not a regular file");
        if (::access(target.c_str(), W_OK) != 0) refuse(path, std::strerror(errno));
    }
    return target;
}

std::unique_ptr<TemporaryFile> create_beside(const std::filesystem::path& target, const std::filesystem::path& name) {
    try {
        return std::make_unique<TemporaryFile>(target.parent_path());
    } catch (const std::system_error& e) { refuse(name, e.code().message()); }
}

}  // namespace

void require_writable(const std::filesystem::path& path) {
    remove_stale_temporaries(behind_links(path).parent_path());
    const OutputFile probe(path);
}

void require_apart(const std::filesystem::path& output, const std::filesystem::path& input) {
    std::error_code absent;
    if (!std::filesystem::equivalent(output, input, absent)) return;
    const std::string which = output == input ? "" : ", which is " + input.string();
    throw lightcuts::invalid_input(output.string() + ": would replace a file that is read" + which +
                                   "; write to another name");
}

OutputFile::OutputFile(std::filesystem::path target)
    : name_(std::move(target)), target_(replaceable(name_)), temporary_(create_beside(target_, name_)) {}

void OutputFile::write(std::span<const char> bytes) {
    if (const int error = write_all(temporary_->number(), bytes)) refuse(name_, std::strerror(error));
}

void OutputFile::commit() {
    // Closing has nothing to report after this, except on the few file systems that cannot do it.
    const bool impossible = ::fsync(temporary_->number()) != 0;
    if (impossible && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) refuse(name_, std::strerror(errno));
    try {
        temporary_->rename_to(target_);
    } catch (const std::system_error& e) { refuse(name_, e.code().message()); }
}

void write_file(const std::filesystem::path& target, std::span<const char> bytes) {
    OutputFile file(target);
    file.write(bytes);
    file.commit();
}

std::filesystem::path beside(const std::filesystem::path& file, const std::string& suffix) {
    std::string stem = file.stem().string();
    if (stem.size() + suffix.size() > longest_name) {
        char mark[18];
        std::snprintf(mark, sizeof mark, "-%016llx", static_cast<unsigned long long>(ContentHash().add(stem).value()));
        std::size_t length = longest_name - suffix.size() - std::strlen(mark);
        while (length > 0 && (static_cast<unsigned char>(stem[length]) & 0xc0) == 0x80) --length;
        stem = stem.substr(0, length) + mark;
    }
    return file.parent_path() / (stem + suffix);
}

}  // namespace render
