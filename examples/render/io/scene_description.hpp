#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/file_source.hpp"
#include "scene.hpp"

namespace render {

/// A camera with the size of the picture that it is meant for.
struct DescribedCamera {
    Camera camera;  ///< named by its place in the list: "0", "1"
    int width = 0;
    int height = 0;
};

/// What a `scene.json` beside a scene file says: which file it is about, and from where to look at it.
struct SceneDescription {
    std::string file;
    std::vector<DescribedCamera> cameras;
};

/// Reads a description: an object with `file` and `cameras` (each with `eye`, `target`, `up`, `vfov_deg`,
/// `resolution`). `up_axis`, if given, is "+Y". What people may note besides is not looked at: `name`, `title`,
/// `author`, `license`, `source`, `units`, `triangles`, `vertices`, `materials`, `textures`, `bytes`, `bbox`,
/// `lighting`, `punctual_lights`, `emissive`, `missing`, `notes`. throws: invalid_input for anything else, naming file
/// and place.
SceneDescription read_scene_description(const std::filesystem::path& path, const FileSource& files = DiskFiles());

/// The description beside a scene file, if there is one that is about this file. throws: as `read_scene_description`.
std::optional<SceneDescription> description_beside(const std::filesystem::path& scene_file);

}  // namespace render
