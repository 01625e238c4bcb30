#include "function_peers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <daylight/reinhart_patches.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/gain.hpp>

#include "cube_map.hpp"
#include "error_sum.hpp"
#include "haar.hpp"
#include "spherical_harmonics.hpp"
#include "timing.hpp"

namespace benchmark {
namespace {

using Cut = lightcuts::PiecewiseConstant<float>;
using Texels = std::vector<float>;
using Random = std::mt19937_64;
using daylighting::ReinhartPatches;

constexpr std::size_t side = 128;
constexpr int most_order = 96;     // of spherical harmonics
constexpr int most_division = 24;  // of patches
constexpr std::array divisions = {1, 2, 4};

double unit(Random& random) { return lightcuts::uniform01(random()); }

double norm(const Texels& a) {
    double sum = 0;
    for (const float v : a) sum += static_cast<double>(v) * static_cast<double>(v);
    return std::sqrt(sum);
}

double distance(const Texels& a, const Texels& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
    }
    return std::sqrt(sum);
}

double exact_sum(std::initializer_list<const Texels*> factors) {
    double sum = 0;
    for (std::size_t t = 0; t < (*factors.begin())->size(); ++t) {
        double product = 1;
        for (const Texels* f : factors) product *= static_cast<double>((*f)[t]);
        sum += product;
    }
    return sum;
}

/// Coefficients in an orthonormal basis: the sum of a product is their dot product.
double dot(const std::vector<float>& a, const std::vector<float>& b) {
    const auto size = static_cast<Eigen::Index>(std::min(a.size(), b.size()));
    return static_cast<double>(
        Eigen::Map<const Eigen::VectorXf>(a.data(), size).dot(Eigen::Map<const Eigen::VectorXf>(b.data(), size)));
}

/// The L2 error of an orthonormal projection that has `kept` of a function's norm.
double left_error(double whole, double kept) { return std::sqrt(std::max(0.0, whole * whole - kept)); }

double sum_of_squares(std::span<const float> a) {
    double sum = 0;
    for (const float v : a) sum += static_cast<double>(v) * static_cast<double>(v);
    return sum;
}

/// Functions on the sphere and what represents them.
class Peers {
public:
    Peers() : map_(side), tree_(map_.tree()) {
        for (int division = 1; division <= most_division; ++division) {
            const ReinhartPatches patches(division);
            std::vector<std::uint32_t>& of = patch_of_.emplace_back();
            for (const glm::dvec3& d : map_.directions()) of.push_back(patches.of(d));
        }
    }

    std::size_t texel_count() const { return map_.directions().size(); }

    /// Visibility from a point among balls, over the ground.
    Texels visibility(Random& random) const {
        std::vector<std::pair<glm::dvec3, double>> balls;
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 at(8 * unit(random) - 4, 8 * unit(random) - 4, 4 * unit(random));
            balls.push_back({at, 0.3 + 0.7 * unit(random)});
        }
        Texels texels;
        for (const glm::dvec3& d : map_.directions()) {
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
    /// floor + cos^exponent of the angle to an axis, the cosine not below 0.
    Texels lobe(const glm::dvec3& axis, double exponent, double floor) const {
        Texels texels;
        for (const glm::dvec3& d : map_.directions()) {
            texels.push_back(static_cast<float>(floor + std::pow(std::max(0.0, glm::dot(d, axis)), exponent)));
        }
        return texels;
    }
    /// An axis near the zenith.
    static glm::dvec3 axis(Random& random, double up) {
        return glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, up));
    }

