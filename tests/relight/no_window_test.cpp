#include <algorithm>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <relight/window.hpp>

namespace {

TEST(RelightWithoutWindow, SaysSoInOneLine) {
    try {
        relight::show_window(relight::Options());
        FAIL() << "there is a window";
    } catch (const std::runtime_error& e) {
        const std::string says = e.what();
        EXPECT_EQ(std::count(says.begin(), says.end(), '\n'), 0) << says;
        EXPECT_NE(says.find("this build has no window"), std::string::npos) << says;
    }
}

}  // namespace
