// Lightcuts of arbitrary lights and receivers: every model of both, positions from touching to far away, against the
// exhaustive sum. Nothing is NaN, a cut of ratio 0 is that sum, and no cut is farther from it than its error bound.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/clampable.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/material/capped.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/material/sum.hpp>
#include <lightcuts/material/thin_sheet.hpp>
#include <lightcuts/material/ward.hpp>

#include "fuzz_target.hpp"

namespace {

using namespace lightcuts;
using V = glm::vec3;
using Forest = LightForest<OmniLight<V>, OmniLight<V, PolynomialFalloff>, OrientedPointLight<V>, SpotLight<V>,
                           DistantLight<V>, VirtualPointLight<V>, VirtualVolumeLight<V>>;

/// Numbers made of bytes; zeros when they are used up.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

    bool empty() const { return next_ == end_; }
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }
    unsigned below(unsigned n) { return byte() % n; }

    /// Any number of at most `largest`: round, ordinary, or of any size.
    float number(float largest) {
        const std::uint8_t kind = byte();
        float x = 0.0f;
        if (kind < 96) {
            x = static_cast<float>(static_cast<std::int8_t>(byte())) / 16.0f;
        } else if (kind < 192) {
            const int high = static_cast<std::int8_t>(byte());
            x = static_cast<float>(high * 256 + byte()) / 4096.0f;
        } else {
            std::uint32_t bits = 0;
            for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
            x = std::bit_cast<float>(bits);
        }
        return std::fabs(x) <= largest ? x : 0.0f;  // NaN too
    }
    float between(float lo, float hi) { return lo + (hi - lo) * static_cast<float>(byte()) / 255.0f; }
    V vector(float largest) { return {number(largest), number(largest), number(largest)}; }
    V unit() {
        const V v = vector(1e6f);
        const double length = glm::length(glm::dvec3(v));
        return length > 1e-30 ? V(glm::dvec3(v) / length) : V(0.0f, 0.0f, 1.0f);
    }
    V color(float largest) { return glm::abs(vector(largest)); }
    /// A point, or close to one that was read before.
    V point() {
        constexpr float far = 1e18f;
        if (!points_.empty() && below(3) == 0) {
            const V& near = points_[below(static_cast<unsigned>(points_.size()))];
            const float scale = std::ldexp(1.0f, -static_cast<int>(below(64)));
            V moved = near + scale * V(unit());
            if (below(4) == 0) moved = near;
            return remember(glm::clamp(moved, V(-far), V(far)));
        }
        return remember(vector(far));
    }

private:
    V remember(const V& point) {
        if (points_.size() < 64) points_.push_back(point);
        return point;
    }

    const std::uint8_t* next_;
    const std::uint8_t* end_;
    std::vector<V> points_;
};

/// Lets pass nothing, all, or a part of a light, by its place.
struct Curtain {
    std::uint64_t seed;

    template <class R, class L>
    float operator()(const R&, const L& light) const {
        const V place = position_or_direction(light);
        std::uint64_t bits = seed;
        for (int i = 0; i < 3; ++i) bits = hash_keys(bits, std::bit_cast<std::uint32_t>(place[i]));
        return seed == 0 ? 1.0f : bits % 4 == 0 ? 0.0f : bits % 4 == 1 ? 0.25f : 1.0f;
    }
};

struct Lights {
    std::vector<OmniLight<V>> omni;
    std::vector<OmniLight<V, PolynomialFalloff>> polynomial;
    std::vector<OrientedPointLight<V>> oriented;
    std::vector<SpotLight<V>> spot;
    std::vector<DistantLight<V>> distant;
    std::vector<VirtualPointLight<V>> virtual_lights;
    std::vector<VirtualVolumeLight<V>> volume_lights;
};

Lights read_lights(Bytes& bytes) {
    constexpr float brightest = 1e15f;
    Lights lights;
    for (unsigned count = 1 + bytes.below(40); count > 0; --count) {
        switch (bytes.below(8)) {
            case 0: lights.omni.push_back({bytes.point(), bytes.color(brightest), {}}); break;
            case 1:
                lights.polynomial.push_back(
                    {bytes.point(),
                     bytes.color(brightest),
                     {bytes.between(0.0f, 2.0f), bytes.between(0.0f, 2.0f), bytes.between(0.01f, 2.0f)}});
                break;
            case 2:
            case 3: lights.oriented.push_back({bytes.point(), bytes.unit(), bytes.color(brightest), {}}); break;
            case 4: {
                const float outer = bytes.between(-1.0f, 1.0f);
                lights.spot.push_back({bytes.point(),
                                       bytes.unit(),
                                       bytes.color(brightest),
                                       {outer + bytes.between(0.0f, 1.0f) * (1.0f - outer), outer}});
                break;
            }
            case 5: lights.distant.push_back({bytes.unit(), bytes.color(brightest)}); break;
            case 6:
                lights.volume_lights.push_back(
                    {{bytes.point(), bytes.unit(), bytes.color(brightest), {bytes.between(0.0f, 0.9999f)}}});
                break;
            default: lights.virtual_lights.push_back({{bytes.point(), bytes.unit(), bytes.color(brightest), {}}});
        }
    }
    return lights;
}

