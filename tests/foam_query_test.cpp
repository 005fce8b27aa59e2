// Foam at any point and in buffers, compared with an oracle in double that uses texels and
// reference points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/oracle/stack_oracle.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

// A gale and a storm, with a large whitecap cover. Finer cascades are rotated against world axes.
const SeaState gale_of_four_cascades{
    .cascades = 4, .resolution = 32, .wind_speed_mps = 20, .wind_direction_rad = 0.7, .lean = 0.4};
const SeaState storm_on_one_cascade{
    .resolution = 64, .patch_size_m = 120, .wind_speed_mps = 25, .wind_direction_rad = 2.5};

OceanOptions with_queries_and_foam(Isa isa = choose_isa()) {
    return {.executor = make_serial_executor(), .isa = isa, .queries = true, .foam = true};
}

/// Interpolates the values of texels bilinearly, as Cascade and CascadeGrid specify.
/// \param value  function from a texel's index to its value
template <class Value>
double interpolated(const Cascade& cascade, double columns, double rows, Value value) {
    const int n = cascade.resolution();
    double sum = 0;
    for (const int right : {0, 1}) {
        for (const int below : {0, 1}) {
            const double column = std::floor(columns) + right, row = std::floor(rows) + below;
            const double weight = (1 - std::fabs(columns - column)) * (1 - std::fabs(rows - row));
            const auto wrapped = [n](double of) { return static_cast<std::size_t>(of - std::floor(of / n) * n); };
            sum += weight * value(wrapped(row) * static_cast<std::size_t>(n) + wrapped(column));
        }
    }
    return sum;
}

/// As snapshot_foam.hpp specifies.
double foam_by_texels(const Frame& frame, double reference_x_m, double reference_z_m) {
    const auto place = [&](const Cascade& cascade) { return cascade.grid.in_cascade(reference_x_m, reference_z_m); };
    const auto breaking = [&](double sum) {
        return std::clamp(0.5 + (sum - double{frame.foam.level}) / 0.3, 0., 1.);
    };
    double largest = 0;
    for (int slot = -1; slot < 16; ++slot) {  // -1: now
        double sum = 0;
        for (const Cascade& cascade : frame.cascades) {
            if (cascade.compression_r8.empty()) continue;
            const CascadeGrid::Vector at = place(cascade);
            const double columns = at.along / cascade.texel_m(), rows = at.across / cascade.texel_m();
            const auto of_now = [&](std::size_t texel) { return -3 + 8 * cascade.compression_r8[texel] / 255.0; };
            const auto of_slot = [&](std::size_t texel) {
                const std::uint32_t word = cascade.snapshots_rgba8[static_cast<std::size_t>(slot) / 4][texel];
                return -3 + 8 * (word >> 8 * (slot % 4) & 255) / 255.0;
            };
            sum += slot < 0
                       ? interpolated(cascade, columns, rows, of_now)
                       : interpolated(cascade, columns - cascade.drift_columns, rows - cascade.drift_rows, of_slot);
        }
        const double age = slot < 0 ? 0 : double{frame.foam.age[static_cast<std::size_t>(slot)]};
        largest = std::max(largest, breaking(sum) - age);
    }
    return largest;
}

TEST(FoamQuery, IsThatOfTheTexelsAtTheReferencePoint) {
    for (const SeaState& sea : {gale_of_four_cascades, storm_on_one_cascade}) {
        Ocean ocean(sea, with_queries_and_foam());
        const Frame& frame = ocean.frame_at(11.03);
        const oracle::Stack stack(frame);
        const Points points = random_points(is_sanitized ? 50 : 2000, 5000, 3);
        std::vector<float> foam(points.x.size()), jacobian(points.x.size());
        SurfaceQuery(frame).sample({points.x, points.z}, {.jacobian = jacobian, .foam = foam});
        int compared = 0, white = 0;
        double largest_error = 0;
        for (std::size_t i = 0; i < foam.size(); ++i) {
            const auto intersections = stack.intersections_at(points.x[i], points.z[i]);
            // Near a fold's edge the reference point changes much faster than the displaced point.
            if (intersections.size() != 1 || jacobian[i] < 0.2f) continue;
            ++compared;
            const double expected = foam_by_texels(frame, intersections[0].x_m, intersections[0].z_m);
            white += expected > 0.1;
            largest_error = std::max(largest_error, std::fabs(static_cast<double>(foam[i]) - expected));
        }
        // The search stops within a 64th of a millimetre, or five times that at the reference
        // point. The sum of the cascades changes by at most 8 over a texel along each axis, and
        // foam by 1 / 0.3 times as much.
        double change_per_m = 0;
        for (const Cascade& cascade : frame.cascades)
            if (!cascade.compression_r8.empty()) change_per_m += 2 * 8 / 0.3 / cascade.texel_m();
        EXPECT_LT(largest_error, 1e-6 + 5 * 1.6e-5 * change_per_m);
        EXPECT_GT(compared, static_cast<int>(foam.size()) * 8 / 10);
        EXPECT_GT(white, compared / 50);
    }
}

