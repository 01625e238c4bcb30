#pragma once

#include <optional>

namespace relight {

/// How coarse pictures have to be while something moves, for each to take at most `most_seconds`: a picture of divisor
/// d has a d-th of the columns and rows. The time of a picture is taken to be proportional to its pixels.
class Pace {
public:
    static constexpr int coarsest = 16;
    static constexpr double most_seconds = 0.1;

    /// Of the next picture while something moves, where that of divisor 1 has so many pixels: 1, 2, 4, 8 or 16, the
    /// finest that is fast enough by the last time that is known; 4 before there is one.
    int divisor(double pixels) const {
        if (!seconds_per_pixel_) return 4;
        const double whole = pixels * seconds_per_pixel_.value();
        int divisor = 1;
        while (divisor < coarsest && whole > most_seconds * divisor * divisor) divisor *= 2;
        return divisor;
    }

    /// A picture of so many pixels, after something had moved, took so long, or was given up after so long.
    void took(double pixels, double seconds) { seconds_per_pixel_ = seconds / pixels; }

    /// Of the picture that follows one of `divisor` when nothing has moved; 1 after the finest but one.
    static int finer(int divisor) { return divisor > 4 ? divisor / 4 : 1; }

private:
    std::optional<double> seconds_per_pixel_;
};

}  // namespace relight
