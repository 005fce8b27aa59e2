// Whether an emulator runs the tests of another processor, ten to twenty times as slowly: then bits are compared, of fewer sizes
// and times, and not executors and threads, which are the same code everywhere and have this machine's order of memory.
#pragma once

namespace pelagic {

#if defined(PELAGIC_EMULATED)
inline constexpr bool is_emulated = true;
#else
inline constexpr bool is_emulated = false;
#endif

}  // namespace pelagic
