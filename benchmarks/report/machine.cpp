#include "report/machine.hpp"

#include <ctime>
#include <fstream>
#include <thread>

namespace benchmark {

namespace {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown compiler";
#endif
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
    return text;
}

}  // namespace

Machine this_machine() {
#ifdef NDEBUG
    const char* build = "without assertions";
#else
    const char* build = "with assertions: times mean little";
#endif
    return {processor_name(), std::thread::hardware_concurrency(), compiler_name(), build, today()};
}

std::string to_text(const Machine& m) {
    return m.processor + ", " + std::to_string(m.threads) + " threads; " + m.compiler + ", " + m.build + "; " + m.date;
}

}  // namespace benchmark
