#pragma once

#include <string>

#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>

/// The message with which `action` refuses its input: one line, or the test fails.
template <class Action>
std::string refusal(Action&& action) {
    try {
        action();
    } catch (const lightcuts::invalid_input& problem) {
        const std::string message = problem.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_FALSE(message.empty());
        return message;
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
}