TEST(FoamQuery, IsBitIdenticalOnEachInstructionSetAndInEachBatch) {
    const Points points = random_points(1500, 5000, 3);
    const auto executor = make_thread_executor(3);
    for (const SeaState& sea : {gale_of_four_cascades, storm_on_one_cascade}) {
        std::vector<float> expected;
        for (const Isa isa : isas_here()) {
            Ocean ocean(sea, with_queries_and_foam(isa));
            const SurfaceQuery query(ocean.frame_at(3.21));
            std::vector<float> together(points.x.size()), apart(together), on_jobs(together);
            query.sample({points.x, points.z}, {.foam = together});
            for (std::size_t i = 0; i < together.size(); ++i)
                query.sample({{&points.x[i], 1}, {&points.z[i], 1}}, {.foam = {&apart[i], 1}});
            SurfaceQueryJobs(executor).sample(query, {points.x, points.z}, {.foam = on_jobs});
            EXPECT_EQ(together, apart);
            EXPECT_EQ(together, on_jobs);
            if (expected.empty()) expected = together;
            EXPECT_EQ(together, expected) << name_of(isa);
            EXPECT_LE(*std::max_element(together.begin(), together.end()), 1.f);
        }
    }
}

TEST(FoamQuery, IsRejectedForFramesWithoutFoam) {
    Ocean ocean(gale_of_four_cascades, {.executor = make_serial_executor(), .queries = true});
    const SurfaceQuery query(ocean.frame_at(0));
    const std::vector<double> places(2000);
    std::vector<float> height(places.size(), -1), foam(places.size());
    const SurfacePoints points{places, places};
    const SurfaceSamples wanted{.height_m = height, .foam = foam};
    EXPECT_THROW(query.sample(points, wanted), std::invalid_argument);
    EXPECT_THROW(SurfaceQueryJobs(make_serial_executor()).sample(query, points, wanted), std::invalid_argument);
    EXPECT_EQ(height[0], -1) << "samples were written before the check";
}

// The unrounded compression is that of the bytes, and q is clamped to them at [-3, 5].
TEST(CopiedCompression, IsThatOfTheBytesWithoutRounding) {
    for (const SeaState& sea : {gale_of_four_cascades, storm_on_one_cascade}) {
        Ocean ocean(sea, with_queries_and_foam());
        for (const Cascade& cascade : ocean.frame_at(5).cascades) {
            const auto side = static_cast<std::size_t>(cascade.resolution());
            std::vector<float> compression(side * side, 77);
            copy_compression(cascade, compression);
            double largest = 0;
            for (std::size_t texel = 0; texel < compression.size(); ++texel) {
                if (cascade.compression_r8.empty()) {
                    ASSERT_EQ(compression[texel], 0);
                    continue;
                }
                const double shown = SnapshotFoam::value_of(cascade.compression_r8[texel]);
                const double clamped = std::clamp(double{compression[texel]}, -3., 5.);
                ASSERT_NEAR(clamped, shown, 0.5001 * double{SnapshotFoam::step}) << texel;
                largest = std::max(largest, std::fabs(clamped));
            }
            EXPECT_EQ(largest > 0, cascade.makes_whitecaps());
        }
        EXPECT_THROW(copy_compression(ocean.frame_at(5).cascades[0], std::span<float>()), std::invalid_argument);
    }
}

}  // namespace
}  // namespace pelagic
