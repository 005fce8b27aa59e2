// Every sea that check() accepts gives complete frames of finite numbers: each option at the edges
// of its range, alone, in pairs and all together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

using Edges = std::vector<double>;

/// Returns minimum, maximum and the neighbouring values inside. A range that is open below begins
/// with the smallest positive number.
Edges edges_of(const SeaStateField& field) {
    // A frame of 2048 tests no more edges than one of 32.
    if (field.name == "resolution") return {16, 32};
    if (std::holds_alternative<std::uint32_t SeaState::*>(field.member)) return {field.min, 1, field.max};
    const auto inside = [](double edge, double towards) { return std::nextafter(edge, towards); };
    Edges edges = {inside(field.min, field.max), inside(field.max, field.min), field.max};
    if (field.restriction != Restriction::above_min) edges.push_back(field.min);
    if (field.also) edges.push_back(*field.also);
    return edges;
}

std::string text_of(const SeaState& sea) {
    std::string text(name_of(sea.spectrum));
    for (const SeaStateField& field : sea_state_fields())
        text += " " + std::string(field.name) + " " + number_text(field.value_in(sea));
    return text;
}

bool is_finite_half(std::uint16_t half) { return (half & 0x7C00) != 0x7C00; }

/// Returns an empty string, or the error in the cascade.
std::string fault_of(const Cascade& cascade) {
    float min = std::numeric_limits<float>::infinity(), max = -min, max_dx = 0, max_dz = 0;
    for (int j = 0; j < cascade.resolution(); ++j) {
        for (int i = 0; i < cascade.resolution(); ++i) {
            for (const PlaneView* plane : {&cascade.dx, &cascade.height, &cascade.dz, &cascade.velocity_x,
                                           &cascade.velocity_y, &cascade.velocity_z})
                if (!std::isfinite(plane->at(i, j))) return "a plane is not finite";
            min = std::min(min, cascade.height.at(i, j));
            max = std::max(max, cascade.height.at(i, j));
            max_dx = std::max(max_dx, std::fabs(cascade.dx.at(i, j)));
            max_dz = std::max(max_dz, std::fabs(cascade.dz.at(i, j)));
        }
    }
    const FrameBounds& bounds = cascade.bounds;
    if (bounds.height_min_m != min || bounds.height_max_m != max || bounds.horizontal_x_max_m != max_dx ||
        bounds.horizontal_z_max_m != max_dz)
        return "bounds are not the extremes";
    for (const std::uint16_t half : cascade.displacement_rgba16f)
        if (!is_finite_half(half)) return "a half is not finite";
    if (!std::isfinite(cascade.compression_scale)) return "the scale of compression is not finite";
    return {};
}

/// Returns an empty string, or the error in the frame.
std::string fault_of(const Frame& frame) {
    for (const Cascade& cascade : frame.cascades)
        if (const std::string fault = fault_of(cascade); !fault.empty()) return fault;
    const double roughness = frame.statistics.roughness;
    if (!(roughness >= 0 && roughness <= 1)) return "the roughness is " + number_text(roughness);
    return {};
}

std::string fault_of_answers(const SurfaceQuery& query, double patch_size_m) {
    constexpr std::size_t count = 16;
    std::vector<double> x(count), z(count);
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = static_cast<double>(i) * 0.37 * patch_size_m;
        z[i] = static_cast<double>(i) * -0.11 * patch_size_m;
    }
    std::vector<float> values[9];
    for (auto& each : values) each.resize(count);
    query.sample({x, z}, {.height_m = values[0],
                          .normal_x = values[1],
                          .normal_y = values[2],
                          .normal_z = values[3],
                          .jacobian = values[4],
                          .velocity_x_mps = values[5],
                          .velocity_y_mps = values[6],
                          .velocity_z_mps = values[7],
                          .error_m = values[8]});
    for (std::size_t i = 0; i < count; ++i) {
        for (const auto& each : values)
            if (!std::isfinite(each[i])) return "an answer is not finite";
        // Heights are interpolated bilinearly between texels, in float.
        const double slack =
            1e-6 * (1 + std::fabs(query.bounds().height_max_m) + std::fabs(query.bounds().height_min_m));
        if (values[0][i] < query.bounds().height_min_m - slack || values[0][i] > query.bounds().height_max_m + slack)
            return "a height is out of bounds";
        const double length = std::hypot(values[1][i], values[2][i], values[3][i]);
        if (std::fabs(length - 1) > 1e-5) return "a normal has the length " + number_text(length);
    }
    return {};
}

