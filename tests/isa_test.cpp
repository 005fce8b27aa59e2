// Reports which instruction sets were tested: those that this CPU lacks are named, and `./test.sh`
// repeats them at its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "pelagic/simd/isa.hpp"
#include "pelagic/tests/each_isa.hpp"

namespace pelagic {
namespace {

std::vector<Isa> compiled_isas() {
    return {
#define PELAGIC_COMPILED_ISA(isa) Isa::isa,
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
    };
}

class CompiledIsa : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, CompiledIsa, testing::ValuesIn(compiled_isas()), isa_test_name);

TEST_P(CompiledIsa, RunsHere) {
    const std::vector<Isa> here = isas_here();
    if (!runs_here(GetParam()))
        GTEST_SKIP() << "this machine has no " << name_of(GetParam()) << ": its kernels were compiled, never run";
    EXPECT_EQ(std::count(here.begin(), here.end(), GetParam()), 1);
    EXPECT_EQ(choose_isa(GetParam()), GetParam());
}

}  // namespace
}  // namespace pelagic
