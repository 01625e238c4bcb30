#include "frame_path.hpp"

#include <cstdio>
#include <string>

#include <render/io/output_file.hpp>

namespace relight {

std::filesystem::path frame_path(const std::filesystem::path& whole, int number) {
    char suffix[16];
    std::snprintf(suffix, sizeof suffix, "-%04d", number);
    const std::string extension = whole.extension().string();
    return render::beside(whole, suffix + (extension.empty() ? ".exr" : extension));
}

}  // namespace relight
