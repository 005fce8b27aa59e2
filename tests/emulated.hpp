// Whether an emulator runs the tests, ten to twenty times slower than native code. Then results are
// compared at fewer sizes and times. Executors and threads are not tested: their code is the same,
// and the memory order is the host CPU's.
#pragma once

namespace pelagic {

#if defined(PELAGIC_EMULATED)
inline constexpr bool is_emulated = true;
#else
inline constexpr bool is_emulated = false;
#endif

}  // namespace pelagic
