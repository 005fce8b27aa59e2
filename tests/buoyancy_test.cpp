// Floating boxes, compared with Archimedes' principle, the metacentric height, free heave, and
// waves much longer or shorter than the box.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/examples/buoyancy/floating_box.hpp"
#include "pelagic/examples/buoyancy/trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic::buoyancy {
namespace {

constexpr double step_s = 1.0 / 60;
constexpr double degree = std::numbers::pi / 180;

glm::dquat turned(double angle_rad, const glm::dvec3& axis) {
    return glm::dquat(std::cos(angle_rad / 2), std::sin(angle_rad / 2) * axis);
}

/// Settling takes many steps; under a sanitizer one density is enough.
std::vector<double> densities(const std::vector<double>& all) { return is_sanitized ? std::vector{0.5} : all; }

double heel_rad(const FloatingBox& box) {
    return std::acos(std::clamp(glm::mat3_cast(box.state().orientation)[1].y, -1.0, 1.0));
}

void float_in_still_water(FloatingBox& box, double seconds) {
    const StillWater water;
    HullWater hull;
    for (int i = 0; i < seconds / step_s; ++i) step({&box, 1}, water.query(), step_s, hull);
}

/// Expects that the box displaces its weight within 0.1 %, with vertical velocity and angular
/// velocity near zero. It may still drift horizontally: quadratic drag takes arbitrarily long to
/// stop it.
void expect_reference(const FloatingBox& box) {
    EXPECT_NEAR(box.displaced_kg() / box.options().mass_kg, 1, 1e-3);
    EXPECT_LT(std::fabs(box.state().velocity_mps.y), 1e-3);
    EXPECT_LT(glm::length(box.state().spin_radps), 1e-3);
}

TEST(Buoyancy, ABoxAtRestDisplacesItsWeightAndFloatsLevel) {
    for (const double density : densities({0.05, 0.25, 0.5, 0.75, 0.95})) {
        SCOPED_TRACE(density);
        // The raft's beam is three times its height, which is stable at every density.
        FloatingBox box(
            {.length_m = 4, .height_m = 1, .beam_m = 3, .mass_kg = density * water_density_kgpm3 * 4 * 1 * 3});
        box.state().position_m.y += 0.5;
        box.state().orientation = turned(10 * degree, {0.6, 0, 0.8});
        float_in_still_water(box, 60);
        expect_reference(box);
        EXPECT_LT(heel_rad(box), 0.05 * degree);
        EXPECT_NEAR(box.heave_m(), 0, 1e-3);
    }
}

/// Stability of a box whose density is `density` times that of water, heeled about its length:
/// GM = KB + I/V - KG, with draught T = density H, KB = T/2, I/V = B^2 / (12 T),
/// and KG = H/2 plus the offset of the centre of mass. (Any textbook of naval architecture.)
struct Stability {
    Stability(const BoxOptions& box)
        : draught_m(box.mass_kg / (water_density_kgpm3 * box.length_m * box.beam_m)),
          bm_m(box.beam_m * box.beam_m / (12 * draught_m)),
          gm_m(draught_m / 2 + bm_m - box.height_m / 2 - box.centre_of_mass_m) {}
    double draught_m, bm_m, gm_m;
};

/// A box of height 1 m whose beam is `factor` times the beam of GM = 0: (B/H)^2 = 6 s (1 - s).
BoxOptions near_critical(double density, double factor) {
    const double beam = factor * std::sqrt(6 * density * (1 - density));
    return {.length_m = 5, .height_m = 1, .beam_m = beam, .mass_kg = density * water_density_kgpm3 * 5 * beam};
}

TEST(Buoyancy, ATiltedBoxWithPositiveMetacentricHeightRightsItself) {
    for (const double density : densities({0.25, 0.5, 0.75})) {
        const BoxOptions options = near_critical(density, 1.03);
        ASSERT_GT(Stability(options).gm_m, 0);
        FloatingBox box(options);
        box.state().orientation = turned(5 * degree, {1, 0, 0});
        float_in_still_water(box, 200);  // long, because the righting moment is small
        expect_reference(box);
        EXPECT_LT(heel_rad(box), 0.1 * degree) << density;
    }
}

TEST(Buoyancy, ABoxWithNegativeMetacentricHeightSettlesAtTheAngleOfLoll) {
    for (const double density : densities({0.25, 0.5, 0.75})) {
        const BoxOptions options = near_critical(density, 0.97);
        const Stability stability(options);
        ASSERT_LT(stability.gm_m, 0);
        FloatingBox box(options);
        box.state().orientation = turned(1 * degree, {1, 0, 0});
        float_in_still_water(box, 200);
        expect_reference(box);
        // Wall-sided formula GZ = sin(heel) (GM + BM/2 tan^2(heel)): zero at tan^2 = -2 GM/BM, as
        // long as neither deck nor bottom crosses the waterline. 12 columns have a BM that is 1/144
        // too small, which is a degree here. With the BM of 12 columns, a twentieth of a degree
        // remains for settling.
        const double bm_m = stability.bm_m * (1 - 1.0 / 144), gm_m = stability.gm_m - stability.bm_m / 144;
        EXPECT_NEAR(heel_rad(box) / degree, std::atan(std::sqrt(-2 * gm_m / bm_m)) / degree, 0.05) << density;
        const double loll = std::atan(std::sqrt(-2 * stability.gm_m / stability.bm_m));
        EXPECT_NEAR(heel_rad(box) / degree, loll / degree, 1.5) << density;
        RecordProperty("loll" + std::to_string(density), std::to_string(heel_rad(box) / degree));
    }
}

TEST(Buoyancy, ABoxOnItsShortSideRollsOntoItsLongOne) {
    const BoxOptions options{
        .length_m = 5, .height_m = 2, .beam_m = 1, .mass_kg = 0.5 * water_density_kgpm3 * 5 * 2 * 1};
    ASSERT_LT(Stability(options).gm_m, 0);
    FloatingBox box(options);
    box.state().orientation = turned(1 * degree, {1, 0, 0});
    float_in_still_water(box, 120);
    expect_reference(box);
    EXPECT_NEAR(heel_rad(box), 90 * degree, 0.1 * degree);
}

TEST(Buoyancy, BallastTurnsABoxThatIsUpsideDown) {
    const BoxOptions options{.length_m = 4,
                             .height_m = 2,
                             .beam_m = 2,
                             .mass_kg = 0.5 * water_density_kgpm3 * 16,
                             .centre_of_mass_m = -0.6};
    ASSERT_GT(Stability(options).gm_m, 0);
    FloatingBox box(options);
    box.state().orientation = turned(175 * degree, {1, 0, 0});
    float_in_still_water(box, 120);
    expect_reference(box);
    EXPECT_LT(heel_rad(box), 0.1 * degree);
}

// Free heave (m + A) z'' + c z' + rho g L B z = 0: the period is
// 2 pi / (omega sqrt(1 - damping^2)), and in each period the amplitude is multiplied by
// exp(-2 pi damping / sqrt(1 - damping^2)). The tolerance of the period is 0.5 %: added mass grows
// with the draught and drag with the velocity squared, both small at an amplitude of a twentieth of
// the draught; and the step is up to a seventieth of the period.
// Drag affects the amplitude more: 5 %.
TEST(Buoyancy, FreeHeaveHasThePeriodAndDampingOfTheOscillator) {
    for (const BoxOptions& options : {BoxOptions{.length_m = 4, .height_m = 1, .beam_m = 3, .mass_kg = 6000},
                                      BoxOptions{.length_m = 40, .height_m = 6, .beam_m = 12, .mass_kg = 1'500'000},
                                      BoxOptions{.length_m = 2, .height_m = 1, .beam_m = 2, .mass_kg = 3000}}) {
        BoxOptions lightly_damped = options;
        lightly_damped.heave_damping = 0.05;
        FloatingBox box(lightly_damped);
        const StillWater water;
        HullWater hull;
        box.state().position_m.y += Stability(options).draught_m / 20;
        std::vector<double> falls, peaks;
        double before = box.heave_m(), before_that = before;
        for (int i = 1; falls.size() < 3; ++i) {
            step({&box, 1}, water.query(), step_s, hull);
            const double now = box.heave_m();
            if (before > 0 && now <= 0) falls.push_back((i - 1 + before / (before - now)) * step_s);
            if (before > 0 && before >= before_that && before > now) peaks.push_back(before);
            before_that = before, before = now;
            ASSERT_LT(i, 10000);
        }
        const double ratio = lightly_damped.heave_damping, rest = std::sqrt(1 - ratio * ratio);
        const double period_s = 2 * std::numbers::pi / (box.heave_frequency_radps() * rest);
        EXPECT_NEAR((falls[2] - falls[0]) / 2 / period_s, 1, 0.005);
        ASSERT_GE(peaks.size(), 2u);
        const double kept = peaks[peaks.size() - 1] / peaks[peaks.size() - 2];
        EXPECT_NEAR(kept / std::exp(-2 * std::numbers::pi * ratio / rest), 1, 0.05);
        RecordProperty("period" + std::to_string(options.mass_kg),
                       std::to_string((falls[2] - falls[0]) / 2 / period_s) + ", kept " + std::to_string(kept));
        // The lower half of a long plate has rho pi/8 B^2 L (Newman, table 4.3). A box has less,
        // because water flows around its ends, by a factor of at least 0.59 (1 - 0.41). All boxes
        // here float about half submerged.
        const double plate_kg =
            water_density_kgpm3 * std::numbers::pi / 8 * options.beam_m * options.beam_m * options.length_m;
        EXPECT_LT(box.heave_added_mass_kg(), plate_kg);
        EXPECT_GT(box.heave_added_mass_kg(), 0.5 * plate_kg);
    }
}

double rms(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Motion of a box on a sea, recorded after it has settled.
struct Ride {
    Ride(const SeaState& sea, const BoxOptions& options, double seconds) {
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = true});
        FloatingBox box(options);
        HullWater hull;
        for (int i = 0; i < seconds / step_s; ++i) {
            const SurfaceQuery water(ocean.frame_at(i * step_s));
            // the previous step advanced the box to the time of this frame
            if (i * step_s >= 20) compare(box, water);
            step({&box, 1}, water, step_s, hull);
        }
    }

