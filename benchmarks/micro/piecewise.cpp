/// Functions on a tree against what else one may represent and multiply functions by: Eigen's sparse vectors, a tree of
/// pairwise merges, a loop over a std::priority_queue, Haar wavelets on a cube map. Prints all and writes
/// piecewise.json.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <queue>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/SparseCore>
#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include <lightcuts/piecewise/gain.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/validate.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "haar.hpp"
#include "timing.hpp"

namespace {

using namespace lightcuts;
using Function = PiecewiseConstant<float>;
using Random = std::mt19937_64;

double unit(Random& random) { return uniform01(random()); }

/// Random refinement of a cut to so many pieces.
Function random_function(const ClusterTree& tree, Random& random, std::size_t size, std::vector<std::uint32_t> nodes) {
    while (nodes.size() < size) {
        std::uint32_t& n = nodes[random() % nodes.size()];
        if (tree.is_leaf(n)) continue;
        const std::uint32_t right = tree.right(n);
        n = tree.left(n);
        nodes.push_back(right);
    }
    std::sort(nodes.begin(), nodes.end());
    std::vector<float> values;
    for (std::size_t i = 0; i < size; ++i) values.push_back(static_cast<float>(unit(random)));
    Function f;
    assign<float>(tree, nodes, values, f);
    return f;
}

ClusterTree sphere_tree(std::uint32_t directions) {
    std::vector<PointItem> items;
    for (std::uint32_t i = 0; i < directions; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / directions, phi = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
        items.push_back({glm::vec3(r * std::cos(phi), r * std::sin(phi), z), 1.0f});
    }
    return divide(items, LongestAxis{});
}

/// Nanoseconds that `each(i)`, which returns how many units it did, takes a unit: medians over runs.
template <class F>
double nanoseconds(int runs, int count, const F& each) {
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        double units = 0;
        const double spent = benchmark::seconds([&] {
            for (int i = 0; i < count; ++i) units += static_cast<double>(each(i));
        });
        times.push_back(1e9 * spent / units);
    }
    return benchmark::median(times);
}

double sink = 0;  // so that nothing is left out

template <std::size_t... k>
std::size_t merge_some(const std::vector<Function>& f, int first, std::index_sequence<k...>) {
    std::size_t nodes = 0;
    double sum = 0;
    merge(
        [&](std::uint32_t, std::uint32_t leaves, auto... values) {
            ++nodes;
            sum += static_cast<double>(leaves) * static_cast<double>((values * ...));
        },
        f[(static_cast<std::size_t>(first) + k) % f.size()]...);
    sink += sum;
    return nodes;
}

/// The product of eight functions in one pass, over that of pairs, of these, and of these.
nlohmann::json against_pairs(const char* what, const std::vector<Function>& f, int runs) {
    const auto count = static_cast<int>(f.size());
    Function out, a[4], b[2];
    const auto at = [&](int i) -> const Function& { return f[static_cast<std::size_t>(i % count)]; };
    const double one = nanoseconds(runs, count, [&](int i) {
        product(out, at(i), at(i + 1), at(i + 2), at(i + 3), at(i + 4), at(i + 5), at(i + 6), at(i + 7));
        return 1;
    });
    const double fold = nanoseconds(runs, count, [&](int i) {
        merge_some(f, i, std::make_index_sequence<8>{});
        return 1;
    });
    const double pairs = nanoseconds(runs, count, [&](int i) {
        for (int k = 0; k < 4; ++k) product(a[k], at(i + 2 * k), at(i + 2 * k + 1));
        for (int k = 0; k < 2; ++k) product(b[k], a[2 * k], a[2 * k + 1]);
        product(out, b[0], b[1]);
        return 1;
    });
    // In storage of their own each time.
    const double fresh = nanoseconds(runs, count, [&](int i) {
        Function c[4], d[2], e;
        for (int k = 0; k < 4; ++k) product(c[k], at(i + 2 * k), at(i + 2 * k + 1));
        for (int k = 0; k < 2; ++k) product(d[k], c[2 * k], c[2 * k + 1]);
        product(e, d[0], d[1]);
        sink += static_cast<double>(e.size());
        return 1;
    });
    std::printf(
        "8 %s at once over a tree of pairs: as a new function %.2f, folded %.2f; if pairs allocate, %.2f, %.2f\n", what,
        one / pairs, fold / pairs, one / fresh, fold / fresh);
    return {{"product", one / pairs},
            {"fold", fold / pairs},
            {"product_over_allocating", one / fresh},
            {"fold_over_allocating", fold / fresh}};
}

