#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lightcuts/piecewise/cut_file.hpp>
#include <lightcuts/piecewise/mapped_file.hpp>
#include <render/scene.hpp>

#include "directions.hpp"
#include "patches.hpp"
#include "site_sky.hpp"

namespace relight {

/// What cuts in a file are good for.
struct Preparation {
    std::string scene;              ///< its name, for messages
    std::uint64_t fingerprint = 0;  ///< render::occlusion_hash of the mesh as it was loaded
    double longest_edge = 0.0;      ///< to which the mesh was refined; 0: as it is
    Sides sides = Sides::both;
    std::size_t sites = 0;
};

/// What is stored of light that surfaces reflect: cuts over patches.
struct StoredBounce {
    const Patches& patches;
    std::span<const std::byte> cuts;
};

/// The bytes of a file: a line of JSON, a tree file, a cut file; and a tree file and a cut file of the bounce, if there
/// is one. Without it the file is of version 1, which programs that know no bounce read.
std::vector<char> relight_file(const Preparation& preparation, const Directions& directions,
                               std::span<const std::byte> cuts, const StoredBounce* bounce = nullptr);

/// Visibility cuts and their tree, and those of a bounce, in a mapped file.
class RelightFile {
public:
    /// throws: invalid_input, one line naming the file, if it cannot be read, is of another kind, cut short or damaged.
    explicit RelightFile(const std::filesystem::path& path);
    RelightFile(const RelightFile&) = delete;
    RelightFile& operator=(const RelightFile&) = delete;

    const Preparation& preparation() const { return preparation_; }
    const Directions& directions() const { return directions_; }
    /// None if the file has no bounce.
    const Patches& patches() const { return patches_; }
    std::size_t bytes() const { return file_.bytes().size(); }

    /// throws: invalid_input unless the file is of `scene`, as it was loaded.
    void require_scene(const render::Scene& scene) const;

    /// throws: invalid_input naming the file if the cut is damaged. threads: any at once.
    void read(std::size_t site, lightcuts::PiecewiseConstant<float>& cut) const;

    /// Solid angles of visible patches, per patch. pre: there are patches. throws, threads: as `read`.
    void read_bounce(std::size_t site, lightcuts::PiecewiseConstant<float>& cut) const;

private:
    std::string name_;
    lightcuts::MappedFile file_;
    Preparation preparation_;
    Directions directions_;
    std::optional<lightcuts::CutFile> cuts_;
    Patches patches_;
    std::optional<lightcuts::CutFile> bounce_cuts_;
};

}  // namespace relight
