// Hardware counter of the instructions of the calling thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Counts instructions in user space, without those of the kernel and of other programs. The
/// counter is available on Linux if the machine has one (virtual machines rarely do) and
/// /proc/sys/kernel/perf_event_paranoid permits it.
class InstructionCounter {
   public:
    InstructionCounter();

    /// Returns the reason why there is no counter, or an empty string if there is one.
    const std::string& unavailable_reason() const { return message_; }

    /// Returns the instructions since construction. Returns no value without a counter, if other
    /// programs used the counter for a while, or if it counted on some of the processor's cores
    /// only.
    std::optional<std::uint64_t> count() const;

   private:
    Descriptor event_;
    std::string message_;
};

}  // namespace pelagic::tools
