// Config files of random bytes: the parser returns entries or throws a one-line error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/tools/options/config_file.hpp"
#include "pelagic/tools/options/wave_systems.hpp"
#include "pelagic/tools/text/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::string> known = {"preset", "spectrum", "wind_speed", "seed", "loop_period", "system"};
    try {
        for (const pelagic::tools::ConfigEntry& entry :
             pelagic::tools::parse_config({reinterpret_cast<const char*>(data), size}, "sea.toml", known))
            if (entry.key == pelagic::tools::list_key) pelagic::tools::wave_systems_of(entry);
    } catch (const pelagic::tools::InputError& error) {
        if (std::string_view(error.what()).find("sea.toml:") == std::string_view::npos) std::abort();
    }
    return 0;
}
