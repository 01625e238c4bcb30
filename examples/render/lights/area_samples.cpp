#include "lights/area_samples.hpp"

#include <algorithm>

#include "lights/flat_samples.hpp"
#include "lights/pieces.hpp"

namespace render {
std::vector<AreaSample> spread_by_area(const Scene& scene, std::span<const std::uint32_t> triangles,
                                       std::size_t count) {
    if (count == 0 || triangles.empty()) return {};
    std::vector<AreaSample> samples = spread_on_flat(scene, triangles, count);
    if (!samples.empty()) return samples;
    const double share = 1.0 / (pieces_per_point * static_cast<double>(count));
    const std::vector<Piece> pieces = SpaceCurve(scene, triangles).sorted(cut_into_pieces(scene, triangles, share));
    if (pieces.empty()) return {};
    double total = 0;
    for (const Piece& piece : pieces) total += piece.area;
    // One point in each of `count` equal parts of the area.
    std::size_t at = 0;
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double wanted = total * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        while (at + 1 < pieces.size() && before + pieces[at].area <= wanted) before += pieces[at++].area;
        const double rest = std::clamp((wanted - before) / pieces[at].area, 0.0, 1.0);
        samples.push_back(sample_at(scene, pieces[at].triangle, pieces[at].at(rest, golden_fraction(i))));
    }
    return samples;
}

}  // namespace render
