// The frame computed with FFTW and PATIENT plans.
//
// FFTW selects its code itself, regardless of the instruction set here; Debian's build supports
// SSE2 and AVX.
#pragma once

#include <memory>
#include <string>

#include "pelagic/bench/peers/library_frame.hpp"

namespace pelagic::peers {

/// Source of FFTW's plans.
enum class FftwPlanning {
    measured,  ///< measured in this process: seconds to minutes
    read       ///< by read_fftw_plans(), for programs that count instructions and run slowly
};

/// Writes all plans that this process has measured, for another process. Throws std::runtime_error.
void write_fftw_plans(const std::string& file);
void read_fftw_plans(const std::string& file);

class FftwFrame final : public LibraryFrame {
   public:
    /// Plans and bakes. Throws std::runtime_error if plans that were read do not include this plan.
    /// \pre check(sea) is empty, runs_here(isa), N >= 2 lanes of isa
    FftwFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement,
              FftwPlanning planning = FftwPlanning::measured);
    ~FftwFrame() override;

   private:
    struct Plans;

    void transform() override;

    std::unique_ptr<Plans> plans_;
};

}  // namespace pelagic::peers