    /// The fewest pieces, about: to an L2 error or up to a size.
    Cut cut(const Texels& texels, double error,
            std::size_t most = lightcuts::OrderedApproximation<float>::unlimited) const {
        const auto of = lightcuts::moments(tree_, [&](std::uint32_t i) { return texels[i]; });
        lightcuts::OrderedApproximation<float> ordered;
        ordered.start(tree_, of);
        const auto gain = lightcuts::gains(tree_, of);
        ordered.refine_to_total_error(
            error, [&](std::uint32_t n) { return gain[n]; }, most);
        Cut result;
        ordered.store(result);
        return result;
    }
    /// At each node of the tree.
    std::vector<float> means(const Texels& texels) const {
        std::vector<float> result;
        for (const auto& m : lightcuts::moments(tree_, [&](std::uint32_t i) { return texels[i]; })) {
            result.push_back(m.value<float>());
        }
        return result;
    }
    Texels texels(const Cut& cut) const {
        Texels result(texel_count());
        std::uint32_t leaf = 0;
        std::vector<std::uint32_t> items;
        for (std::uint32_t n = 0; n < tree_.size(); ++n) {
            if (tree_.is_leaf(n)) items.push_back(tree_.item(n));
        }
        for (std::size_t i = 0; i < cut.size(); ++i) {
            for (; leaf < cut.pieces()[i].leaf_end(); ++leaf) result[items[leaf]] = cut.values()[i];
        }
        return result;
    }

    std::vector<std::vector<float>> harmonics(std::span<const Texels> functions, int order) const {
        return project(SphericalHarmonics(order), map_.directions(), functions);
    }
    Texels harmonic_texels(const std::vector<float>& coefficients, int order) const {
        return expand(SphericalHarmonics(order), map_.directions(), coefficients);
    }

    /// The L2 norm above the horizon: patches are of the sky, so that nothing else counts for them.
    double norm_above(const Texels& texels) const {
        double sum = 0;
        for (std::size_t t = 0; t < texels.size(); ++t) {
            if (patch_of_[0][t] != 0) sum += static_cast<double>(texels[t]) * static_cast<double>(texels[t]);
        }
        return std::sqrt(sum);
    }
    /// The L2 error above the horizon of what `patches` gives for a function.
    double patch_error(const Texels& texels, const std::vector<float>& means) const {
        return left_error(norm_above(texels), sum_of_squares(std::span(means).subspan(1)));
    }
    /// Means over patches times the roots of their texels' numbers, so that they are orthonormal.
    std::vector<float> patches(const Texels& texels, int division) const {
        const std::vector<std::uint32_t>& of = patch_of_[static_cast<std::size_t>(division - 1)];
        std::vector<double> sums(ReinhartPatches(division).size()), counts(sums.size());
        for (std::size_t t = 0; t < texels.size(); ++t) {
            sums[of[t]] += static_cast<double>(texels[t]);
            counts[of[t]] += 1;
        }
        std::vector<float> result;
        for (std::size_t p = 0; p < sums.size(); ++p) {
            result.push_back(static_cast<float>(counts[p] > 0 ? sums[p] / std::sqrt(counts[p]) : 0.0));
        }
        return result;
    }

private:
    CubeMap map_;
    lightcuts::ClusterTree tree_;
    std::vector<std::vector<std::uint32_t>> patch_of_;  ///< of each division, of each texel
};

/// The fewest harmonics, order by order, within an error; none if there are not enough.
std::optional<std::size_t> harmonics_within(const std::vector<float>& coefficients, double whole, double error) {
    for (std::size_t order = 1; order * order <= coefficients.size(); ++order) {
        const double kept = sum_of_squares(std::span(coefficients).first(order * order));
        if (left_error(whole, kept) <= error) return order * order;
    }
    return std::nullopt;
}

std::optional<std::size_t> patches_within(const Peers& peers, const Texels& texels, double error) {
    for (int division = 1; division <= most_division; ++division) {
        const std::vector<float> means = peers.patches(texels, division);
        if (peers.patch_error(texels, means) <= error) return means.size();
    }
    return std::nullopt;
}

/// The mean of what all have; none if one has none.
std::optional<double> mean(const std::vector<std::optional<std::size_t>>& values) {
    double sum = 0;
    for (const auto& v : values) {
        if (!v) return std::nullopt;
        sum += static_cast<double>(*v) / static_cast<double>(values.size());
    }
    return sum;
}

std::string shown(const std::optional<double>& value, std::size_t most) {
    char text[32];
    std::snprintf(text, sizeof text, "%s%.0f", value ? "" : "> ", value.value_or(static_cast<double>(most)));
    return text;
}

