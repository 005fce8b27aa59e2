#include "pelagic/quadtree/quadtree_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {
namespace {

// Below tau = 1.58 neighbours can be two levels apart (errata). Pelagic's presets have larger
// values, so patches are rarely split because of a neighbour. A cull scale of 1 suffices, because
// the boxes contain the frame's extremes.
constexpr QuadtreePreset presets[] = {
    {"low", 16, 1.8, 1.0},        {"medium", 32, 2.0, 1.0},      {"high", 64, 2.2, 1.0, 16},
    {"ultra", 128, 2.4, 1.0, 16}, {"paper_low", 16, 2.0, 1.2},   {"paper_medium", 32, 1.5, 1.5},
    {"paper_high", 64, 1.2, 1.8}, {"paper_ultra", 64, 1.0, 2.0},
};

using Field = NumericField<QuadtreeOptions>;
constexpr Field fields[] = {
    // generated from schema/quadtree.toml: table
    {"size_m", &QuadtreeOptions::size_m, 256, 8192, "[256, 8192]"},
    {"vertices", &QuadtreeOptions::vertices, 2, 128, "an even number from 2 to 128", Restriction::even},
    {"lod_scale", &QuadtreeOptions::lod_scale, 0.75, 8, "[0.75, 8]"},
    {"cull_scale", &QuadtreeOptions::cull_scale, 1, 4, "[1, 4]"},
    {"finest_patch_m", &QuadtreeOptions::finest_patch_m, 16, 64, "[16, 64]"},
    // end of generated
};

}  // namespace

std::string check(const QuadtreeOptions& options) {
    if (std::string reason = check_fields(options, fields); !reason.empty()) return reason;
    if (const auto limit = options.batch_limit; limit && *limit < 1)
        return invalid_value_message("batch_limit", *limit, "1 or more");
    return {};
}

int deepest_level(double size_m, double finest_patch_m) {
    return std::clamp(static_cast<int>(std::floor(std::log2(size_m / finest_patch_m) + 0.5)), 2, 8);
}

std::span<const QuadtreePreset> quadtree_presets() { return presets; }

const QuadtreePreset* quadtree_preset_named(std::string_view name) {
    const auto is_it = [name](const QuadtreePreset& preset) { return preset.name == name; };
    const auto* preset = std::find_if(std::begin(presets), std::end(presets), is_it);
    return preset == std::end(presets) ? nullptr : preset;
}

}  // namespace pelagic
