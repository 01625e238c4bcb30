#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "options.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"

namespace render {

/// Everything that a picture depends on, each with its name, so that it can be told what is different in another.
class Fingerprint {
public:
    /// `value`: as text; of what has no short one, a hash that begins with `#`.
    void add(const std::string& name, const std::string& value) { items_.emplace_back(name, value); }

    std::string text() const;

    /// What `text` gave. Of anything else, items that equal no picture's.
    static Fingerprint parse(const std::string& text);

    /// What differs in `now`, in words; empty if nothing does.
    std::string difference(const Fingerprint& now) const;

private:
    std::vector<std::pair<std::string, std::string>> items_;
};

/// Of the picture that `options` ask for of `camera` in the prepared `scene`, by this program, `program`, on this
/// machine. Not in it: where it goes, the number of threads, and how the scene's files are called.
Fingerprint fingerprint_of(const Options& options, const Scene& scene, const Camera& camera, const RayScene& rays,
                           const std::string& program);

/// A hash of all in a scene that shadow rays depend on, by which what was made of them is told from what others would
/// make: its triangles and, where some let light pass, what their materials are. Not in it: the materials of the
/// others.
std::uint64_t occlusion_hash(const Scene& scene);

}  // namespace render
