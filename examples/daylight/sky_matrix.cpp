#include "sky_matrix.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>
#include <render/io/escape.hpp>
#include <render/io/text_file.hpp>

#include "reinhart_patches.hpp"

namespace daylighting {
namespace {

constexpr double lumens_per_watt = 179.0;
constexpr std::array<double, 3> brightness = {0.265, 0.670, 0.065};
constexpr double most_radiance = 1e9;  // the sun's own is some 2e7
constexpr double most_hours = 1e6;
constexpr std::string_view blanks = " \t\r\n\v\f";

/// The number whose bytes are the first of `bytes`.
template <class Number, class Word>
double number_of(const char* bytes, bool high_byte_first) {
    static_assert(sizeof(Number) == sizeof(Word));
    Word word = 0;
    for (std::size_t i = 0; i < sizeof(Word); ++i) {
        const auto byte = static_cast<Word>(static_cast<unsigned char>(bytes[i]));
        word |= static_cast<Word>(byte << (8 * (high_byte_first ? sizeof(Word) - 1 - i : i)));
    }
    return static_cast<double>(std::bit_cast<Number>(word));
}

class SkyMatrixReader {
public:
    SkyMatrixReader(std::string_view bytes, const std::filesystem::path& path) : rest_(bytes), path_(path) {}

    SkyMatrix read() {
        read_header();
        const std::size_t count = matrix_.patches * matrix_.hours * 3;
        switch (format_) {
            case Format::ascii:
                // A digit and a blank each, at least.
                if (rest_.size() / 2 + 1 < count) refuse_size("");
                read_numbers([this] { return next_word(); });
                if (rest_.find_first_not_of(blanks) != std::string_view::npos) refuse_size("more than ");
                break;
            case Format::single: read_binary<float, std::uint32_t>(count); break;
            case Format::twofold: read_binary<double, std::uint64_t>(count); break;
        }
        return std::move(matrix_);
    }

private:
    enum class Format { ascii, single, twofold };

    [[noreturn]] void fail(const std::string& problem) const { render::fail_at(path_, line_, problem); }
    [[noreturn]] void refuse(const std::string& problem) const {
        throw lightcuts::invalid_input(path_.string() + ": " + problem);
    }
    [[noreturn]] void refuse_size(const char* more) const {
        refuse(std::string("there are ") + (*more == '\0' ? "fewer than " : more) + std::to_string(matrix_.patches) +
               " patches x " + std::to_string(matrix_.hours) + " hours x 3 numbers; the file is " +
               (*more == '\0' ? "cut short" : "of another matrix") + ", or its header is");
    }

    void read_header() {
        bool is_over = false, has_rows = false, has_hours = false;
        while (!is_over && !rest_.empty()) {
            ++line_;
            const std::string_view line = render::take_line(rest_);
            if (line_ == 1 && !line.starts_with("#?")) fail("does not begin with #?; is this a matrix of gendaymtx?");
            is_over = line.empty();
            const std::size_t equals = std::min(line.find('='), line.size());
            const std::string_view key = render::trim(line.substr(0, equals));
            const std::string_view value = render::trim(line.substr(std::min(equals + 1, line.size())));
            if (line.starts_with('\t')) continue;  // what an earlier program said of its own
            if (line.starts_with("gendaymtx")) look_at_command(line);
            if (key == "NROWS") {
                const std::size_t rows = whole(key, value);
                const std::optional<int> division = ReinhartPatches::division_of(rows);
                if (!division) {
                    fail("NROWS is " + std::to_string(rows) +
                         ", which is no sky's; gendaymtx makes 146, 578, 2306 or 144 m^2 + 2");
                }
                matrix_.division = *division;
                matrix_.patches = rows;
                has_rows = true;
            } else if (key == "NCOLS") {
                matrix_.hours = whole(key, value);
                has_hours = true;
            } else if (key == "NCOMP") {
                if (whole(key, value) != 3) fail("NCOMP is not 3; a sky has red, green and blue");
            } else if (key == "BigEndian") {
                if (value != "0" && value != "1") fail("BigEndian is neither 0 nor 1");
                high_byte_first_ = value == "1";
            } else if (key == "FORMAT") {
                if (value != "ascii" && value != "float" && value != "double") {
                    fail("FORMAT is '" + render::excerpt(value) + "'; ascii, float and double can be read");
                }
                format_ = value == "ascii" ? Format::ascii : value == "float" ? Format::single : Format::twofold;
            } else if (key == "EXPOSURE" || key == "COLORCORR") {
                fail(std::string(key) + " says that the numbers are scaled, which is not read; undo it by rmtxop");
            }
        }
        if (!is_over) refuse("its header has no end, an empty line; the file is cut short");
        if (!has_rows || !has_hours) refuse(std::string("its header has no ") + (has_rows ? "NCOLS" : "NROWS"));
    }

