#include "trace.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <render/fingerprint.hpp>
#include <render/interrupt.hpp>
#include <render/io/content_hash.hpp>
#include <render/program.hpp>
#include <render/progress.hpp>

#include "chunk_file.hpp"
#include "facing.hpp"
#include "sensor_cuts.hpp"
#include "visibility.hpp"
#include "visibility_file.hpp"

namespace daylighting {
namespace {

/// Sensors that are finished, and kept, together.
constexpr std::size_t chunk_sensors = 32;

/// The encoded cuts of a chunk: of each sensor, sky and sun with their numbers of pieces.
struct Chunk {
    std::vector<std::byte> bytes;

    void add(const lightcuts::PiecewiseConstant<float>& cut) {
        const std::size_t begin = bytes.size();
        bytes.resize(begin + 2 * sizeof(std::uint32_t));
        lightcuts::encode(cut, cut_encoding, bytes);
        const auto size = static_cast<std::uint32_t>(bytes.size() - begin - 2 * sizeof(std::uint32_t));
        const auto pieces = static_cast<std::uint32_t>(cut.size());
        std::memcpy(bytes.data() + begin, &size, sizeof size);
        std::memcpy(bytes.data() + begin + sizeof size, &pieces, sizeof pieces);
    }
};

/// Moves the cuts of a chunk to the files.
void collect(const Chunk& chunk, Trace& trace) {
    std::span<const std::byte> rest = chunk.bytes;
    for (bool is_sky = true; !rest.empty(); is_sky = !is_sky) {
        std::uint32_t size = 0, pieces = 0;
        std::memcpy(&size, rest.data(), sizeof size);
        std::memcpy(&pieces, rest.data() + sizeof size, sizeof pieces);
        rest = rest.subspan(2 * sizeof size);
        (is_sky ? trace.sky : trace.sun).append_encoded(rest.first(size));
        (is_sky ? trace.sky_pieces : trace.sun_pieces) += pieces;
        trace.finished += is_sky ? 0 : 1;
        rest = rest.subspan(size);
    }
}

/// Of all that the cuts depend on.
std::uint64_t fingerprint_of(const render::Scene& scene, const render::RayScene& rays, const DirectionTree& directions,
                             std::span<const Sensor> sensors, const TraceSettings& settings) {
    render::ContentHash hash;
    hash.add(render::program_build()).add(rays.tracer().isa()).add(settings.error);
    hash.add(render::occlusion_hash(scene));
    hash.add(directions.directions);
    for (const Sensor& s : sensors) {
        for (int c = 0; c < 3; ++c) hash.add(s.position[c]);
        hash.add(s.normal);
    }
    return hash.value();
}

struct Workspace {
    std::optional<Facing> facing;
    std::vector<float> visibility;
    VisibilityTracer::Scratch scratch;
    CutMaker maker;
    SensorCuts cuts;
};

}  // namespace

Trace::Trace(const DirectionTree& directions)
    : sky(directions.tree, cut_encoding), sun(directions.tree, cut_encoding) {}

Trace trace_sensors(const render::Scene& scene, const render::RayScene& rays, const DirectionTree& directions,
                    std::span<const Sensor> sensors, const TraceSettings& settings) {
    const std::size_t count = sensors.size(), chunk_count = (count + chunk_sensors - 1) / chunk_sensors;
    std::vector<std::optional<Chunk>> chunks(chunk_count);
    Trace trace(directions);
    const auto size_of = [&](std::size_t c) { return std::min(count, (c + 1) * chunk_sensors) - c * chunk_sensors; };
    std::size_t done = 0;
    std::optional<ChunkFile> kept;
    if (!settings.unfinished.empty()) {
        kept.emplace(settings.unfinished, fingerprint_of(scene, rays, directions, sensors, settings),
                     static_cast<std::uint32_t>(chunk_count), settings.resume,
                     [&](std::uint32_t index, std::vector<std::byte> bytes) {
                         if (chunks[index]) return;
                         chunks[index] = Chunk{std::move(bytes)};
                         trace.resumed += size_of(index);
                         ++done;
                     });
    }
    const VisibilityTracer tracer(scene, rays, directions);
    tbb::enumerable_thread_specific<Workspace> workspaces;
    {
        render::Progress progress(chunk_count - done, settings.shows_progress);
        tbb::parallel_for(std::size_t{0}, chunk_count, [&](std::size_t c) {
            if (chunks[c] || render::interrupted()) return;
            Workspace& work = workspaces.local();
            Chunk chunk;
            for (std::size_t i = c * chunk_sensors; i < c * chunk_sensors + size_of(c); ++i) {
                const Sensor& sensor = sensors[i];
                if (!work.facing || work.facing->normal() != sensor.normal) {
                    work.facing.emplace(directions, sensor.normal);
                }
                tracer.trace(sensor, *work.facing, work.visibility, work.scratch);
                work.maker.make(directions, *work.facing, work.visibility, settings.error, work.cuts);
                chunk.add(work.cuts.sky);
                chunk.add(work.cuts.sun);
            }
            if (kept) kept->append(static_cast<std::uint32_t>(c), chunk.bytes);
            chunks[c] = std::move(chunk);
            progress.step();
        });
    }
    const bool is_complete = std::all_of(chunks.begin(), chunks.end(), [](const auto& c) { return c.has_value(); });
    for (std::size_t c = 0; c < chunk_count; ++c) {
        if (!chunks[c]) continue;
        if (is_complete) {
            collect(*chunks[c], trace);
        } else {
            trace.finished += size_of(c);
        }
        chunks[c].reset();
    }
    if (kept && !is_complete && trace.finished == 0) kept->remove();
    return trace;
}

}  // namespace daylighting
