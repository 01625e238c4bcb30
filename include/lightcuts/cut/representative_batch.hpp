#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "../core/reusable_list.hpp"
#include "../shading/shadow_origin.hpp"
#include "../shading/transfer.hpp"
#include "../visibility/oracle.hpp"
#include "clamp.hpp"
#include "cut_node.hpp"
#include "forest.hpp"

namespace lightcuts::detail {

/// Looks at the representatives of new nodes of one receiver's cut: their transfer without shadows, then their shadow
/// rays, one by one or as queries of a stream.
template <class Forest, class R, class Oracle>
class RepresentativeBatch {
public:
    using S = typename Forest::spectrum;
    using Node = CutNode<S, Forest::clamps>;

    RepresentativeBatch(const Forest& forest, const R& receiver, const Oracle& oracle, const ClampingOptions& clamp,
                        ReusableList<VisibilityQuery>& queries)
        : forest_(forest), receiver_(receiver), oracle_(oracle), clamp_(clamp), queries_(queries) {}

    /// Finds the transfer of the representatives that are not shared with a parent, shadows apart; a batched oracle's
    /// queries go to the caller's list. Returns the number of shadow rays.
    std::uint32_t request(std::span<Node> fresh) const {
        std::uint32_t rays = 0;
        for (std::size_t begin = 0; begin < fresh.size();) {
            if (!fresh[begin].queried) {
                ++begin;
                continue;
            }
            std::array<Node*, lane_count> members;
            std::size_t count = 0;
            const std::uint8_t kind = fresh[begin].kind;
            for (; begin < fresh.size() && count < members.size() && fresh[begin].kind == kind; ++begin) {
                if (fresh[begin].queried) members[count++] = &fresh[begin];
            }
            forest_.visit(kind, [&](const auto& tree) { rays += request(tree, std::span(members).first(count)); });
        }
        return rays;
    }

    /// Traces the shadow ray of a node that waits for it.
    void trace(Node& n) const {
        forest_.visit(n.kind, [&](const auto& tree) {
            const auto& light = tree.lights()[tree.topology().item(n.representative)];
            with_shadow_origin(receiver_, light,
                               [&](const auto& lit) { receive(n, as_factor<S>(oracle_(lit, light))); });
        });
    }

    /// Takes the answer to a node's shadow ray: a float or a spectrum.
    template <class A>
    void receive(Node& n, const A& visibility) const {
        if constexpr (std::same_as<A, float>) {
            if (visibility == 1.0f) return;
        }
        n.transfer = n.transfer * visibility;
        if (!is_saturated(n.estimate)) [[likely]] {
            n.estimate = n.estimate * visibility;
        } else {
            forest_.visit(n.kind, [&](const auto& tree) {
                n.estimate = finite_product(n.transfer, tree.clusters()[n.node].intensity);
            });
        }
    }

private:
    template <class Tree>
    std::uint32_t request(const Tree& tree, std::span<Node* const> nodes) const {
        using L = typename Tree::light_type;
        LightBlock lights;
        LaneSpectra<S> transfer;
        const auto light_of = [&](int i) -> const L& {
            return tree.lights()[tree.topology().item(nodes[static_cast<std::size_t>(i)]->representative)];
        };
        const int count = static_cast<int>(nodes.size());
        for (int i = 0; i < count; ++i) {
            const auto& leaf = tree.clusters()[nodes[static_cast<std::size_t>(i)]->representative];
            lights.place.set(i, leaf.box.lo);
            if constexpr (OrientedLight<L>) lights.axis.set(i, leaf.cone.axis);
        }
        lights.template finish<L>(count);
        unshadowed_transfer<L>(receiver_, lights, count, light_of, transfer);
        std::uint32_t rays = 0;
        for (int i = 0; i < count; ++i) {
            Node& n = *nodes[static_cast<std::size_t>(i)];
            n.transfer = transfer[static_cast<std::size_t>(i)];
            if constexpr (ClampableLight<L>) {
                n.transfer = at_most(n.transfer, clamp_.transfer);
                if (clamp_.is_automatic()) {
                    n.part = representative_part(tree.clusters()[n.representative].intensity,
                                                 tree.clusters()[n.node].intensity);
                }
            }
            n.queried = !is_black(n.transfer);
            if (!n.queried) continue;
            n.estimate = finite_product(n.transfer, tree.clusters()[n.node].intensity);
            if constexpr (std::same_as<Oracle, AlwaysVisible>) {
                n.queried = false;
                continue;
            }
            ++rays;
            if constexpr (AnswersMany<Oracle, S>) {
                // In place: what is written in pieces is slow to copy at once.
                VisibilityQuery& query = queries_.append();
                query.to = lights.place.at(i);
                query.from = receiver_.shadow_origin_towards(towards<L>(receiver_.position, query.to));
                query.receiver = receiver_.id;
                query.light = tree.topology().item(n.representative);
                query.kind = n.kind;
                query.distant = DirectionalLight<L>;
            }
        }
        return rays;
    }

    const Forest& forest_;
    const R& receiver_;
    const Oracle& oracle_;
    const ClampingOptions& clamp_;  ///< of clamped lights
    ReusableList<VisibilityQuery>& queries_;
};

}  // namespace lightcuts::detail
