#include "saved_picture.hpp"

#include <system_error>

#include <render/io/file_group.hpp>

#include "frame_path.hpp"

namespace relight {

std::filesystem::path save_picture(const std::filesystem::path& whole, const ShownFrame& frame) {
    std::filesystem::path path, png;
    std::error_code ignored;
    int number = 0;
    do {
        path = frame_path(whole, number++);
        png = render::beside(path, ".png");
    } while (std::filesystem::exists(path, ignored) || std::filesystem::exists(png, ignored));
    render::FileGroup files;
    files.add(path, [&] { return render::exr_bytes(*frame.picture); });
    files.add(png, [&] { return render::png_bytes(frame.picture->width, frame.picture->height, frame.bytes); });
    files.commit();
    return path;
}

}  // namespace relight