/// Terms of all that bring functions within errors. `absolute`: errors are root mean squares, else shares of a norm.
nlohmann::json terms_at_equal_error(const Peers& peers, const std::string& name, const std::vector<Texels>& functions,
                                    bool absolute, const std::vector<double>& errors) {
    const auto coefficients = peers.harmonics(functions, most_order);
    nlohmann::json rows;
    for (const double e : errors) {
        double pieces = 0, wavelets = 0;
        std::vector<std::optional<std::size_t>> harmonics, patches;
        for (std::size_t k = 0; k < functions.size(); ++k) {
            const Texels& f = functions[k];
            const double whole = norm(f);
            const double error = e * (absolute ? std::sqrt(static_cast<double>(f.size())) : whole);
            const HaarCube haar = HaarCube::within(side, f, error);
            if (distance(haar.texels(), f) > 1.001 * error) throw std::runtime_error("the wavelets are wrong");
            const auto n = static_cast<double>(functions.size());
            pieces += static_cast<double>(peers.cut(f, error).size()) / n;
            wavelets += static_cast<double>(haar.terms()) / n;
            harmonics.push_back(harmonics_within(coefficients[k], whole, error));
            patches.push_back(patches_within(peers, f, absolute ? error : e * peers.norm_above(f)));
        }
        const auto of_harmonics = mean(harmonics), of_patches = mean(patches);
        std::printf("%-22s %7.3f %9.0f %9.0f %9.2f %11s %11s\n", name.c_str(), e, pieces, wavelets, pieces / wavelets,
                    shown(of_harmonics, most_order * most_order).c_str(),
                    shown(of_patches, ReinhartPatches(most_division).size()).c_str());
        nlohmann::json row{
            {"function", name}, {"error", e}, {"absolute", absolute}, {"cut", pieces}, {"haar", wavelets}};
        if (of_harmonics) row["harmonics"] = *of_harmonics;
        if (of_patches) row["patches"] = *of_patches;
        rows.push_back(row);
    }
    return rows;
}

/// The sum over the texels of a cut times a function whose means at all nodes are known.
double sum_with_means(const Cut& cut, const std::vector<float>& means) {
    double sum = 0;
    for (std::size_t i = 0; i < cut.size(); ++i) {
        sum += static_cast<double>(cut.leaves(i)) *
               static_cast<double>(cut.values()[i] * means[cut.pieces()[i].node()]);
    }
    return sum;
}

double sink = 0;  // so that nothing is left out

