#include "pelagic/sim/sea_state.hpp"

#include <array>
#include <cmath>

#include "pelagic/message/refusal.hpp"

namespace pelagic {
namespace {

constexpr std::array models = {SpectrumModel::phillips_paper, SpectrumModel::phillips,
                               SpectrumModel::pierson_moskowitz, SpectrumModel::jonswap};
constexpr std::array<std::string_view, models.size()> model_names = {"phillips-paper", "phillips",
                                                                     "pierson-moskowitz", "jonswap"};

constexpr double two_pi = 6.283185307179586;

constexpr std::array fields = {
    SeaStateField{"resolution", &SeaState::resolution, 16, 2048, false, true, "a power of two from 16 to 2048"},
    SeaStateField{"patch_size_m", &SeaState::patch_size_m, 0.001, 1e6, false, false, "[0.001, 1e6]"},
    SeaStateField{"wind_speed_mps", &SeaState::wind_speed_mps, 0, 60, true, false, "(0, 60]"},
    SeaStateField{"wind_direction_rad", &SeaState::wind_direction_rad, -two_pi, two_pi, false, false,
                  "[-2 pi, 2 pi]"},
    SeaStateField{"fetch_m", &SeaState::fetch_m, 0, 2e6, true, false, "(0, 2e6]"},
    SeaStateField{"depth_m", &SeaState::depth_m, 0.01, 11000, false, false, "[0.01, 11000]"},
    SeaStateField{"choppiness", &SeaState::choppiness, 0, 1, false, false, "[0, 1]"},
    SeaStateField{"roughness", &SeaState::roughness, 0, 1, false, false, "[0, 1]"},
    SeaStateField{"small_waves", &SeaState::small_waves, 0, 1, false, false, "[0, 1]"},
    SeaStateField{"alignment", &SeaState::alignment, 0, 1, false, false, "[0, 1]"},
    SeaStateField{"loop_period_s", &SeaState::loop_period_s, 0.1, 86400, false, false, "[0.1, 86400]"},
    SeaStateField{"seed", &SeaState::seed, 0, 4294967295.0, false, false, "a whole number from 0 to 4294967295"},
};

}  // namespace

std::string_view name_of(SpectrumModel model) { return model_names[static_cast<std::size_t>(model)]; }

std::optional<SpectrumModel> spectrum_model_named(std::string_view name) {
    for (const SpectrumModel model : models)
        if (name_of(model) == name) return model;
    return {};
}

std::span<const SpectrumModel> spectrum_models() { return models; }

bool SeaStateField::accepts(double value) const {
    // The first comparison is false for NaN.
    if (!(value >= least && value <= most) || (open_below && value == least)) return false;
    if (!power_of_two) return true;
    const auto whole = static_cast<long>(value);
    return static_cast<double>(whole) == value && (whole & (whole - 1)) == 0;
}

std::span<const SeaStateField> sea_state_fields() { return fields; }

std::string check(const SeaState& sea) {
    if (static_cast<std::size_t>(sea.spectrum) >= models.size()) return "spectrum is no known model";
    for (const SeaStateField& field : fields) {
        const double value = std::visit([&](auto member) { return static_cast<double>(sea.*member); }, field.member);
        if (!field.accepts(value)) return refusal(field.name, value, field.accepted);
    }
    return {};
}

}  // namespace pelagic
