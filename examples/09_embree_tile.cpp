// Many receivers at once, on all cores: bakes the light map of a floor. A tile's texels advance in lock-step, so that
// their shadow rays reach Embree in long streams.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/lightcuts.hpp>

namespace {

constexpr std::size_t size = 128;     // texels along an edge of the map
constexpr std::size_t tile_edge = 4;  // 16 receivers at a time are enough for long streams
constexpr float edge = 16.0f;         // of the floor, in meters

using Receiver = lightcuts::Receiver<lightcuts::Lambert<>>;
using Texel = lightcuts::CutResult<glm::vec3>;

// Slabs that hover above the floor.
RTCScene make_scene(RTCDevice device) {
    std::mt19937 random(2);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    constexpr std::size_t slabs = 200;
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* corners = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 4 * slabs));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), slabs));
    for (std::size_t i = 0; i < slabs; ++i) {
        const glm::vec3 at{uniform(0, edge), uniform(0, edge), uniform(0.2f, 1.5f)};
        const glm::vec3 u{uniform(-1, 1), uniform(-1, 1), 0.0f};
        const glm::vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-0.1f, 0.1f)};
        const glm::vec3 quad[4] = {at, at + u, at + u + v, at + v};
        std::copy_n(quad, 4, corners + 4 * i);
    }
    for (unsigned i = 0; i < 4 * slabs; ++i) indices[i] = i;
    rtcCommitGeometry(mesh);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);  // or rays slip between triangles that share an edge
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);
    return scene;
}

Receiver receiver_at(std::size_t x, std::size_t y) {
    const auto along = [](std::size_t texel) { return edge * (static_cast<float>(texel) + 0.5f) / size; };
    const glm::vec3 at(along(x), along(y), 0.0f);
    // The id goes into random choices: with it, a texel does not depend on the thread that shades it.
    const auto id = static_cast<std::uint32_t>(y * size + x);
    return Receiver(at, {glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.7f)}, at, id);
}

std::vector<Texel> bake(const auto& lights, const lightcuts::EmbreeOracle& oracle, unsigned thread_count) {
    std::vector<Texel> map(size * size);
    std::atomic<std::size_t> next_tile = 0;
    const auto work = [&] {
        // One scratch a thread: after the first tile nothing is allocated any more.
        lightcuts::LightcutScratch<glm::vec3> scratch;
        std::vector<Receiver> receivers;
        std::vector<Texel> results(tile_edge * tile_edge);
        constexpr std::size_t tiles_across = size / tile_edge;
        for (std::size_t tile; (tile = next_tile++) < tiles_across * tiles_across;) {
            const std::size_t x0 = tile % tiles_across * tile_edge, y0 = tile / tiles_across * tile_edge;
            receivers.clear();
            for (std::size_t i = 0; i < tile_edge * tile_edge; ++i) {
                receivers.push_back(receiver_at(x0 + i % tile_edge, y0 + i / tile_edge));
            }
            lightcuts::shade(lights, std::span<const Receiver>(receivers), oracle, results, scratch);
            for (std::size_t i = 0; i < results.size(); ++i) map[receivers[i].id] = results[i];
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < thread_count; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    return map;
}

}  // namespace

int main() {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = make_scene(device);
    const lightcuts::EmbreeOracle oracle(scene);

    // A ceiling of 64 panels, 60,000 points of light.
    std::mt19937 random(1);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    std::vector<lightcuts::OrientedPointLight<>> lights(60'000);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto column = static_cast<float>(i % 8), row = static_cast<float>(i / 8 % 8);
        lights[i].position = {2.0f * column + uniform(0.7f, 1.3f), 2.0f * row + uniform(0.7f, 1.3f), 4.0f};
        lights[i].axis = {0.0f, 0.0f, -1.0f};
        lights[i].intensity = glm::vec3(1.0f, 0.9f, 0.7f) * 1e-2f;
    }
    const lightcuts::LightTree tree(lights);

    const auto map = bake(tree, oracle, std::max(2u, std::thread::hardware_concurrency()));
    const auto alone = bake(tree, oracle, 1);
    double rays = 0.0;
    bool same = true;
    for (std::size_t i = 0; i < map.size(); ++i) {
        rays += map[i].queries;
        same = same && map[i].radiance == alone[i].radiance;
    }
    std::printf("%zu x %zu texels, %zu lights, %.0f shadow rays a texel\n", size, size, lights.size(),
                rays / static_cast<double>(map.size()));
    std::printf("one thread bakes %s\n", same ? "the same map" : "ANOTHER MAP");

    // Some texels light by light.
    double squares = 0.0;
    int compared = 0;
    bool within = true;
    for (std::size_t x = 0; x < size; x += 8, ++compared) {
        const std::size_t y = (x * 37) % size;
        const auto exact = lightcuts::exhaustive(tree, receiver_at(x, y), oracle);
        const Texel& texel = map[y * size + x];
        const float error = std::abs(texel.radiance.r - exact.radiance.r);
        within = within && error <= texel.error_bound.r;
        squares += std::pow(static_cast<double>(error / exact.radiance.r), 2.0);
    }
    const double rms = std::sqrt(squares / compared);
    std::printf("error of %d texels, RMS: %.2f %%\n", compared, 100.0 * rms);

    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return same && within && rms < 0.05 ? 0 : 1;
}
