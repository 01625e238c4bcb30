#include "io/radiance_pixels.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace render {

namespace {

constexpr std::size_t min_encoded_length = 8;
constexpr std::size_t max_encoded_length = 0x7fff;

/// More pixels than any picture has.
constexpr std::size_t too_much = std::size_t(1) << 40;

class Scanlines {
public:
    Scanlines(std::string_view bytes, std::size_t length) : left_(bytes), length_(length) {}

    /// Appends the next scanline to `pixels`.
    void read(std::vector<Rgbe>& pixels) {
        const Rgbe first = take_pixel();
        const bool can_be_encoded = length_ >= min_encoded_length && length_ <= max_encoded_length;
        if (can_be_encoded && first[0] == 2 && first[1] == 2 && first[2] < 128) {
            const std::size_t stated = std::size_t(256) * first[2] + first[3];
            if (stated != length_) {
                throw std::runtime_error("is " + std::to_string(stated) + " pixels long instead of " +
                                         std::to_string(length_));
            }
            read_channels(pixels);
        } else {
            read_pixels(first, pixels);
        }
    }

private:
    std::uint8_t take() {
        if (left_.empty()) throw std::runtime_error("is cut short");
        const char byte = left_.front();
        left_.remove_prefix(1);
        return static_cast<std::uint8_t>(byte);
    }
    Rgbe take_pixel() { return {take(), take(), take(), take()}; }

    void read_channels(std::vector<Rgbe>& pixels) {
        const std::size_t begin = pixels.size();
        pixels.resize(begin + length_);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            for (std::size_t i = 0; i < length_;) {
                const std::size_t code = take();
                const bool is_run = code > 128;
                const std::size_t count = is_run ? code - 128 : code;
                require_room(count, length_ - i);
                const std::uint8_t repeated = is_run ? take() : std::uint8_t(0);
                for (const std::size_t end = i + count; i < end; ++i) {
                    pixels[begin + i][channel] = is_run ? repeated : take();
                }
            }
        }
    }

    void read_pixels(const Rgbe& first, std::vector<Rgbe>& pixels) {
        pixels.push_back(first);
        std::size_t weight = 1;  // of the next repeat count
        for (std::size_t left = length_ - 1; left > 0;) {
            const Rgbe pixel = take_pixel();
            const bool is_run = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
            const std::size_t count = is_run ? pixel[3] * weight : 1;
            require_room(count, left);
            pixels.insert(pixels.end(), count, is_run ? Rgbe(pixels.back()) : pixel);
            left -= count;
            weight = is_run ? std::min(256 * weight, too_much) : 1;
        }
    }

    static void require_room(std::size_t count, std::size_t left) {
        if (count > left) {
            throw std::runtime_error("has a run of " + std::to_string(count) + " pixels where " + std::to_string(left) +
                                     " are left: it is damaged");
        }
    }

    std::string_view left_;
    std::size_t length_;
};

std::vector<Rgbe> unpacked(std::string_view bytes, std::size_t length, std::size_t count) {
    Scanlines scanlines(bytes, length);
    std::vector<Rgbe> pixels;
    // No more than the bytes can hold, runs of 1, 1, 1, n aside.
    pixels.reserve(std::min(length * count, 16 * bytes.size()));
    for (std::size_t i = 0; i < count; ++i) {
        try {
            scanlines.read(pixels);
        } catch (const std::runtime_error& problem) {
            throw std::runtime_error("scanline " + std::to_string(i + 1) + " of " + std::to_string(count) + " " +
                                     problem.what());
        }
    }
    return pixels;
}

}  // namespace

std::vector<Rgbe> radiance_pixels(std::string_view bytes, std::size_t length, std::size_t scanlines) {
    try {
        return unpacked(bytes, length, scanlines);
    } catch (const std::runtime_error&) {
        if (bytes.size() != sizeof(Rgbe) * length * scanlines) throw;
        std::vector<Rgbe> pixels(length * scanlines);
        std::memcpy(pixels.data(), bytes.data(), bytes.size());
        return pixels;
    }
}

}  // namespace render
