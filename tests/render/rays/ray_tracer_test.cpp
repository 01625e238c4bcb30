#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <render/error.hpp>
#include <render/io/picture.hpp>
#include <render/rays/ray_tracer.hpp>

#include "render/programs.hpp"

namespace {

using render::Picture;

/// The renderer with each instruction set of the ray tracer.
class InstructionSet : public Programs {
protected:
    Process::Result with(const std::string& isa, const std::string& scene, const std::string& output) {
        return render("--quiet --method exhaustive --size 64x48 -o " + output + ".exr " + scene +
                      (isa.empty() ? "" : " --isa " + isa));
    }
    std::string used(const std::string& output) const {
        return report(output + ".json").at("ray_tracer").at("isa").get<std::string>();
    }
};

/// What this processor and Embree have.
std::vector<std::string> usable() {
    std::vector<std::string> names;
    for (const std::string& name : render::isa_names()) {
        try {
            const render::RayTracer tracer(name);
            names.push_back(name);
        } catch (const std::exception&) {}
    }
    return names;
}

TEST_F(InstructionSet, IsTheBestUnlessChosen) {
    const std::string scene = "room.obj" + view;
    const std::vector<std::string> names = usable();
    ASSERT_FALSE(names.empty());
    ASSERT_EQ(with("", scene, "default").status, 0);
    EXPECT_EQ(used("default"), names.back());
    EXPECT_EQ(report("default.json").at("options").at("isa"), nullptr);
    const std::string version = report("default.json").at("ray_tracer").at("version");
    EXPECT_EQ(version, RTC_VERSION_STRING);
    for (const std::string& name : render::isa_names()) {
        const auto result = with(name, scene, name);
        if (std::count(names.begin(), names.end(), name) > 0) {
            ASSERT_EQ(result.status, 0) << result.err;
            EXPECT_EQ(used(name), name);
            EXPECT_EQ(report(name + ".json").at("options").at("isa"), name);
        } else {
            EXPECT_EQ(result.status, 1) << result.err;
            EXPECT_TRUE(is_one_line(result.err)) << result.err;
            EXPECT_NE(result.err.find("--isa " + name + ": this"), std::string::npos) << result.err;
            EXPECT_FALSE(folder.has(name + ".exr"));
        }
    }
}

#if defined(__x86_64__) && defined(__GNUC__)
TEST_F(InstructionSet, IsTakenForUsableIfTheProcessorHasIt) {
    const std::vector<std::string> names = usable();
    const auto is_usable = [&](const char* name) { return std::count(names.begin(), names.end(), name) > 0; };
    EXPECT_TRUE(is_usable("sse2"));
    EXPECT_EQ(is_usable("sse4.2"), __builtin_cpu_supports("sse4.2") != 0);
    EXPECT_EQ(is_usable("avx"), __builtin_cpu_supports("avx") != 0);
    EXPECT_EQ(is_usable("avx2"), __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
    EXPECT_EQ(is_usable("avx512"), __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                       __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"));
}
#endif

TEST_F(InstructionSet, IsNotExceeded) {
    const auto has = [](const std::string& isa, RTCDeviceProperty width) {
        return rtcGetDeviceProperty(render::RayTracer(isa).device(), width) != 0;
    };
    for (const std::string& name : usable()) {
        EXPECT_EQ(has(name, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED), name.starts_with("avx")) << name;
        EXPECT_EQ(has(name, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED), name == "avx512") << name;
    }
}

TEST_F(InstructionSet, GivesItsPictureEachTime) {
    for (const std::string& name : usable()) {
        ASSERT_EQ(with(name, "room.obj" + view, "first").status, 0);
        ASSERT_EQ(with(name, "room.obj" + view + "--threads 2", "second").status, 0);
        EXPECT_EQ(folder.read("first.exr"), folder.read("second.exr")) << name;
    }
}

/// Where a pixel's center or a shadow ray meets an edge to within rounding, sets may differ in which surface they see;
/// these scenes have no such place.
TEST_F(InstructionSet, ChangesAPictureByTheLastDigitsOnly) {
    for (const std::string& scene : {"room.obj" + view, std::string("builtin:surfaces?lights=200")}) {
        ASSERT_EQ(with("", scene, "default").status, 0);
        const Picture expected = render::read_exr(folder / "default.exr");
        for (const std::string& name : usable()) {
            ASSERT_EQ(with(name, scene, name).status, 0);
            const render::ErrorFigures error = render::compare(render::read_exr(folder / (name + ".exr")), expected);
            EXPECT_LE(error.relative_rmse, 1e-4) << scene << " " << name;
            EXPECT_LE(error.max_relative, 0.01) << scene << " " << name;
        }
    }
}

TEST_F(InstructionSet, IsRefusedIfItIsUnknown) {
    for (const std::string name : {"neon64", "AVX2", "''"}) {
        const auto result = with(name, "room.obj" + view, "no");
        EXPECT_EQ(result.status, 2) << name;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("sse2, sse4.2, avx, avx2, avx512"), std::string::npos) << result.err;
        EXPECT_FALSE(folder.has("no.exr"));
    }
}

}  // namespace
