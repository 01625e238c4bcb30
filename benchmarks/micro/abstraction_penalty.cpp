/// Time of the library's generic code over that of a loop written by hand for the smallest case: omni lights, one
/// representative a cluster, Lambert's material, an oracle of one ray at a time. Both do the same work and must agree
/// bit for bit. Prints both times and writes abstraction_penalty.json.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/lambert.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "timing.hpp"

namespace {

using lightcuts::hash_keys;
using lightcuts::uniform01;
using Light = lightcuts::OmniLight<>;
using Tree = lightcuts::LightTree<Light>;
using Material = lightcuts::Lambert<>;
using Point = lightcuts::Receiver<Material>;
using Result = lightcuts::CutResult<glm::vec3>;

/// A ball above the floor is all that casts a shadow. Never inlined, as ray tracers are not: what compilers make of it
/// in one loop and not in the other is no penalty of either.
[[gnu::noinline]] bool is_lit(const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 ball(5.0f, 1.0f, 5.0f), d = to - from, offset = ball - from;
    const float along = glm::dot(offset, d), length2 = glm::dot(d, d);
    if (along <= 0.0f || along >= length2) return true;
    return glm::dot(offset, offset) - along * along / length2 > 0.64f;
}

struct BallOracle {
    bool operator()(const Point& receiver, const Light& light) const {
        return is_lit(receiver.shadow_origin, light.position);
    }
};

/// Lightcuts without a template: what the library comes to for this case, with an unlimited cut.
class HandWritten {
public:
    HandWritten(const Tree& tree, const lightcuts::LightcutOptions& options)
        : lights_(tree.lights().data()), words_(tree.topology().words().data()), clusters_(tree.clusters().data()),
          representatives_(tree.representatives().of(0).data()), start_(tree.start()),
          threshold_(static_cast<double>(options.error_ratio)), round_fraction_(options.round_fraction) {}

    Result shade(const Point& point) {
        point_ = &point;
        albedo_ = point.material.cosine_lobe().scale;
        nodes_.clear();
        keys_.clear();
        holes_.clear();
        absorbed_ = 0;
        queries_ = 0;
        for (int c = 0; c < 3; ++c) {
            total_[c] = largest_[c] = 0.0;
            weight_[c] = base_[c] = darkest;
        }
        for (const std::uint32_t n : start_) add_with_representative(n, glm::vec3(infinity));
        do {
            set_transfer();
            absorb();
            update_weights();
            choose();
            split_chosen();
        } while (!chosen_.empty());
        return result();
    }

private:
    static constexpr double darkest = 1e150, most_spread = 1.02, final_node = -1.0, hole = -2.0;
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    static constexpr int lanes = lightcuts::lane_count;

    struct Node {
        std::uint32_t node = 0, representative = 0;
        glm::vec3 transfer{}, estimate{}, unit_bound{}, bound{};
        bool bounded = false, queried = false;
    };
    struct Candidate {
        std::uint32_t at;
        double priority;
    };

