#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <lightcuts/cut/lightcut.hpp>

// One minimal type a concept: each offers what the concept asks for and denies everything else.
namespace lightcuts::test {

/// Denies copies, moves and default construction.
class Pinned {
public:
    explicit Pinned(int) {}
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;
};

/// A vector whose coordinates only its traits can read.
class OwnVector {
public:
    OwnVector(float x, float y, float z) : at_{x, y, z} {}

private:
    friend struct vector_traits<OwnVector>;
    std::array<float, 3> at_;
};

/// A spectrum of five bands. Its operators give expressions, which only become a spectrum where one is asked for;
/// nothing compares, subtracts or accumulates it.
class Bands;
class BandsExpression {
public:
    explicit BandsExpression(const std::array<float, 5>& at) : at_(at) {}
    operator Bands() const;

private:
    std::array<float, 5> at_;
};
class Bands {
public:
    static constexpr int channels = 5;
    Bands() = default;
    explicit Bands(const std::array<float, 5>& at) : at_(at) {}
    float operator[](int i) const { return at_[static_cast<std::size_t>(i)]; }
    float& operator[](int i) { return at_[static_cast<std::size_t>(i)]; }

    friend BandsExpression operator+(const Bands& a, const Bands& b) {
        return each([&](std::size_t i) { return a.at_[i] + b.at_[i]; });
    }
    friend BandsExpression operator*(const Bands& a, const Bands& b) {
        return each([&](std::size_t i) { return a.at_[i] * b.at_[i]; });
    }
    friend BandsExpression operator*(const Bands& a, float k) {
        return each([&](std::size_t i) { return a.at_[i] * k; });
    }

private:
    template <class F>
    static BandsExpression each(F&& f) {
        std::array<float, 5> at;
        for (std::size_t i = 0; i < 5; ++i) at[i] = f(i);
        return BandsExpression(at);
    }
    std::array<float, 5> at_{};
};
inline BandsExpression::operator Bands() const { return Bands(at_); }

/// A spectrum whose default constructor leaves what is no number, and whose assignment returns nothing.
class Unset {
public:
    static constexpr int channels = 2;
    Unset() : at_{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()} {}
    Unset(float a, float b) : at_{a, b} {}
    Unset(const Unset&) = default;
    void operator=(const Unset& other) { at_ = other.at_; }
    float operator[](int i) const { return at_[static_cast<std::size_t>(i)]; }
    float& operator[](int i) { return at_[static_cast<std::size_t>(i)]; }

    friend Unset operator+(const Unset& a, const Unset& b) { return {a[0] + b[0], a[1] + b[1]}; }
    friend Unset operator*(const Unset& a, const Unset& b) { return {a[0] * b[0], a[1] * b[1]}; }
    friend Unset operator*(const Unset& a, float k) { return {a[0] * k, a[1] * k}; }

private:
    std::array<float, 2> at_;
};

/// A light that has a position and an intensity, as functions, and cannot be copied.
class LeastLight : Pinned {
public:
    LeastLight(const OwnVector& position, const Bands& intensity)
        : Pinned(0), position_(position), intensity_(intensity) {}
    OwnVector position() const { return position_; }
    const Bands& intensity() const { return intensity_; }

private:
    OwnVector position_;
    Bands intensity_;
};

/// A light of somebody else's that only the traits can read: oriented, with a profile and a falloff of its own.
class ForeignLight : Pinned {
public:
    ForeignLight(const OwnVector& where, const OwnVector& forward, const Bands& watts)
        : Pinned(0), where_(where), forward_(forward), watts_(watts) {}

private:
    friend struct light_traits<ForeignLight>;
    OwnVector where_, forward_;
    Bands watts_;
};

/// A light at infinity, likewise minimal.
class LeastSun : Pinned {
public:
    LeastSun(const OwnVector& direction, const Bands& intensity)
        : Pinned(0), direction_(direction), intensity_(intensity) {}
    OwnVector direction() const { return direction_; }
    Bands intensity() const { return intensity_; }

private:
    OwnVector direction_;
    Bands intensity_;
};

/// A material that evaluates and bounds itself, and cannot be copied: a receiver refers to it.
class LeastMaterial : Pinned {
public:
    LeastMaterial() : Pinned(0) {}
    Bands evaluate(const glm::vec3& to_light) const {
        return to_light.z > 0.0f ? Bands(std::array<float, 5>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f}) : Bands();
    }
    Bands upper_bound(const OffsetBox& offsets) const {
        return offsets.hi.z > 0.0 ? Bands(std::array<float, 5>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f}) : Bands();
    }
};

