#pragma once

#include <filesystem>
#include <vector>

#include "io/picture.hpp"
#include "statistics.hpp"

namespace render {

/// The names of what a run leaves: the picture, beside it a tone-mapped one and the report, and while it is rendered
/// the finished tiles.
struct Outputs {
    std::filesystem::path exr;
    std::filesystem::path png;
    std::filesystem::path json;
    std::filesystem::path resume;

    explicit Outputs(const std::filesystem::path& picture);

    /// Where a picture goes that is not finished: under these names, unless they hold one that is.
    Outputs of_unfinished() const;

    /// throws: invalid_input unless the first three can be written.
    void require_all_writable() const;

    /// throws: invalid_input if one of the files that may be written, also of an unfinished picture, is one of
    /// `inputs`, whatever links lead there.
    void require_no_input(const std::vector<std::filesystem::path>& inputs) const;

private:
    Outputs of_part() const;
};

/// Writes the picture, the tone-mapped one and the report. throws: invalid_input naming what could not be written and
/// what was; without the picture itself nothing is.
void save(const Outputs& outputs, const Picture& picture, const RunReport& report);

}  // namespace render
