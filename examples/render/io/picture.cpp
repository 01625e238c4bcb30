#include "io/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <utility>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include "io/exr_picture.hpp"
#include "io/output_file.hpp"
#include "io/text_file.hpp"
#include "luminance.hpp"

namespace render {

namespace {

using lightcuts::invalid_input;

constexpr const char* color_names[3] = {"R", "G", "B"};

/// A plane of floats as OpenEXR addresses it. Its interface takes a pointer to non-const for reading and writing.
Imf::Slice slice(const float* first, int width, std::size_t stride) {
    auto* base = const_cast<char*>(reinterpret_cast<const char*>(first));
    return {Imf::FLOAT, base, stride, stride * static_cast<std::size_t>(width)};
}

/// What OpenEXR writes, in memory: there nothing goes wrong unseen when a file is closed.
class ByteStream final : public Imf::OStream {
public:
    ByteStream() : Imf::OStream("memory") {}

    void write(const char bytes[], int count) override {
        const std::size_t end = position_ + static_cast<std::size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::copy(bytes, bytes + count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::vector<char> take() { return std::move(bytes_); }

private:
    std::vector<char> bytes_;
    std::size_t position_ = 0;
};

float srgb_from_linear(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f; }

void append_bytes(void* context, void* data, int size) {
    const auto* bytes = static_cast<const char*>(data);
    static_cast<std::vector<char>*>(context)->insert(static_cast<std::vector<char>*>(context)->end(), bytes,
                                                     bytes + size);
}

}  // namespace

Picture::Picture(int w, int h)
    : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), glm::vec3(0.0f)) {}

void Picture::add_channel(const std::string& name) { channels.push_back({name, std::vector<float>(size(), 0.0f)}); }

const Picture::Channel* Picture::find(const std::string& name) const {
    const auto at = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
    return at == channels.end() ? nullptr : &*at;
}

Picture::Channel* Picture::find(const std::string& name) {
    return const_cast<Channel*>(static_cast<const Picture*>(this)->find(name));
}

std::vector<char> exr_bytes(const Picture& picture) {
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (int c = 0; c < 3; ++c) {
        header.channels().insert(color_names[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(color_names[c], slice(&picture.pixels[0][c], picture.width, sizeof(glm::vec3)));
    }
    for (const Picture::Channel& channel : picture.channels) {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        buffer.insert(channel.name, slice(channel.values.data(), picture.width, sizeof(float)));
    }
    ByteStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(picture.height);
        // The table of the lines' places, at the front, is written when the file goes away.
    }
    return stream.take();
}

void write_exr(const std::filesystem::path& path, const Picture& picture) { write_file(path, exr_bytes(picture)); }

Picture read_exr(const std::filesystem::path& path) {
    return exr_picture(read_file(path), path.string(), ExrUse::picture);
}

std::vector<std::uint8_t> srgb_bytes(std::span<const glm::vec3> colors) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * colors.size());
    for (const glm::vec3& color : colors) {
        for (int c = 0; c < 3; ++c) {
            const float encoded = srgb_from_linear(glm::clamp(color[c], 0.0f, 1.0f));
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * encoded)));
        }
    }
    return bytes;
}

std::vector<char> png_bytes(int width, int height, std::span<const std::uint8_t> bytes) {
    std::vector<char> encoded;
    if (stbi_write_png_to_func(append_bytes, &encoded, width, height, 3, bytes.data(), 3 * width) == 0) {
        throw std::bad_alloc();
    }
    return encoded;
}

std::vector<char> png_bytes(int width, int height, const std::vector<glm::vec3>& colors) {
    return png_bytes(width, height, srgb_bytes(colors));
}

void write_png(const std::filesystem::path& path, int width, int height, const std::vector<glm::vec3>& colors) {
    write_file(path, png_bytes(width, height, colors));
}

ToneCurve tone_curve(const Picture& picture) {
    std::vector<float> lit;
    for (const glm::vec3& pixel : picture.pixels) {
        const float l = luminance(pixel);
        if (l > 0.0f && std::isfinite(l)) lit.push_back(l);
    }
    if (lit.empty()) return {};

    std::sort(lit.begin(), lit.end());
    const auto percentile = [&](double share) {
        return static_cast<double>(lit[static_cast<std::size_t>(share * static_cast<double>(lit.size() - 1))]);
    };
    // What looks black is no reason to expose the rest for longer. Lamps in view, which may be millions of times as
    // bright as what they light, rarely fill a fifth of a picture, and so leave this measure alone.
    const double visible = 1e-3 * percentile(0.8);
    double log_sum = 0;
    const auto first = std::find_if(lit.begin(), lit.end(), [&](float l) { return static_cast<double>(l) >= visible; });
    for (auto l = first; l != lit.end(); ++l) log_sum += std::log(static_cast<double>(*l));
    const double exposure = 0.18 / std::exp(log_sum / static_cast<double>(lit.end() - first));
    return {exposure, std::max(1.0, percentile(0.995) * exposure)};
}

std::vector<glm::vec3> tone_mapped(const Picture& picture, const ToneCurve& curve) {
    std::vector<glm::vec3> colors;
    colors.reserve(picture.size());
    for (const glm::vec3& pixel : picture.pixels) {
        glm::vec3 color(0.0f);
        for (int c = 0; c < 3; ++c) {
            const double v = static_cast<double>(pixel[c]) * curve.exposure;
            if (!(v > 0.0)) continue;
            const double compressed = v * (1.0 + v / (curve.white * curve.white)) / (1.0 + v);
            color[c] = static_cast<float>(std::isfinite(v) ? std::min(1.0, compressed) : 1.0);
        }
        colors.push_back(color);
    }
    return colors;
}

std::vector<glm::vec3> tone_mapped(const Picture& picture) { return tone_mapped(picture, tone_curve(picture)); }

}  // namespace render
