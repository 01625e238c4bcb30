#include "surfaces/texture_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "surfaces/texture.hpp"

namespace render {
namespace {

/// Texels along the sides of the smallest blocks.
constexpr int block = 4;
constexpr int block_shift = 2;

constexpr TexelRange nothing() {
    return {glm::vec4(std::numeric_limits<float>::max()), glm::vec4(-std::numeric_limits<float>::max())};
}

void add(TexelRange& range, const glm::vec4& texel) {
    range.low = glm::min(range.low, texel);
    range.high = glm::max(range.high, texel);
}

void add(TexelRange& range, const TexelRange& other) {
    range.low = glm::min(range.low, other.low);
    range.high = glm::max(range.high, other.high);
}

}  // namespace

/// Along u or v: which texels a box reads.
struct TextureRange::Axis {
    std::array<Interval, 3> intervals{};  ///< of texels that are there
    std::size_t count = 0;
    bool is_cell = false;  ///< between the same two neighbors everywhere
    int first = 0;         ///< the neighbors, before wrapping: this and the next
    double from = 0;       ///< the box between them
    double to = 0;

    Axis(double low, double high, int size, Texture::Wrap wrap, Texture::Filter filter) {
        const double texels = size;
        const double period = wrap == Texture::Wrap::mirror ? 2.0 : 1.0;
        const bool is_clamped = wrap == Texture::Wrap::clamp;
        // How far the floats of `Texture::sample` may be off.
        const double slack = 1e-3 + texels * 0x1p-21 * std::max(std::abs(low), std::abs(high));
        if (is_clamped) {
            low = std::clamp(low, 0.0, 1.0);
            high = std::clamp(high, 0.0, 1.0);
        }
        if (!(high - low < period) || !(slack < 0.25 * texels)) {
            everything(size);
            return;
        }
        const double start = is_clamped ? 0.0 : period * std::floor(low / period);
        const double half = filter == Texture::Filter::linear ? 0.5 : 0.0;
        const double begin = (low - start) * texels - half - slack;
        const double end = (high - start) * texels - half + slack;
        first = static_cast<int>(std::floor(begin));
        const int last = static_cast<int>(std::floor(end)) + (filter == Texture::Filter::linear ? 1 : 0);
        is_cell = filter == Texture::Filter::linear && last == first + 1;
        from = std::clamp(begin - first, 0.0, 1.0);
        to = std::clamp(end - first, 0.0, 1.0);
        if (is_clamped) {
            push({std::clamp(first, 0, size - 1), std::clamp(last, 0, size - 1)});
            return;
        }
        const int whole = wrap == Texture::Wrap::mirror ? 2 * size : size;
        if (last - first + 1 >= whole) {
            everything(size);
            return;
        }
        const int a = (first % whole + whole) % whole;
        const int b = a + (last - first);
        for (int turn = 0; turn < 4 && count < intervals.size(); ++turn) {
            const int lo = std::max(a, turn * size) - turn * size;
            const int hi = std::min(b, turn * size + size - 1) - turn * size;
            if (lo > hi) continue;
            const bool is_back = wrap == Texture::Wrap::mirror && turn % 2 == 1;
            push(is_back ? Interval{size - 1 - hi, size - 1 - lo} : Interval{lo, hi});
        }
    }

private:
    void push(const Interval& interval) { intervals[count++] = interval; }
    void everything(int size) {
        count = 0;
        push({0, size - 1});
        is_cell = false;
    }
};

TextureRange::TextureRange(const Texture& texture) : texture_(&texture) {
    Level level;
    level.width = (texture.width + block - 1) / block;
    level.height = (texture.height + block - 1) / block;
    level.blocks.assign(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height), nothing());
    for (int y = 0; y < texture.height; ++y) {
        const glm::vec4* row = texture.texels.data() + static_cast<std::ptrdiff_t>(y) * texture.width;
        TexelRange* blocks = level.blocks.data() + static_cast<std::ptrdiff_t>(y / block) * level.width;
        for (int x = 0; x < texture.width; ++x) add(blocks[x / block], row[x]);
    }
    levels_.push_back(std::move(level));
    while (levels_.back().blocks.size() > 1) {
        const Level& fine = levels_.back();
        Level coarse;
        coarse.width = (fine.width + 1) / 2;
        coarse.height = (fine.height + 1) / 2;
        coarse.blocks.assign(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height),
                             nothing());
        for (int y = 0; y < fine.height; ++y) {
            for (int x = 0; x < fine.width; ++x) {
                add(coarse.blocks[static_cast<std::size_t>(y / 2 * coarse.width + x / 2)],
                    fine.blocks[static_cast<std::size_t>(y * fine.width + x)]);
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

TexelRange TextureRange::over_all() const { return levels_.back().blocks.front(); }

void TextureRange::add_texels(const Interval& columns, const Interval& rows, TexelRange& range) const {
    if (std::max(columns.last - columns.first, rows.last - rows.first) < 2 * block) {
        for (int y = rows.first; y <= rows.last; ++y) {
            const glm::vec4* row = texture_->texels.data() + static_cast<std::ptrdiff_t>(y) * texture_->width;
            for (int x = columns.first; x <= columns.last; ++x) add(range, row[x]);
        }
        return;
    }
    int shift = block_shift;
    const auto blocks = [&](const Interval& i) { return (i.last >> shift) - (i.first >> shift) + 1; };
    while (std::max(blocks(columns), blocks(rows)) > 3) ++shift;
    const Level& level = levels_[static_cast<std::size_t>(shift - block_shift)];
    for (int y = rows.first >> shift; y <= rows.last >> shift; ++y) {
        for (int x = columns.first >> shift; x <= columns.last >> shift; ++x) {
            add(range, level.blocks[static_cast<std::size_t>(y * level.width + x)]);
        }
    }
}

TexelRange TextureRange::in_cell(const Axis& x, const Axis& y) const {
    const Texture& t = *texture_;
    const auto texel = [&](int i, int j) {
        return glm::dvec4(t.texels[static_cast<std::size_t>(wrapped_texel(j, t.height, t.wrap_v)) *
                                       static_cast<std::size_t>(t.width) +
                                   static_cast<std::size_t>(wrapped_texel(i, t.width, t.wrap_u))]);
    };
    const glm::dvec4 t00 = texel(x.first, y.first);
    const glm::dvec4 t10 = texel(x.first + 1, y.first);
    const glm::dvec4 t01 = texel(x.first, y.first + 1);
    const glm::dvec4 t11 = texel(x.first + 1, y.first + 1);
    TexelRange range = nothing();
    // Bilinear: the extremes are at the corners.
    for (const double v : {y.from, y.to}) {
        for (const double u : {x.from, x.to}) {
            add(range, glm::vec4(glm::mix(glm::mix(t00, t10, u), glm::mix(t01, t11, u), v)));
        }
    }
    return range;
}

TexelRange TextureRange::over(const glm::dvec2& low, const glm::dvec2& high) const {
    const Texture& t = *texture_;
    const Axis x(low.x, high.x, t.width, t.wrap_u, t.filter);
    const Axis y(low.y, high.y, t.height, t.wrap_v, t.filter);
    if (x.is_cell && y.is_cell) return in_cell(x, y);
    TexelRange range = nothing();
    for (std::size_t i = 0; i < x.count; ++i) {
        for (std::size_t j = 0; j < y.count; ++j) add_texels(x.intervals[i], y.intervals[j], range);
    }
    return range;
}

}  // namespace render
