#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "fingerprint.hpp"
#include "io/descriptor.hpp"
#include "render_loop.hpp"

namespace render {

/// What a tile has come to.
struct FinishedTile {
    std::uint32_t tile = 0;  ///< index in the order in which the picture's tiles are listed
    RenderStatistics statistics;
    std::vector<float> values;  ///< of its pixels row by row: R, G, B, and the picture's further channels
};

/// The finished tiles of a picture, in a file beside it from which a later run can go on. It begins with the
/// fingerprint of the picture; each tile has a checksum; it grows while the picture is rendered and is locked for so
/// long. A file that something else has written is never touched.
class ResumeFile {
public:
    /// Takes a warning in one line.
    using Warn = std::function<void(const std::string&)>;

    /// Opens what is at `path`. Later problems of writing go to `warn`, once.
    ResumeFile(std::filesystem::path path, Warn warn);
    /// Keeps the file if it holds tiles.
    ~ResumeFile();
    ResumeFile(const ResumeFile&) = delete;
    ResumeFile& operator=(const ResumeFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// True iff this program left tiles there.
    bool is_there() const { return is_there_; }
    /// Why the file can be neither continued nor replaced; empty if it can.
    const std::string& obstacle() const { return obstacle_; }

    /// Goes on with the file. throws: invalid_input if it is damaged, or of another picture than that of `now`.
    /// pre: is_there()
    void go_on(const Fingerprint& now);

    /// Replaces it by an empty one, or creates that.
    void begin(const Fingerprint& now);

    /// Calls `visit` for each tile that is in the file; one that is cut off at its end is dropped. `value_counts`: the
    /// number of values of each tile of the picture. throws: invalid_input if the file is damaged.
    /// pre: `go_on` or `begin` has been called.
    void read(std::span<const std::size_t> value_counts, const std::function<void(const FinishedTile&)>& visit);

    /// Writes soon. threads: may be called by all.
    void append(const FinishedTile& tile);

    /// Writes what is not yet written.
    void flush();

    /// True iff there are tiles in it that a later run can use.
    bool is_of_use() const { return open_ && end_ > begin_; }

    /// Does `action` with the room on the disk that the tiles take. They are put back if it throws.
    void lend_room(const std::function<void()>& action);

    /// Deletes the file: the picture is complete.
    void remove();

private:
    using Clock = std::chrono::steady_clock;

    void look();
    void write_pending();
    void fail(int error);
    [[noreturn]] void refuse(const std::string& problem) const;

    std::filesystem::path path_;
    Warn warn_;
    Descriptor file_;
    bool is_there_ = false;
    std::string obstacle_;
    std::string header_problem_;
    Fingerprint stored_;
    std::size_t begin_ = 0;  ///< of the first tile in the file
    std::size_t end_ = 0;    ///< of the last
    bool ready_ = false;     ///< it is the picture's own
    bool open_ = false;      ///< tiles are appended
    bool warned_ = false;
    std::mutex appending_;
    std::vector<char> pending_;
    Clock::time_point written_{};
    Clock::duration interval_{};
};

}  // namespace render
