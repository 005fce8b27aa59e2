// Cascades through the C interface: the data of each, and copies to an application's memory.
#include <cstring>
#include <string>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

pelagic_ocean_options serial_options(const COceanExecutor& serial) {
    auto options = pelagic_ocean_options_make();
    options.executor = serial.get();
    return options;
}

class CInterfaceCascades : public testing::Test {
   protected:
    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);

    static std::vector<pelagic_cascade> cascades_of(const pelagic_ocean* ocean, const pelagic_frame& frame) {
        std::vector<pelagic_cascade> cascades(static_cast<std::size_t>(frame.cascade_count));
        for (std::int32_t i = 0; i < frame.cascade_count; ++i)
            EXPECT_EQ(pelagic_ocean_cascade(ocean, i, &cascades[static_cast<std::size_t>(i)]), PELAGIC_OK)
                << pelagic_last_error();
        return cascades;
    }
};

/// Textures of a frame of N = 32, in the application's memory.
struct ApplicationTextures {
    static constexpr std::size_t texels = 32 * 32, chain = (4 * texels - 1) / 3;
    alignas(64) std::uint16_t halves[4 * texels];
    std::uint32_t slopes[chain], moments[chain];

    pelagic_texture_targets targets(std::uint32_t cascade_count, const std::uint32_t (&offset)[12]) {
        auto out = pelagic_texture_targets_make();
        out.cascade_count = cascade_count;
        out.displacement_rgba16f = halves;
        for (int level = 0; level < 6; ++level) {
            out.slopes_rgba8[level] = slopes + offset[level];
            out.moments_rgba8[level] = moments + offset[level];
        }
        return out;
    }
};

TEST_F(CInterfaceCascades, TexturesOnlyAreBitIdenticalAndHaveNoPlanes) {
    pelagic_ocean_options options = serial_options(serial);
    const COcean usual = ocean_of(stack_sea(3), serial.get());
    options.textures_only = 1;
    const COcean textures = ocean_of(stack_sea(3), options);
    const auto expected = cascades_of(usual.get(), complete(usual, 4));
    const auto cascades = cascades_of(textures.get(), complete(textures, 4));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(cascades[i].height.data, nullptr);
        EXPECT_EQ(std::memcmp(cascades[i].displacement_rgba16f, expected[i].displacement_rgba16f, 8 * 32 * 32), 0);
        EXPECT_EQ(std::memcmp(cascades[i].slopes_rgba8, expected[i].slopes_rgba8, 4 * 32 * 32), 0);
        EXPECT_EQ(std::memcmp(&cascades[i].bounds, &expected[i].bounds, sizeof expected[i].bounds), 0);
    }
    options.queries = 1;
    const pelagic_sea sea = stack_sea(3);
    pelagic_ocean* made = nullptr;
    expect_rejected(pelagic_ocean_create(&sea, &options, &made),
                    "queries cannot be combined with an ocean without planes");
}

TEST_F(CInterfaceCascades, TexturesAreWrittenToTheApplicationsMemory) {
    const COcean usual = ocean_of(stack_sea(3), serial.get()), elsewhere = ocean_of(stack_sea(3), serial.get());
    const pelagic_frame frame = complete(usual, 4);
    const std::vector<pelagic_cascade> expected = cascades_of(usual.get(), frame);
    std::vector<ApplicationTextures> memory(3);
    std::vector<pelagic_texture_targets> targets;
    for (std::size_t i = 0; i < 3; ++i)
        targets.push_back(memory[i].targets(i == 0 ? 3 : 0, expected[i].level_offset));

    pelagic_frame shown{};
    ASSERT_EQ(pelagic_ocean_schedule_into(elsewhere.get(), 4, targets.data()), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()), PELAGIC_WRONG_ORDER);
    ASSERT_EQ(pelagic_ocean_complete(elsewhere.get(), &shown), PELAGIC_OK) << pelagic_last_error();
    const std::vector<pelagic_cascade> cascades = cascades_of(elsewhere.get(), shown);
    EXPECT_EQ(shown.displacement_rgba16f, nullptr);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(std::memcmp(memory[i].halves, expected[i].displacement_rgba16f, sizeof memory[i].halves), 0) << i;
        EXPECT_EQ(std::memcmp(memory[i].slopes, expected[i].slopes_rgba8, sizeof memory[i].slopes), 0) << i;
        EXPECT_EQ(std::memcmp(memory[i].moments, expected[i].moments_rgba8, sizeof memory[i].moments), 0) << i;
        EXPECT_TRUE(!cascades[i].displacement_rgba16f && !cascades[i].slopes_rgba8 && !cascades[i].moments_rgba8);
    }

    targets[0].cascade_count = 2;
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()),
                    "targets.cascade_count is 2, expected 3, with as many structs one after the other");
    targets[0].cascade_count = 3;
    targets[1].moments_rgba8[2] = nullptr;
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, targets.data()),
                    "targets: moments_rgba8 lacks level 2, expected 6 levels");
    expect_rejected(pelagic_ocean_schedule_into(elsewhere.get(), 5, nullptr), "targets is NULL, expected a pointer");
}