nlohmann::json merging(int runs) {
    constexpr std::size_t size = 256;
    constexpr int count = 256;
    Random random(1);
    const ClusterTree tree = sphere_tree(32768);
    std::vector<Function> f;
    std::vector<Eigen::SparseVector<float>> sparse;
    for (int i = 0; i < count; ++i) {
        f.push_back(random_function(tree, random, size, {tree.root()}));
        std::vector<int> support;
        while (support.size() < size) {
            support.push_back(static_cast<int>(random() % tree.size()));
            std::sort(support.begin(), support.end());
            support.erase(std::unique(support.begin(), support.end()), support.end());
        }
        Eigen::SparseVector<float> v(static_cast<int>(tree.size()));
        for (const int at : support) v.insert(at) = static_cast<float>(unit(random));
        sparse.push_back(v);
    }
    const auto dot = [&](int i, int j) {
        sink += static_cast<double>(sparse[static_cast<std::size_t>(i)].dot(sparse[static_cast<std::size_t>(j)]));
        return 2 * size;
    };
    nlohmann::json result;
    const double eigen = nanoseconds(runs, count, [&](int i) { return dot(i, (i + 1) % count); });
    const double same = nanoseconds(runs, count, [&](int i) { return dot(i, i) / 2; });
    std::printf("Eigen's sparse dot: %.2f ns a non-zero on random supports, %.2f on identical ones\n", eigen, same);
    result["eigen_random_ns"] = eigen;
    result["eigen_identical_ns"] = same;
    const auto report = [&](const char* n, double ns) {
        std::printf("merge of %s: %.2f ns a node, %.2f of Eigen's\n", n, ns, ns / eigen);
        result[std::string("merge_ns_") + n] = ns;
    };
    report("2", nanoseconds(runs, count, [&](int i) { return merge_some(f, i, std::make_index_sequence<2>{}); }));
    report("3", nanoseconds(runs, count, [&](int i) { return merge_some(f, i, std::make_index_sequence<3>{}); }));
    report("4", nanoseconds(runs, count, [&](int i) { return merge_some(f, i, std::make_index_sequence<4>{}); }));
    report("8", nanoseconds(runs, count, [&](int i) { return merge_some(f, i, std::make_index_sequence<8>{}); }));
    report("2_of_one_cut", nanoseconds(runs, count, [&](int i) {
               const Function& g = f[static_cast<std::size_t>(i)];
               sink += sum_of_products(g, g);
               return g.size();
           }));
    MergeScratch<float> scratch;
    report("8_dynamic", nanoseconds(runs, count - 8, [&](int i) {
               std::size_t nodes = 0;
               merge(std::span<const Function>(f).subspan(static_cast<std::size_t>(i), 8), scratch,
                     [&](std::uint32_t, std::uint32_t leaves, std::span<const float> values) {
                         float product = 1;
                         for (const float v : values) product *= v;
                         sink += static_cast<double>(leaves) * static_cast<double>(product);
                         ++nodes;
                     });
               return nodes;
           }));
    result["eight_of_random_cuts"] = against_pairs("of random cuts", f, runs);
    // As those of neighboring vertices are.
    std::vector<Function> similar;
    std::vector<std::uint32_t> common;
    for (const Piece& p : f[0].pieces()) common.push_back(p.node());
    for (int i = 0; i < count; ++i) similar.push_back(random_function(tree, random, size + 16, common));
    result["eight_of_similar_cuts"] = against_pairs("of similar cuts", similar, runs);

    // Bounds of errors.
    std::vector<Function> means;
    std::vector<std::vector<Moments<1>>> of;
    for (int i = 0; i < 16; ++i) {
        of.push_back(moments(tree, [&](std::uint32_t) { return static_cast<float>(unit(random)); }));
        OrderedApproximation<float> ordered;
        ordered.start(tree, of.back());
        ordered.refine_by_error(0.0, size);
        ordered.store(means.emplace_back(), true);
    }
    const auto pair_of = [&](int i) -> const Function& { return means[static_cast<std::size_t>(i) % means.size()]; };
    const double plain = nanoseconds(runs, 256, [&](int i) {
        sink += sum_of_products(pair_of(i), pair_of(i + 1), pair_of(i + 2));
        return 1;
    });
    const double bounded = nanoseconds(runs, 256, [&](int i) {
        sink += bounded_product(pair_of(i), pair_of(i + 1), pair_of(i + 2)).error_bound;
        return 1;
    });
    std::printf("three factors with a bound of the error: %.1f times the time without\n", bounded / plain);
    result["bounded_over_plain"] = bounded / plain;
    return result;
}

