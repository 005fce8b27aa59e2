// Rows of tests/golden/values.txt, which tests of bindings read, too: a kind, a name, and the bits
// of numbers in hexadecimal.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iomanip>
#include <sstream>
#include <string>

#include "pelagic/tests/test_paths.hpp"

namespace pelagic {

class GoldenRows {
   public:
    explicit GoldenRows(std::string kind) : kind_(std::move(kind)) {}

    void begin(const std::string& name) { rows_ << (rows_.tellp() > 0 ? "\n" : "") << kind_ << ' ' << name; }
    void add(std::uint64_t hash) { add(hash, 16); }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number), 16); }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number), 8); }
    template <class Number>
    void row(const std::string& name, std::initializer_list<Number> numbers) {
        begin(name);
        for (const Number number : numbers) add(number);
    }

    /// Expects the file to have exactly these rows of the kind. A failure prints them.
    void expect() const {
        std::ifstream file(in_sources("tests/golden/values.txt"));
        std::string golden;
        for (std::string line; std::getline(file, line);) {
            if (line.ends_with('\r')) line.pop_back();  // of a system that translates lines
            if (line.starts_with(kind_ + ' ')) golden += (golden.empty() ? "" : "\n") + line;
        }
        EXPECT_EQ(rows_.str(), golden) << "tests/golden/values.txt";
    }

   private:
    void add(std::uint64_t bits, int digits) {
        rows_ << ' ' << std::hex << std::setw(digits) << std::setfill('0') << bits;
    }

    std::string kind_;
    std::ostringstream rows_;
};

}  // namespace pelagic
