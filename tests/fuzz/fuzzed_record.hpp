// Invariants of a record that was read from arbitrary bytes.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/tests/fuzz/fuzz.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/record/export_record.hpp"

namespace pelagic {

/// Two frames of a small sea, with the gradient's first level: the options of the stored corpus.
inline tools::ExportOptions small_export() {
    tools::ExportOptions options;
    options.sea.sea = {.resolution = 16, .patch_size_m = 250};
    options.times.ranges = {{0, 1}};
    options.times.fps = 24;
    return options;
}

template <class Parse>
void read_back(Parse parse, std::string_view text) {
    const tools::ExportOptions options = small_export();
    try {
        const tools::EarlierExport earlier = parse(text, options);
        for (const auto& [number, record] : earlier.frames) {
            must(options.times.contains(number) && record.frame == number);
            must(record.time_s == options.times.time_of(number));
            const std::vector<tools::ImageFile> images = tools::image_files(options, number);
            must(record.files.size() == images.size());
            for (std::size_t i = 0; i < images.size(); ++i) must(record.files[i].name == images[i].name);
        }
        // Names must be plain file names in the export's folder, and not hidden.
        for (const std::string& name : earlier.images)
            must((tools::cascade_map_named(name.substr(0, name.find('_'))) || name.starts_with("sea_") ||
                       name.starts_with("mesh") || name.starts_with("flipbook")) &&
                      name.find('/') == name.npos && name.find('\0') == name.npos && name.size() < 40);
        const tools::Json now = tools::options_as_json(options);
        must(tools::first_difference(earlier.options, now).was_and_is().size() < 250);
        must(tools::first_option_difference(earlier.options, now).was_and_is().size() < 250);
    } catch (const tools::DamagedRecord&) {
    }
}

}  // namespace pelagic
