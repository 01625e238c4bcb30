// Visibility from a ray tracer of one's own: CGAL's AABB tree with exact predicates. Renders a small picture with it
// and once more with Embree, compares the two pixel by pixel, and writes the first as cgal.ppm.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <glm/geometric.hpp>
#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/lightcuts.hpp>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

namespace {

Kernel::Point_3 to_cgal(const glm::vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
glm::vec3 to_glm(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

// All that an oracle has to be: true if the light reaches the receiver.
class CgalOracle {
public:
    explicit CgalOracle(const Tree& tree) : tree_(tree) {}

    bool operator()(const auto& receiver, const auto& light) const {
        return !tree_.do_intersect(Kernel::Segment_3(to_cgal(receiver.shadow_origin), to_cgal(light.position)));
    }

private:
    const Tree& tree_;
};

constexpr std::size_t width = 128, height = 96;

// A floor and a torus that stands on it.
Triangles make_scene() {
    Triangles triangles;
    const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        triangles.emplace_back(to_cgal(a), to_cgal(b), to_cgal(c));
        triangles.emplace_back(to_cgal(a), to_cgal(c), to_cgal(d));
    };
    quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
    constexpr int around = 64, across = 32;
    const auto torus = [](int i, int j) {
        const float u = 6.2831853f * static_cast<float>(i) / around, v = 6.2831853f * static_cast<float>(j) / across;
        const float r = 1.5f + 0.5f * std::cos(v);
        return glm::vec3(r * std::cos(u), 0.5f * std::sin(v) + 0.5f * r * std::cos(u), 2.0f + r * std::sin(u));
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) quad(torus(i, j), torus(i + 1, j), torus(i + 1, j + 1), torus(i, j + 1));
    }
    return triangles;
}

// Two panels under the ceiling, one warm and one cold, as point lights that emit downwards.
std::vector<lightcuts::OrientedPointLight<>> make_lights() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-1.0f, 1.0f);
    std::vector<lightcuts::OrientedPointLight<>> lights(10'000);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool warm = i % 2 == 0;
        const float x = across(random), y = across(random);
        lights[i].position = {(warm ? -3.0f : 3.0f) + x, y, 6.0f};
        lights[i].axis = {0.0f, 0.0f, -1.0f};
        lights[i].intensity = (warm ? glm::vec3(100.0f, 60.0f, 30.0f) : glm::vec3(30.0f, 57.0f, 100.0f)) / 5'000.0f;
    }
    return lights;
}

using Receiver = lightcuts::Receiver<lightcuts::Lambert<>>;

// What the camera sees, pixel by pixel; a white surface everywhere.
struct Pixel {
    std::uint32_t index;
    Receiver seen;
};

std::vector<Pixel> trace_eye_rays(const Tree& tree) {
    const glm::vec3 eye(0.0f, -8.0f, 4.0f);
    const glm::vec3 ahead = glm::normalize(glm::vec3(0.0f, 0.0f, 1.6f) - eye);
    const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0.0f, 0.0f, 1.0f)));
    const glm::vec3 up = glm::cross(right, ahead);
    std::vector<Pixel> pixels;
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const std::size_t column = i % width, row = i / width;
        const float x = (static_cast<float>(column) + 0.5f) / width - 0.5f;
        const float y = 0.5f - (static_cast<float>(row) + 0.5f) / height;
        const glm::vec3 direction = ahead + x * right + y * (up * (static_cast<float>(height) / width));
        const auto hit = tree.first_intersected_primitive(Kernel::Ray_3(to_cgal(eye), to_cgal(eye + direction)));
        if (!hit) continue;
        const glm::vec3 a = to_glm((*hit)->vertex(0)), b = to_glm((*hit)->vertex(1)), c = to_glm((*hit)->vertex(2));
        glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(normal, direction) > 0.0f) normal = -normal;
        const glm::vec3 position = eye + direction * (glm::dot(normal, a - eye) / glm::dot(normal, direction));
        // Shadow rays start a little above the surface, or they would hit it.
        pixels.push_back({i, Receiver(position, {normal, glm::vec3(0.8f)}, position + 1e-3f * normal, i)});
    }
    return pixels;
}

