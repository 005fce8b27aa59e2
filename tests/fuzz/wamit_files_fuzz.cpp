// Files .1 and .3 of WAMIT of random bytes: tables that other functions accept, or a one-line error.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/floating/wamit_files.hpp"
#include "pelagic/floating/wave_forces.hpp"
#include "pelagic/tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelagic;
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
    const WamitScale scale{.first_column = data[0] % 2 == 0 ? WamitScale::Column::period_s
                                                            : WamitScale::Column::omega_radps,
                           .length_m = 1.0 + data[0] % 5,
                           .origin_m = glm::dvec3(data[0] % 3, 1, 0)};
    try {
        if (data[0] < 128)
            must(check(read_wamit_1(text, scale)).empty());
        else
            must(WaveForces::check(read_wamit_3(text, scale)).empty());
    } catch (const std::invalid_argument& error) {
        const std::string_view what = error.what();
        must(!what.empty() && what.size() < 300 && what.find('\n') == std::string_view::npos);
    }
    return 0;
}
