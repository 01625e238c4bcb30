#pragma once

#include <concepts>
#include <limits>

#include <glm/vec3.hpp>

namespace lightcuts {

/// How the library reads the channels of a spectrum type.
///
/// The primary template serves types that state `static constexpr int channels` and index with `operator[]`.
/// Specialize it (same two members) for a type that cannot be edited.
template <class S>
struct spectrum_traits {};

template <std::floating_point S>
struct spectrum_traits<S> {
    static constexpr int channels = 1;
    static constexpr float channel(const S& s, int) { return static_cast<float>(s); }
    static constexpr void set(S& s, int, float value) { s = value; }
};

template <>
struct spectrum_traits<glm::vec3> {
    static constexpr int channels = 3;
    // GLM's own index operator is a switch that compilers leave as a call.
    static constexpr float channel(const glm::vec3& s, int i) { return i == 0 ? s.x : i == 1 ? s.y : s.z; }
    static constexpr void set(glm::vec3& s, int i, float value) { (i == 0 ? s.x : i == 1 ? s.y : s.z) = value; }
};

template <class S>
    requires requires(S s, int i) {
        { S::channels } -> std::convertible_to<int>;
        { s[i] } -> std::convertible_to<float>;
    }
struct spectrum_traits<S> {
    static constexpr int channels = S::channels;
    static constexpr float channel(const S& s, int i) { return s[i]; }
    static constexpr void set(S& s, int i, float value) { s[i] = value; }
};

/// A quantity of light per channel: `float`, `glm::vec3`, or a user's N bands. `+` and `*` work channel by channel; `*`
/// by a float scales. `S s;` may leave the channels as they are: darkness is `black<S>()`, which sets them. Copies are
/// made and assigned; what `operator=` returns does not matter.
template <class S>
concept Spectrum = std::copy_constructible<S> && std::default_initializable<S> &&
    requires(S a, const S b, float k, int i) {
    a = b;
    { b + b } -> std::convertible_to<S>;
    { b* b } -> std::convertible_to<S>;
    { b* k } -> std::convertible_to<S>;
    { spectrum_traits<S>::channels } -> std::convertible_to<int>;
    { spectrum_traits<S>::channel(b, i) } -> std::convertible_to<float>;
    spectrum_traits<S>::set(a, i, k);
};

/// Number of channels of `S`.
template <Spectrum S>
inline constexpr int channels_of = spectrum_traits<S>::channels;

template <Spectrum S>
constexpr float channel(const S& s, int i) {
    return spectrum_traits<S>::channel(s, i);
}

/// The spectrum whose channel i is `f(i)`.
template <Spectrum S, class F>
constexpr S make_spectrum(F&& f) {
    S s{};
    for (int i = 0; i < channels_of<S>; ++i) spectrum_traits<S>::set(s, i, static_cast<float>(f(i)));
    return s;
}

/// Darkness: every channel is zero, whatever the default constructor of `S` leaves there.
template <Spectrum S>
constexpr S black() {
    return make_spectrum<S>([](int) { return 0.0f; });
}

/// Sum of the channels: the scalar by which lights and clusters are weighted.
template <Spectrum S>
constexpr double channel_sum(const S& s) {
    double sum = 0;
    for (int i = 0; i < channels_of<S>; ++i) sum += static_cast<double>(channel(s, i));
    return sum;
}

/// Largest channel.
template <Spectrum S>
constexpr float channel_max(const S& s) {
    float largest = channel(s, 0);
    for (int i = 1; i < channels_of<S>; ++i) {
        const float c = channel(s, i);
        largest = c > largest ? c : largest;
    }
    return largest;
}

/// Of each channel the larger one.
template <Spectrum S>
constexpr S larger_channels(const S& a, const S& b) {
    return make_spectrum<S>([&](int i) {
        const float x = channel(a, i), y = channel(b, i);
        return x > y ? x : y;
    });
}

/// Of each channel the smaller one; that of `a` where `b` is no number.
template <Spectrum S>
constexpr S smaller_channels(const S& a, const S& b) {
    return make_spectrum<S>([&](int i) {
        const float x = channel(a, i), y = channel(b, i);
        return y < x ? y : x;
    });
}

/// True iff every channel is exactly zero.
template <Spectrum S>
constexpr bool is_black(const S& s) {
    for (int i = 0; i < channels_of<S>; ++i) {
        if (channel(s, i) != 0.0f) return false;
    }
    return true;
}

namespace detail {

/// Finite if every channel is, with room to spare; infinite or NaN if one is.
template <Spectrum S>
constexpr float rough_sum(const S& s) {
    float sum = channel(s, 0);
    for (int i = 1; i < channels_of<S>; ++i) sum += channel(s, i);
    return sum;
}

/// True if a channel may be the largest float, in place of a larger number.
template <Spectrum S>
constexpr bool is_saturated(const S& s) {
    return !(rough_sum(s) < (std::numeric_limits<float>::max)());
}

}  // namespace detail

/// `s` with no channel above the largest float, so that a product with zero stays zero.
template <Spectrum S>
[[gnu::always_inline]] constexpr S finite(const S& s) {
    constexpr float largest = (std::numeric_limits<float>::max)();
    if (detail::rough_sum(s) <= largest) return s;
    return make_spectrum<S>([&](int i) {
        const float c = channel(s, i);
        return c < largest ? c : largest;
    });
}

namespace detail {

/// `finite_product` where a product exceeds the largest float or is no number.
template <Spectrum S>
[[gnu::noinline]] constexpr S saturated_product(const S& a, const S& b) {
    return make_spectrum<S>([&](int i) {
        constexpr float largest = (std::numeric_limits<float>::max)();
        const float x = channel(a, i), y = channel(b, i);
        if (!(x > 0.0f && y > 0.0f)) return 0.0f;
        return x * y < largest ? x * y : largest;
    });
}

}  // namespace detail

/// Channel-wise a * b for a, b >= 0, with 0 * infinity = 0 and no channel above the largest float.
template <Spectrum S>
[[gnu::always_inline]] constexpr S finite_product(const S& a, const S& b) {
    const S product = a * b;
    if (detail::rough_sum(product) <= (std::numeric_limits<float>::max)()) [[likely]]
        return product;
    return detail::saturated_product(a, b);
}

}  // namespace lightcuts
