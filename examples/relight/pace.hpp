#pragma once

namespace relight {

/// How coarse pictures have to be while something moves, for each to take at most about a tenth of a second: a picture
/// of divisor d has a d-th of the columns and rows.
class Pace {
public:
    static constexpr int coarsest = 16;

    /// Of the next picture while something moves: 1, 2, 4, 8 or 16.
    int divisor() const { return divisor_; }

    /// A picture of this divisor took so long. Too long makes the next ones coarser, a third of that time finer.
    void took(double seconds) {
        if (seconds > most_seconds && divisor_ < coarsest) {
            divisor_ *= 2;
        } else if (seconds < most_seconds / 3.0 && divisor_ > 1) {
            divisor_ /= 2;
        }
    }

    /// Of the picture that follows one of `divisor` when nothing has moved; 1 after the finest but one.
    static int finer(int divisor) { return divisor > 4 ? divisor / 4 : 1; }

private:
    static constexpr double most_seconds = 0.1;

    int divisor_ = 4;
};

}  // namespace relight
