/// Functions on a tree against what else one may represent and multiply functions by: Eigen's sparse vectors, a tree of
/// pairwise merges, a loop over a std::priority_queue, Haar wavelets, spherical harmonics, patches of the sky. Prints
/// all and writes piecewise.json.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <queue>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/SparseCore>
#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "function_peers.hpp"
#include "timing.hpp"

namespace {

using namespace lightcuts;
using benchmark::nanoseconds;
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
    std::printf("three factors with a bound of the error: %.0f ns, %.1f times the %.0f without\n", bounded,
                bounded / plain, plain);
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

}  // namespace

int main(int argc, char** argv) {
    int runs = 21;
    CLI::App app{"Functions on a tree against sparse vectors, a priority queue, wavelets, harmonics and patches"};
    app.add_option("--runs", runs, "medians are over this odd number")->check(benchmark::odd_number());
    CLI11_PARSE(app, argc, argv);
    return benchmark::write_figures("bench-piecewise", "piecewise.json", [&] {
        nlohmann::json result{
            {"merging", merging(runs)}, {"ordering", ordering(runs)}, {"peers", benchmark::function_peers(runs)}};
        result["sink"] = sink;
        return result;
    });
}