    void compare(const FloatingBox& box, const SurfaceQuery& water) {
        const double x[] = {box.state().position_m.x}, z[] = {box.state().position_m.z};
        float height[1], normal_x[1], normal_z[1];
        water.sample({x, z}, {.height_m = height, .normal_x = normal_x, .normal_z = normal_z});
        const glm::dvec3 up = glm::mat3_cast(box.state().orientation)[1];
        heave.push_back(box.heave_m());
        wave.push_back(height[0]);
        off.push_back(box.heave_m() - height[0]);
        slope.push_back(std::hypot(normal_x[0], normal_z[0]));
        slope_off.push_back(std::hypot(up.x - normal_x[0], up.z - normal_z[0]));
    }

    std::vector<double> heave, wave, off, slope, slope_off;
};

// Swell of 12 s (225 m) in very weak wind: its spectrum falls as omega^-13, so almost no wave is
// shorter than 60 m, twelve times the box. Over the box's length such a wave bends by
// (pi/12)^2/6 = 1 % of its height.
// Without the water's acceleration heave would be off by k T, 4 % here.
// Heel: the box rolls at 2.9 rad/s by itself. Waves of 60 m, 1 rad/s, tilt it by
// 1 / (1 - (1/2.9)^2) = 1.13 of their slope, and it oscillates about that.
TEST(Buoyancy, ABoxFollowsLongSwell) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the storm test below runs the same code";
    const Ride ride(
        {.resolution = 128, .patch_size_m = 1600, .wind_speed_mps = 0.5, .swell_height_m = 4, .swell_period_s = 12},
        {.length_m = 5, .height_m = 1.5, .beam_m = 3, .mass_kg = 9000}, 120);
    ASSERT_GT(rms(ride.wave), 0.5);
    EXPECT_LT(rms(ride.off) / rms(ride.wave), 0.01);
    EXPECT_LT(rms(ride.slope_off) / rms(ride.slope), 0.25) << "it heels with the slope";
    RecordProperty("heave_off", std::to_string(rms(ride.off) / rms(ride.wave)));
    RecordProperty("slope_off", std::to_string(rms(ride.slope_off) / rms(ride.slope)));
    RecordProperty("wave_rms_m", std::to_string(rms(ride.wave)));
}

