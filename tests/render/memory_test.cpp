#include <string>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "programs.hpp"

/// With less memory than a picture takes.
class Memory : public Programs {
protected:
    static std::function<void()> address_space(rlim_t bytes) {
        return [bytes] {
            const rlimit limit{bytes, bytes};
            ::setrlimit(RLIMIT_AS, &limit);
        };
    }
};

TEST_F(Memory, AShortageIsToldInOneLine) {
    const auto before = files();
    const auto result = render("builtin:hall --size 64x48", address_space(150'000ull * 1024));
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("not enough memory"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("154 MB"), std::string::npos) << result.err;
    EXPECT_EQ(files(), before);
}

TEST_F(Memory, NoLimitEndsInACrash) {
    // Threads, the ray tracer, trees and the picture run short in turn. With less the program and its libraries cannot
    // be loaded.
    for (rlim_t megabytes = 75; megabytes <= 600; megabytes += 45) {
        const auto result = render("builtin:hall --size 64x48 --threads 8 --indirect 1000 --quiet",
                                   address_space(megabytes << 20));
        EXPECT_TRUE(result.status == 0 || result.status == 1) << megabytes << " MB: " << result.status << result.err;
        if (result.status == 0) continue;
        EXPECT_TRUE(is_one_line(result.err)) << megabytes << " MB: " << result.err;
        EXPECT_NE(result.err.find("not enough memory"), std::string::npos) << megabytes << " MB: " << result.err;
    }
}
