#pragma once

#include <relight/frame_source.hpp>
#include <relight/options.hpp>
#include <relight/prepared_scene.hpp>
#include <render/choose_camera.hpp>

#include "small_world.hpp"

/// A small world on disk, with the options of a program that shows it.
struct ViewedWorld {
    explicit ViewedWorld(const relight::CutOptions& cuts = {.deviation = 0.5}, double edge = 1.0,
                         const SmallBounce& bounce = {})
        : world(block_over_floor, cuts, 512, edge, 32, bounce),
          prepared(world.folder / "scene.relight", relight::load_still_scene(world.folder / "scene.obj"),
                   render::RayTracer()) {
        render::write_exr(world.folder / "map.exr", small_map());
        options.cut_file = world.folder / "scene.relight";
        options.map = world.folder / "map.exr";
        options.view.eye = glm::dvec3(1.0, 5.0, 7.0);
        options.view.target = glm::dvec3(0.0, 0.5, 0.0);
        options.view.quiet = true;
    }

    relight::FrameState state(int width = 24, int height = 16) const {
        return {render::choose_camera(prepared.mesh.scene, options.view), 0.0, {}, width, height};
    }

    SmallWorld world;
    relight::PreparedScene prepared;
    relight::Options options;
};