bool is_same(const pelagic_plane& a, const pelagic_plane& b) {
    return a.data == b.data && a.resolution == b.resolution && a.block_columns == b.block_columns &&
           a.row_stride == b.row_stride && a.block_stride == b.block_stride;
}

TEST_F(CInterfaceCascades, TheFrameHoldsItsCoarsestCascade) {
    const COcean ocean = ocean_of(stack_sea(3), serial.get());
    pelagic_ocean_info info{};
    ASSERT_EQ(pelagic_ocean_describe(ocean.get(), &info), PELAGIC_OK);
    EXPECT_EQ(info.cascade_count, 3);
    EXPECT_EQ(info.resolution, 32);
    const pelagic_frame frame = complete(ocean, 3);
    ASSERT_EQ(frame.cascade_count, 3);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    EXPECT_EQ(frame.resolution, 32);
    EXPECT_EQ(frame.patch_size_m, cascades[0].side_m);
    EXPECT_EQ(frame.displacement_rgba16f, cascades[0].displacement_rgba16f);
    EXPECT_TRUE(is_same(frame.dx, cascades[0].dx) && is_same(frame.height, cascades[0].height) &&
                is_same(frame.dz, cascades[0].dz) && is_same(frame.velocity_x, cascades[0].velocity_x) &&
                is_same(frame.velocity_y, cascades[0].velocity_y) &&
                is_same(frame.velocity_z, cascades[0].velocity_z));
    EXPECT_NE(frame.velocity_x.data, nullptr);
    EXPECT_EQ(frame.gradient_rgba8, nullptr);
    EXPECT_EQ(frame.gradient_levels, 0);
    EXPECT_GT(frame.roughness, 0);
    EXPECT_LE(frame.roughness, 1);
    for (std::size_t i = 0; i < 3; ++i) {
        const pelagic_cascade& cascade = cascades[i];
        EXPECT_EQ(cascade.resolution, 32);
        EXPECT_NEAR(cascade.cosine * cascade.cosine + cascade.sine * cascade.sine, 1, 1e-15);
        if (i > 0) {
            EXPECT_LT(cascade.side_m, cascades[i - 1].side_m);
            EXPECT_NE(cascade.sine, cascades[i - 1].sine);
        }
        EXPECT_EQ(cascade.gradient_rgba8, nullptr);
        ASSERT_EQ(cascade.levels, 6);
        std::uint32_t offset = 0;
        for (int level = 0; level < 6; ++level) {
            EXPECT_EQ(cascade.level_offset[level], offset);
            offset += 1024u >> 2 * level;
        }
    }
}

