// The frame computed with KISS FFT, whose code is scalar and portable.
#pragma once

#include <memory>

#include "pelagic/bench/peers/library_frame.hpp"

namespace pelagic::peers {

class KissFrame final : public LibraryFrame {
   public:
    /// \pre check(sea) is empty, runs_here(isa), N >= 2 lanes of isa
    KissFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement);
    ~KissFrame() override;

   private:
    struct Plans;

    void transform() override;

    std::unique_ptr<Plans> plans_;
};

}  // namespace pelagic::peers
