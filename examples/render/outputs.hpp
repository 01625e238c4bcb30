#pragma once

#include <filesystem>

#include "picture.hpp"
#include "statistics.hpp"

namespace render {

/// The names of what a run leaves: the picture, and beside it a tone-mapped one and the report.
struct Outputs {
    std::filesystem::path exr;
    std::filesystem::path png;
    std::filesystem::path json;

    explicit Outputs(const std::filesystem::path& picture);

    /// throws: invalid_input unless all can be written.
    void require_all_writable() const;
};

/// Writes the picture, the tone-mapped one and the report. throws: invalid_input naming what could not be written and
/// what was; without the picture itself nothing is.
void save(const Outputs& outputs, const Picture& picture, const RunReport& report);

}  // namespace render
