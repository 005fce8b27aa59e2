// Fallback for systems without an implementation.
#include "pelagic/tools/benchmark/instruction_counter.hpp"

namespace pelagic::tools {

InstructionCounter::InstructionCounter() : message_("counters are not supported on this system") {}

std::optional<std::uint64_t> InstructionCounter::count() const { return {}; }

}  // namespace pelagic::tools
