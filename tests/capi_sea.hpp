// Seas and oceans of the C interface that several tests use.
#pragma once

#include <gtest/gtest.h>
#include <pelagic/pelagic.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pelagic {

/// A sea with cascades = 1.
inline pelagic_sea small_sea(std::int32_t resolution = 16) {
    auto sea = pelagic_sea_make();
    sea.resolution = resolution;
    sea.patch_size_m = 250;
    return sea;
}

/// A sea with a stack of cascades.
inline pelagic_sea stack_sea(std::int32_t cascades, std::int32_t resolution = 32) {
    auto sea = pelagic_sea_make();
    sea.cascades = cascades;
    sea.resolution = resolution;
    return sea;
}

/// Returns whether the library was built with hulls.
inline bool has_hulls() {
    pelagic_hull* hull = nullptr;
    pelagic_hull_create(nullptr, nullptr, &hull);
    return std::string(pelagic_last_error()).find("hulls are unavailable") == std::string::npos;
}

/// Returns the ocean's dynamic waves, null if it has none.
inline pelagic_dynamic_waves* waves_of(const pelagic_ocean* ocean) {
    pelagic_dynamic_waves* waves = nullptr;
    pelagic_ocean_dynamic_waves(const_cast<pelagic_ocean*>(ocean), &waves);
    return waves;
}

struct DestroyExecutor {
    void operator()(pelagic_executor* executor) const { pelagic_executor_destroy(executor); }
};
using COceanExecutor = std::unique_ptr<pelagic_executor, DestroyExecutor>;

inline COceanExecutor executor_of(std::int32_t kind, std::int32_t threads = 0) {
    auto options = pelagic_executor_options_make();
    options.kind = kind;
    options.threads = threads;
    pelagic_executor* executor = nullptr;
    EXPECT_EQ(pelagic_executor_create(&options, &executor), PELAGIC_OK) << pelagic_last_error();
    return COceanExecutor(executor);
}

struct DestroyOcean {
    void operator()(pelagic_ocean* ocean) const { pelagic_ocean_destroy(ocean); }
};
using COcean = std::unique_ptr<pelagic_ocean, DestroyOcean>;

inline COcean ocean_of(const pelagic_sea& sea, const pelagic_ocean_options& options) {
    pelagic_ocean* ocean = nullptr;
    EXPECT_EQ(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_OK) << pelagic_last_error();
    return COcean(ocean);
}

/// An ocean with queries and velocities.
inline COcean ocean_of(const pelagic_sea& sea, const pelagic_executor* executor) {
    auto options = pelagic_ocean_options_make();
    options.queries = options.velocities = options.depth = 1;
    options.executor = executor;
    return ocean_of(sea, options);
}

/// Computes the frame of a time.
inline pelagic_frame complete(pelagic_ocean* ocean, double time_s) {
    pelagic_frame frame{};
    EXPECT_EQ(pelagic_ocean_schedule(ocean, time_s), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(pelagic_ocean_complete(ocean, &frame), PELAGIC_OK) << pelagic_last_error();
    return frame;
}
inline pelagic_frame complete(const COcean& ocean, double time_s) { return complete(ocean.get(), time_s); }

/// Returns a hash of the current frame.
inline std::uint64_t hash_of(const pelagic_ocean* ocean, std::int32_t kind = PELAGIC_HASH_FRAME) {
    std::uint64_t hash = 0;
    EXPECT_EQ(pelagic_ocean_frame_hash(ocean, 0, kind, &hash), PELAGIC_OK) << pelagic_last_error();
    return hash;
}
/// Computes the frame of a time and returns its hash.
inline std::uint64_t hash_at(const COcean& ocean, double time_s) {
    complete(ocean, time_s);
    return hash_of(ocean.get());
}

/// Expects a failure with exactly this message.
inline void expect_rejected(pelagic_status status, pelagic_status expected, const std::string& line) {
    EXPECT_EQ(status, expected);
    EXPECT_EQ(pelagic_last_error(), line);
}
inline void expect_rejected(pelagic_status status, const std::string& line) {
    expect_rejected(status, PELAGIC_INVALID_ARGUMENT, line);
}

inline float texel_of(const pelagic_plane& plane, int i, int j) {
    return plane.data[i / plane.block_columns * plane.block_stride + j * plane.row_stride + i % plane.block_columns];
}

/// Arrays of a cascade for pelagic_ocean_frame_at(), of the required sizes.
struct FrameArrays {
    explicit FrameArrays(std::int32_t resolution, bool has_slopes = false)
        : planes(6, std::vector<float>(static_cast<std::size_t>(resolution) * resolution)),
          halves(4 * planes[0].size()),
          bytes((4 * planes[0].size() - 1) / 3),
          slopes(has_slopes ? bytes.size() : 0),
          moments(slopes.size()) {}

    pelagic_frame_buffers view() {
        auto buffers = pelagic_frame_buffers_make();
        buffers.plane_count = planes[0].size();
        buffers.dx = planes[0].data(), buffers.height = planes[1].data(), buffers.dz = planes[2].data();
        buffers.velocity_x = planes[3].data();
        buffers.velocity_y = planes[4].data();
        buffers.velocity_z = planes[5].data();
        buffers.rgba16f_count = halves.size();
        buffers.displacement_rgba16f = halves.data();
        buffers.rgba8_count = bytes.size();
        buffers.gradient_rgba8 = bytes.data();
        buffers.slopes_count = slopes.size();
        buffers.slopes_rgba8 = slopes.empty() ? nullptr : slopes.data();
        buffers.moments_rgba8 = moments.empty() ? nullptr : moments.data();
        return buffers;
    }
    bool operator==(const FrameArrays&) const = default;

    std::vector<std::vector<float>> planes;
    std::vector<std::uint16_t> halves;
    std::vector<std::uint32_t> bytes, slopes, moments;
};

}  // namespace pelagic
