// The floating-point environment of jobs.
//
// Game engines and audio libraries may set flush-to-zero or another rounding mode on their threads,
// which an application's executor may use. Either mode would change results. Each job sets the IEEE
// 754 default (round to nearest even, denormals kept, no traps) and restores the previous mode.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic {

/// Sets the IEEE 754 default environment of the calling thread; the destructor restores the
/// previous one.
class DefaultFloatEnvironment {
   public:
    DefaultFloatEnvironment() : found_(read()) {
        if (found_ != standard) write(standard);
    }
    ~DefaultFloatEnvironment() {
        if (found_ != standard) write(found_);
    }
    DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
    DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

   private:
#if defined(__x86_64__)
    using Word = std::uint32_t;
    // MXCSR at reset: all exceptions masked, nothing else set.
    static constexpr Word standard = 0x1F80;
    static Word read() { return _mm_getcsr() & ~Word{0x3F}; }  // without the sticky exception flags
    static void write(Word word) { _mm_setcsr(word); }
#elif defined(__aarch64__)
    using Word = std::uint64_t;
    static constexpr Word standard = 0;  // FPCR at reset
    static Word read() {
        Word word;
        __asm__ __volatile__("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void write(Word word) { __asm__ __volatile__("msr fpcr, %0" : : "r"(word)); }
#elif defined(__wasm__)
    using Word = std::uint32_t;
    static constexpr Word standard = 0;  // WebAssembly has no other mode
    static Word read() { return standard; }
    static void write(Word) {}
#endif
    Word found_;
};

}  // namespace pelagic
