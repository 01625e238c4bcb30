#pragma once

#include <type_traits>
#include <utility>

#include "../core/box.hpp"
#include "../core/cone.hpp"
#include "../light/incidence.hpp"

namespace lightcuts {

namespace detail {
/// Takes the place of a member that a kind of light does not need; tagged, since two empty members of one type
/// cannot share an address.
template <class Tag>
struct Empty {};
struct ConeTag {};
struct EnvelopeTag {};

template <class L>
struct EnvelopeType {
    using type = Empty<EnvelopeTag>;
};
template <class L>
    requires requires(const L& l) { envelope_of(l); }
struct EnvelopeType<L> {
    using type = std::remove_cvref_t<decltype(envelope_of(std::declval<const L&>()))>;
};
}  // namespace detail

/// What a node of a light tree knows of the lights below it.
/// Directional lights are boxed by their unit directions towards the light.
template <Light L>
struct LightCluster {
    using light_type = L;
    using spectrum = spectrum_of<L>;
    static constexpr bool oriented = OrientedLight<L>;
    static constexpr bool enveloped = requires(const L& l) { detail::envelope_of(l); };
    using cone_type = std::conditional_t<oriented, Cone, detail::Empty<detail::ConeTag>>;
    using envelope_type = typename detail::EnvelopeType<L>::type;

    Box box;
    spectrum intensity{};                            ///< sum over the lights
    [[no_unique_address]] cone_type cone{};          ///< holds the lights' axes
    [[no_unique_address]] envelope_type envelope{};  ///< dominates the lights' emission and falloff
};

/// The cluster of a single light.
template <Light L>
LightCluster<L> cluster_of(const L& light) {
    LightCluster<L> cluster;
    cluster.box = box_of(position_or_direction(light));
    cluster.intensity = detail::intensity_of(light);
    if constexpr (LightCluster<L>::oriented) cluster.cone = cone_of(to_vec3(detail::axis_of(light)));
    if constexpr (LightCluster<L>::enveloped) cluster.envelope = detail::envelope_of(light);
    return cluster;
}

/// The union of two clusters with an intensity of zero: many intensities are best added up in double, by the caller.
template <Light L>
LightCluster<L> merge_extents(const LightCluster<L>& a, const LightCluster<L>& b) {
    LightCluster<L> cluster;
    cluster.box = merge(a.box, b.box);
    if constexpr (LightCluster<L>::oriented) cluster.cone = merge(a.cone, b.cone);
    if constexpr (LightCluster<L>::enveloped) cluster.envelope = merge(a.envelope, b.envelope);
    return cluster;
}

}  // namespace lightcuts
