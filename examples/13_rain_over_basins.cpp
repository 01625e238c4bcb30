// Functions over a tree that has nothing to do with light: how much water a storm brings to a river. The river's basin
// is divided into those of its tributaries, and so on down to cells of one square kilometer. Rain and ground are kept
// as cuts, coarse where they hardly vary, and multiplied without ever being spread out over the cells.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include <lightcuts/tree/validate.hpp>

namespace {

// A basin has two to five tributaries; the array is in post-order, each basin after all that flows into it.
void add_basin(std::uint32_t first_cell, std::uint32_t cells, std::mt19937& random, std::vector<std::uint32_t>& words) {
    if (cells == 1) {
        words.push_back(lightcuts::ClusterTree::leaf_word(first_cell));
        return;
    }
    const auto first_node = static_cast<std::uint32_t>(words.size());
    const std::uint32_t end = first_cell + cells;
    for (std::uint32_t left = std::min<std::uint32_t>(cells, 2 + random() % 4); left > 0; --left) {
        const std::uint32_t share = left == 1 ? end - first_cell
                                              : std::max<std::uint32_t>(1, (end - first_cell) / left);
        add_basin(first_cell, share, random, words);
        first_cell += share;
    }
    words.push_back(first_node);
}

}  // namespace

int main() {
    constexpr std::uint32_t cells = 20'000;
    std::mt19937 random(1);
    std::vector<std::uint32_t> words;
    add_basin(0, cells, random, words);
    const lightcuts::ClusterTree river(words);
    lightcuts::validate(river);  // our own tree: better asked once

    // Three forecasts of a storm in mm, dry but for a front; the part of the rain that runs off, high in towns.
    const auto rain = [](std::uint32_t cell, double front) {
        const double x = (cell - front) / 1500.0;
        return static_cast<float>(std::max(0.0, 40.0 * std::exp(-x * x) - 1.0));
    };
    const auto runoff = [](std::uint32_t cell) {
        return cell / 250 % 9 == 0 ? 0.9f : 0.15f + 0.05f * std::sin(static_cast<float>(cell) / 900.0f);
    };
    const double fronts[] = {7000.0, 7600.0, 8300.0};
    std::vector<lightcuts::PiecewiseConstant<float>> forecasts(3);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto moments = lightcuts::moments(river, [&](std::uint32_t cell) { return rain(cell, fronts[i]); });
        lightcuts::approximate(river, moments, 15.0, forecasts[i], true);  // each node within 15 mm in L2
    }
    const auto ground_moments = lightcuts::moments(river, runoff);
    lightcuts::PiecewiseConstant<float> ground;
    lightcuts::approximate(river, ground_moments, 0.3, ground, true);

    // How much arrives of each forecast, and how far that may be from the sum over all cells.
    bool is_good = true;
    std::printf("forecast  pieces   1000 m3   certainly within   in fact within\n");
    for (std::size_t i = 0; i < 3; ++i) {
        const lightcuts::BoundedSum water = lightcuts::bounded_product(ground, forecasts[i]);
        double exact = 0.0;
        for (std::uint32_t cell = 0; cell < cells; ++cell) {
            exact += static_cast<double>(rain(cell, fronts[i])) * static_cast<double>(runoff(cell));
        }
        const double error = std::abs(water.value - exact);
        std::printf("%8zu %7zu %9.0f %16.2f %% %14.3f %%\n", i, forecasts[i].size(), water.value,
                    100.0 * water.error_bound / exact, 100.0 * error / exact);
        is_good = is_good && error <= water.error_bound && water.error_bound < 0.1 * exact;
    }

    // The forecasts weighted, a function of its own; and the most that any of them brings, by a rule of one's own.
    const float weights[] = {0.5f, 0.3f, 0.2f};
    lightcuts::MergeScratch<float> scratch;
    lightcuts::PiecewiseConstant<float> expected;
    lightcuts::interpolate(expected, std::span<const float>(weights),
                           std::span<const lightcuts::PiecewiseConstant<float>>(forecasts), scratch);
    const double mean = lightcuts::sum_of_products(ground, expected);
    const double worst = lightcuts::sum_over_leaves(
        [](float share, float a, float b, float c) {
            return share * std::max({a, b, c});
        },
        ground, forecasts[0], forecasts[1], forecasts[2]);
    std::printf("expected %.0f, if the worst came to each cell %.0f, from %zu pieces for %u cells\n", mean, worst,
                expected.size(), cells);
    return is_good && worst > mean && expected.size() < cells / 20 ? 0 : 1;
}
