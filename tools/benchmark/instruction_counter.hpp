// Instructions that the calling thread has executed, by the processor's own counter.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Counts in user space alone, so that neither the kernel's work nor other programs are in it. Linux lends the counter where
/// the machine has one (virtual ones seldom do) and /proc/sys/kernel/perf_event_paranoid allows it.
class InstructionCounter {
   public:
    InstructionCounter();

    /// Why there is no counter; empty if there is one.
    const std::string& invalid_value_message() const { return message_; }

    /// What has been counted since construction. None without a counter, and none if the counter was lent to others for a part
    /// of the time, or counted on some of the processor's cores only.
    std::optional<std::uint64_t> count() const;

   private:
    Descriptor event_;
    std::string message_;
};

}  // namespace pelagic::tools
