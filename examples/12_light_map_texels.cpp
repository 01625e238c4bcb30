// One sum over many points and many lights, without a camera: the mean irradiance of each texel of a coarse light map.
// A texel is 256 points of the floor, of a hundred thousand lights each; some hundreds of pairs of clusters tell what
// the 26 million pairs come to.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>
#include <lightcuts/product/gather.hpp>

namespace {

constexpr int texels = 4;          // along an edge of the map
constexpr int points_across = 16;  // of a texel
constexpr float edge = 8.0f;       // of the floor, in meters

// Balloons above the floor.
struct Balloons {
    std::vector<glm::vec3> centers;
    template <class Receiver, class Light>
    bool operator()(const Receiver& receiver, const Light& light) const {
        const glm::vec3 ray = light.position - receiver.shadow_origin;
        for (const glm::vec3& center : centers) {
            const glm::vec3 balloon = center - receiver.shadow_origin;
            const float nearest = std::fmax(0.0f, std::fmin(1.0f, glm::dot(balloon, ray) / glm::dot(ray, ray)));
            if (glm::distance(balloon, nearest * ray) < 0.4f) return false;
        }
        return true;
    }
};

}  // namespace

int main() {
    std::mt19937 random(3);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    std::vector<lightcuts::OmniLight<>> lanterns(100'000);
    for (auto& lantern : lanterns) {
        lantern.position = {uniform(-8.0f, 16.0f), uniform(-8.0f, 16.0f), uniform(3.0f, 6.0f)};
        lantern.intensity = uniform(0.5f, 1.5f) * glm::vec3(1.0f, 0.7f, 0.4f);  // W/sr
    }
    // Each pair of clusters draws a light of its own, of up to 32 that may stand for a cluster.
    const lightcuts::LightTree tree(lanterns, {.representatives = 32});
    Balloons visible;
    for (int i = 0; i < 12; ++i) visible.centers.push_back({uniform(0, edge), uniform(0, edge), uniform(0.6f, 2.0f)});

    // Irradiance is what a white diffuse surface reflects, times pi: strengths of a texel sum to pi.
    using Point = lightcuts::GatherPoint<lightcuts::Lambert<>>;
    const lightcuts::Lambert floor{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(1.0f)};
    constexpr float share = std::numbers::pi_v<float> / (points_across * points_across);
    lightcuts::GatherForest<Point> points_of_texel;        // rebuilt for each texel
    lightcuts::gather_scratch_of<decltype(tree)> scratch;  // reused, too
    lightcuts::ProductOptions options;
    options.cut.error_ratio = 0.005f;  // of the total, at most, by which a pair of clusters may be off
    double difference = 0.0, total = 0.0, queries = 0.0;
    for (int y = 0; y < texels; ++y) {
        for (int x = 0; x < texels; ++x) {
            std::vector<Point> points;
            for (int j = 0; j < points_across; ++j) {
                for (int i = 0; i < points_across; ++i) {
                    const float u = (static_cast<float>(x * points_across + i) + 0.5f) / (texels * points_across);
                    const float v = (static_cast<float>(y * points_across + j) + 0.5f) / (texels * points_across);
                    points.push_back({{glm::vec3(edge * u, edge * v, 0.0f), floor}, glm::vec3(share)});
                }
            }
            options.id = static_cast<std::uint32_t>(y * texels + x);
            points_of_texel.build(points, {});
            const auto texel = lightcuts::gather(tree, points_of_texel, visible, scratch, options);
            queries += texel.queries;

            // For comparison, an independent lightcut for each point.
            glm::vec3 mean(0.0f);
            for (const Point& p : points) {
                mean += p.strength * lightcuts::shade(tree, p.receiver, visible, {.error_ratio = 0.002f}).radiance;
            }
            difference += static_cast<double>(std::abs(texel.radiance.r - mean.r));
            total += static_cast<double>(mean.r);
            std::printf("%8.2f", static_cast<double>(texel.radiance.r));
        }
        std::printf("  W/m^2\n");
    }
    std::printf("%.0f shadow rays a texel of %.0f million pairs; off by %.2f %%\n", queries / (texels * texels),
                points_across * points_across * 0.1, 100.0 * difference / total);
    return difference < 0.02 * total && queries < 1000.0 * texels * texels ? 0 : 1;
}