/// Resets options that other options exclude.
SeaState without_exclusions(SeaState sea) {
    if (sea.spectrum == SpectrumModel::phillips_paper) sea.swell_height_m = 0;
    if (sea.spectrum == SpectrumModel::none && sea.swell_height_m == 0) sea.swell_height_m = 2;
    if (check(sea).starts_with("cascades")) sea.cascades = 0;
    if (check(sea).starts_with("fetch_m")) sea.fetch_m = SeaState{}.fetch_m;
    if (const std::string reason = check(sea);
        reason.starts_with("wave_height_m") || reason.starts_with("peak_period_s"))
        sea.wave_height_m = sea.peak_period_s = 0;
    return sea;
}

void expect_finite(const SeaState& sea) {
    ASSERT_EQ(check(sea), "") << text_of(sea);
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
    for (const double time_s : {0.0, 0.7 * sea.loop_period_s}) {
        const Frame& frame = ocean.frame_at(time_s);
        const std::string fault = fault_of(frame);
        ASSERT_EQ(fault, "") << text_of(sea);
        ASSERT_EQ(fault_of_answers(SurfaceQuery(frame), frame.cascades[0].grid.side_m), "") << text_of(sea);
    }
}

class SeaRange : public testing::TestWithParam<SpectrumModel> {};
INSTANTIATE_TEST_SUITE_P(Models, SeaRange, testing::ValuesIn(values_of<SpectrumModel>()), [](const auto& test) {
    std::string name(name_of(test.param));
    std::erase(name, '-');
    return name;
});

// At night: each pair of options with every model. In the quick run: each pair with one or two of
// the four models, with others for the next pair.
TEST_P(SeaRange, PairsOfEdgesGiveFiniteFrames) {
    const auto fields = sea_state_fields();
    const std::size_t step = of_sweep(3, 1);
    for (std::size_t a = 0; a < fields.size(); ++a) {
        for (std::size_t b = a; b < fields.size(); ++b) {
            if ((a + b + static_cast<std::size_t>(GetParam())) % step != 0) continue;
            for (const double first : edges_of(fields[a])) {
                for (const double second : edges_of(fields[b])) {
                    SeaState sea{.spectrum = GetParam(), .resolution = 16, .patch_size_m = 250};
                    fields[a].set(sea, first);
                    fields[b].set(sea, second);
                    expect_finite(without_exclusions(sea));
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

TEST_P(SeaRange, AllOptionsAtEdgesGiveFiniteFramesAndStatistics) {
    std::mt19937 random(11);
    for (int n = 0; n < of_sweep(100, 300); ++n) {
        SeaState sea{.spectrum = GetParam()};
        if (sea.spectrum != SpectrumModel::phillips_paper)
            sea.spreading = values_of<SpreadingModel>()[random() % names_of<SpreadingModel>().size()];
        for (const SeaStateField& field : sea_state_fields()) {
            const Edges edges = edges_of(field);
            field.set(sea, edges[random() % edges.size()]);
        }
        sea = without_exclusions(sea);
        expect_finite(sea);
        if (HasFatalFailure()) return;
        const ExpectedWaves waves = expected_waves(sea);
        ASSERT_TRUE(std::isfinite(waves.significant_wave_height_m)) << text_of(sea);
        ASSERT_TRUE(std::isfinite(waves.peak_period_s) && waves.peak_period_s > 0) << text_of(sea);
        ASSERT_TRUE(std::isfinite(waves.peak_wavelength_m) && waves.peak_wavelength_m > 0) << text_of(sea);
        ASSERT_TRUE(std::isfinite(waves.model_significant_wave_height_m.value_or(0))) << text_of(sea);
        for (const std::string& warning : warnings_about(sea)) {
            ASSERT_EQ(warning.find("nan"), std::string::npos) << warning << text_of(sea);
            ASSERT_EQ(warning.find("inf"), std::string::npos) << warning << text_of(sea);
        }
    }
}

// Values outside of the range, infinities and NaN are rejected.
TEST(SeaRange, ValuesBeyondAnEdgeAreRejected) {
    for (const SeaStateField& field : sea_state_fields()) {
        const double infinity = std::numeric_limits<double>::infinity();
        EXPECT_FALSE(field.accepts(std::nextafter(field.min, -infinity))) << field.name;
        EXPECT_FALSE(field.accepts(std::nextafter(field.max, infinity))) << field.name;
        EXPECT_EQ(field.accepts(field.min), field.restriction != Restriction::above_min || field.also == field.min)
            << field.name;
        EXPECT_TRUE(field.accepts(field.max)) << field.name;
        for (const double value : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
            EXPECT_FALSE(field.accepts(value)) << field.name;
    }
}

}  // namespace
}  // namespace pelagic
