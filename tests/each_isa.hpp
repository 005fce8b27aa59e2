// Instruction sets as test parameters: TEST_P(EvolveOnEachIsa, ...) runs on every one that this CPU
// supports.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

inline void PrintTo(Isa isa, std::ostream* out) { *out << name_of(isa); }

class OnEachIsa : public testing::TestWithParam<Isa> {
   protected:
    const Kernels& kernels() const { return kernels_for(GetParam()); }
};

/// Returns a test name without dots, which GoogleTest does not allow: "sse4_2".
inline std::string isa_test_name(const testing::TestParamInfo<Isa>& info) {
    std::string name(name_of(info.param));
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

}  // namespace pelagic
