// The floating-point environment of jobs.
//
// Game engines and audio libraries may set flush-to-zero or another rounding mode on their threads,
// which an application's executor may use. Either mode would change results. Each job sets the IEEE
// 754 default (round to nearest even, denormals kept, no traps) and restores the previous mode.
//
// Compilers do not know that arithmetic depends on the mode and move it over the change of mode. The
// change is a barrier for memory, which holds what a function reads and writes by reference. Numbers
// in registers need a barrier of their own: parameters by value are named in the constructor, and
// results by value pass through result().
#pragma once

#include <cstdint>

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic {

/// Sets the IEEE 754 default environment of the calling thread; the destructor restores the
/// previous one.
class DefaultFloatEnvironment {
   public:
    /// Arithmetic with `numbers`, the parameters by value, starts after the change of mode.
    template <class... Numbers>
    explicit DefaultFloatEnvironment(Numbers&... numbers) : found_(read()) {
        if (found_ != standard) write(standard);
        (pin(numbers), ...);
    }
    ~DefaultFloatEnvironment() {
        if (found_ != standard) write(found_);
    }
    DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
    DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

    /// Returns `value`, whose arithmetic ends before the mode is restored.
    template <class Value>
    Value result(Value value) const {
        pin(value);
        return value;
    }

   private:
#if defined(__wasm__)
    using Word = std::uint32_t;
    static constexpr Word standard = 0;  // WebAssembly has no other mode
    static Word read() { return standard; }
    static void write(Word) {}
    template <class Value>
    static void pin(Value&) {}
#else
    template <class Value>
    static void pin(Value& value) {
        __asm__ __volatile__("" : "+m"(value) : : "memory");
    }
#endif
#if defined(__x86_64__)
    using Word = std::uint32_t;
    // MXCSR at reset: all exceptions masked, nothing else set.
    static constexpr Word standard = 0x1F80;
    static Word read() {
        Word word;
        __asm__ __volatile__("stmxcsr %0" : "=m"(word));
        return word & ~Word{0x3F};  // without the sticky exception flags
    }
    static void write(Word word) { __asm__ __volatile__("ldmxcsr %0" : : "m"(word) : "memory"); }
#elif defined(__aarch64__)
    using Word = std::uint64_t;
    static constexpr Word standard = 0;  // FPCR at reset
    static Word read() {
        Word word;
        __asm__ __volatile__("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void write(Word word) { __asm__ __volatile__("msr fpcr, %0" : : "r"(word) : "memory"); }
#endif
    Word found_;
};

}  // namespace pelagic