/// Sums of products of two at equal terms, as many as patches have.
nlohmann::json pairs_at_equal_terms(const Peers& peers, const std::string& name, const std::vector<Texels>& first,
                                    const std::vector<Texels>& second, int runs) {
    std::vector<Texels> all = first;
    all.insert(all.end(), second.begin(), second.end());
    const std::size_t count = first.size();
    nlohmann::json rows;
    const auto report = [&](const char* peer, std::size_t terms, std::size_t bytes, double first_error,
                            double second_error, const auto& sum) {
        ErrorSum errors;
        for (std::size_t k = 0; k < count; ++k) errors.add(sum(k), exact_sum({&first[k], &second[k]}));
        const double ns = nanoseconds(runs, 20 * static_cast<int>(count), [&](int i) {
            sink += sum(static_cast<std::size_t>(i) % count);
            return 1;
        });
        std::printf("%-22s %-14s %6zu %8zu %9.2f %% %9.2f %% %9.3f %% %9.0f\n", name.c_str(), peer, terms, bytes,
                    100 * first_error, 100 * second_error, 100 * errors.relative(), ns);
        rows.push_back({{"functions", name},
                        {"peer", peer},
                        {"terms", terms},
                        {"bytes", bytes},
                        {"first_error", first_error},
                        {"second_error", second_error},
                        {"sum_error", errors.relative()},
                        {"ns", ns}});
    };
    // The mean, over functions, of errors as shares of norms.
    const auto share = [&](std::size_t begin, const auto& texels_of) {
        double sum = 0;
        for (std::size_t k = begin; k < begin + count; ++k) {
            sum += distance(texels_of(k), all[k]) / norm(all[k]) / static_cast<double>(count);
        }
        return sum;
    };
    std::vector<std::vector<float>> means;
    std::vector<HaarCube> all_wavelets;
    for (const Texels& g : second) {
        means.push_back(peers.means(g));
        all_wavelets.push_back(HaarCube::of_terms(side, g, g.size()));
    }
    for (const int division : divisions) {
        const std::size_t terms = ReinhartPatches(division).size();
        std::vector<Cut> cuts;
        std::vector<HaarCube> wavelets;
        std::vector<std::vector<float>> patches;
        for (const Texels& f : all) {
            cuts.push_back(peers.cut(f, 0.0, terms));
            wavelets.push_back(HaarCube::of_terms(side, f, terms));
            patches.push_back(peers.patches(f, division));
        }
        const int order = 12 * division;
        const auto harmonics = peers.harmonics(all, order);
        const auto cut_texels = [&](std::size_t k) { return peers.texels(cuts[k]); };
        report("cut", cuts[0].size(), cuts[0].size() * (sizeof(lightcuts::Piece) + sizeof(float)), share(0, cut_texels),
               share(count, cut_texels),
               [&](std::size_t k) { return lightcuts::sum_of_products(cuts[k], cuts[count + k]); });
        // A factor of which all is known besides: its means at the nodes of the tree, all of its wavelets.
        report("cut, means", cuts[0].size(), cuts[0].size() * (sizeof(lightcuts::Piece) + sizeof(float)),
               share(0, cut_texels), 0.0, [&](std::size_t k) { return sum_with_means(cuts[k], means[k]); });
        const auto wavelet_texels = [&](std::size_t k) { return wavelets[k].texels(); };
        report("wavelets", wavelets[0].terms(), wavelets[0].memory_bytes(), share(0, wavelet_texels),
               share(count, wavelet_texels),
               [&](std::size_t k) { return HaarCube::sum_of_products(wavelets[k], wavelets[count + k]); });
        report("wavelets, all", wavelets[0].terms(), wavelets[0].memory_bytes(), share(0, wavelet_texels), 0.0,
               [&](std::size_t k) { return HaarCube::sum_of_products(wavelets[k], all_wavelets[k]); });
        const auto harmonic_texels = [&](std::size_t k) { return peers.harmonic_texels(harmonics[k], order); };
        report("harmonics", harmonics[0].size(), harmonics[0].size() * sizeof(float), share(0, harmonic_texels),
               share(count, harmonic_texels), [&](std::size_t k) { return dot(harmonics[k], harmonics[count + k]); });
        const auto patch_share = [&](std::size_t begin) {
            double sum = 0;
            for (std::size_t k = begin; k < begin + count; ++k) {
                sum += peers.patch_error(all[k], patches[k]) / peers.norm_above(all[k]) / static_cast<double>(count);
            }
            return sum;
        };
        report("patches", patches[0].size(), patches[0].size() * sizeof(float), patch_share(0), patch_share(count),
               [&](std::size_t k) { return dot(patches[k], patches[count + k]); });
    }
    return rows;
}

