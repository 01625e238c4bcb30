/// Proofs that lights are hidden against shadow rays to all of these lights: how many verdicts there are, for clusters
/// of how many lights, and how many are wrong. Exit status 1 if one is.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/visibility/receiver_groups.hpp>

#include "rays/scene_proofs.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;

constexpr std::uint32_t many_lights = 64;

struct Verdicts {
    std::uint64_t asked = 0, hidden = 0, of_many_lights = 0, segments = 0, wrong = 0;

    void add(const Verdicts& v) {
        asked += v.asked;
        hidden += v.hidden;
        of_many_lights += v.of_many_lights;
        segments += v.segments;
        wrong += v.wrong;
    }
};

/// Which lights and nodes of one tree are seen from some receivers.
template <class Tree>
class Seen {
public:
    explicit Seen(const Tree& tree) : tree_(tree), nodes_(tree.topology().size()) {}

    void forget() { nodes_.assign(nodes_.size(), false); }

    /// Traces a shadow ray to every light above the receiver's horizon.
    void look_from(const Receiver& receiver, std::uint32_t kind, const render::OpaqueOracle& oracle) {
        using L = typename Tree::light_type;
        const lightcuts::ClusterTree& topology = tree_.topology();
        const std::optional<glm::vec3> horizon = receiver.material.horizon();
        queries_.clear();
        leaves_.clear();
        for (std::uint32_t n = 0; n < topology.size(); ++n) {
            if (!topology.is_leaf(n) || nodes_[n]) continue;
            const glm::vec3 place = lightcuts::position_or_direction(tree_.lights()[topology.item(n)]);
            constexpr bool distant = lightcuts::DirectionalLight<L>;
            const glm::dvec3 way = distant ? glm::dvec3(place) : glm::dvec3(place) - glm::dvec3(receiver.position);
            if (horizon && !(glm::dot(glm::dvec3(*horizon), way) > 0.0)) continue;
            queries_.push_back({receiver.shadow_origin, receiver.id, place, topology.item(n), kind, distant});
            leaves_.push_back(n);
        }
        answers_.resize(queries_.size());
        if (!queries_.empty()) oracle.many(queries_, answers_);
        for (std::size_t i = 0; i < leaves_.size(); ++i) {
            if (answers_[i] > 0.0f) nodes_[leaves_[i]] = true;
        }
    }

    /// Asks of all clusters of many lights, and of one in eight of the others.
    Verdicts judge(const lightcuts::ReceiverBox& receivers, std::uint32_t kind,
                   const render::SceneProofs::HiddenLights& hidden) {
        const lightcuts::ClusterTree& topology = tree_.topology();
        Verdicts verdicts;
        for (std::uint32_t n = 0; n < topology.size(); ++n) {
            if (!topology.is_leaf(n)) nodes_[n] = nodes_[topology.left(n)] || nodes_[topology.right(n)];
            const auto lights = static_cast<std::uint32_t>(topology.leaf_count(n));
            if (lights < many_lights && lightcuts::hash_keys(calls_, 0, kind, n) % 8 != 0) continue;
            ++verdicts.asked;
            const lightcuts::place_box<typename Tree::light_type> box{tree_.clusters()[n].box};
            if (!hidden.hides(receivers, box)) continue;
            ++verdicts.hidden;
            verdicts.of_many_lights += lights >= many_lights ? 1 : 0;
            verdicts.segments += lights;
            if (nodes_[n]) {
                ++verdicts.wrong;
                const glm::vec3 from = receivers.box.lo;
                std::printf("  WRONG: kind %u, node %u of %u lights, from %.9g %.9g %.9g\n", kind, n, lights,
                            static_cast<double>(from.x), static_cast<double>(from.y), static_cast<double>(from.z));
            }
        }
        ++calls_;
        return verdicts;
    }

private:
    const Tree& tree_;
    std::vector<bool> nodes_;
    std::vector<std::uint32_t> leaves_;
    std::vector<lightcuts::VisibilityQuery> queries_;
    std::vector<float> answers_;
    std::uint64_t calls_ = 0;
};

/// Of the receivers in groups of at most `group`.
template <class Forest>
Verdicts judge(const Workload& work, const Forest& forest, std::size_t group, std::uint64_t wanted) {
    const render::OpaqueOracle oracle = work.oracle();
    const render::SceneProofs proofs(work.scene(), work.rays());
    std::vector<lightcuts::ReceiverBox> boxes;
    for (const Receiver& r : work.receivers()) boxes.push_back(lightcuts::box_of(r));
    lightcuts::ReceiverGroups groups;
    groups.divide(boxes, group);
    Verdicts all;
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        if (tree.empty()) return;
        Seen seen(tree);
        Verdicts of_kind;
        for (std::size_t g = 0; g < groups.size() && of_kind.hidden < wanted; ++g) {
            seen.forget();
            for (const std::uint32_t i : groups.members(g)) seen.look_from(work.receivers()[i], kind, oracle);
            of_kind.add(seen.judge(groups.box(g), kind, proofs.hidden()));
        }
        all.add(of_kind);
    });
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes{"builtin:hall?sun-sky=35,120&indirect=20000", "builtin:classroom", "builtin:haze",
                                    "builtin:surfaces", "builtin:colonnade"};
    int width = 32, height = 24;
    std::vector<std::size_t> group_sizes{1, 16};
    std::uint64_t wanted = 1'000'000;
    CLI::App app{"Proofs that lights are hidden against shadow rays to all of them"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--width", width, "of the picture whose points are the receivers");
    app.add_option("--height", height, "of that picture");
    app.add_option("--groups", group_sizes, "receivers that share proofs, at most");
    app.add_option("--verdicts", wanted, "`hidden` of a kind of lights, after which no more are asked for");
    CLI11_PARSE(app, argc, argv);
    Verdicts total;
    for (const std::string& scene : scenes) {
        const Workload work(scene, width, height);
        for (const std::size_t group : group_sizes) {
            Verdicts v;
            const double time = seconds(
                [&] { v = work.visit([&](const auto& forest) { return judge(work, forest, group, wanted); }); });
            std::printf(
                "%s, groups of %zu: %.4g asked, %.4g hidden (%.3g of %u lights and more; %.4g lights), %llu "
                "wrong, %.1f s\n",
                scene.c_str(), group, static_cast<double>(v.asked), static_cast<double>(v.hidden),
                static_cast<double>(v.of_many_lights), many_lights, static_cast<double>(v.segments),
                static_cast<unsigned long long>(v.wrong), time);
            std::fflush(stdout);
            total.add(v);
        }
    }
    std::printf("all: %.4g hidden, %.3g of %u lights and more, %llu wrong\n", static_cast<double>(total.hidden),
                static_cast<double>(total.of_many_lights), many_lights, static_cast<unsigned long long>(total.wrong));
    return total.wrong == 0 ? 0 : 1;
}
