#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>
#include <lightcuts/core/lanes.hpp>
#include <render/surfaces/surface_material.hpp>

namespace relight {

/// Sums up light that arrives from single directions, eight at a time.
class LitSum {
public:
    explicit LitSum(const render::SurfaceMaterial& material) : material_(material) {}

    void add(const glm::vec3& direction, const glm::vec3& power) {
        directions_.set(count_, direction);
        powers_[count_] = power;
        if (++count_ == lightcuts::lane_count) flush();
    }
    glm::vec3 result() {
        if (count_ > 0) flush();
        return sum_;
    }
    std::uint64_t evaluated() const { return evaluated_; }

private:
    void flush() {
        lightcuts::detail::repeat_last(directions_, count_);
        lightcuts::LaneSpectra<glm::vec3> values;
        material_.evaluate_many(directions_, count_, values);
        for (int i = 0; i < count_; ++i) sum_ += powers_[i] * values[static_cast<std::size_t>(i)];
        evaluated_ += static_cast<std::uint64_t>(count_);
        count_ = 0;
    }

    const render::SurfaceMaterial& material_;
    lightcuts::LaneVectors directions_;
    glm::vec3 powers_[lightcuts::lane_count];
    int count_ = 0;
    std::uint64_t evaluated_ = 0;
    glm::vec3 sum_{0.0f};
};

}  // namespace relight
