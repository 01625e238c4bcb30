#pragma once

#include <concepts>

#include "../light/incidence.hpp"
#include "receiver.hpp"

namespace lightcuts::detail {

/// Towards the light at `place`: not of unit length unless it is distant.
template <Light L>
constexpr glm::vec3 towards(const glm::vec3& position, const glm::vec3& place) {
    return DirectionalLight<L> ? place : place - position;
}

/// The receiver as seen from behind: its shadow rays start there.
template <class M>
constexpr Receiver<M> from_behind(const Receiver<M>& receiver) {
    static_assert(
        std::copy_constructible<M>,
        "an oracle that is asked about receivers sees a copy of a two-sided one: let its material be copyable, "
        "or Receiver<const M&> refer to it");
    Receiver<M> behind = receiver;
    behind.shadow_origin = receiver.shadow_origin_behind();
    return behind;
}

/// Calls `ask(receiver)` with the receiver whose shadow rays start on the side where `light` is: the receiver itself,
/// and a copy if it is two-sided and the light behind it. So oracles need not know of either.
template <class M, Light L, class F>
constexpr decltype(auto) with_shadow_origin(const Receiver<M>& receiver, [[maybe_unused]] const L& light, F&& ask) {
    if constexpr (Receiver<M>::two_sided) {
        if (receiver.material.is_behind(towards<L>(receiver.position, position_or_direction(light)))) {
            return ask(from_behind(receiver));
        }
    }
    return ask(receiver);
}

}  // namespace lightcuts::detail