LightcutOptions read_options(Bytes& bytes) {
    LightcutOptions options;
    options.error_ratio = bytes.below(3) == 0 ? 0.0f : bytes.between(0.0f, 0.5f);
    options.max_cut = bytes.below(3) == 0 ? bytes.below(40) : 0;
    options.exhaustive_below = bytes.below(4) == 0 ? 256 : 0;
    options.adaptation = bytes.below(4) == 0 ? bytes.between(0.0f, 1.0f) : 0.0f;
    options.seed = bytes.byte();
    options.round_fraction = bytes.below(4) == 0 ? 1.0 : 0.1;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    options.clamp.ratio = bytes.below(2) == 0 ? infinity : bytes.below(2) == 0 ? 0.01f : bytes.between(0.0f, 1.0f);
    options.clamp.radiance = bytes.below(4) == 0 ? std::fabs(bytes.number(1e6f)) : infinity;
    options.clamp.transfer = bytes.below(4) == 0 ? std::fabs(bytes.number(1e6f)) : infinity;
    return options;
}

void report(const char* what, int channel, double radiance, double exact, double bound) {
    std::fprintf(stderr, "%s: channel %d, radiance %.9g, exhaustive %.9g, error bound %.9g\n", what, channel, radiance,
                 exact, bound);
    std::abort();
}

/// What float loses below its smallest number, of any light.
double underflow(const Lights& lights) {
    double sum = 0.0;
    const auto add = [&](const auto& all) {
        for (const auto& l : all) sum += channel_sum(l.intensity);
    };
    add(lights.omni);
    add(lights.polynomial);
    add(lights.oriented);
    add(lights.spot);
    add(lights.distant);
    add(lights.virtual_lights);
    add(lights.volume_lights);
    return 0x1p-126 * (sum + 64.0);
}

template <class M>
void check(const Forest& forest, const Receiver<M>& receiver, const Curtain& oracle, const LightcutOptions& options,
           double lost) {
    constexpr double rounding = 2e-5;
    const V exact = exhaustive(forest, receiver, oracle, options.clamp).radiance;
    Lightcut cut(forest, receiver, oracle, options);
    for (bool more = true; more;) {
        more = cut.step();
        const CutResult<V> result = cut.result();
        const bool is_exact = !more && options.error_ratio == 0.0f && options.max_cut == 0;
        for (int c = 0; c < 3; ++c) {
            const auto radiance = static_cast<double>(result.radiance[c]), truth = static_cast<double>(exact[c]),
                       bound = static_cast<double>(result.error_bound[c]);
            if (!(radiance >= 0.0) || !(truth >= 0.0) || !(bound >= 0.0)) report("NaN", c, radiance, truth, bound);
            if (!std::isfinite(radiance) || !std::isfinite(truth)) report("infinite", c, radiance, truth, bound);
            const double difference = std::fabs(radiance - truth), allowed = rounding * truth + 1e-6 * radiance + lost;
            if (!(difference <= bound + allowed)) report("error", c, radiance, truth, bound);
            // What remains in an exact cut is what its own rounding may do to a threshold.
            if (is_exact && !options.clamp.is_automatic() && bound != 0.0) report("ratio 0", c, radiance, truth, bound);
        }
    }
}

void shade_some(Bytes& bytes, const Forest& forest, double lost) {
    const V at = bytes.point(), normal = bytes.unit(),
            albedo = V(bytes.between(0.0f, 1.0f), bytes.between(0.0f, 1.0f), 0.5f);
    V view = bytes.unit();
    if (bytes.below(8) != 0 && glm::dot(view, normal) < 0.0f) view = -view;
    const float alpha = bytes.below(4) == 0 ? std::ldexp(1.0f, -static_cast<int>(bytes.below(10)))
                                            : bytes.between(0.01f, 1.0f);
    const float exponent = bytes.below(4) == 0 ? std::ldexp(1.0f, static_cast<int>(bytes.below(20)))
                                               : bytes.between(0.0f, 100.0f);
    const Curtain oracle{bytes.below(2) == 0 ? 0u : 1u + bytes.byte()};
    const LightcutOptions options = read_options(bytes);
    const auto with = [&](const auto& material) {
        check(forest, Receiver<std::remove_cvref_t<decltype(material)>>(at, material), oracle, options, lost);
    };
    const Lambert<V> lambert{normal, albedo};
    switch (bytes.below(10)) {
        case 0: return with(lambert);
        case 1: return with(ModifiedPhong<V>(normal, view, albedo, exponent));
        case 2: return with(Ward<V, Ward1992>(normal, view, albedo, alpha));
        case 3: return with(Ward<V, WardDuer>(normal, view, albedo, alpha));
        case 4: return with(Ward<V>(normal, view, albedo, alpha));
        case 5: return with(Ggx<V>(normal, view, albedo, alpha));
        case 6: return with(Ggx<V, SeparableShadowing>(normal, view, albedo, alpha));
        case 7: return with(Sum(lambert, Ggx<V>(normal, view, albedo, alpha)));
        case 8: return with(ThinSheet<Lambert<V>, Lambert<V>>{lambert, {-normal, albedo}, normal});
        default: return with(Capped{ModifiedPhong<V>(normal, view, albedo, exponent), V(4.0f)});
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const Lights lights = read_lights(bytes);
    const LightTreeOptions options{.representatives = bytes.below(2) == 0 ? 1u : 8u, .seed = bytes.byte()};
    const LightTree omni(lights.omni, options);
    const LightTree polynomial(lights.polynomial, options);
    const LightTree oriented(lights.oriented, options);
    const LightTree spot(lights.spot, options);
    const LightTree distant(lights.distant, options);
    const LightTree virtual_lights(lights.virtual_lights, options);
    const LightTree volume_lights(lights.volume_lights, options);
    const Forest forest(omni, polynomial, oriented, spot, distant, virtual_lights, volume_lights);
    const double lost = underflow(lights);
    for (int i = 0; i < 16 && !bytes.empty(); ++i) shade_some(bytes, forest, lost);
    return 0;
}
