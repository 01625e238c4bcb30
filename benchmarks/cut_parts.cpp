#include "cut_parts.hpp"

#include <array>
#include <type_traits>

#include <lightcuts/light/clampable.hpp>

namespace benchmark {

namespace {

template <class L>
constexpr double Parts::*part_of() {
    if constexpr (lightcuts::ClampableLight<L>) {
        return &Parts::indirect;
    } else if constexpr (lightcuts::DirectionalLight<L>) {
        return &Parts::environment;
    } else {
        return &Parts::direct;
    }
}

}  // namespace

CutParts measure_cut_parts(const Workload& work, const lightcuts::LightcutOptions& options) {
    const render::OpaqueOracle oracle = work.oracle();
    const double share = 1.0 / static_cast<double>(work.receivers().size());
    CutParts result;
    work.visit([&]<class Forest>(const Forest& forest) {
        std::array<double Parts::*, Forest::kinds> parts{};
        forest.for_each([&](std::uint32_t kind, const auto& tree) {
            parts[kind] = part_of<typename std::remove_cvref_t<decltype(tree)>::light_type>();
            result.lights.*parts[kind] += static_cast<double>(tree.lights().size());
        });
        for (const Receiver& receiver : work.receivers()) {
            lightcuts::Lightcut cut(forest, receiver, oracle, options);
            while (cut.step()) {}
            cut.for_each([&](const auto& node) { result.cut.*parts[node.kind] += share; });
            const auto shaded = cut.result();
            result.rays += share * shaded.queries;
            if (shaded.stop == lightcuts::StopReason::limit) result.at_limit += share;
        }
    });
    return result;
}

}  // namespace benchmark
