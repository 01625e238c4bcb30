#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/vec3.hpp>
#include <lightcuts/core/cosine.hpp>
#include <lightcuts/core/spectrum.hpp>
#include <lightcuts/material/material.hpp>
#include <lightcuts/product/envelope.hpp>

namespace benchmark {

/// Dominates several lobes by a cube of 6 x 6 cells a face, each of which has the largest value over its directions
/// [Multidimensional Lightcuts 2006, section 3.5]: to compare with the library's envelopes, in place of which a cluster
/// of gather points can keep it. 864 bytes for one channel.
template <lightcuts::Spectrum S>
class CubeMapEnvelope {
public:
    static constexpr int side = 6;

    /// Dominates no lobe.
    CubeMapEnvelope() { cells_.fill(lightcuts::black<S>()); }
    /// Dominates one. cost: 216 bounds of it.
    template <class M>
    explicit CubeMapEnvelope(const M& lobe) {
        for (int face = 0; face < 6; ++face) {
            for (int row = 0; row < side; ++row) {
                for (int column = 0; column < side; ++column) {
                    cells_[index(face, row, column)] = lobe.upper_bound(cell(face, row, column));
                }
            }
        }
    }

    /// The largest of the cells that directions of `box` may touch.
    S upper_bound(const lightcuts::OffsetBox& box) const {
        S largest = lightcuts::black<S>();
        for (int face = 0; face < 6; ++face) {
            const int axis = face / 2;
            const double sign = face % 2 == 0 ? 1.0 : -1.0;
            const double a = sign * box.lo[axis], b = sign * box.hi[axis];
            const double near = std::max(std::min(a, b), 0.0), far = std::max(a, b);
            if (!(far >= 0.0)) continue;
            const Range rows = cells(box, (axis + 1) % 3, near, far), columns = cells(box, (axis + 2) % 3, near, far);
            for (int row = rows.first; row <= rows.last; ++row) {
                for (int column = columns.first; column <= columns.last; ++column) {
                    largest = lightcuts::larger_channels(largest, cells_[index(face, row, column)]);
                }
            }
        }
        return largest;
    }

    /// Dominates what either dominates.
    friend CubeMapEnvelope merge(const CubeMapEnvelope& a, const CubeMapEnvelope& b) {
        CubeMapEnvelope both;
        for (std::size_t i = 0; i < both.cells_.size(); ++i) {
            both.cells_[i] = lightcuts::larger_channels(a.cells_[i], b.cells_[i]);
        }
        return both;
    }

private:
    struct Range {
        int first, last;
    };

    static std::size_t index(int face, int row, int column) {
        return static_cast<std::size_t>((face * side + row) * side + column);
    }
    static double edge(int i) { return -1.0 + 2.0 * i / side; }
    /// The directions of a cell: a rectangle in the plane of its face.
    static lightcuts::OffsetBox cell(int face, int row, int column) {
        const int axis = face / 2;
        lightcuts::OffsetBox box;
        box.lo[axis] = box.hi[axis] = face % 2 == 0 ? 1.0 : -1.0;
        box.lo[(axis + 1) % 3] = edge(row);
        box.hi[(axis + 1) % 3] = edge(row + 1);
        box.lo[(axis + 2) % 3] = edge(column);
        box.hi[(axis + 2) % 3] = edge(column + 1);
        return box;
    }
    /// The cells along one axis of a face that the quotients of the box's offsets along that axis and of `near` to
    /// `far` along the face's may lie in; empty if all are beyond the face.
    static Range cells(const lightcuts::OffsetBox& box, int axis, double near, double far) {
        // 0 / 0 may be any direction of the face.
        const auto quotient = [](double over, double under, double otherwise) {
            return under > 0.0 ? over / under : over == 0.0 ? otherwise : over < 0.0 ? -2.0 : 2.0;
        };
        const double lo = box.lo[axis], hi = box.hi[axis];
        const double least = quotient(lo, lo < 0.0 ? near : far, -1.0), most = quotient(hi, hi < 0.0 ? far : near, 1.0);
        constexpr double rounding = 1e-6;
        if (least > 1.0 + rounding || most < -1.0 - rounding) return {0, -1};
        const auto at = [](double x) {
            return std::clamp(static_cast<int>((std::clamp(x, -1.0, 1.0) + 1.0) * 0.5 * side), 0, side - 1);
        };
        return {at(least - rounding), at(most + rounding)};
    }

    std::array<S, static_cast<std::size_t>(6 * side * side)> cells_;
};

/// A lobe whose clusters are bounded by cube maps in place of its own envelope.
template <class M>
class ByCubeMap : public M {
public:
    explicit ByCubeMap(const M& lobe) : M(lobe) {}
    CubeMapEnvelope<lightcuts::material_spectrum<M>> envelope() const {
        return CubeMapEnvelope<lightcuts::material_spectrum<M>>(static_cast<const M&>(*this));
    }
};

}  // namespace benchmark