/// A material that also takes light from behind.
class LeastLeaf : public LeastMaterial {
public:
    Bands evaluate(const glm::vec3&) const { return Bands(std::array<float, 5>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f}); }
    Bands upper_bound(const OffsetBox&) const { return evaluate({}); }
    bool is_behind(const glm::vec3& to_light) const { return to_light.z < 0.0f; }
};

/// Answers about one light at a time.
struct LeastOracle : private Pinned {
    LeastOracle() : Pinned(0) {}
    template <class R, class L>
    bool operator()(const R&, const L&) const {
        return true;
    }
};

/// Answers about many lights only.
struct LeastBatchedOracle : private Pinned {
    LeastBatchedOracle() : Pinned(0) {}
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = 1.0f;
    }
};

/// Answers for each channel, about one light or about many: half of all gets through.
struct LeastTint : private Pinned {
    LeastTint() : Pinned(0) {}
    template <class R, class L>
    Bands operator()(const R&, const L&) const {
        return Bands(std::array<float, 5>{0.5f, 0.5f, 0.5f, 0.5f, 0.5f});
    }
};
struct LeastTintingOracle : private Pinned {
    LeastTintingOracle() : Pinned(0) {}
    void many(std::span<const VisibilityQuery> queries, std::span<Bands> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = LeastTint()(0, 0);
    }
};

/// What an oracle says of clusters: it is neither copied nor moved.
struct LeastLikelihood : private Pinned {
    LeastLikelihood() : Pinned(0) {}
    float operator()(std::uint32_t, std::uint32_t node) const { return node % 2 == 0 ? 0.5f : 1.0f; }
};
/// Predicts, and answers about one light or about many.
struct LeastPredictingOracle : LeastOracle {
    template <class R>
    LeastLikelihood likely_visible(const R&) const {
        return {};
    }
};
struct LeastBatchedPredictingOracle : LeastBatchedOracle {
    template <class R>
    LeastLikelihood likely_visible(const R&) const {
        return {};
    }
};

/// Answer that a light is visible if rays to it start on its side of the plane z = 0.
struct LeastBlade : private Pinned {
    LeastBlade() : Pinned(0) {}
    template <class R, class L>
    bool operator()(const R& receiver, const L& light) const {
        return (receiver.shadow_origin.z > 0.0f) == (position_or_direction(light).z > 0.0f);
    }
};
struct LeastBatchedBlade : private Pinned {
    LeastBatchedBlade() : Pinned(0) {}
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            answers[i] = (queries[i].from.z > 0.0f) == (queries[i].to.z > 0.0f) ? 1.0f : 0.0f;
        }
    }
};

/// One stage, one bound: infinity unless the light is alone.
struct LeastPolicy {
    static constexpr bool two_stages = false;
    template <class B, Light L>
    spectrum_of<L> quick(const B&, const LightCluster<L>&, const Box&) const {
        return make_spectrum<spectrum_of<L>>([](int) { return std::numeric_limits<float>::infinity(); });
    }
};

}  // namespace lightcuts::test

template <>
struct lightcuts::vector_traits<lightcuts::test::OwnVector> {
    static float x(const lightcuts::test::OwnVector& v) { return v.at_[0]; }
    static float y(const lightcuts::test::OwnVector& v) { return v.at_[1]; }
    static float z(const lightcuts::test::OwnVector& v) { return v.at_[2]; }
};

template <>
struct lightcuts::light_traits<lightcuts::test::ForeignLight> {
    using L = lightcuts::test::ForeignLight;
    static const lightcuts::test::OwnVector& position(const L& l) { return l.where_; }
    static const lightcuts::test::OwnVector& axis(const L& l) { return l.forward_; }
    static const lightcuts::test::Bands& intensity(const L& l) { return l.watts_; }
    static float emission(const L&, float cosine) { return cosine > 0.0f ? cosine * cosine : 0.0f; }
    static float emission_bound(float, float cos_max) { return cos_max > 0.0f ? cos_max * cos_max : 0.0f; }
    static float falloff(const L&, float distance) { return 1.0f / (1.0f + distance); }
    static float falloff_bound(float min_distance) { return 1.0f / (1.0f + min_distance); }
};