/// Largest error first, one at a time, until nothing but leaves is left.
nlohmann::json ordering(int runs) {
    Random random(2);
    const ClusterTree tree = sphere_tree(65536);
    const auto of = moments(tree, [&](std::uint32_t) { return static_cast<float>(unit(random)); });
    OrderedApproximation<float> ordered;
    const double ours = nanoseconds(runs, 1, [&](int) {
        ordered.start(tree, of);
        ordered.refine_by_error(0.0);
        return ordered.size() - 1;
    });
    const double queue = nanoseconds(runs, 1, [&](int) {
        std::priority_queue<std::pair<double, std::uint32_t>> nodes;
        nodes.push({of.back().squared_deviation[0], tree.root()});
        std::size_t splits = 0;
        while (!nodes.empty()) {
            const std::uint32_t n = nodes.top().second;
            nodes.pop();
            ++splits;
            for (const std::uint32_t child : {tree.left(n), tree.right(n)}) {
                if (!tree.is_leaf(child)) nodes.push({of[child].squared_deviation[0], child});
            }
        }
        return splits;
    });
    std::printf("ordered refinement of 65,536 leaves: %.0f ns a split, %.2f of a std::priority_queue's\n", ours,
                ours / queue);
    return {{"ordered_split_ns", ours}, {"ordered_over_queue", ours / queue}};
}

constexpr std::size_t side = 128;

/// The direction of a texel.
glm::dvec3 direction(std::size_t texel) {
    const std::size_t face = texel / (side * side), y = texel / side % side, x = texel % side;
    const double u = (2.0 * static_cast<double>(x) + 1.0) / side - 1.0,
                 v = (2.0 * static_cast<double>(y) + 1.0) / side - 1.0;
    const glm::dvec3 of_axis[]{{1, u, v}, {-1, u, v}, {u, 1, v}, {u, -1, v}, {u, v, 1}, {u, v, -1}};
    return glm::normalize(of_axis[face]);
}

/// Each face halved along its longer side, down to texels: items are texels.
ClusterTree cube_tree() {
    std::vector<std::uint32_t> words;
    struct Part {
        std::size_t face, x, y, width, height;
    };
    const auto build = [&](const auto& self, const Part& p) -> void {
        if (p.width == 1 && p.height == 1) {
            words.push_back(ClusterTree::leaf_word(static_cast<std::uint32_t>((p.face * side + p.y) * side + p.x)));
            return;
        }
        const auto first = static_cast<std::uint32_t>(words.size());
        if (p.width >= p.height) {
            self(self, {p.face, p.x, p.y, p.width / 2, p.height});
            self(self, {p.face, p.x + p.width / 2, p.y, p.width / 2, p.height});
        } else {
            self(self, {p.face, p.x, p.y, p.width, p.height / 2});
            self(self, {p.face, p.x, p.y + p.height / 2, p.width, p.height / 2});
        }
        words.push_back(first);
    };
    for (std::size_t face = 0; face < 6; ++face) {
        build(build, {face, 0, 0, side, side});
        if (face > 0) words.push_back(0);  // above all so far
    }
    ClusterTree tree(std::move(words));
    validate(tree);
    return tree;
}

/// Visibility from a point among balls, over the ground.
std::vector<float> visibility(Random& random) {
    std::vector<std::pair<glm::dvec3, double>> balls;
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 at(8 * unit(random) - 4, 8 * unit(random) - 4, 4 * unit(random));
        balls.push_back({at, 0.3 + 0.7 * unit(random)});
    }
    std::vector<float> texels;
    for (std::size_t t = 0; t < 6 * side * side; ++t) {
        const glm::dvec3 d = direction(t);
        bool is_free = d.z > 0;
        for (const auto& [center, radius] : balls) {
            const double along = glm::dot(center, d), distance2 = glm::dot(center, center);
            is_free = is_free &&
                      !(distance2 > radius * radius && along > 0 && distance2 - along * along < radius * radius);
        }
        texels.push_back(is_free ? 1.0f : 0.0f);
    }
    return texels;
}

std::vector<float> lobe(const glm::dvec3& axis, double exponent, double floor) {
    std::vector<float> texels;
    for (std::size_t t = 0; t < 6 * side * side; ++t) {
        const double cosine = std::max(0.0, glm::dot(direction(t), axis));
        texels.push_back(static_cast<float>(floor + std::pow(cosine, exponent)));
    }
    return texels;
}

double distance(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
    }
    return std::sqrt(sum);
}