    bool is_leaf(std::uint32_t n) const { return (words_[n] & 0x8000'0000u) != 0; }
    const Light& light_of(std::uint32_t leaf) const { return lights_[words_[leaf] & 0x7fff'ffffu]; }

    static glm::vec3 finite(const glm::vec3& v) {
        constexpr float largest = std::numeric_limits<float>::max();
        return {v.x < largest ? v.x : largest, v.y < largest ? v.y : largest, v.z < largest ? v.z : largest};
    }

    /// Where 0 x infinity = 0.
    static glm::vec3 product(const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 p = a * b;
        const float sum = p.x + p.y + p.z;
        if (sum == sum) return p;
        const auto safe = [](float x, float y) { return x > 0.0f && y > 0.0f ? x * y : 0.0f; };
        return {safe(a.x, b.x), safe(a.y, b.y), safe(a.z, b.z)};
    }

    Node& add_node(std::uint32_t n, const glm::vec3& unit_bound) {
        Node& node = nodes_.emplace_back();
        node.node = n;
        node.unit_bound = unit_bound;
        if (!is_leaf(n)) node.bound = product(unit_bound, clusters_[n].intensity);
        return node;
    }

    void add_with_representative(std::uint32_t n, const glm::vec3& unit_bound) {
        Node& node = add_node(n, unit_bound);
        node.representative = representatives_[n];
        node.queried = true;
    }

    void split_chosen() {
        nodes_.reserve(nodes_.size() + 2 * chosen_.size());
        for (const Candidate& c : chosen_) {
            split(nodes_[c.at]);
            keys_[c.at] = hole;
            holes_.push_back(c.at);
        }
    }

    void split(const Node& parent) {
        add(parent.estimate, -1.0);
        const std::uint32_t right = parent.node - 1;
        const std::uint32_t left = (is_leaf(right) ? right : words_[right]) - 1;
        const bool in_left = parent.representative <= left;
        Node& inheriting = add_node(in_left ? left : right, parent.unit_bound);
        inheriting.representative = parent.representative;
        inheriting.transfer = parent.transfer;
        inheriting.estimate = finite(inheriting.transfer * clusters_[inheriting.node].intensity);
        add_with_representative(in_left ? right : left, parent.unit_bound);
    }

    /// Shades new nodes by the representatives they do not share with a parent, but for the shadow rays.
    void set_transfer() {
        Node* members[lanes];
        for (std::size_t next = absorbed_; next < nodes_.size();) {
            int count = 0;
            for (; next < nodes_.size() && count < lanes; ++next) {
                if (nodes_[next].queried) members[count++] = &nodes_[next];
            }
            if (count > 0) set_transfer(members, count);
        }
    }

    void set_transfer(Node* const* members, int count) {
        const glm::vec3 at = point_->position, n = point_->material.normal;
        alignas(32) lightcuts::Lanes x, y, z, cosine, geometric, in_range;
        for (int i = 0; i < lanes; ++i) {
            const glm::vec3 place = clusters_[members[i < count ? i : count - 1]->representative].box.lo;
            x[i] = place.x;
            y[i] = place.y;
            z[i] = place.z;
        }
        for (int i = 0; i < lanes; ++i) {
            const float dx = x[i] - at.x, dy = y[i] - at.y, dz = z[i] - at.z;
            const float distance2 = dx * dx + dy * dy + dz * dz;
            const float inverse = lightcuts::detail::inverse_sqrt(distance2);
            const float facing = n.x * (dx * inverse) + n.y * (dy * inverse) + n.z * (dz * inverse);
            cosine[i] = lightcuts::detail::larger(facing, 0.0f);
            geometric[i] = inverse * inverse;
            in_range[i] = lightcuts::detail::smaller(distance2 - 1e-20f, 1e20f - distance2);
        }
        for (int i = 0; i < count; ++i) {
            Node& node = *members[i];
            node.transfer = in_range[i] > 0.0f ? finite(albedo_ * cosine[i] * geometric[i])
                                               : transfer_of(light_of(node.representative));
            node.queried = node.transfer != glm::vec3(0.0f);
            if (!node.queried) continue;
            node.estimate = finite(node.transfer * clusters_[node.node].intensity);
            ++queries_;
        }
    }

    /// In double, for what is out of float's range.
    glm::vec3 transfer_of(const Light& light) const {
        const glm::dvec3 offset = glm::dvec3(light.position) - glm::dvec3(point_->position);
        const double distance2 = glm::dot(offset, offset);
        if (!(distance2 > 0.0)) return glm::vec3(0.0f);
        const double inverse = 1.0 / std::sqrt(distance2);
        const float cosine = glm::dot(point_->material.normal, glm::vec3(offset * inverse));
        if (!(cosine > 0.0f)) return glm::vec3(0.0f);
        return finite(albedo_ * cosine * static_cast<float>(std::min(inverse * inverse, 3.4028234663852886e38)));
    }

    void add(const glm::vec3& estimate, double sign) {
        for (int c = 0; c < 3; ++c) total_[c] += sign * static_cast<double>(estimate[c]);
    }

    /// Traces the shadow rays of new nodes, which join the frontier, in the places of those that were refined first.
    void absorb() {
        for (std::size_t i = absorbed_; i < nodes_.size(); ++i) {
            Node& node = nodes_[i];
            if (node.queried && !is_lit(point_->shadow_origin, light_of(node.representative).position)) {
                node.transfer = node.transfer * 0.0f;
                node.estimate = node.estimate * 0.0f;
            }
            add(node.estimate, 1.0);
        }
        while (!holes_.empty() && nodes_.size() > absorbed_) {
            const std::uint32_t at = holes_.back();
            holes_.pop_back();
            nodes_[at] = nodes_.back();
            nodes_.pop_back();
            keys_[at] = key(nodes_[at]);
        }
        keys_.resize(nodes_.size());
        for (; absorbed_ < nodes_.size(); ++absorbed_) keys_[absorbed_] = key(nodes_[absorbed_]);
    }

    void update_weights() {
        bool is_noise = false;
        for (int c = 0; c < 3; ++c) {
            largest_[c] = total_[c] > largest_[c] ? total_[c] : largest_[c];
            is_noise = is_noise || !(largest_[c] <= 1e6 * total_[c]);
        }
        if (is_noise) {
            for (double& t : total_) t = 0.0;
            for (std::size_t i = 0; i < absorbed_; ++i) {
                if (keys_[i] != hole) add(nodes_[i].estimate, 1.0);
            }
            for (int c = 0; c < 3; ++c) largest_[c] = total_[c];
        }
        for (int c = 0; c < 3; ++c) weight_[c] = total_[c] * darkest > 1.0 ? 1.0 / total_[c] : darkest;
    }

    double priority(const Node& node) const {
        double largest = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double p = static_cast<double>(node.bound[c]) * base_[c];
            largest = p > largest ? p : largest;
        }
        return largest;
    }
    double key(const Node& node) const { return node.bound == glm::vec3(0.0f) ? final_node : priority(node); }

    void choose() {
        double most = weight_[0] / base_[0], least = most;
        for (int c = 1; c < 3; ++c) {
            const double ratio = weight_[c] / base_[c];
            most = std::max(most, ratio);
            least = std::min(least, ratio);
        }
        if (!(most / least <= most_spread)) {
            for (int c = 0; c < 3; ++c) base_[c] = weight_[c];
            most = 1.0;
            for (std::size_t i = 0; i < absorbed_; ++i) {
                if (keys_[i] != hole) keys_[i] = key(nodes_[i]);
            }
        }
        const double threshold = threshold_ / most;
        bool any_left = true;
        do {
            double largest = 0.0;
            for (std::size_t i = 0; i < absorbed_; ++i) {
                if (keys_[i] < std::numeric_limits<double>::infinity()) largest = std::max(largest, keys_[i]);
            }
            const double cutoff = round_fraction_ * largest;
            any_left = cutoff > threshold;
            chosen_.clear();
            for (std::size_t i = 0; i < absorbed_; ++i) {
                if (keys_[i] > threshold && keys_[i] >= cutoff) {
                    chosen_.push_back({static_cast<std::uint32_t>(i), keys_[i]});
                }
            }
            tighten();
            keep_top(threshold);
        } while (chosen_.empty() && any_left);
    }

    void keep_top(double threshold) {
        double largest = 0.0;
        for (const Candidate& c : chosen_) {
            keys_[c.at] = c.priority;
            if (c.priority < std::numeric_limits<double>::infinity()) largest = std::max(largest, c.priority);
        }
        std::erase_if(chosen_, [&](const Candidate& c) {
            return !(c.priority > threshold) || c.priority < round_fraction_ * largest;
        });
    }

    /// Bounds the candidates that only have their parents' bounds.
    void tighten() {
        Candidate* members[lanes];
        const Tree::cluster* clusters[lanes];
        for (std::size_t next = 0; next < chosen_.size();) {
            int count = 0;
            for (; next < chosen_.size() && count < lanes; ++next) {
                if (!nodes_[chosen_[next].at].bounded) members[count++] = &chosen_[next];
            }
            if (count == 0) continue;
            for (int i = 0; i < count; ++i) clusters[i] = &clusters_[nodes_[members[i]->at].node];
            const lightcuts::detail::ClusterBlock block(clusters, count, lightcuts::box_of(point_->position));
            lightcuts::ConeBlock normals;
            normals.fill(point_->material.normal, block);
            alignas(32) lightcuts::Lanes bound;
            lightcuts::detail::max_dots_over_distance<3>(normals.axis, normals.support, block, bound);
            for (int i = 0; i < count; ++i) {
                Node& node = nodes_[members[i]->at];
                node.bounded = true;
                node.unit_bound = glm::min(node.unit_bound, lightcuts::detail::scale_bound(albedo_, bound[i]));
                node.bound = product(node.unit_bound, clusters[i]->intensity);
                members[i]->priority = priority(node);
            }
        }
    }

    Result result() const {
        double radiance[3] = {}, bound[3] = {};
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] == hole) continue;
            for (int c = 0; c < 3; ++c) {
                radiance[c] += static_cast<double>(nodes_[i].estimate[c]);
                bound[c] += static_cast<double>(nodes_[i].bound[c]);
            }
        }
        Result result;
        result.radiance = finite(glm::vec3(radiance[0], radiance[1], radiance[2]));
        for (int c = 0; c < 3; ++c) result.error_bound[c] = lightcuts::round_up(bound[c]);
        result.cut_size = static_cast<std::uint32_t>(absorbed_ - holes_.size());
        result.queries = queries_;
        return result;
    }