/// Visibility times a sky with a sun times a glossy lobe: by cuts and wavelets, each factor to the same share of its
/// own norm; and by patches.
nlohmann::json triples(const Peers& peers, Random& random, int runs) {
    nlohmann::json rows;
    constexpr int count = 20;
    std::vector<std::array<Texels, 3>> all;
    std::vector<double> exact;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 sun = Peers::axis(random, 0.6), axis = Peers::axis(random, 0.7);
        all.push_back({peers.visibility(random), peers.lobe(sun, 200.0, 0.02), peers.lobe(axis, 20.0, 0.0)});
        exact.push_back(exact_sum({&all.back()[0], &all.back()[1], &all.back()[2]}));
    }
    std::printf("sums of triple products\n%-22s %9s %12s\n", "", "ns", "mean error");
    const auto report = [&](const std::string& name, const auto& sum) {
        double error = 0;
        for (std::size_t i = 0; i < all.size(); ++i) error += std::abs(sum(i) - exact[i]) / (exact[i] + 1.0) / count;
        const double ns = nanoseconds(runs, 5 * count, [&](int i) {
            sink += sum(static_cast<std::size_t>(i % count));
            return 1;
        });
        std::printf("%-22s %9.0f %10.2f %%\n", name.c_str(), ns, 100 * error);
        rows.push_back({{"peer", name}, {"ns", ns}, {"error", error}});
    };
    for (const double share : {0.2, 0.1, 0.05}) {
        std::vector<std::array<Cut, 3>> f;
        std::vector<std::vector<HaarCube>> h;
        for (const auto& factors : all) {
            f.emplace_back();
            h.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const double error = share * norm(factors[k]);
                f.back()[k] = peers.cut(factors[k], error);
                h.back().push_back(HaarCube::within(side, factors[k], error));
            }
        }
        char within[32];
        std::snprintf(within, sizeof within, " within %.0f %%", 100 * share);
        report(std::string("cuts") + within,
               [&](std::size_t i) { return lightcuts::sum_of_products(f[i][0], f[i][1], f[i][2]); });
        report(std::string("wavelets") + within,
               [&](std::size_t i) { return HaarCube::sum_of_products(h[i][0], h[i][1], h[i][2]); });
    }
    for (const int division : divisions) {
        std::vector<std::array<Eigen::ArrayXf, 3>> p;
        const std::vector<float> roots = peers.patches(Texels(peers.texel_count(), 1.0f), division);
        const auto array_of = [](const std::vector<float>& values) {
            return Eigen::ArrayXf(
                Eigen::Map<const Eigen::ArrayXf>(values.data(), static_cast<Eigen::Index>(values.size())));
        };
        for (const auto& factors : all) {
            p.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) p.back()[k] = array_of(peers.patches(factors[k], division));
            p.back()[2] /= array_of(roots).max(1.0f);  // a patch between texels has none, and is 0
        }
        report(std::to_string(roots.size()) + " patches",
               [&](std::size_t i) { return static_cast<double>((p[i][0] * p[i][1] * p[i][2]).sum()); });
    }
    return rows;
}

}  // namespace

nlohmann::json function_peers(int runs) {
    constexpr int count = 10;
    Random random(3);
    const Peers peers;
    std::vector<Texels> visible, skies, glossy, diffuse;
    for (int i = 0; i < count; ++i) {
        visible.push_back(peers.visibility(random));
        skies.push_back(peers.lobe(Peers::axis(random, 0.6), 200.0, 0.02));
        glossy.push_back(peers.lobe(Peers::axis(random, 0.7), 20.0, 0.0));
        diffuse.push_back(peers.lobe(Peers::axis(random, 0.7), 1.0, 0.0));
    }
    nlohmann::json result;
    std::printf("terms at equal error, on 6 x %zu x %zu texels of one solid angle\n%-22s %7s %9s %9s %9s %11s %11s\n",
                side, side, "", "error", "cut", "Haar", "cut/Haar", "harmonics", "patches");
    for (const auto& rows : {terms_at_equal_error(peers, "visibility, RMS", visible, true, {0.15, 0.1, 0.075, 0.05}),
                             terms_at_equal_error(peers, "sky with a sun", skies, false, {0.2, 0.1, 0.05, 0.02}),
                             terms_at_equal_error(peers, "glossy lobe", glossy, false, {0.2, 0.1, 0.05, 0.02}),
                             terms_at_equal_error(peers, "cosine lobe", diffuse, false, {0.2, 0.1, 0.05, 0.02})}) {
        for (const auto& row : rows) result["terms"].push_back(row);
    }
    std::printf("sums of products of two at equal terms\n%-22s %-14s %6s %8s %11s %11s %11s %9s\n", "", "", "terms",
                "bytes", "first", "second", "sum", "ns");
    for (const auto& rows : {pairs_at_equal_terms(peers, "visibility x sky", visible, skies, runs),
                             pairs_at_equal_terms(peers, "visibility x cosine", visible, diffuse, runs),
                             pairs_at_equal_terms(peers, "sky x cosine", skies, diffuse, runs)}) {
        for (const auto& row : rows) result["pairs"].push_back(row);
    }
    result["triple"] = triples(peers, random, runs);
    result["sink"] = sink;
    return result;
}

}  // namespace benchmark