TEST_F(CInterfaceCascades, OptionsSelectTheDataOfACascade) {
    for (const bool is_asked : {false, true}) {
        pelagic_ocean_options options = serial_options(serial);
        options.slopes = options.gradients = is_asked;
        const COcean one = ocean_of(small_sea(32), options), two = ocean_of(stack_sea(2), options);
        const pelagic_frame frame = complete(one, 1), stack = complete(two, 1);
        const std::vector<pelagic_cascade> alone = cascades_of(one.get(), frame),
                                           cascades = cascades_of(two.get(), stack);
        ASSERT_EQ(alone.size(), 1u);
        EXPECT_EQ(alone[0].side_m, 250);
        EXPECT_EQ(alone[0].cosine, 1);
        EXPECT_EQ(alone[0].sine, 0);
        EXPECT_EQ(frame.gradient_levels, 6);
        EXPECT_NE(frame.gradient_rgba8, nullptr);
        EXPECT_EQ(alone[0].gradient_rgba8, frame.gradient_rgba8);
        EXPECT_EQ(std::memcmp(alone[0].level_offset, frame.gradient_offset, sizeof frame.gradient_offset), 0);
        EXPECT_EQ(alone[0].slopes_rgba8 != nullptr, is_asked);
        EXPECT_EQ(alone[0].moments_rgba8 != nullptr, is_asked);
        EXPECT_EQ(stack.gradient_levels, is_asked ? 6 : 0);
        for (const pelagic_cascade& cascade : cascades) {
            EXPECT_EQ(cascade.gradient_rgba8 != nullptr, is_asked);
            EXPECT_NE(cascade.slopes_rgba8, nullptr);
            EXPECT_NE(cascade.moments_rgba8, nullptr);
            EXPECT_EQ(cascade.velocity_y.data, nullptr);
        }
    }
}

TEST_F(CInterfaceCascades, TexturesCanBeOff) {
    pelagic_ocean_options options = serial_options(serial);
    options.gradients = PELAGIC_TEXTURES_OFF;
    const COcean ocean = ocean_of(small_sea(32), options);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), complete(ocean, 1));
    EXPECT_EQ(cascades[0].gradient_rgba8, nullptr);
    EXPECT_NE(cascades[0].slopes_rgba8, nullptr);
    const auto expect_message = [&](const std::string& message) {
        pelagic_ocean* made = nullptr;
        const pelagic_sea sea = small_sea(32);
        expect_rejected(pelagic_ocean_create(&sea, &options, &made), message);
    };
    options.slopes = PELAGIC_TEXTURES_OFF;
    expect_message("gradients and slopes are off, expected one of them on");
    options.slopes = 3;
    expect_message("slopes is 3, expected 0, 1 or 2");
}

TEST_F(CInterfaceCascades, AnInvalidCascadeIndexIsNamed) {
    const COcean one = ocean_of(small_sea(), serial.get()), two = ocean_of(stack_sea(2), serial.get());
    complete(one, 0), complete(two, 0);
    pelagic_cascade cascade, untouched;
    std::memset(&cascade, 0xAB, sizeof cascade);
    std::memcpy(&untouched, &cascade, sizeof cascade);
    expect_rejected(pelagic_ocean_cascade(one.get(), 1, &cascade), "index is 1, expected 0");
    expect_rejected(pelagic_ocean_cascade(two.get(), 2, &cascade), "index is 2, expected 0 to 1");
    expect_rejected(pelagic_ocean_cascade(two.get(), -1, &cascade), "index is -1, expected 0 to 1");
    expect_rejected(pelagic_ocean_cascade(two.get(), INT32_MIN, &cascade), "index is -2147483648, expected 0 to 1");
    EXPECT_EQ(std::memcmp(&cascade, &untouched, sizeof cascade), 0);
    const pelagic_sea lone = small_sea(32), more = stack_sea(3);
    expect_rejected(pelagic_ocean_schedule_sea(two.get(), &lone),
                    "cascades is 1, expected 2, as the ocean was built");
    expect_rejected(pelagic_ocean_schedule_sea(two.get(), &more),
                    "cascades is 3, expected 2, as the ocean was built");
}

