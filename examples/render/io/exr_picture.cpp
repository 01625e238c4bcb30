#include "io/exr_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include <IexBaseExc.h>
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/exr_header.hpp"
#include "io/exr_stream.hpp"
#include "io/file_kind.hpp"
#include "io/picture_size.hpp"
#include "io/primaries.hpp"

namespace render {

namespace {

using Window = Imath::Box2i;

std::int64_t width_of(const Window& w) { return std::int64_t(w.max.x) - w.min.x + 1; }
std::int64_t height_of(const Window& w) { return std::int64_t(w.max.y) - w.min.y + 1; }

/// A plane of floats, of which the window's upper left corner is `first`. OpenEXR addresses pixels from the origin of
/// coordinates, by arithmetic that may leave the plane on its way.
Imf::Slice plane(float* first, const Window& window, std::size_t stride) {
    return Imf::Slice::Make(Imf::FLOAT, first, window, stride);
}

/// The channels besides color that are wanted and have a value for each pixel.
std::vector<std::string> other_channels(const Imf::ChannelList& channels, const ExrColor& color, ExrUse use) {
    const auto is_color = [&](const std::string& name) {
        if (color.kind == ExrColor::Kind::rgb) return name == "R" || name == "G" || name == "B";
        return name == "Y";
    };
    std::vector<std::string> names;
    if (use == ExrUse::map) return names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        if (is_color(name) || (use == ExrUse::texture && name != "A")) continue;
        if (channel.channel().xSampling == 1 && channel.channel().ySampling == 1) names.push_back(name);
    }
    return names;
}

void check_sizes(const Window& data, const Window& display, std::size_t channels) {
    constexpr std::int64_t max_values = std::int64_t(1) << 30;
    for (const Window& window : {data, display}) {
        check_picture_size(width_of(window), height_of(window));
        if (width_of(window) * height_of(window) * static_cast<std::int64_t>(channels + 3) > max_values) {
            throw std::runtime_error(std::to_string(channels + 3) + " channels of " + std::to_string(width_of(window)) +
                                     " x " + std::to_string(height_of(window)) + " pixels are more than the " +
                                     std::to_string(max_values) + " values that are read");
        }
    }
}

/// Reads color by OpenEXR's own reconstruction of chroma between its samples; halves are all that it has.
void read_luminance_chroma(ExrStream& stream, const Window& window, Picture& picture) {
    stream.seekg(0);
    Imf::RgbaInputFile file(stream);
    std::vector<Imf::Rgba> pixels(picture.size());
    const std::ptrdiff_t origin = window.min.x + std::ptrdiff_t(window.min.y) * picture.width;
    file.setFrameBuffer(pixels.data() - origin, 1, static_cast<std::size_t>(picture.width));
    file.readPixels(window.min.y, window.max.y);
    for (std::size_t i = 0; i < pixels.size(); ++i) picture.pixels[i] = {pixels[i].r, pixels[i].g, pixels[i].b};
}

/// The picture that fills the data window. Leaves `file` unusable where color is luminance and chroma.
Picture read_data(ExrStream& stream, Imf::MultiPartInputFile& file, const ExrColor& color,
                  const std::vector<std::string>& others) {
    const Window window = file.header(color.part).dataWindow();
    Picture picture(static_cast<int>(width_of(window)), static_cast<int>(height_of(window)));
    for (const std::string& channel : others) picture.add_channel(channel);

    Imf::FrameBuffer buffer;
    if (color.kind == ExrColor::Kind::rgb) {
        constexpr const char* names[3] = {"R", "G", "B"};
        for (int c = 0; c < 3; ++c) {
            buffer.insert(names[c], plane(&picture.pixels[0][c], window, sizeof(glm::vec3)));
        }
    } else if (color.kind == ExrColor::Kind::gray) {
        buffer.insert("Y", plane(&picture.pixels[0].x, window, sizeof(glm::vec3)));
    }
    for (Picture::Channel& channel : picture.channels) {
        buffer.insert(channel.name, plane(channel.values.data(), window, sizeof(float)));
    }
    if (buffer.begin() != buffer.end()) {
        Imf::InputPart part(file, color.part);
        part.setFrameBuffer(buffer);
        part.readPixels(window.min.y, window.max.y);
    }
    if (color.kind == ExrColor::Kind::gray) {
        for (glm::vec3& pixel : picture.pixels) pixel = glm::vec3(pixel.x);
    }
    if (color.kind == ExrColor::Kind::luminance_chroma) read_luminance_chroma(stream, window, picture);
    return picture;
}

/// What the display window shows of a picture that fills the data window.
Picture shown(Picture data, const Window& data_window, const Window& display) {
    if (data_window == display || !data_window.intersects(display)) return data;
    Picture picture(static_cast<int>(width_of(display)), static_cast<int>(height_of(display)));
    for (const Picture::Channel& channel : data.channels) picture.add_channel(channel.name);

    const int begin_x = std::max(data_window.min.x, display.min.x);
    const int end_x = std::min(data_window.max.x, display.max.x) + 1;
    const int begin_y = std::max(data_window.min.y, display.min.y);
    const int end_y = std::min(data_window.max.y, display.max.y) + 1;
    for (int y = begin_y; y < end_y; ++y) {
        const auto copy_row = [&](const auto& from, auto& to) {
            const auto begin = from.begin() + std::ptrdiff_t(y - data_window.min.y) * data.width - data_window.min.x;
            std::copy(begin + begin_x, begin + end_x,
                      to.begin() + std::ptrdiff_t(y - display.min.y) * picture.width + (begin_x - display.min.x));
        };
        copy_row(data.pixels, picture.pixels);
        for (std::size_t c = 0; c < data.channels.size(); ++c) {
            copy_row(data.channels[c].values, picture.channels[c].values);
        }
    }
    return picture;
}

void convert_to_rec709(Picture& picture, const Imf::Header& header) {
    if (!Imf::hasChromaticities(header)) return;
    const Imf::Chromaticities& of = Imf::chromaticities(header);
    const auto xy = [](const Imath::V2f& c) { return glm::dvec2(c.x, c.y); };
    const auto conversion = to_rec709({xy(of.red), xy(of.green), xy(of.blue), xy(of.white)});
    if (!conversion) return;
    for (glm::vec3& pixel : picture.pixels) pixel = glm::vec3((*conversion)(pixel));
}

Picture decoded(std::string_view bytes, ExrStream& stream, ExrUse use) {
    check_exr_attributes(bytes);
    Imf::MultiPartInputFile file(stream);
    const ExrColor color = exr_color(file);
    const Imf::Header& header = file.header(color.part);
    if (use == ExrUse::map && Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE) {
        throw std::runtime_error("it is a cube map; convert it to latitude and longitude, as OpenEXR's exrenvmap can");
    }
    if (color.kind == ExrColor::Kind::luminance_chroma && color.part > 0) {
        throw std::runtime_error("luminance and chroma are read in a file's first part only");
    }
    const auto others = other_channels(header.channels(), color, use);
    check_sizes(header.dataWindow(), header.displayWindow(), others.size());
    Picture picture = shown(read_data(stream, file, color, others), header.dataWindow(), header.displayWindow());
    convert_to_rec709(picture, header);
    return picture;
}

/// What OpenEXR says is wrong, without the name of the file before it.
std::string cause_of(const Iex::BaseExc& problem, const std::string& name) {
    const std::string_view text = problem.what();
    const std::string named = '"' + name + "\". ";
    const std::size_t at = text.find(named);
    return excerpt(at == std::string_view::npos ? text : text.substr(at + named.size()), 200);
}

}  // namespace

Picture exr_picture(std::string_view bytes, const std::string& name, ExrUse use) {
    const auto fail = [&](const std::string& problem) {
        throw lightcuts::invalid_input(name + ": cannot be read as an OpenEXR picture (" + problem + ")");
    };
    if (!begins_as_openexr(bytes)) fail(what_it_is(bytes, "it does not begin like one"));
    ExrStream stream(bytes, name);
    try {
        return decoded(bytes, stream, use);
    } catch (const Iex::BaseExc& problem) {
        fail(stream.ran_out() ? "it is cut short or damaged: it ends where pixels should be" : cause_of(problem, name));
    } catch (const std::runtime_error& problem) { fail(problem.what()); }
    return {};
}

}  // namespace render
