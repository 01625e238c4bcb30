#include "pilot.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/two_centers.hpp>
#include <lightcuts/tree/build/visibility_vectors.hpp>
#include <render/rays/sky_rays.hpp>
#include <render/tbb_executor.hpp>

namespace relight {

Directions data_driven_directions(std::span<const glm::vec3> directions, std::span<const Site> sites,
                                  const render::RayScene& rays, const PilotOptions& options) {
    const std::size_t tried = std::min(options.sites, sites.size());
    if (tried == 0) return geometric_directions(directions);
    std::vector<std::uint8_t> seen(tried * directions.size());
    std::vector<lightcuts::OrientedItem> items(tried);
    struct Scratch {
        render::SkyRays sky;
        std::vector<float> shares;
    };
    tbb::enumerable_thread_specific<Scratch> scratches([&] {
        return Scratch{{}, std::vector<float>(directions.size())};
    });
    tbb::parallel_for(std::size_t{0}, tried, [&](std::size_t k) {
        const Site& site = sites[k * sites.size() / tried];
        items[k] = {site.front, site.normal, 1.0f};
        Scratch& scratch = scratches.local();
        scratch.sky.look(rays, site.front, directions, scratch.shares);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            seen[k * directions.size() + i] = static_cast<std::uint8_t>(scratch.shares[i] * 255.0f + 0.5f);
        }
    });
    const render::TbbExecutor all;
    const lightcuts::ClusterTree of_sites = lightcuts::divide(items, lightcuts::TwoCenters{}, all);
    const auto clusters = lightcuts::even_clusters(of_sites, options.clusters);
    const auto vectors = lightcuts::visibility_vectors(
        of_sites, clusters, directions.size(),
        [&](std::uint32_t site, std::uint32_t direction) {
            return static_cast<float>(seen[site * directions.size() + direction]) / 255.0f;
        },
        all);
    std::vector<lightcuts::OrientedItem> lights;
    for (const glm::vec3& d : directions) lights.push_back({d, d, 1.0f});
    return make_directions(
        lightcuts::divide(lights, lightcuts::DataDriven(vectors, clusters.size(), options.beta), all), directions);
}

}  // namespace relight
