#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <lightcuts/core/invalid_input.hpp>

/// What libFuzzer calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Calls `read(bytes)`, which may refuse them by invalid_input in one line, or find that they ask for more memory than
/// there is. Anything else that it throws is a finding.
template <class Read>
int feed(const std::uint8_t* data, std::size_t size, const Read& read) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        read(bytes);
    } catch (const lightcuts::invalid_input& problem) {
        const std::string_view message = problem.what();
        if (message.empty() || message.find('\n') != std::string_view::npos) std::terminate();
    } catch (const std::bad_alloc&) {
        return -1;  // not worth keeping
    }
    return 0;
}
