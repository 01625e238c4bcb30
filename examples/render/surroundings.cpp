#include "surroundings.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <stb_image.h>
#include <lightcuts/core/invalid_input.hpp>

#include "text_file.hpp"

namespace render {

namespace {

using lightcuts::invalid_input;

constexpr std::size_t sun_disc_lights = 64;
constexpr std::uint32_t sky_rows = 256;

/// Bytes of a file, which remember whether more were wanted than there are: stb_image reads zeros then.
struct Bytes {
    std::string_view left;
    bool ran_out = false;

    static int read(void* self, char* to, int wanted) {
        Bytes& bytes = *static_cast<Bytes*>(self);
        const std::size_t count = std::min(bytes.left.size(), static_cast<std::size_t>(wanted));
        bytes.ran_out = bytes.ran_out || bytes.left.empty();
        std::memcpy(to, bytes.left.data(), count);
        bytes.left.remove_prefix(count);
        return static_cast<int>(count);
    }
    static void skip(void* self, int count) {
        Bytes& bytes = *static_cast<Bytes*>(self);
        bytes.left.remove_prefix(std::min(bytes.left.size(), static_cast<std::size_t>(std::max(count, 0))));
    }
    static int is_at_end(void* self) { return static_cast<Bytes*>(self)->left.empty() ? 1 : 0; }
};

Picture read_map(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".hdr") return read_hdr(path);
    if (extension == ".exr") return read_exr(path);
    throw invalid_input(path.string() + ": not a kind of map that can be read; give an .exr or .hdr file");
}

}  // namespace

Picture read_hdr(const std::filesystem::path& path) {
    const std::string file = read_file(path);
    const auto fail = [&](const std::string& problem) {
        throw invalid_input(path.string() + ": not a Radiance picture that can be read (" + problem +
                            "); save it again as .hdr or .exr");
    };
    if (!file.starts_with("#?RADIANCE\n") && !file.starts_with("#?RGBE\n")) fail("it begins like none");
    Bytes bytes{file};
    const stbi_io_callbacks callbacks{&Bytes::read, &Bytes::skip, &Bytes::is_at_end};
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, void (*)(void*)> pixels(
        stbi_loadf_from_callbacks(&callbacks, &bytes, &width, &height, &channels, 3), stbi_image_free);
    if (!pixels) fail(stbi_failure_reason());
    if (bytes.ran_out) fail("it is cut short");
    Picture picture(width, height);
    std::memcpy(picture.pixels.data(), pixels.get(), picture.size() * sizeof(glm::vec3));
    return picture;
}

void add_environment(Scene& scene, const EnvironmentOptions& options) {
    Environment environment{read_map(options.file), options.scale, options.rotation};
    environment.picture.channels.clear();
    try {
        const auto lights = lightcuts::environment_lights(environment.map(), options.lights,
                                                          lightcuts::CentredNumbers{options.seed});
        scene.directional.insert(scene.directional.end(), lights.begin(), lights.end());
        scene.environment_lights += lights.size();
    } catch (const invalid_input& problem) {
        throw invalid_input(options.file.string() + ": " + problem.what() + "; correct it or give another map");
    }
    scene.background.environment = std::move(environment);
}

void add_daylight(Scene& scene, const lightcuts::SunPosition& sun, std::size_t sky_lights, std::uint64_t seed) {
    const lightcuts::SunSky daylight(sun);
    const auto of_sun = lightcuts::sun_lights(daylight, sun_disc_lights, lightcuts::LowDiscrepancy{seed});
    const auto of_sky = lightcuts::sky_lights(daylight, sky_lights, sky_rows, lightcuts::CentredNumbers{seed});
    scene.directional.insert(scene.directional.end(), of_sun.begin(), of_sun.end());
    scene.directional.insert(scene.directional.end(), of_sky.begin(), of_sky.end());
    scene.sun_lights += of_sun.size();
    scene.sky_lights += of_sky.size();
    scene.background.daylight = daylight;
}

}  // namespace render