    const Light* lights_;
    const std::uint32_t* words_;
    const Tree::cluster* clusters_;
    const std::uint32_t* representatives_;
    std::span<const std::uint32_t> start_;
    double threshold_, round_fraction_;

    const Point* point_ = nullptr;
    glm::vec3 albedo_{};  ///< over pi
    double total_[3]{}, weight_[3]{}, base_[3]{}, largest_[3]{};
    std::uint32_t queries_ = 0;
    std::vector<Node> nodes_;           ///< the frontier, with holes, and new nodes behind
    std::vector<double> keys_;          ///< of the frontier
    std::vector<std::uint32_t> holes_;  ///< places of refined nodes
    std::size_t absorbed_ = 0;          ///< nodes behind are new
    std::vector<Candidate> chosen_;
};

/// Lights in a room of 10 x 4 x 10 m.
std::vector<Light> room_lights(std::size_t count) {
    std::vector<Light> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto uniform = [i](int k) { return static_cast<float>(uniform01(hash_keys(1, i, k))); };
        lights[i].position = {10.0f * uniform(0), 2.0f + 2.0f * uniform(1), 10.0f * uniform(2)};
        lights[i].intensity = {uniform(3), uniform(4), uniform(5)};
    }
    return lights;
}

/// Points on the uneven floor of that room.
std::vector<Point> floor_points(std::size_t count) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto uniform = [i](int k) { return static_cast<float>(uniform01(hash_keys(2, i, k))); };
        const glm::vec3 normal = glm::normalize(glm::vec3(uniform(0) - 0.5f, 1.0f, uniform(1) - 0.5f));
        const glm::vec3 position(10.0f * uniform(2), 0.0f, 10.0f * uniform(3));
        points.emplace_back(position, Material{normal, glm::vec3(0.6f, 0.5f, 0.4f)});
    }
    return points;
}

