#include "pelagic/floating/given_coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

void append(std::vector<double>& numbers, const HullMatrix& matrix) {
    for (const Vector6& row : matrix) numbers.insert(numbers.end(), row.begin(), row.end());
}

template <class Read>
auto read_named(const std::string& name, const Read& read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(name + ": " + error.what());
    }
}

/// Numbers with dimensions, or of another length, are wrong by factors of hundreds.
void require_size(const std::string& name, const char* quantity, double value, double expected, const char* unit,
                  const char* accepted) {
    constexpr double least = 0.004, most = 25;
    if (value >= least * expected && value <= most * expected) return;
    throw std::invalid_argument(name + ": " + quantity + " is " + rounded_text(value, 3) + " " + unit +
                                ", expected about " + rounded_text(expected, 2) + " " + unit +
                                " for this hull: numbers without dimension, " + accepted);
}

}  // namespace

GivenCoefficients::GivenCoefficients(const RadiationTable& radiation, std::optional<ForceTable> excitation)
    : fit_(std::make_unique<const RadiationFit>(fit_radiation(radiation))), excitation_(std::move(excitation)) {
    std::vector<double> numbers;
    append(numbers, fit_->infinite_added_mass);
    for (const RadiationFit::Resonator& of : fit_->resonators) {
        numbers.insert(numbers.end(), {of.omega_radps, of.damping_ratio});
        append(numbers, of.strength);
    }
    if (excitation_) {
        require(WaveForces::check(*excitation_));
        for (const std::vector<double>* of : {&excitation_->omega_radps, &excitation_->heading_rad})
            numbers.insert(numbers.end(), of->begin(), of->end());
        for (const ForceTable::Forces& forces : excitation_->forces)
            for (const std::complex<double>& force : forces)
                numbers.insert(numbers.end(), {force.real(), force.imag()});
    }
    digest_ = XXH3_64bits(numbers.data(), numbers.size() * sizeof(double));
}

GivenCoefficients::~GivenCoefficients() = default;

WamitScale wamit_scale_of(const Hull& hull) {
    if (!hull.afloat().floats) throw std::invalid_argument("the hull sinks, expected one that floats");
    const glm::dvec3 centre = hull.centre_of_mass_m();
    WamitScale scale;
    scale.density_kgpm3 = hull.water_density_kgpm3();
    scale.origin_m = {-centre.x, -hull.afloat().height_m, -centre.z};
    return scale;
}

std::shared_ptr<const GivenCoefficients> read_coefficients(const Hull& hull, const CoefficientTexts& texts,
                                                           const std::optional<WamitScale>& asked) {
    const DefaultFloatEnvironment environment;
    const WamitScale scale = asked ? *asked : wamit_scale_of(hull);
    const RadiationTable radiation =
        read_named(texts.radiation_name, [&] { return read_wamit_1(texts.radiation, scale); });
    const double waterplane_m2 = hull.afloat().waterplane_m2, length_m = std::sqrt(waterplane_m2);
    require_size(texts.radiation_name, "A(3,3)", radiation.infinite_added_mass[1][1],
                 0.2 * scale.density_kgpm3 * waterplane_m2 * length_m, "kg", "A over rho L^3 and L in metres");
    std::optional<ForceTable> forces;
    if (!texts.excitation.empty()) {
        forces = read_named(texts.excitation_name, [&] { return read_wamit_3(texts.excitation, scale); });
        double heave = 0;
        for (const ForceTable::Forces& of : forces->forces) heave = std::max(heave, std::norm(of[1]));
        require_size(texts.excitation_name, "X(3)", std::sqrt(heave),
                     scale.density_kgpm3 * scale.gravity_mps2 * waterplane_m2, "N/m",
                     "X over rho g L^2 and L in metres");
    }
    return read_named(texts.radiation_name,
                      [&] { return std::make_shared<const GivenCoefficients>(radiation, std::move(forces)); });
}

std::string SeaForces::reason_unavailable(const Frame* frame) {
    if (!frame) return "in water without a frame";
    if (frame->sea.waves == WaveModel::pond) return "in a pond";
    if (frame->shore) return "on a shore";
    if (frame->sea_changes) return "while the sea changes";
    const std::vector<CascadePlan> plans = plan_cascades(frame->sea);
    const auto is_equal = [](const CascadePlan& plan, const Cascade& cascade) {
        return plan.grid.side_m == cascade.grid.side_m;
    };
    if (!std::equal(plans.begin(), plans.end(), frame->cascades.begin(), frame->cascades.end(), is_equal))
        return "in a forecast whose cascades hold other seas";
    return {};
}

const WaveForces& SeaForces::on(const Hull& hull, const WaterKinematics& water) {
    const Frame* const frame = water.frame_or_null();
    if (!sea_ || !frame || frame->shore || frame->sea_changes || !(*sea_ == frame->sea)) {
        if (const std::string reason = reason_unavailable(frame); !reason.empty())
            throw std::invalid_argument("forces of waves are unavailable " + reason +
                                        ", expected the water of a frame, or coefficients without a file .3");
        kinds_.clear();
        waves_ = highest_waves_of(frame->sea, share);
        sea_ = frame->sea;
    }
    for (const Kind& kind : kinds_)
        if (kind.of == hull.diffraction_) return *kind.forces;
    kinds_.push_back({hull.diffraction_, std::make_unique<const WaveForces>(*hull.diffraction_, waves_, 1)});
    return *kinds_.back().forces;
}

}  // namespace pelagic
