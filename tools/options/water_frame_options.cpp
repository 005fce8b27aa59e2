#include "pelagic/tools/options/water_frame_options.hpp"

#include <cmath>
#include <vector>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {

void WaterFrameFlags::add_to(CLI::App& app) {
    app.add_option("--sea-level", sea_level_,
                   "height of still water in metres, as of a tide; [-1000, 1000] (default: 0)")
        ->type_name("METRES")
        ->group(help_group::sea);
    app.add_option("--current", current_,
                   "velocity of the water in m/s, since time 0; each in [-10, 10] (default: 0,0)")
        ->type_name("X,Z")
        ->group(help_group::sea);
}

WaterFrame WaterFrameFlags::resolve(bool has_shore) const {
    WaterFrame water;
    if (sea_level_) {
        if (has_shore) throw InputError("--sea-level cannot be combined with --shore");
        water.sea_level_m = number_in("--sea-level", *sea_level_, -1000, 1000, "metres in [-1000, 1000]");
    }
    if (current_) {
        if (has_shore) throw InputError("--current cannot be combined with --shore");
        const std::vector<std::string> numbers = split_at_commas(*current_);
        const auto x = parse_number(numbers[0]), z = parse_number(numbers.size() == 2 ? numbers[1] : "");
        if (!x || !z || std::abs(*x) > 10 || std::abs(*z) > 10)
            throw bad_value("--current", *current_, "X,Z in m/s, each in [-10, 10]");
        water.current_x_mps = *x;
        water.current_z_mps = *z;
    }
    return water;
}

std::string WaterFrameFlags::typed() const {
    return (sea_level_ ? " --sea-level " + *sea_level_ : "") + (current_ ? " --current " + *current_ : "");
}

}  // namespace pelagic::tools
