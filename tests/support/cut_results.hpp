#pragma once

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/cut/lightcut.hpp>

namespace lightcuts::test {

/// Expects the same bits.
inline void expect_same(const std::vector<CutResult<glm::vec3>>& a, const std::vector<CutResult<glm::vec3>>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].radiance, b[i].radiance) << i;
        EXPECT_EQ(a[i].error_bound, b[i].error_bound) << i;
        EXPECT_EQ(a[i].clamp_threshold, b[i].clamp_threshold) << i;
        EXPECT_EQ(a[i].cut_size, b[i].cut_size) << i;
        EXPECT_EQ(a[i].queries, b[i].queries) << i;
        EXPECT_EQ(a[i].stop, b[i].stop) << i;
    }
}

}  // namespace lightcuts::test
