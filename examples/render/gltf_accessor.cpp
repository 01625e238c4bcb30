#include "gltf_accessor.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include <lightcuts/core/invalid_input.hpp>

namespace render {
namespace {

[[noreturn]] void fail(const char* problem) { throw lightcuts::invalid_input(problem); }

template <class T>
const T& element(const std::vector<T>& all, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= all.size()) {
        fail("it refers to data that does not exist; the file is damaged");
    }
    return all[static_cast<std::size_t>(index)];
}

template <class T>
double component(const unsigned char* p, bool normalized) {
    T value;
    std::memcpy(&value, p, sizeof value);
    const auto v = static_cast<double>(value);
    if constexpr (std::is_integral_v<T>) {
        if (normalized) return std::max(v / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
    }
    return v;
}

double read_component(const unsigned char* p, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return component<float>(p, false);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return component<std::uint32_t>(p, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return component<std::uint16_t>(p, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return component<std::int16_t>(p, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return component<std::uint8_t>(p, normalized);
        case TINYGLTF_COMPONENT_TYPE_BYTE: return component<std::int8_t>(p, normalized);
        default: fail("its numbers are of an unknown type; the file is damaged");
    }
}

}  // namespace

std::vector<double> read_accessor(const tinygltf::Model& model, int index, int components) {
    const tinygltf::Accessor& accessor = element(model.accessors, index);
    if (accessor.sparse.isSparse) fail("sparse accessors are not supported; export without them");
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components) {
        fail("its elements have the wrong number of components; the file is damaged");
    }
    const tinygltf::BufferView& view = element(model.bufferViews, accessor.bufferView);
    const std::vector<unsigned char>& data = element(model.buffers, view.buffer).data;
    const int stride_or_error = accessor.ByteStride(view);
    const int size_or_error = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    if (stride_or_error <= 0 || size_or_error <= 0) fail("its numbers are of an unknown type; the file is damaged");

    // Subtract rather than add: offsets from a damaged file may overflow.
    const auto width = static_cast<std::size_t>(components);
    const auto stride = static_cast<std::size_t>(stride_or_error);
    const auto size = static_cast<std::size_t>(size_or_error);
    const auto fits = [&] {
        if (view.byteOffset > data.size() || accessor.byteOffset > data.size() - view.byteOffset) return false;
        const std::size_t room = data.size() - view.byteOffset - accessor.byteOffset;
        return width * size <= room && accessor.count - 1 <= (room - width * size) / stride;
    };
    if (accessor.count == 0) return {};
    if (!fits()) fail("its data is cut off; the file is damaged");

    std::vector<double> result(accessor.count * width);
    const unsigned char* first = data.data() + view.byteOffset + accessor.byteOffset;
    for (std::size_t i = 0; i < accessor.count; ++i) {
        for (std::size_t c = 0; c < width; ++c) {
            result[i * width + c] = read_component(first + i * stride + c * size, accessor.componentType,
                                                   accessor.normalized);
        }
    }
    return result;
}

}  // namespace render
