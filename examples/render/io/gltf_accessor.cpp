#include "io/gltf_accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include <lightcuts/core/invalid_input.hpp>

namespace render {
namespace {

/// Of an accessor without data of its own: a short file shall not ask for much memory.
constexpr std::size_t most_zeros = std::size_t{1} << 22;

struct ElementType {
    std::string_view name;
    std::size_t components;
};
constexpr std::array<ElementType, 7> element_types{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};

std::size_t components_of(const JsonObject& accessor) {
    const std::string type = accessor.text("type");
    for (const ElementType& each : element_types) {
        if (each.name == type) return each.components;
    }
    accessor.refuse("type", "one that the format knows");
}

/// Calls `f(a value of the type)`.
template <class F>
void with_component_type(const JsonObject& object, F&& f) {
    switch (object.needed("componentType")) {
        case 5120: return f(std::int8_t{});
        case 5121: return f(std::uint8_t{});
        case 5122: return f(std::int16_t{});
        case 5123: return f(std::uint16_t{});
        case 5125: return f(std::uint32_t{});
        case 5126: return f(float{});
        default: object.refuse("componentType", "one that the format knows");
    }
}

template <class T>
double component(const char* p, bool normalized) {
    T value;
    std::memcpy(&value, p, sizeof value);
    const auto v = static_cast<double>(value);
    if constexpr (std::is_integral_v<T>) {
        if (normalized) return std::max(v / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
    }
    return v;
}

/// `count` elements in a bufferView: where they begin, and the bytes from one to the next.
struct Layout {
    std::string_view bytes;
    std::size_t stride = 0;
};

/// `who` names the view; `element`: bytes of one.
Layout layout_of(GltfDocument& document, const JsonObject& who, std::size_t count, std::size_t element,
                 bool may_be_interleaved) {
    const std::size_t index = who.needed("bufferView");
    const std::string_view view = document.view(index);
    const std::size_t given = may_be_interleaved
                                  ? document.element("bufferViews", index, "bufferView").whole_number("byteStride", 0)
                                  : 0;
    const std::size_t stride = given > 0 ? given : element;
    const std::size_t offset = who.whole_number("byteOffset", 0);
    // Divided rather than multiplied: numbers of a damaged file may overflow.
    const bool fits = offset <= view.size() && element <= view.size() - offset &&
                      count - 1 <= (view.size() - offset - element) / stride;
    if (!fits) who.fail("its data is cut off; the file is damaged");
    return {view.substr(offset), stride};
}

template <class T>
void read_into(const Layout& layout, std::size_t count, std::size_t components, bool normalized, double* to) {
    for (std::size_t i = 0; i < count; ++i) {
        const char* from = layout.bytes.data() + i * layout.stride;
        for (std::size_t c = 0; c < components; ++c) *to++ = component<T>(from + c * sizeof(T), normalized);
    }
}

/// Puts the values of `accessor.sparse` in their places.
void apply_sparse(GltfDocument& document, const JsonObject& accessor, std::size_t components,
                  std::vector<double>& values) {
    const JsonObject sparse = accessor.object("sparse");
    const std::size_t count = sparse.needed("count");
    const std::size_t elements = values.size() / components;
    if (count == 0) return;
    if (count > elements) sparse.refuse("count", "at most the accessor's");
    const JsonObject places = sparse.object("indices");
    std::vector<double> indices(count);
    with_component_type(places, [&](auto type) {
        using T = decltype(type);
        if constexpr (std::is_unsigned_v<T>) {
            read_into<T>(layout_of(document, places, count, sizeof(T), false), count, 1, false, indices.data());
        } else {
            places.refuse("componentType", "an unsigned type");
        }
    });
    const JsonObject source = sparse.object("values");
    std::vector<double> replaced(count * components);
    with_component_type(accessor, [&](auto type) {
        using T = decltype(type);
        read_into<T>(layout_of(document, source, count, components * sizeof(T), false), count, components,
                     accessor.flag("normalized", false), replaced.data());
    });
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(indices[i]);
        if (at >= elements) places.fail("an index is past the accessor's end; the file is damaged");
        std::copy_n(&replaced[i * components], components, &values[at * components]);
    }
}

}  // namespace

std::size_t components_of(const GltfDocument& document, std::size_t accessor) {
    return components_of(document.element("accessors", accessor, "accessor"));
}

bool has_data(const GltfDocument& document, std::size_t index) {
    const JsonObject accessor = document.element("accessors", index, "accessor");
    return accessor.has("bufferView") || accessor.has("sparse");
}

std::vector<double> read_accessor(GltfDocument& document, std::size_t index, std::size_t components, std::size_t most,
                                  const char* element) {
    const JsonObject accessor = document.element("accessors", index, "accessor");
    if (components_of(accessor) != components) {
        accessor.fail("its elements have the wrong number of components; the file is damaged");
    }
    const std::size_t count = accessor.needed("count");
    if (count == 0) return {};
    std::vector<double> values;
    if (accessor.has("bufferView")) {
        with_component_type(accessor, [&](auto type) {
            using T = decltype(type);
            const Layout layout = layout_of(document, accessor, count, components * sizeof(T), true);
            values.resize(count * components);
            read_into<T>(layout, count, components, accessor.flag("normalized", false), values.data());
        });
    } else {
        if (count > most_zeros) accessor.fail("it has too many elements without data");
        values.resize(count * components);
    }
    if (accessor.has("sparse")) apply_sparse(document, accessor, components, values);
    if (most < count) values.resize(most * components);
    const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
    if (bad != values.end()) {
        const auto place = static_cast<std::size_t>(bad - values.begin()) / components;
        accessor.fail(std::string("its ") + element + " " + std::to_string(place) + " is not finite; correct it");
    }
    return values;
}

}  // namespace render
