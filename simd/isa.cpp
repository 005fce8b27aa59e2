#include "pelagic/simd/isa.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {
namespace {

constexpr std::array isa_names = {std::string_view("sse4.2"), std::string_view("avx2"), std::string_view("avx512"),
                                  std::string_view("neon"), std::string_view("wasm128")};
constexpr std::array all_isas = {Isa::sse4_2, Isa::avx2, Isa::avx512, Isa::neon, Isa::wasm128};
constexpr std::array compiled_isas = {
#define PELAGIC_COMPILED_ISA(isa) Isa::isa,
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
};

std::string names_here() {
    std::string names;
    for (const Isa isa : isas_here()) names.append(names.empty() ? "" : ", ").append(name_of(isa));
    return names.empty() ? "none" : names;
}

#if defined(__x86_64__)
// F16C is a CPUID feature separate from AVX2, and clang 14's __builtin_cpu_supports() does not
// accept it.
bool has_f16c() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
#endif

[[noreturn]] void reject(std::string_view option, std::string_view value) {
    throw std::invalid_argument(
        invalid_value_message(option, value, "an instruction set that this CPU runs: " + names_here()));
}

}  // namespace

std::string_view name_of(Isa isa) { return isa_names[static_cast<std::size_t>(isa)]; }

std::optional<Isa> isa_named(std::string_view name) {
    for (const Isa isa : all_isas)
        if (name_of(isa) == name) return isa;
    return {};
}

bool runs_here(Isa isa) {
    if (std::find(compiled_isas.begin(), compiled_isas.end(), isa) == compiled_isas.end()) return false;
#if defined(__x86_64__)
    switch (isa) {
        case Isa::sse4_2: return __builtin_cpu_supports("sse4.2");
        case Isa::avx2: return __builtin_cpu_supports("avx2") && has_f16c();
        case Isa::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
        case Isa::neon:
        case Isa::wasm128: return false;
    }
    return false;
#elif defined(__wasm__)
    return isa == Isa::wasm128;  // a browser without it would not have compiled this module
#else
    return isa == Isa::neon;  // part of every 64-bit Arm
#endif
}

std::vector<Isa> isas_here() {
    std::vector<Isa> isas;
    for (const Isa isa : compiled_isas)
        if (runs_here(isa)) isas.push_back(isa);
    return isas;
}

Isa choose_isa(std::optional<Isa> wanted) {
    if (wanted) {
        if (!runs_here(*wanted)) reject("isa", name_of(*wanted));
        return *wanted;
    }
    if (const char* name = std::getenv("PELAGIC_ISA"); name && *name) {
        const std::optional<Isa> isa = isa_named(name);
        if (!isa || !runs_here(*isa)) reject("PELAGIC_ISA", name);
        return *isa;
    }
    const std::vector<Isa> isas = isas_here();
    if (isas.empty())
        throw std::invalid_argument(std::string("this CPU lacks ").append(name_of(compiled_isas[0])) +
                                    ", the least that this build's kernels need");
    return isas.back();
}

}  // namespace pelagic
