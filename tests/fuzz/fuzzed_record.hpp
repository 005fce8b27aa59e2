// What must hold of a record that was read back, whatever bytes it came from.
#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "pelagic/tools/export_names.hpp"
#include "pelagic/tools/export_record.hpp"

namespace pelagic {

/// Two frames of a small sea, with the gradient's first level: what the kept corpus was made with.
inline tools::ExportOptions small_export() {
    tools::ExportOptions options;
    options.sea.sea = {.resolution = 16, .patch_size_m = 250};
    options.frames = 2;
    options.fps = 24;
    return options;
}

inline void must_hold(bool holds) {
    if (!holds) std::abort();
}

template <class Parse>
void read_back(Parse parse, std::string_view text) {
    const tools::ExportOptions options = small_export();
    try {
        const tools::EarlierExport earlier = parse(text, options);
        for (const auto& [number, record] : earlier.frames) {
            must_hold(number >= 0 && number < options.frames && record.frame == number);
            must_hold(record.time_s == options.time_of(number));
            const std::vector<std::string> names = tools::image_names(options, number);
            must_hold(record.files.size() == names.size());
            for (std::size_t i = 0; i < names.size(); ++i) must_hold(record.files[i].name == names[i]);
        }
        // Plain names in the export's folder, none of them hidden.
        for (const std::string& name : earlier.images)
            must_hold(
                (name.starts_with("displacement_") || name.starts_with("gradient_") || name.starts_with("foam_")) &&
                name.find('/') == name.npos && name.find('\0') == name.npos && name.size() < 40);
        must_hold(tools::first_difference(earlier.options, tools::options_as_json(options)).size() < 250);
    } catch (const tools::DamagedRecord&) {
    }
}

}  // namespace pelagic
