#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/moments.hpp>
#include <lightcuts/piecewise/piecewise_constant.hpp>

#include "patches.hpp"

namespace relight {

/// Light that patches reflect, with its sum at every cluster of them. The cut only says how finely to look.
class BounceLight {
public:
    /// Refers to `patches`.
    explicit BounceLight(const Patches& patches) : patches_(patches) {}

    /// `radiance`: by patch, the same in all directions. Refined by error to a share `relative_error` of all light,
    /// then by value, up to `size` pieces [Cut merging 2008, section 3.2]. throws: invalid_input for what is not
    /// finite.
    void set(std::span<const glm::vec3> radiance, std::size_t size, double relative_error);

    const Patches& patches() const { return patches_; }
    const lightcuts::PiecewiseConstant<glm::vec3>& cut() const { return cut_; }
    /// The sum of the radiance of the patches below a node: times their solid angle, what arrives of it.
    const glm::vec3& sum(std::uint32_t node) const { return sums_[node]; }

private:
    const Patches& patches_;
    std::vector<lightcuts::Moments<3>> moments_;
    lightcuts::OrderedApproximation<glm::vec3> approximation_;
    lightcuts::PiecewiseConstant<glm::vec3> cut_;
    std::vector<glm::vec3> sums_;  ///< by node
};

}  // namespace relight
