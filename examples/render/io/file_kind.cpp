#include "io/file_kind.hpp"

#include <cstddef>

namespace render {

namespace {

using namespace std::string_view_literals;

/// Bytes by which a kind of file is known, and where they stand.
struct Magic {
    std::string_view bytes;
    std::size_t offset;
    std::string_view kind;
};

constexpr Magic magics[] = {
    {"#?"sv, 0, "a Radiance picture"sv},
    {"\x76\x2f\x31\x01"sv, 0, "an OpenEXR picture"sv},
    {"\x89PNG\r\n\x1a\n"sv, 0, "a PNG picture"sv},
    {"\xff\xd8\xff"sv, 0, "a JPEG picture"sv},
    {"GIF8"sv, 0, "a GIF picture"sv},
    {"BM"sv, 0, "a BMP picture"sv},
    {"WEBP"sv, 8, "a WebP picture"sv},
    {"ftypavif"sv, 4, "an AVIF picture"sv},
    {"ftypavis"sv, 4, "an AVIF picture"sv},
    {"ftyphei"sv, 4, "a HEIF picture"sv},
    {"ftyphev"sv, 4, "a HEIF picture"sv},
    {"ftypmif1"sv, 4, "a HEIF picture"sv},
    {"\xabKTX 20\xbb"sv, 0, "a KTX2 texture"sv},
    {"\xabKTX 11\xbb"sv, 0, "a KTX texture"sv},
    {"DDS "sv, 0, "a DDS texture"sv},
    {"sB\x13\0"sv, 0, "a Basis texture"sv},
    {"II*\0"sv, 0, "a TIFF picture"sv},
    {"MM\0*"sv, 0, "a TIFF picture"sv},
    {"II+\0"sv, 0, "a TIFF picture"sv},
    {"8BPS"sv, 0, "a Photoshop file"sv},
    {"\0\0\0\x0cjP  "sv, 0, "a JPEG 2000 picture"sv},
    {"\xff\x4f\xff\x51"sv, 0, "a JPEG 2000 picture"sv},
    {"\0\0\0\x0cJXL "sv, 0, "a JPEG XL picture"sv},
    {"\xff\x0a"sv, 0, "a JPEG XL picture"sv},
    {"qoif"sv, 0, "a QOI picture"sv},
    {"PF\n"sv, 0, "a PFM picture"sv},
    {"Pf\n"sv, 0, "a PFM picture"sv},
    {"P5"sv, 0, "a PGM picture"sv},
    {"P6"sv, 0, "a PPM picture"sv},
    {"<svg"sv, 0, "an SVG drawing"sv},
    {"%PDF"sv, 0, "a PDF document"sv},
    {"PK\x03\x04"sv, 0, "a ZIP archive"sv},
    {"\x1f\x8b"sv, 0, "compressed by gzip"sv},
    {"<!DOCTYPE"sv, 0, "a web page"sv},
    {"<!doctype"sv, 0, "a web page"sv},
    {"<html"sv, 0, "a web page"sv},
    {"version https://git-lfs"sv, 0, "a Git LFS pointer in place of the file"sv},
};

bool has(std::string_view bytes, const Magic& magic) {
    return bytes.size() > magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes);
}

}  // namespace

bool begins_as_radiance(std::string_view bytes) { return bytes.starts_with("#?"); }

bool begins_as_openexr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

std::string_view file_kind(std::string_view bytes) {
    for (const Magic& magic : magics) {
        if (has(bytes, magic)) return magic.kind;
    }
    return {};
}

std::string what_it_is(std::string_view bytes, const std::string& otherwise) {
    if (bytes.empty()) return "it is empty";
    const std::string_view kind = file_kind(bytes);
    return kind.empty() ? otherwise : "it is " + std::string(kind);
}

}  // namespace render
