#pragma once

#include <render/io/gltf_writer.hpp>
#include <render/io/load_gltf.hpp>
#include <render/io/validate.hpp>
#include <render/motion.hpp>
#include <render/scene.hpp>

/// Makes glTF files in memory, and reads them.
class GltfBuilder : public render::GltfWriter {
public:
    /// The attributes of a square on the plane y = 0, x from `left` to `left` + 1, z from -1 to 1, seen from above.
    Json square(float left = -1.0f) {
        const float right = left + 1.0f;
        return {{"POSITION", add<float>({left, 0, 1, right, 0, 1, right, 0, -1, left, 0, -1}, "VEC3", 3)}};
    }

    /// Read and checked.
    render::Scene load(const render::Shutter& shutter = {}) const {
        render::Scene scene = render::load_gltf(path, render::MemoryFiles(files()), shutter);
        render::set_instants(scene, shutter);
        render::validate(scene);
        return scene;
    }
};
