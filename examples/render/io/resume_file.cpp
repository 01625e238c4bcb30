#include "io/resume_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lightcuts/core/invalid_input.hpp>

#include "io/content_hash.hpp"
#include "io/temporary_file.hpp"

namespace render {

namespace {

/// What a file begins with; the number counts the formats.
constexpr std::string_view magic = "lightcuts-render: finished tiles, format 1\n";
constexpr std::string_view magic_of_any_format = magic.substr(0, magic.size() - 2);

/// After `magic`; then the fingerprint's text.
struct Header {
    std::uint64_t byte_order = 0x0102030405060708u;
    std::uint64_t statistics_bytes = sizeof(RenderStatistics);
    std::uint64_t fingerprint_bytes = 0;
    std::uint64_t check = 0;  ///< of the fingerprint

    bool is_usual() const {
        const Header usual;
        return byte_order == usual.byte_order && statistics_bytes == usual.statistics_bytes &&
               fingerprint_bytes < (1u << 20);
    }
};

/// Before a tile's statistics and values, which a checksum follows.
struct TileHeader {
    std::uint32_t tile = 0;
    std::uint32_t values = 0;
    std::uint64_t check = 0;  ///< of the two

    std::uint64_t right_check() const { return ContentHash().add(tile).add(values).value(); }
    std::size_t content_bytes() const { return sizeof(RenderStatistics) + std::size_t{values} * sizeof(float); }
};

static_assert(std::is_trivially_copyable_v<RenderStatistics>);

template <class T>
void append_bytes(std::vector<char>& to, const T* data, std::size_t count) {
    const auto* bytes = reinterpret_cast<const char*>(data);
    to.insert(to.end(), bytes, bytes + count * sizeof(T));
}

template <class T>
T object_at(const std::vector<char>& bytes, std::size_t offset) {
    T object;
    std::memcpy(&object, bytes.data() + offset, sizeof object);
    return object;
}

std::vector<char> header_bytes(const Fingerprint& print) {
    const std::string text = print.text();
    Header header;
    header.fingerprint_bytes = text.size();
    header.check = ContentHash().add(text).value();
    std::vector<char> bytes(magic.begin(), magic.end());
    append_bytes(bytes, &header, 1);
    append_bytes(bytes, text.data(), text.size());
    return bytes;
}

/// Tiles are written so often, so that a program that is killed loses little, and so rarely that they take no more than
/// a hundredth of the time.
constexpr auto shortest_interval = std::chrono::milliseconds(20);
constexpr int rest_per_write = 100;

}  // namespace

ResumeFile::ResumeFile(std::filesystem::path path, Warn warn) : path_(std::move(path)), warn_(std::move(warn)) {
    look();
}

ResumeFile::~ResumeFile() {
    flush();
    if (open_ && end_ == begin_) remove();
}

void ResumeFile::look() {
    file_ = Descriptor(::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!file_) {
        if (errno != ENOENT) obstacle_ = std::string("cannot be opened (") + std::strerror(errno) + ")";
        return;
    }
    if (file_.lock() == Descriptor::Lock::busy) {
        obstacle_ = "is in use by another run";
        return;
    }
    std::vector<char> start(magic.size() + sizeof(Header));
    const std::ptrdiff_t length = file_.read_at(0, start);
    start.resize(length < 0 ? 0 : static_cast<std::size_t>(length));
    if (length == 0) return;
    const std::string_view text(start.data(), std::min(start.size(), magic.size()));
    if (!text.starts_with(magic_of_any_format)) {
        obstacle_ = "is not a file of finished tiles";
        return;
    }
    is_there_ = true;
    if (text != magic) {
        header_problem_ = "is of another version of this program";
        return;
    }
    header_problem_ = "is damaged at its beginning";
    if (start.size() < magic.size() + sizeof(Header)) return;
    const auto header = object_at<Header>(start, magic.size());
    if (!header.is_usual()) header_problem_ = "is damaged, or of another version of this program";
    if (!header.is_usual()) return;
    std::string print(header.fingerprint_bytes, '\0');
    const bool whole = file_.read_at(start.size(), print) == static_cast<std::ptrdiff_t>(print.size());
    if (!whole || ContentHash().add(print).value() != header.check) return;
    header_problem_.clear();
    stored_ = Fingerprint::parse(print);
    begin_ = start.size() + print.size();
}

void ResumeFile::refuse(const std::string& problem) const {
    throw lightcuts::invalid_input(path_.string() + ": " + problem + "; leave --resume out to start over");
}

void ResumeFile::go_on(const Fingerprint& now) {
    if (!header_problem_.empty()) refuse(header_problem_);
    const std::string difference = stored_.difference(now);
    if (!difference.empty()) refuse("is of another picture, by " + difference);
    ready_ = true;
}

void ResumeFile::begin(const Fingerprint& now) {
    if (!obstacle_.empty()) return;
    try {
        TemporaryFile file(path_.parent_path());
        const std::vector<char> bytes = header_bytes(now);
        if (const int error = write_all(file.number(), bytes)) {
            throw std::system_error(error, std::generic_category());
        }
        file_ = file.rename_to(path_);
        begin_ = end_ = bytes.size();
        ready_ = open_ = true;
    } catch (const std::system_error& e) {
        file_.close();
        fail(e.code().value());
    }
}

void ResumeFile::read(std::span<const std::size_t> value_counts,
                      const std::function<void(const FinishedTile&)>& visit) {
    if (!ready_) return;
    std::vector<bool> seen(value_counts.size(), false);
    std::vector<char> bytes;
    FinishedTile tile;
    end_ = begin_;
    const auto read_next = [&](std::size_t offset, std::size_t size) {
        bytes.resize(size);
        const std::ptrdiff_t length = file_.read_at(offset, bytes);
        if (length < 0) refuse(std::string("cannot be read (") + std::strerror(errno) + ")");
        return length == static_cast<std::ptrdiff_t>(size);
    };
    const auto require = [&](bool good) {
        if (!good) refuse("is damaged at byte " + std::to_string(end_));
    };
    while (read_next(end_, sizeof(TileHeader))) {
        const auto header = object_at<TileHeader>(bytes, 0);
        require(header.check == header.right_check() && header.tile < value_counts.size() &&
                header.values == value_counts[header.tile] && !seen[header.tile]);
        const std::size_t content = header.content_bytes();
        if (!read_next(end_ + sizeof header, content + sizeof(std::uint64_t))) break;
        require(object_at<std::uint64_t>(bytes, content) == ContentHash().add_bytes(bytes.data(), content).value());
        tile.tile = header.tile;
        tile.statistics = object_at<RenderStatistics>(bytes, 0);
        tile.values.resize(header.values);
        std::memcpy(tile.values.data(), bytes.data() + sizeof tile.statistics, header.values * sizeof(float));
        seen[header.tile] = true;
        visit(tile);
        end_ += sizeof header + bytes.size();
    }
    const auto end = static_cast<off_t>(end_);
    if (::ftruncate(file_.number(), end) != 0 || ::lseek(file_.number(), end, SEEK_SET) < 0) return fail(errno);
    open_ = true;
}

void ResumeFile::append(const FinishedTile& tile) {
    const std::lock_guard lock(appending_);
    if (!open_) return;
    const std::size_t before = pending_.size();
    try {
        TileHeader header{tile.tile, static_cast<std::uint32_t>(tile.values.size())};
        header.check = header.right_check();
        append_bytes(pending_, &header, 1);
        append_bytes(pending_, &tile.statistics, 1);
        append_bytes(pending_, tile.values.data(), tile.values.size());
        const std::size_t content = header.content_bytes();
        const std::uint64_t check =
            ContentHash().add_bytes(pending_.data() + pending_.size() - content, content).value();
        append_bytes(pending_, &check, 1);
    } catch (const std::bad_alloc&) { pending_.resize(before); }
    if (Clock::now() - written_ >= interval_) write_pending();
}

void ResumeFile::flush() {
    const std::lock_guard lock(appending_);
    if (open_) write_pending();
}

void ResumeFile::write_pending() {
    const Clock::time_point start = Clock::now();
    if (const int error = write_all(file_.number(), pending_)) {
        // Later tiles may find room; these are rendered once more by who goes on.
        const auto end = static_cast<off_t>(end_);
        if (::ftruncate(file_.number(), end) != 0 || ::lseek(file_.number(), end, SEEK_SET) < 0) open_ = false;
        fail(error);
    } else {
        end_ += pending_.size();
    }
    pending_.clear();
    written_ = Clock::now();
    interval_ = std::max<Clock::duration>(shortest_interval, rest_per_write * (written_ - start));
}

void ResumeFile::fail(int error) {
    if (std::exchange(warned_, true)) return;
    warn_(path_.string() + ": cannot be written (" + std::strerror(error) +
          "); rendering goes on, and --resume would find less than is finished");
}

void ResumeFile::lend_room(const std::function<void()>& action) {
    const std::lock_guard lock(appending_);
    std::vector<char> bytes(open_ ? end_ : 0);
    const bool taken = !bytes.empty() && file_.read_at(0, bytes) == static_cast<std::ptrdiff_t>(bytes.size()) &&
                       ::ftruncate(file_.number(), 0) == 0;
    try {
        action();
    } catch (...) {
        if (taken && ::lseek(file_.number(), 0, SEEK_SET) == 0) {
            if (const int error = write_all(file_.number(), bytes)) fail(error);
        }
        throw;
    }
}

void ResumeFile::remove() {
    const std::lock_guard lock(appending_);
    if (open_ && file_.is_at(path_)) ::unlink(path_.c_str());
    open_ = false;
}

}  // namespace render
