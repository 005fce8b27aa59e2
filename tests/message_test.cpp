// Error messages: numbers read back exactly, and a message is one short line without control
// characters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

/// Returns the value of "NAME VALUE is out of range ...", parsed by the C library.
double quoted_number(const std::string& message) {
    return std::strtod(message.c_str() + message.find(' ') + 1, nullptr);
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 100'000; ++i) {
        const std::uint64_t bits = random();
        double value;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value)) continue;
        ASSERT_EQ(std::strtod(number_text(value).c_str(), nullptr), value) << number_text(value);
        const float single = static_cast<float>(random() % 2'000'000) / 977.f - 1000.f;
        ASSERT_EQ(std::strtof(number_text(single).c_str(), nullptr), single) << number_text(single);
    }
    for (const double value : {0.0, -0.0, 1e-300, 5e-324, 1e-4, 9.99e-5, 1e15, 1.7976931348623157e308})
        EXPECT_EQ(std::strtod(number_text(value).c_str(), nullptr), value) << number_text(value);
}

TEST(NumberText, IsTheShortestNotation) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(0.1f), "0.1");
    EXPECT_EQ(number_text(100'000.0), "100000");
    EXPECT_EQ(number_text(1e-9), "1e-09");
    EXPECT_EQ(number_text(-7), "-7");
    EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(rounded_text(7.654321, 4), "7.654");
    EXPECT_EQ(rounded_text(0.000123456, 4), "0.0001235");
    EXPECT_EQ(rounded_text(1234567, 4), "1235000");
    EXPECT_EQ(rounded_text(200, 4), "200");
    EXPECT_EQ(rounded_text(0, 4), "0");
}

TEST(InvalidValueMessage, PrintsTheGivenNumber) {
    for (const double value : {8.000000000000002, -4.9e-324, -1e-300, 12345678.912345679}) {
        EXPECT_EQ(quoted_number(check(SeaState{.choppiness = value})), value);
        EXPECT_EQ(quoted_number(check(QuadtreeOptions{.size_m = value})), value);
        EXPECT_EQ(quoted_number(check(QuadtreeOptions{.lod_scale = value})), value);
    }
}

TEST(OneLine, HasNoControlCharactersAndKeepsLetters) {
    EXPECT_EQ(one_line("a\nb\tc\x1b[2J\x7f"), R"(a\nb\x09c\x1b[2J\x7f)");
    EXPECT_EQ(one_line(std::string_view("a\0b", 3)), R"(a\x00b)");
    EXPECT_EQ(one_line("h\xc3\xb6he 5 \xe2\x89\xa4 6 \xf0\x9f\x8c\x8a"),
              "h\xc3\xb6he 5 \xe2\x89\xa4 6 \xf0\x9f\x8c\x8a");
    // U+009B starts a terminal escape as "\x1b[" does; U+2028 ends a line.
    EXPECT_EQ(one_line("\xc2\x9b"), R"(\xc2\x9b)");
    EXPECT_EQ(one_line("\xe2\x80\xa8"), R"(\xe2\x80\xa8)");
    // Invalid UTF-8: a lone byte of Latin 1, an overlong "/", a surrogate, a value beyond U+10FFFF,
    // a truncated sequence.
    EXPECT_EQ(one_line("\xe9t\xe9"), R"(\xe9t\xe9)");
    EXPECT_EQ(one_line("\xc0\xaf"), R"(\xc0\xaf)");
    EXPECT_EQ(one_line("\xed\xa0\x80"), R"(\xed\xa0\x80)");
    EXPECT_EQ(one_line("\xf4\x90\x80\x80"), R"(\xf4\x90\x80\x80)");
    EXPECT_EQ(one_line("\xe2\x89"), R"(\xe2\x89)");
}

TEST(OneLine, IsShortAndKeepsBothEnds) {
    for (std::size_t length = 0; length < 2000; length += 7) {
        for (const std::string piece : {"x", "\n", "\xc3\xb6", "\xf0\x9f\x8c\x8a"}) {
            std::string value;
            while (value.size() < length) value += piece;
            const std::string line = invalid_value_message("wind_speed_mps", value, "(0, 60]");
            ASSERT_LE(line.size(), max_line_bytes);
            ASSERT_TRUE(line.starts_with("wind_speed_mps ")) << line;
            ASSERT_TRUE(line.ends_with(" is out of range (0, 60]")) << line;
            ASSERT_EQ(one_line(line), line) << "cut within a character";
            if (piece == "x" && line.size() < max_line_bytes - 5) {
                ASSERT_EQ(line.find(" ... "), std::string::npos) << line;
            }
        }
    }
}

TEST(OneLine, IsUsedForTheNamesOfStages) {
    JobGraph graph;
    const std::string what =
        message_of([&] { graph.add({.name = std::string(1000, '\n'), .batch = 0, .body = {}}); });
    EXPECT_LE(what.size(), max_line_bytes);
    EXPECT_EQ(what.find('\n'), std::string::npos);
    EXPECT_TRUE(what.ends_with("has a batch of 0, expected at least 1")) << what;
}

}  // namespace
}  // namespace pelagic