RTCScene make_embree_scene(RTCDevice device, const Triangles& triangles) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                    sizeof(glm::vec3), 3 * triangles.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), triangles.size()));
    for (unsigned i = 0; i < 3 * triangles.size(); ++i) {
        corners[i] = to_glm(triangles[i / 3].vertex(static_cast<int>(i % 3)));
        indices[i] = i;
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);
    return scene;
}

using Picture = std::vector<lightcuts::CutResult<glm::vec3>>;

Picture render(const char* name, const auto& lights, const std::vector<Pixel>& pixels, const auto& oracle) {
    const auto start = std::chrono::steady_clock::now();
    Picture picture(width * height);
    std::uint64_t rays = 0;
    for (const Pixel& pixel : pixels) {
        picture[pixel.index] = lightcuts::shade(lights, pixel.seen, oracle);
        rays += picture[pixel.index].queries;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%-7s %.2f s, %.0f shadow rays a pixel\n", name, seconds.count(),
                static_cast<double>(rays) / static_cast<double>(pixels.size()));
    return picture;
}

bool write_ppm(const char* path, const Picture& picture) {
    std::FILE* file = std::fopen(path, "wb");
    if (file == nullptr) return false;
    std::fprintf(file, "P6 %zu %zu 255\n", width, height);
    for (const auto& pixel : picture) {
        for (int c = 0; c < 3; ++c) {
            const float encoded = 255.0f * std::pow(std::min(pixel.radiance[c], 1.0f), 1.0f / 2.2f);
            std::fputc(static_cast<int>(std::lround(encoded)), file);
        }
    }
    return std::fclose(file) == 0;
}

}  // namespace

int main() {
    const Triangles triangles = make_scene();
    Tree tree(triangles.cbegin(), triangles.cend());
    tree.build();  // now: CGAL would do it at the first ray, which is no good when several threads shade
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene embree_scene = make_embree_scene(device, triangles);

    const auto lamps = make_lights();
    const lightcuts::LightTree lights(lamps);
    const std::vector<Pixel> pixels = trace_eye_rays(tree);

    const CgalOracle cgal_oracle(tree);
    const Picture cgal = render("CGAL", lights, pixels, cgal_oracle);
    const Picture embree = render("Embree", lights, pixels, lightcuts::EmbreeOracle(embree_scene));
    rtcReleaseScene(embree_scene);
    rtcReleaseDevice(device);

    // Only a ray along an edge may have two answers: Embree computes in float. It moves a pixel by one cluster's share.
    int different = 0;
    float largest = 0.0f;
    for (const Pixel& pixel : pixels) {
        const glm::vec3 a = cgal[pixel.index].radiance, b = embree[pixel.index].radiance;
        if (a == b) continue;
        ++different;
        largest = std::max(largest, glm::distance(a, b) / glm::length(a));
    }
    std::printf("%d of %zu pixels differ, by at most %.1f %%\n", different, pixels.size(), 100.0 * largest);

    // And some pixels light by light.
    double squares = 0.0;
    int compared = 0;
    bool good = true;
    for (std::size_t i = 0; i < pixels.size(); i += 499) {
        const auto& shaded = cgal[pixels[i].index];
        const auto exact = lightcuts::exhaustive(lights, pixels[i].seen, cgal_oracle);
        const float error = std::abs(shaded.radiance.g - exact.radiance.g);
        good = good && error <= shaded.error_bound.g + 1e-5f * exact.radiance.g;
        if (!(exact.radiance.g > 0.0f)) continue;
        squares += std::pow(static_cast<double>(error / exact.radiance.g), 2.0);
        ++compared;
    }
    const double rms = std::sqrt(squares / compared);
    std::printf("error of %d pixels, RMS: %.2f %%\n", compared, 100.0 * rms);

    const auto few = static_cast<int>(pixels.size() / 100);
    good = good && different <= few && largest < 0.1f && rms < 0.05;
    return write_ppm("cgal.ppm", cgal) && good ? 0 : 1;
}
