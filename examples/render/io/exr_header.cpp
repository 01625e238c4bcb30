#include "io/exr_header.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfVersion.h>

#include "io/escape.hpp"

namespace render {

namespace {

/// The bytes of a header, taken one after the other.
class Bytes {
public:
    explicit Bytes(std::string_view left) : left_(left) {}

    void skip(std::size_t count) {
        if (count > left_.size()) throw std::runtime_error("it is cut short in its header");
        left_.remove_prefix(count);
    }
    /// Text that ends with a zero.
    std::string_view text() {
        const std::string_view text = left_.substr(0, left_.find('\0'));
        skip(text.size() + 1);
        return text;
    }
    std::uint32_t number() {
        const std::string_view bytes = left_.substr(0, 4);
        skip(4);
        std::uint32_t number = 0;
        for (std::size_t i = 0; i < 4; ++i) number |= std::uint32_t(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
        return number;
    }
    std::size_t left() const { return left_.size(); }

private:
    std::string_view left_;
};

/// Passes over one part's attributes; false if there are none, which ends a list of parts.
bool skip_attributes(Bytes& bytes) {
    std::string_view name = bytes.text();
    if (name.empty()) return false;
    for (; !name.empty(); name = bytes.text()) {
        bytes.text();  // its type
        const std::uint32_t size = bytes.number();
        if (size > bytes.left()) {
            throw std::runtime_error("its attribute '" + excerpt(name) + "' is longer than the file: it is cut short " +
                                     "or damaged");
        }
        bytes.skip(size);
    }
    return true;
}

/// How color is stored in these channels, if it is.
std::optional<ExrColor::Kind> kind_of(const Imf::ChannelList& channels) {
    const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
    if (has("R") && has("G") && has("B")) return ExrColor::Kind::rgb;
    if (!has("Y")) return std::nullopt;
    return has("RY") || has("BY") ? ExrColor::Kind::luminance_chroma : ExrColor::Kind::gray;
}

void require_sampling(const Imf::ChannelList& channels, const char* name, int every) {
    const Imf::Channel* channel = channels.findChannel(name);
    if (!channel) throw std::runtime_error(std::string("it has no channel ") + name);
    if (channel->xSampling != every || channel->ySampling != every) {
        throw std::runtime_error(std::string("its channel ") + name + " is sampled at every " +
                                 std::to_string(channel->xSampling) + " x " + std::to_string(channel->ySampling) +
                                 " pixels instead of " + std::to_string(every) + " x " + std::to_string(every));
    }
}

void require_samplings(const Imf::ChannelList& channels, ExrColor::Kind kind) {
    if (kind == ExrColor::Kind::rgb) {
        for (const char* name : {"R", "G", "B"}) require_sampling(channels, name, 1);
        return;
    }
    require_sampling(channels, "Y", 1);
    if (kind == ExrColor::Kind::luminance_chroma) {
        for (const char* name : {"RY", "BY"}) require_sampling(channels, name, 2);
    }
}

/// The channels of all parts, for a message.
std::string channels_of(const Imf::MultiPartInputFile& file) {
    constexpr std::size_t shown = 12;
    std::vector<std::string> names;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::ChannelList& channels = file.header(part).channels();
        for (auto channel = channels.begin(); channel != channels.end(); ++channel) names.push_back(channel.name());
    }
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < shown; ++i) list += (i == 0 ? "" : ", ") + excerpt(names[i]);
    if (names.size() > shown) list += " and " + std::to_string(names.size() - shown) + " more";
    return list.empty() ? "no channels" : list;
}

}  // namespace

void check_exr_attributes(std::string_view bytes) {
    Bytes header(bytes);
    header.skip(4);  // what all OpenEXR files begin with
    const bool is_multi_part = Imf::isMultiPart(static_cast<int>(header.number()));
    while (skip_attributes(header) && is_multi_part) {}
}

ExrColor exr_color(const Imf::MultiPartInputFile& file) {
    bool has_deep = false;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        const auto kind = kind_of(header.channels());
        if (!kind) continue;
        if (header.hasType() && Imf::isDeepData(header.type())) {
            has_deep = true;
            continue;
        }
        require_samplings(header.channels(), *kind);
        return {part, *kind};
    }
    if (has_deep) throw std::runtime_error("it is deep: it has many samples a pixel; flatten it");
    throw std::runtime_error("it has no R, G and B, nor Y, but " + channels_of(file) +
                             "; save the layer that is meant as R, G and B");
}

}  // namespace render
