#include "saved_picture.hpp"

#include <system_error>

#include <render/io/file_group.hpp>

#include "frame_path.hpp"

namespace relight {

SavedPaths free_paths(const std::filesystem::path& whole) {
    SavedPaths paths;
    std::error_code ignored;
    int number = 0;
    do {
        paths.exr = frame_path(whole, number++);
        paths.png = render::beside(paths.exr, ".png");
    } while (std::filesystem::exists(paths.exr, ignored) || std::filesystem::exists(paths.png, ignored));
    return paths;
}

std::filesystem::path save_picture(const std::filesystem::path& whole, const ShownFrame& frame) {
    const SavedPaths paths = free_paths(whole);
    render::FileGroup files;
    files.add(paths.exr, [&] { return render::exr_bytes(*frame.picture); });
    files.add(paths.png, [&] { return render::png_bytes(frame.picture->width, frame.picture->height, frame.bytes); });
    files.commit();
    return paths.exr;
}

}  // namespace relight