TEST_F(CInterfaceCascades, CascadesBelongToTheFrameCompletedLast) {
    const COcean ocean = ocean_of(stack_sea(2), serial.get());
    const pelagic_frame first = complete(ocean, 1);
    const pelagic_cascade before = cascades_of(ocean.get(), first)[1];
    const float height = texel_of(before.height, 3, 4);
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    EXPECT_TRUE(is_same(cascades_of(ocean.get(), first)[1].height, before.height)) << "while the next is computed";
    pelagic_frame second{};
    ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &second), PELAGIC_OK);
    EXPECT_NE(texel_of(cascades_of(ocean.get(), second)[1].height, 3, 4), height);
    EXPECT_EQ(texel_of(before.height, 3, 4), height) << "views of the frame before are still valid";

    // The new sea's cascades have different sides; the current frame still shows the old sea.
    pelagic_sea storm = stack_sea(2);
    storm.wind_speed_mps = 25;
    ASSERT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &storm), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete_sea(ocean.get()), PELAGIC_OK);
    EXPECT_EQ(cascades_of(ocean.get(), second)[0].side_m, first.patch_size_m);
    const pelagic_frame third = complete(ocean, 3);
    EXPECT_GT(third.patch_size_m, first.patch_size_m);
    EXPECT_EQ(cascades_of(ocean.get(), third)[0].side_m, third.patch_size_m);
}

// ---- An application's memory ------------------------------------------------------

TEST_F(CInterfaceCascades, ACopyWritesEachCascadeToItsOwnBuffers) {
    pelagic_ocean_options options = serial_options(serial);
    options.velocities = options.gradients = 1;
    const COcean ocean = ocean_of(stack_sea(3), options);
    std::vector<FrameArrays> arrays(3, FrameArrays(32, true)), computed = arrays;
    std::vector<pelagic_frame_buffers> copies, to;
    for (FrameArrays& cascade : arrays) copies.push_back(cascade.view());
    for (FrameArrays& cascade : computed) to.push_back(cascade.view());
    copies[0].cascade_count = to[0].cascade_count = 3;

    const pelagic_frame frame = complete(ocean, 4);
    ASSERT_EQ(pelagic_ocean_copy(ocean.get(), copies.data()), PELAGIC_OK) << pelagic_last_error();
    pelagic_bounds bounds{};
    ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), 4, to.data(), &bounds), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(arrays, computed);
    EXPECT_EQ(std::memcmp(&bounds, &frame.bounds, sizeof bounds), 0);
    const std::vector<pelagic_cascade> cascades = cascades_of(ocean.get(), frame);
    for (std::size_t t = 0; t < 3; ++t) {
        const pelagic_cascade& cascade = cascades[t];
        const FrameArrays& copy = arrays[t];
        const pelagic_plane* planes[6] = {&cascade.dx,         &cascade.height,     &cascade.dz,
                                          &cascade.velocity_x, &cascade.velocity_y, &cascade.velocity_z};
        for (std::size_t p = 0; p < 6; ++p)
            for (int texel = 0; texel < 1024; ++texel)
                ASSERT_EQ(copy.planes[p][static_cast<std::size_t>(texel)],
                          texel_of(*planes[p], texel % 32, texel / 32));
        EXPECT_EQ(std::memcmp(cascade.displacement_rgba16f, copy.halves.data(), 2 * copy.halves.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.gradient_rgba8, copy.bytes.data(), 4 * copy.bytes.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.slopes_rgba8, copy.slopes.data(), 4 * copy.slopes.size()), 0);
        EXPECT_EQ(std::memcmp(cascade.moments_rgba8, copy.moments.data(), 4 * copy.slopes.size()), 0);
    }
    EXPECT_NE(arrays[0], arrays[1]);
}

// Before the first complete(), the current frame is that of frame_at(), also for cascades.
TEST_F(CInterfaceCascades, CascadesOfFrameAtAreAvailableBeforeTheFirstComplete) {
    const COcean ocean = ocean_of(stack_sea(2), serial.get());
    pelagic_frame_buffers nothing[2] = {pelagic_frame_buffers_make(), pelagic_frame_buffers_make()};
    nothing[0].cascade_count = 2;
    ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), 4, nothing, nullptr), PELAGIC_OK) << pelagic_last_error();
    pelagic_cascade cascade{};
    ASSERT_EQ(pelagic_ocean_cascade(ocean.get(), 1, &cascade), PELAGIC_OK) << pelagic_last_error();
    const COcean other = ocean_of(stack_sea(2), serial.get());
    const pelagic_cascade expected = cascades_of(other.get(), complete(other, 4))[1];
    EXPECT_EQ(std::memcmp(cascade.slopes_rgba8, expected.slopes_rgba8, 4 * 1024), 0);
}

