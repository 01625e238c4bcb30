#include "io/gltf_animation.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "io/escape.hpp"
#include "io/gltf_accessor.hpp"

namespace render {
namespace {

using Property = GltfChannel::Property;
using Interpolation = GltfChannel::Interpolation;

constexpr std::pair<std::string_view, Property> properties[] = {{"translation", Property::translation},
                                                                {"rotation", Property::rotation},
                                                                {"scale", Property::scale},
                                                                {"weights", Property::weights}};

glm::dquat quaternion_of(const std::vector<double>& v) {
    const glm::dquat q(v[3], v[0], v[1], v[2]);
    return glm::length(q) > 0.0 ? glm::normalize(q) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

std::vector<double> numbers_of(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

Interpolation interpolation_of(const JsonObject& sampler) {
    const std::string name = sampler.text("interpolation", "LINEAR");
    return name == "CUBICSPLINE" ? Interpolation::cubic : name == "STEP" ? Interpolation::step : Interpolation::linear;
}

}  // namespace

std::vector<double> GltfChannel::key(std::size_t index) const {
    // A cubic spline's keys are triples: incoming tangent, value, outgoing tangent.
    const std::size_t place = interpolation == Interpolation::cubic ? 3 * index + 1 : index;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(place * size);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(size));
}

std::vector<double> GltfChannel::cubic_between(std::size_t index, double share) const {
    const double duration = times[index + 1] - times[index];
    const double s = share;
    const double from = (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s);
    const double leaving = duration * s * (1.0 - s) * (1.0 - s);
    const double to = s * s * (3.0 - 2.0 * s);
    const double arriving = duration * s * s * (s - 1.0);
    std::vector<double> result(size);
    for (std::size_t i = 0; i < size; ++i) {
        const auto number = [&](std::size_t place) { return values[place * size + i]; };
        result[i] = from * number(3 * index + 1) + leaving * number(3 * index + 2) + to * number(3 * index + 4) +
                    arriving * number(3 * index + 3);
    }
    return property == Property::rotation ? numbers_of(quaternion_of(result)) : result;
}

std::vector<double> GltfChannel::at(double second) const {
    if (times.size() < 2 || second <= times.front()) return key(0);
    if (second >= times.back()) return key(times.size() - 1);
    const auto after = std::upper_bound(times.begin(), times.end(), second);
    const auto index = static_cast<std::size_t>(after - times.begin()) - 1;
    const double share = (second - times[index]) / (times[index + 1] - times[index]);
    if (interpolation == Interpolation::step || share == 0.0) return key(index);
    if (interpolation == Interpolation::cubic) return cubic_between(index, share);
    std::vector<double> a = key(index);
    const std::vector<double> b = key(index + 1);
    if (property == Property::rotation) return numbers_of(glm::slerp(quaternion_of(a), quaternion_of(b), share));
    for (std::size_t i = 0; i < size; ++i) a[i] = (1.0 - share) * a[i] + share * b[i];
    return a;
}

GltfAnimation::GltfAnimation(GltfDocument& document, const Shutter& shutter, LeftOutList& left_out)
    : document_(document), shutter_(shutter) {
    const std::size_t animations = document_.count("animations");
    if (animations == 0) return;
    const JsonObject first = document_.element("animations", 0, "animation");
    for (const nlohmann::json& json : first.list("channels")) {
        read_channel(first, JsonObject(json, first.name() + ": a channel"), left_out);
    }
    const std::string shown = shutter.opens == 0.0 ? "its beginning" : "the one that --time names";
    if (animations > 1) {
        leave_out(left_out, "all animations but the first",
                  shutter.is_moment() ? "a picture shows one moment, " + shown + " of the first"
                                      : "a picture shows the first, while the shutter is open");
    } else if (shutter.is_moment()) {
        leave_out(left_out, "the animation", "a picture shows one moment, " + shown);
    }
}

void GltfAnimation::read_channel(const JsonObject& animation, const JsonObject& channel, LeftOutList& left_out) {
    const JsonObject target = channel.object("target");
    const auto node = target.index("node");
    if (!node) return;  // the target of an extension
    document_.element("nodes", *node, "node");
    const std::string path = target.text("path");
    const auto known = std::find_if(std::begin(properties), std::end(properties),
                                    [&](const auto& property) { return property.first == path; });
    if (known == std::end(properties)) {
        leave_out(left_out, "an animation of '" + excerpt(path) + "'", "such channels are unknown");
        return;
    }
    const std::size_t sampler_index = channel.needed("sampler");
    const nlohmann::json& samplers = animation.list("samplers");
    if (sampler_index >= samplers.size()) channel.fail("its sampler does not exist; the file is damaged");
    const JsonObject sampler(samplers[sampler_index], animation.name() + ": a sampler");
    const std::size_t input = sampler.needed("input");
    const std::size_t output = sampler.needed("output");
    const std::size_t components = components_of(document_, output);
    const auto count_of = [&](std::size_t accessor) {
        return document_.element("accessors", accessor, "accessor").needed("count");
    };
    GltfChannel result;
    result.node = *node;
    result.property = known->second;
    result.interpolation = interpolation_of(sampler);
    const bool is_cubic = result.interpolation == Interpolation::cubic;
    const std::size_t keys = count_of(input);
    // A key of weights has one element for each weight; a key of anything else is one element.
    const std::size_t elements = keys > 0 ? count_of(output) / (is_cubic ? 3 * keys : keys) : 0;
    const bool is_rotation = result.property == Property::rotation;
    const bool fits = result.property == Property::weights ? components == 1 && elements > 0
                                                           : components == (is_rotation ? 4u : 3u) && elements == 1;
    if (!fits) sampler.fail("its output has not one " + path + " for each key; correct it");
    result.size = elements * components;
    // The first key's value holds before it, too, and keys begin at 0 or later.
    result.times = {0.0};
    if (shutter_.second_at(1.0) > 0.0) {
        result.times = read_accessor(document_, input, 1);
        if (std::adjacent_find(result.times.begin(), result.times.end(), std::greater_equal<>()) !=
            result.times.end()) {
            sampler.fail("the times of its input do not ascend; the file is damaged");
        }
        const auto last = std::lower_bound(result.times.begin(), result.times.end(), shutter_.second_at(1.0));
        if (last != result.times.end()) result.times.erase(last + 1, result.times.end());
    }
    const std::size_t needed = result.times.size() * (is_cubic ? 3 : 1);
    // Of a single key the outgoing tangent is of no matter.
    const std::size_t read = is_cubic && result.times.size() == 1 ? needed - 1 : needed;
    result.values = read_accessor(document_, output, components, read * elements);
    channels_[*node].push_back(std::move(result));
}

const std::vector<GltfChannel>& GltfAnimation::channels(std::size_t node) const {
    static const std::vector<GltfChannel> none;
    const auto known = channels_.find(node);
    return known == channels_.end() ? none : known->second;
}

std::uint32_t GltfAnimation::least_parts(std::size_t node) const {
    std::size_t most = 0;
    for (const GltfChannel& channel : channels(node)) {
        const auto inside = std::count_if(channel.times.begin(), channel.times.end(),
                                          [&](double t) { return t > shutter_.opens && t < shutter_.second_at(1.0); });
        most = std::max(most, static_cast<std::size_t>(inside) + 1);
    }
    return static_cast<std::uint32_t>(most);
}

}  // namespace render
