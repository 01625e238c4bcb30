#pragma once

#include <string>
#include <vector>

#include "rays/embree.hpp"

namespace render {

/// Names of the instruction sets that Embree can trace with, the oldest first.
const std::vector<std::string>& isa_names();

/// Embree, started. Pictures depend on its instruction set in their last digits: the hierarchies of different widths
/// meet triangles in another order, and some sets round products and sums at once.
class RayTracer {
public:
    /// `isa`: one of isa_names(), or empty for what Embree chooses, the best that the processor has.
    /// throws: invalid_input if the processor or Embree lacks it; std::runtime_error if Embree cannot be started.
    explicit RayTracer(const std::string& isa = {});
    RayTracer(const RayTracer& other);
    RayTracer& operator=(const RayTracer&) = delete;
    ~RayTracer();

    RTCDevice device() const { return device_; }
    /// The instruction set in use, one of isa_names().
    const std::string& isa() const { return isa_; }
    /// Of Embree, such as 3.13.5.
    std::string version() const;

private:
    RTCDevice device_ = nullptr;
    std::string isa_;
};

}  // namespace render