nlohmann::json wavelets(int runs) {
    Random random(3);
    const ClusterTree tree = cube_tree();
    const auto cut_of = [&](const std::vector<float>& texels, double error, Function& out) {
        const auto of = moments(tree, [&](std::uint32_t i) { return texels[i]; });
        OrderedApproximation<float> ordered;
        ordered.start(tree, of);
        const auto gain = gains(tree, of);
        ordered.refine_to_total_error(error, [&](std::uint32_t n) { return gain[n]; });
        ordered.store(out);
    };
    const double texel_count = 6.0 * side * side;
    nlohmann::json result;
    std::printf("visibility on a 6 x %zu x %zu cube map\n%10s %10s %10s %10s\n", side, side, "RMS", "cut", "Haar",
                "ratio");
    for (const double rms : {0.15, 0.1, 0.075, 0.05}) {
        double pieces = 0, terms = 0;
        for (int view = 0; view < 10; ++view) {
            const auto texels = visibility(random);
            Function f;
            const double error = rms * std::sqrt(texel_count);
            cut_of(texels, error, f);
            const benchmark::HaarCube haar(side, texels, error);
            if (distance(haar.texels(), texels) > 1.001 * error) throw std::runtime_error("the wavelets are wrong");
            pieces += static_cast<double>(f.size());
            terms += static_cast<double>(haar.terms());
        }
        std::printf("%10.3f %10.0f %10.0f %10.2f\n", rms, pieces / 10, terms / 10, pieces / terms);
        result["terms"].push_back({{"rms", rms}, {"cut", pieces / 10}, {"haar", terms / 10}});
    }
    // Visibility times a sky with a sun times a glossy lobe, each to the same share of its own norm.
    std::printf("triple product, each factor within a share of its norm\n%10s %10s %10s %10s %12s %12s\n", "share",
                "cut, ns", "Haar, ns", "speed-up", "cut, error", "Haar, error");
    for (const double share : {0.2, 0.1, 0.05}) {
        double cut_error = 0, haar_error = 0;
        std::vector<Function> f;
        std::vector<benchmark::HaarCube> h;
        constexpr int count = 20;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 sun = glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, 0.6));
            const glm::dvec3 axis = glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, 0.7));
            const std::vector<float> factors[]{visibility(random), lobe(sun, 200.0, 0.02), lobe(axis, 20.0, 0.0)};
            double exact = 0;
            for (std::size_t t = 0; t < factors[0].size(); ++t) {
                exact += static_cast<double>(factors[0][t]) * static_cast<double>(factors[1][t]) *
                         static_cast<double>(factors[2][t]);
            }
            for (const auto& texels : factors) {
                const double error = share * distance(texels, std::vector<float>(texels.size(), 0.0f));
                cut_of(texels, error, f.emplace_back());
                h.emplace_back(side, texels, error);
            }
            const std::size_t k = f.size() - 3;
            const double norm = exact + 1.0;
            cut_error += std::abs(sum_of_products(f[k], f[k + 1], f[k + 2]) - exact) / norm / count;
            haar_error += std::abs(benchmark::HaarCube::sum_of_products(h[k], h[k + 1], h[k + 2]) - exact) / norm /
                          count;
        }
        const double ours = nanoseconds(runs, count, [&](int i) {
            const auto k = static_cast<std::size_t>(3 * i);
            sink += sum_of_products(f[k], f[k + 1], f[k + 2]);
            return 1;
        });
        const double theirs = nanoseconds(runs, count, [&](int i) {
            const auto k = static_cast<std::size_t>(3 * i);
            sink += benchmark::HaarCube::sum_of_products(h[k], h[k + 1], h[k + 2]);
            return 1;
        });
        std::printf("%10.2f %10.0f %10.0f %10.1f %10.2f %% %10.2f %%\n", share, ours, theirs, theirs / ours,
                    100 * cut_error, 100 * haar_error);
        result["triple"].push_back({{"share", share},
                                    {"cut_ns", ours},
                                    {"haar_ns", theirs},
                                    {"cut_error", cut_error},
                                    {"haar_error", haar_error}});
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    int runs = 21;
    CLI::App app{"Functions on a tree against sparse vectors, a priority queue and wavelets"};
    app.add_option("--runs", runs, "medians are over this odd number")->check(benchmark::odd_number());
    CLI11_PARSE(app, argc, argv);
    return benchmark::write_figures("bench-piecewise", "piecewise.json", [&] {
        nlohmann::json result{{"merging", merging(runs)}, {"ordering", ordering(runs)}, {"wavelets", wavelets(runs)}};
        result["sink"] = sink;
        return result;
    });
}
