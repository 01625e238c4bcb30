#include "rays/ray_tracer.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <lightcuts/core/invalid_input.hpp>

#include "memory.hpp"
#include "options.hpp"

namespace render {

namespace {

struct Isa {
    const char* name;
    RTCDeviceProperty width;  ///< a property of every Embree that was compiled for this set
};

constexpr Isa isas[] = {{"sse2", RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED},
                        {"sse4.2", RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED},
                        {"avx", RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED},
                        {"avx2", RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED},
                        {"avx512", RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED}};

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;

/// Embree with this instruction set, or as it chooses; empty if the processor lacks it.
/// throws: std::bad_alloc, or std::runtime_error if something else is wrong.
Device start(const char* isa) {
    Device device(rtcNewDevice(isa ? (std::string("isa=") + isa).c_str() : nullptr));
    if (device) return device;
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_UNSUPPORTED_CPU) return device;
    if (error == RTC_ERROR_OUT_OF_MEMORY || is_memory_short()) throw std::bad_alloc();
    throw std::runtime_error("Embree cannot be started on this machine");
}

/// Whether Embree was compiled for it. Embree itself falls back to the next one that it was compiled for and says
/// nothing; that shows in the width of its packets, or else only in what its CMake package says.
bool is_compiled_in(const Isa& isa, RTCDevice device) {
    const std::string_view all = "," LIGHTCUTS_EMBREE_ISAS ",";
    return rtcGetDeviceProperty(device, isa.width) != 0 && all.find("," + std::string(isa.name) + ",") != all.npos;
}

std::string usable() {
    std::vector<std::string> names;
    for (const Isa& isa : isas) {
        const Device device = start(isa.name);
        if (device && is_compiled_in(isa, device.get())) names.push_back(isa.name);
    }
    return listed(names);
}

[[noreturn]] void refuse(const std::string& isa, const std::string& who) {
    throw lightcuts::invalid_input("--isa " + isa + ": " + who + " does not have it; leave --isa out or give one of " +
                                   usable());
}

/// The best instruction set that the processor has, of those that Embree was compiled for and `device` may use.
std::string chosen_by(RTCDevice device) {
    for (std::size_t i = std::size(isas); i-- > 0;) {
        if (is_compiled_in(isas[i], device) && start(isas[i].name)) return isas[i].name;
    }
    return "unknown";
}

}  // namespace

const std::vector<std::string>& isa_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Isa& isa : isas) all.push_back(isa.name);
        return all;
    }();
    return names;
}

RayTracer::RayTracer(const std::string& isa) {
    Device device = start(isa.empty() ? nullptr : isa.c_str());
    if (isa.empty()) {
        if (!device) throw std::runtime_error("Embree cannot be started on this processor");
        isa_ = chosen_by(device.get());
    } else {
        const auto known = std::find_if(std::begin(isas), std::end(isas), [&](const Isa& i) { return i.name == isa; });
        if (!device) refuse(isa, "this processor");
        if (known == std::end(isas) || !is_compiled_in(*known, device.get())) refuse(isa, "this build of Embree");
        isa_ = isa;
    }
    device_ = device.release();
}

RayTracer::RayTracer(const RayTracer& other) : device_(other.device_), isa_(other.isa_) { rtcRetainDevice(device_); }

RayTracer::~RayTracer() { rtcReleaseDevice(device_); }

std::string RayTracer::version() const {
    const auto number = [&](RTCDeviceProperty part) { return std::to_string(rtcGetDeviceProperty(device_, part)); };
    return number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
           number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace render