// Waves of 5 m at the peak (2 pi U^2 / (0.877^2 g), Pierson and Moskowitz) under a box of 40 m by
// 15 m. The average over the box is at most 1 / (8 pi) = 4 % of a wave along it,
// and 1 / (3 pi) = 11 % of a wave across it.
TEST(Buoyancy, WavesMuchShorterThanTheBoxHardlyMoveIt) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the storm test below runs the same code";
    const Ride ride(
        {.spectrum = SpectrumModel::pierson_moskowitz, .resolution = 128, .patch_size_m = 80, .wind_speed_mps = 2.5},
        {.length_m = 40, .height_m = 3, .beam_m = 15, .mass_kg = 600'000}, 80);
    ASSERT_GT(rms(ride.wave), 0.02);
    EXPECT_LT(rms(ride.heave) / rms(ride.wave), 0.15);
    RecordProperty("heave", std::to_string(rms(ride.heave) / rms(ride.wave)));
    RecordProperty("wave_rms_m", std::to_string(rms(ride.wave)));
}

const SeaState small_storm{
    .resolution = 64, .patch_size_m = 400, .wind_speed_mps = 19, .fetch_m = 400e3, .choppiness = 1};

std::vector<FloatingBox> three_boxes() {
    std::vector<FloatingBox> boxes;
    boxes.emplace_back(BoxOptions{});
    boxes.emplace_back(BoxOptions{.length_m = 12, .height_m = 2.5, .beam_m = 4, .mass_kg = 36'000});
    boxes.emplace_back(BoxOptions{.length_m = 60, .height_m = 5, .beam_m = 15, .mass_kg = 2'000'000});
    for (FloatingBox& box : boxes) {
        box.state().position_m = {31, 4, -17};
        box.state().orientation = turned(1, {0, 0.8, 0.6});
        box.state().spin_radps = {0.5, -0.3, 0.2};
    }
    return boxes;
}

std::vector<std::uint64_t> trajectory_bits(Isa isa, std::shared_ptr<Executor> executor) {
    Ocean ocean(small_storm, {.executor = std::move(executor), .isa = isa, .queries = true, .velocities = true});
    std::vector<FloatingBox> boxes = three_boxes();
    HullWater hull;
    std::vector<std::uint64_t> bits;
    ocean.schedule(0);
    for (int i = 0; i < 120; ++i) {
        const Frame& frame = ocean.complete();
        // the next frame is computed while the boxes sample this one
        ocean.schedule((i + 1) * step_s);
        step(boxes, SurfaceQuery(frame), step_s, hull);
        for (const FloatingBox& box : boxes)
            for (int axis = 0; axis < 3; ++axis)
                for (const double value : {box.state().position_m[axis], box.state().velocity_mps[axis],
                                           box.state().spin_radps[axis], box.state().orientation[axis]})
                    bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
    return bits;
}

// FNV-1a hash, to compare compilers.
std::uint64_t hash_of_bits(const std::vector<std::uint64_t>& bits) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::uint64_t word : bits) hash = (hash ^ word) * 0x100000001b3u;
    return hash;
}

TEST(BuoyancyDeterminism, TrajectoriesAreBitIdenticalOnEachInstructionSetAndThreadCount) {
    const std::vector<std::uint64_t> expected = trajectory_bits(isas_here().front(), make_serial_executor());
    for (const Isa isa : isas_here())
        for (const ExecutorKind& kind : executor_kinds())
            EXPECT_TRUE(trajectory_bits(isa, kind.make(kind.threads)) == expected) << name_of(isa) << kind.name;
    EXPECT_EQ(hash_of_bits(expected), 13706028884819009965u)
        << "the same from every compiler; a change of physics changes it, too";
}

// Boxes start in a storm, rotated by one radian and spinning. No box ever has more kinetic energy
// than a fall from 5 m above the highest crest into the lowest trough gives, in addition to the
// velocity of the fastest water.
TEST(Buoyancy, EnergyStaysBoundedInAStorm) {
    Ocean ocean(small_storm, {.executor = make_serial_executor(), .queries = true, .velocities = true});
    std::vector<FloatingBox> boxes = three_boxes();
    HullWater hull;
    double max = 0;
    for (int i = 0; i < (is_sanitized ? 120 : 3600); ++i) {
        const Frame& frame = ocean.frame_at(i * step_s);
        step(boxes, SurfaceQuery(frame), step_s, hull);
        double water_mps = 0;
        const Cascade& cascade = frame.cascades[0];
        for (int j = 0; j < cascade.resolution(); ++j)
            for (int k = 0; k < cascade.resolution(); ++k)
                water_mps =
                    std::max<double>(water_mps, std::hypot(cascade.velocity_x.at(k, j), cascade.velocity_y.at(k, j),
                                                           cascade.velocity_z.at(k, j)));
        const double fall_m = 5 + frame.bounds.height_max_m - frame.bounds.height_min_m;
        const double fastest_mps = std::sqrt(2 * gravity_mps2 * fall_m) + water_mps;
        for (const FloatingBox& box : boxes) {
            const BoxState& state = box.state();
            const BoxOptions& options = box.options();
            const double radius_m = std::hypot(options.length_m, options.height_m, options.beam_m) /
                                    std::sqrt(12.0);  // largest radius of gyration
            const double speed_mps =
                std::hypot(glm::length(state.velocity_mps), radius_m * glm::length(state.spin_radps));
            ASSERT_TRUE(std::isfinite(speed_mps) && std::isfinite(glm::length(state.position_m)));
            ASSERT_LE(speed_mps, fastest_mps) << "at " << i * step_s << " s, " << options.length_m << " m";
            max = std::max(max, speed_mps / fastest_mps);
            ASSERT_NEAR(glm::length(state.orientation), 1, 1e-12);
            const double diagonal_m = radius_m * std::sqrt(12.0);
            ASSERT_GE(state.position_m.y, frame.bounds.height_min_m - diagonal_m);
            ASSERT_LE(state.position_m.y, frame.bounds.height_max_m + diagonal_m + 5);
        }
    }
    RecordProperty("most", std::to_string(max));
}

TEST(Buoyancy, BowUpIsPositivePitchAndStarboardDownIsPositiveRoll) {
    BoxState state;
    state.orientation = turned(10 * degree, {0, 0, 1});  // x turns towards y
    EXPECT_NEAR(attitude_of(state).pitch_deg, 10, 1e-9);
    EXPECT_NEAR(attitude_of(state).roll_deg, 0, 1e-9);
    state.orientation = turned(10 * degree, {1, 0, 0});  // z, starboard, turns towards -y
    EXPECT_NEAR(attitude_of(state).pitch_deg, 0, 1e-9);
    EXPECT_NEAR(attitude_of(state).roll_deg, 10, 1e-9);
}

TEST(Buoyancy, InvalidOptionsAreNamed) {
    EXPECT_EQ(check(BoxOptions{}), "");
    EXPECT_EQ(check({.beam_m = -1}), "beam_m -1 is out of range (0, 1000]");
    EXPECT_NE(check({.mass_kg = 1e6}).find("to float"), std::string::npos);
    EXPECT_THROW(FloatingBox({.heave_damping = 1}), std::invalid_argument);
    EXPECT_THROW(write_csv(std::filesystem::path("no such folder") / "trace.csv", {{"boat", {{}}}}),
                 std::runtime_error);
}

}  // namespace
}  // namespace pelagic::buoyancy