TEST_F(CInterfaceCascades, UnsuitableBuffersAreNamed) {
    const COcean ocean = ocean_of(stack_sea(2), serial_options(serial));
    complete(ocean, 0);
    std::vector<FrameArrays> arrays(2, FrameArrays(32, true));
    const auto expect_line = [&](const std::string& line, void (*change)(pelagic_frame_buffers*)) {
        pelagic_frame_buffers buffers[2] = {arrays[0].view(), arrays[1].view()};
        buffers[0].cascade_count = 2;
        for (pelagic_frame_buffers& cascade : buffers)
            cascade.gradient_rgba8 = nullptr, cascade.velocity_x = cascade.velocity_y = cascade.velocity_z = nullptr;
        change(buffers);
        if (line.empty()) {
            EXPECT_EQ(pelagic_ocean_copy(ocean.get(), buffers), PELAGIC_OK) << pelagic_last_error();
            return;
        }
        const std::vector<FrameArrays> before = arrays;
        expect_rejected(pelagic_ocean_copy(ocean.get(), buffers), line);
        expect_rejected(pelagic_ocean_frame_at(ocean.get(), 1, buffers, nullptr), line);
        EXPECT_EQ(arrays, before) << "nothing was written";
    };
    const std::string size = std::to_string(sizeof(pelagic_frame_buffers));
    const std::string odd = std::to_string(sizeof(pelagic_frame_buffers) - 1);
    expect_line("buffers[1].struct_size is 0, expected " + size + ", as the first's",
                [](auto* buffers) { buffers[1].struct_size = 0; });
    expect_line("buffers.struct_size is " + odd + ", expected " + size + ", the size of the struct",
                [](auto* buffers) { buffers[0].struct_size -= 1; });
    expect_line("buffers[1].cascade_count is 2, expected 0", [](auto* buffers) { buffers[1].cascade_count = 2; });
    for (const std::uint32_t count : {0u, 1u, 3u}) {
        pelagic_frame_buffers alone = arrays[0].view();  // no struct follows it
        alone.cascade_count = count;
        expect_rejected(pelagic_ocean_copy(ocean.get(), &alone),
                        "buffers.cascade_count is " + std::to_string(count) +
                            ", expected 2, with as many structs one after the other");
    }
    expect_line("height has 1023 elements, expected 1024",
                [](auto* buffers) { buffers[1].plane_count = 1023, buffers[1].dx = nullptr; });
    expect_line("slopes_rgba8 has 1 elements, expected 1365", [](auto* buffers) { buffers[1].slopes_count = 0; });
    expect_line("moments_rgba8 has 1366 elements, expected 1365",
                [](auto* buffers) { buffers[0].slopes_count = 1366, buffers[0].slopes_rgba8 = nullptr; });
    static float room[1024];
    static std::uint32_t chain[1365];
    expect_line("velocity_z is requested, but the ocean was created without velocities",
                [](auto* buffers) { buffers[1].velocity_z = room; });
    expect_line("gradient_rgba8 is requested, but the ocean was created without gradients",
                [](auto* buffers) { buffers[1].gradient_rgba8 = chain; });
    expect_line("", [](auto*) {});

    const COcean one = ocean_of(small_sea(32), serial_options(serial));
    complete(one, 0);
    auto buffers = pelagic_frame_buffers_make();
    buffers.slopes_rgba8 = chain, buffers.slopes_count = 1365;
    expect_rejected(pelagic_ocean_copy(one.get(), &buffers),
                    "slopes_rgba8 is requested, but the ocean was created without slopes");
}

}  // namespace
}  // namespace pelagic
