#include <gtest/gtest.h>

#include "render/process.hpp"
#include "support/temporary_folder.hpp"

namespace {

TEST(RelightWithoutWindow, SaysSoInOneLine) {
    const TemporaryFolder folder;
    const auto result = Process(LIGHTCUTS_RELIGHT_EXECUTABLE, {"view", "a.relight", "--scene", "b", "--env", "c.hdr"},
                                folder.path(), folder.path())
                            .wait();
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("this build has no window"), std::string::npos) << result.err;
}

}  // namespace
