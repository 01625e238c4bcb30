#include "chunk_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lightcuts/core/invalid_input.hpp>
#include <render/io/content_hash.hpp>

namespace daylighting {
namespace {

constexpr std::string_view magic = "lightcuts-daylight: finished sensors, format 1\n";

struct Header {
    char magic[daylighting::magic.size()];
    char padding[8 - daylighting::magic.size() % 8];
    std::uint64_t fingerprint;
    std::uint64_t check;  ///< of the fingerprint
};
static_assert(sizeof(Header) % 8 == 0);

struct RecordHeader {
    std::uint32_t index, size;
    std::uint64_t check;  ///< of both and of the bytes, which follow
};

std::uint64_t check_of(std::uint32_t index, std::span<const std::byte> bytes) {
    return render::ContentHash().add(index).add_bytes(bytes.data(), bytes.size()).value();
}

std::span<const char> chars(const void* data, std::size_t size) { return {static_cast<const char*>(data), size}; }

}  // namespace

ChunkFile::ChunkFile(std::filesystem::path path, std::uint64_t fingerprint, std::uint32_t count, bool resume,
                     const Visit& visit)
    : path_(std::move(path)) {
    file_ = render::Descriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
    if (!file_) refuse(std::string("cannot be opened (") + std::strerror(errno) + ")");
    struct stat status {};
    if (::fstat(file_.number(), &status) != 0 || !S_ISREG(status.st_mode)) refuse("is not a regular file");
    if (file_.lock() == render::Descriptor::Lock::busy) refuse("is in use by another run");
    Header usual{};
    std::memcpy(usual.magic, magic.data(), magic.size());
    usual.fingerprint = fingerprint;
    usual.check = render::ContentHash().add(fingerprint).value();
    Header header{};
    std::vector<char> start(sizeof header);
    const std::ptrdiff_t length = file_.read_at(0, start);
    std::memcpy(&header, start.data(), start.size());
    const auto compared = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(length, 0)), magic.size());
    if (std::memcmp(header.magic, usual.magic, compared) != 0) {
        refuse("is not a file of finished sensors; move it away");
    }
    const bool is_whole = length == static_cast<std::ptrdiff_t>(sizeof header) &&
                          header.check == render::ContentHash().add(header.fingerprint).value();
    if (resume && is_whole) {
        if (header.fingerprint != fingerprint) {
            refuse("is of another scene, other sensors or options, or another build; leave --resume out to start over");
        }
        read(count, visit);
        return;
    }
    if (::ftruncate(file_.number(), 0) != 0) refuse(std::strerror(errno));
    if (const int error = render::write_all(file_.number(), chars(&usual, sizeof usual))) {
        refuse(std::string("cannot be written (") + std::strerror(error) + ")");
    }
}

void ChunkFile::read(std::uint32_t count, const Visit& visit) {
    std::size_t end = sizeof(Header);
    for (;;) {
        std::vector<char> start(sizeof(RecordHeader));
        if (file_.read_at(end, start) != static_cast<std::ptrdiff_t>(start.size())) break;
        RecordHeader header{};
        std::memcpy(&header, start.data(), sizeof header);
        if (header.index >= count) break;
        std::vector<char> content(header.size);
        if (file_.read_at(end + sizeof header, content) != static_cast<std::ptrdiff_t>(content.size())) break;
        std::vector<std::byte> bytes(content.size());
        if (!content.empty()) std::memcpy(bytes.data(), content.data(), content.size());
        if (check_of(header.index, bytes) != header.check) break;
        visit(header.index, std::move(bytes));
        end += sizeof header + content.size();
    }
    const auto length = static_cast<off_t>(end);
    if (::ftruncate(file_.number(), length) != 0 || ::lseek(file_.number(), length, SEEK_SET) < 0) {
        refuse(std::strerror(errno));
    }
}

void ChunkFile::append(std::uint32_t index, std::span<const std::byte> bytes) {
    const RecordHeader header{index, static_cast<std::uint32_t>(bytes.size()), check_of(index, bytes)};
    const std::lock_guard lock(writing_);
    int error = render::write_all(file_.number(), chars(&header, sizeof header));
    if (error == 0) error = render::write_all(file_.number(), chars(bytes.data(), bytes.size()));
    if (error != 0) refuse(std::string("cannot be written (") + std::strerror(error) + ")");
}

void ChunkFile::remove() { ::unlink(path_.c_str()); }

void ChunkFile::refuse(const std::string& problem) const {
    throw lightcuts::invalid_input(path_.string() + ": " + problem);
}

}  // namespace daylighting