    /// What the matrix was made by: options that make its numbers something else, and whether it has suns.
    void look_at_command(std::string_view line) {
        matrix_.has_suns = true;
        while (!line.empty()) {
            const std::string_view word = line.substr(0, std::min(line.find_first_of(blanks), line.size()));
            line.remove_prefix(std::min(line.size(), word.size() + 1));
            if (word == "-O1") fail("gendaymtx -O1 makes solar radiance, of which there is no luminance; leave it out");
            if (word == "-5") fail("gendaymtx -5 makes suns of their own size, not of a patch's; leave it out");
            if (word == "-s") matrix_.has_suns = false;
        }
    }

    std::size_t whole(std::string_view key, std::string_view text) const {
        const std::optional<double> value = render::parse_number(text);
        if (!value || !(*value >= 1.0 && *value <= most_hours) || *value != std::floor(*value)) {
            fail(std::string(key) + " '" + render::excerpt(text) + "' is not a whole number from 1 to 1000000");
        }
        return static_cast<std::size_t>(*value);
    }

    template <class Number, class Word>
    void read_binary(std::size_t count) {
        if (rest_.size() < count * sizeof(Number)) refuse_size("");
        if (rest_.size() > count * sizeof(Number)) refuse_size("more than ");
        const char* at = rest_.data();
        read_numbers([&] {
            const double number = number_of<Number, Word>(at, high_byte_first_);
            at += sizeof(Number);
            return number;
        });
    }

    std::optional<double> next_word() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        if (rest_.empty()) refuse_size("");
        const std::size_t end = rest_.find_first_of(blanks);
        if (end == std::string_view::npos) refuse("ends within a number; the file is cut short");
        word_ = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return render::parse_number(word_);
    }

    /// `next()`: a number, or none if what stands there is not one.
    template <class Next>
    void read_numbers(const Next& next) {
        matrix_.luminances.resize(matrix_.patches * matrix_.hours);
        for (std::size_t patch = 0; patch < matrix_.patches; ++patch) {
            for (std::size_t hour = 0; hour < matrix_.hours; ++hour) {
                double luminance = 0.0;
                for (const double share : brightness) {
                    const std::optional<double> radiance = next();
                    if (!radiance || !(*radiance >= 0.0 && *radiance <= most_radiance)) {
                        char text[32];
                        std::snprintf(text, sizeof text, "%g", radiance.value_or(0.0));
                        refuse("row " + std::to_string(patch + 1) + ", column " + std::to_string(hour + 1) + ": '" +
                               (format_ == Format::ascii ? render::excerpt(word_) : std::string(text)) +
                               "' is not a radiance from 0 to 1e9");
                    }
                    luminance += lumens_per_watt * share * *radiance;
                }
                matrix_.luminances[hour * matrix_.patches + patch] = static_cast<float>(luminance);
            }
        }
    }

    std::string_view rest_;
    const std::filesystem::path& path_;
    std::string_view word_;
    std::size_t line_ = 0;
    Format format_ = Format::ascii;
    bool high_byte_first_ = false;
    SkyMatrix matrix_;
};

}  // namespace

SkyMatrix sky_matrix(std::string_view bytes, const std::filesystem::path& path) {
    return SkyMatrixReader(bytes, path).read();
}

SkyMatrix read_sky_matrix(const std::filesystem::path& path) {
    const std::string bytes = render::read_file(path);
    return sky_matrix(bytes, path);
}

}  // namespace daylighting