bool same_bits(const Result& a, const Result& b) {
    return std::memcmp(&a.radiance, &b.radiance, sizeof a.radiance) == 0 &&
           std::memcmp(&a.error_bound, &b.error_bound, sizeof a.error_bound) == 0 && a.cut_size == b.cut_size &&
           a.queries == b.queries;
}

}  // namespace

int main(int argc, char** argv) {
    std::size_t light_count = 10000, point_count = 1000;
    int runs = 31;
    CLI::App app{"Time of the generic code over that of a loop written by hand"};
    app.add_option("--lights", light_count, "omni lights")->check(CLI::PositiveNumber);
    app.add_option("--points", point_count, "receivers")->check(CLI::PositiveNumber);
    app.add_option("--runs", runs, "medians are over this odd number")->check(benchmark::odd_number());
    CLI11_PARSE(app, argc, argv);

    return benchmark::write_figures("bench-abstraction_penalty", "abstraction_penalty.json", [&] {
        const std::vector<Light> lights = room_lights(light_count);
        const std::vector<Point> points = floor_points(point_count);
        const Tree tree(lights);
        lightcuts::LightcutOptions options;
        options.max_cut = 0;
        options.exhaustive_below = 0;
        lightcuts::LightcutScratch<glm::vec3> scratch;
        std::vector<Result> generic(points.size()), by_hand(points.size());
        HandWritten hand(tree, options);
        const auto run_generic = [&] { lightcuts::shade(tree, points, BallOracle{}, generic, scratch, options); };
        const auto run_by_hand = [&] {
            for (std::size_t i = 0; i < points.size(); ++i) by_hand[i] = hand.shade(points[i]);
        };

        run_generic();
        run_by_hand();
        double nodes = 0, rays = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!same_bits(generic[i], by_hand[i])) {
                throw std::runtime_error("the results for point " + std::to_string(i) + " differ");
            }
            nodes += generic[i].cut_size;
            rays += generic[i].queries;
        }
        std::vector<double> generic_times, hand_times;
        for (int run = 0; run < runs; ++run) {
            generic_times.push_back(benchmark::seconds(run_generic));
            hand_times.push_back(benchmark::seconds(run_by_hand));
        }
        const double generic_time = benchmark::median(generic_times), hand_time = benchmark::median(hand_times);
        const auto count = static_cast<double>(points.size());
        std::printf("%zu lights, %zu points, mean cut %.1f, %.1f rays\n", lights.size(), points.size(), nodes / count,
                    rays / count);
        std::printf("%-12s %12s\n", "", "us per point");
        std::printf("%-12s %12.2f\n", "generic", 1e6 * generic_time / count);
        std::printf("%-12s %12.2f\n", "by hand", 1e6 * hand_time / count);
        std::printf("%-12s %12.3f\n", "ratio", generic_time / hand_time);
        return nlohmann::json{{"lights", lights.size()},          {"points", points.size()},
                              {"cut_size", nodes / count},        {"shadow_rays", rays / count},
                              {"generic_seconds", generic_time},  {"by_hand_seconds", hand_time},
                              {"ratio", generic_time / hand_time}};
    });
}
