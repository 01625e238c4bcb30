#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/source/sphere.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/rays/scene_proofs.hpp>
#include <render/scene.hpp>
#include <render/surfaces/surface_material.hpp>

namespace {

using render::Scene;
using Receiver = lightcuts::Receiver<render::SurfaceMaterial>;

/// A wall of two triangles across x = 0, as large as that, of the material.
Scene wall(const render::Material& material) {
    Scene s;
    s.name = "wall";
    s.materials = {material};
    s.positions = {{0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}};
    s.triangles = {{0, 1, 2}, {0, 2, 3}};
    s.triangle_material = {0, 0};
    return s;
}

/// A diffuse point that looks at the wall; from there its shadow rays start.
Receiver before_the_wall(const glm::vec3& at) {
    render::SurfacePoint point;
    point.position = at;
    point.shading_normal = point.geometric_normal = point.to_viewer = {1, 0, 0};
    point.diffuse = glm::vec3(0.5f);
    return Receiver(at, render::SurfaceMaterial(point), at + glm::vec3(1e-4f, 0, 0));
}

TEST(SceneProofs, HideBehindWhatLetsNoLightPass) {
    render::Material glass;
    glass.transmission = 1.0f;
    const lightcuts::Box behind{{1, -1, -1}, {2, 1, 1}};
    const lightcuts::DirectionBox beyond{{{0.9f, -0.1f, -0.1f}, {1.0f, 0.1f, 0.1f}}};
    const Receiver receiver = before_the_wall({-2.0f, 0.3f, 0.2f});
    for (const bool opaque : {true, false}) {
        const Scene scene = wall(opaque ? render::Material{} : glass);
        const render::RayScene rays(scene);
        const render::SceneProofs proofs(scene, rays);
        EXPECT_EQ(proofs.mesh().size(), scene.triangles.size()) << "triangles keep their numbers";
        EXPECT_EQ(proofs.hidden().hides(receiver, behind), opaque);
        EXPECT_EQ(proofs.hidden().hides(receiver, beyond), opaque);
        EXPECT_FALSE(proofs.hidden().hides(receiver, lightcuts::Box{{-1.5f, -1, -1}, {-1, 1, 1}})) << "before the wall";
    }
}

TEST(SceneProofs, HideNoLightOfASphereThatReachesThroughTheWall) {
    // The sphere's lights lie behind the wall, but rays to them end where they enter the sphere, before it.
    Scene scene = wall({});
    lightcuts::SphereLight<> sphere;
    sphere.center = {0.2f, 0.0f, 0.0f};
    sphere.radius = 1.0f;
    scene.spheres = {sphere};
    const render::RayScene rays(scene);
    const render::SceneProofs proofs(scene, rays);
    const Receiver receiver = before_the_wall({-5.0f, 0.3f, 0.2f});
    EXPECT_FALSE(proofs.hidden().hides(receiver, lightcuts::box_of({1.1f, 0.0f, 0.0f})));
    EXPECT_TRUE(proofs.hidden().hides(receiver, lightcuts::box_of({4.0f, 0.0f, 0.0f})))
        << "no ray ends so far off its light";
}

}  // namespace
