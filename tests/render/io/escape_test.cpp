#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <render/io/escape.hpp>

namespace {

using render::as_utf8;
using render::escaped;

TEST(Escape, LeavesTextAlone) {
    for (const std::string text : {"", "a/b c.exr", "\xc3\xa9t\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x8c\x9e", "\\x"}) {
        EXPECT_EQ(as_utf8(text), text);
        EXPECT_EQ(escaped(text), text);
    }
}

TEST(Escape, WritesBytesThatAreNoCharacter) {
    EXPECT_EQ(as_utf8("\xe9t\xe9"), "\\xE9t\\xE9");
    EXPECT_EQ(as_utf8("a\xc3"), "a\\xC3");
    EXPECT_EQ(as_utf8("\xc0\xaf \xe0\x80\xaf \xf0\x80\x80\xaf"), "\\xC0\\xAF \\xE0\\x80\\xAF \\xF0\\x80\\x80\\xAF");
    EXPECT_EQ(as_utf8("\xed\xa0\x80"), "\\xED\\xA0\\x80");
    EXPECT_EQ(as_utf8("\xf4\x90\x80\x80\xff"), "\\xF4\\x90\\x80\\x80\\xFF");
    EXPECT_EQ(as_utf8("a\nb"), "a\nb");
}

TEST(Escape, EscapedTextStaysInItsLine) {
    EXPECT_EQ(escaped("a\nb\r\tc"), "a\\nb\\r\\tc");
    EXPECT_EQ(escaped("\x1b[31m\x7f"), "\\x1B[31m\\x7F");
    EXPECT_EQ(escaped("\xc2\x9b"
                      "31m \xc2\xa0"),
              "\\xC2\\x9B31m \xc2\xa0");
    EXPECT_EQ(escaped(std::string_view("\0", 1)), "\\x00");
}

TEST(Escape, AgreesWithWhatJsonTakes) {
    // All pairs of bytes after a letter and before one, and what makes a longer character of them.
    for (int first = 0x80; first < 0x100; ++first) {
        for (int second = 0; second < 0x100; ++second) {
            for (const std::string tail : {"", "\x80", "\x80\x80"}) {
                const std::string text = std::string{static_cast<char>(first), static_cast<char>(second)} + tail;
                bool taken = true;
                try {
                    static_cast<void>(nlohmann::json(text).dump());
                } catch (const nlohmann::json::exception&) { taken = false; }
                ASSERT_EQ(as_utf8(text) == text, taken) << first << " " << second << " " << tail.size();
                ASSERT_NO_THROW(static_cast<void>(nlohmann::json(as_utf8(text)).dump()));
            }
        }
    }
}

}  // namespace
