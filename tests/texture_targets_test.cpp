// Textures in the application's memory hold the bytes of the frame's own textures, and nothing
// outside of them is written.
#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

constexpr int target_n = 32;
constexpr std::uint32_t guard = 0xA5C3A5C3;

/// An application's memory for a map of a cascade, with guard words on both sides of every
/// piece.
class Guarded {
   public:
    explicit Guarded(std::vector<std::size_t> words) {
        for (const std::size_t count : words) {
            pieces_.emplace_back(count + 2 * margin);
            std::fill_n(pieces_.back().data(), pieces_.back().size(), guard);
        }
    }
    std::uint32_t* piece(std::size_t number) { return pieces_[number].data() + margin; }
    bool guards_hold() const {
        return std::all_of(pieces_.begin(), pieces_.end(), [](const AlignedBuffer<std::uint32_t>& piece) {
            const auto holds = [](std::uint32_t word) { return word == guard; };
            return std::all_of(piece.data(), piece.data() + margin, holds) &&
                   std::all_of(piece.data() + piece.size() - margin, piece.data() + piece.size(), holds);
        });
    }

   private:
    static constexpr std::size_t margin = 16;  // keeps pieces aligned as targets must be
    std::vector<AlignedBuffer<std::uint32_t>> pieces_;
};

std::vector<std::size_t> texels_by_level() {
    std::vector<std::size_t> texels;
    for (int level = 0; level < mip_levels(target_n); ++level)
        texels.push_back(static_cast<std::size_t>(target_n >> level) * static_cast<std::size_t>(target_n >> level));
    return texels;
}

struct CascadeMemory {
    Guarded halves{{2 * target_n * target_n}}, gradients{texels_by_level()}, slopes{texels_by_level()},
        moments{texels_by_level()};

    TextureTargets targets() {
        const auto chain = [](Guarded& map) {
            TextureTargets::Chain levels{};
            for (std::size_t level = 0; level < texels_by_level().size(); ++level) levels[level] = map.piece(level);
            return levels;
        };
        return {reinterpret_cast<std::uint16_t*>(halves.piece(0)), chain(gradients), chain(slopes), chain(moments)};
    }
    bool holds(const Cascade& cascade) {
        const auto is_chain = [&](Guarded& map, std::span<const std::uint32_t> chain) {
            for (int level = 0; level < mip_levels(target_n); ++level) {
                const auto texels = cascade.level_of(chain, level);
                if (std::memcmp(map.piece(static_cast<std::size_t>(level)), texels.data(), texels.size_bytes()) != 0)
                    return false;
            }
            return map.guards_hold();
        };
        return std::memcmp(halves.piece(0), cascade.displacement_rgba16f.data(),
                           cascade.displacement_rgba16f.size_bytes()) == 0 &&
               halves.guards_hold() && is_chain(gradients, cascade.gradient_rgba8) &&
               is_chain(slopes, cascade.slopes_rgba8) && is_chain(moments, cascade.moments_rgba8);
    }
};

SeaState target_sea(int cascades) {
    return cascades == 1 ? SeaState{.resolution = target_n, .patch_size_m = 130}
                         : SeaState{.cascades = cascades, .resolution = target_n};
}

class TextureTargetsOnEachIsa : public OnEachIsa {
   protected:
    Ocean ocean_of(int cascades) const {
        return Ocean(target_sea(cascades),
                     {.executor = make_serial_executor(), .isa = GetParam(), .gradients = true, .slopes = true});
    }
};
INSTANTIATE_TEST_SUITE_P(Isa, TextureTargetsOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(TextureTargetsOnEachIsa, HoldTheTexturesOfTheFrame) {
    for (const int cascades : {1, 3}) {
        Ocean usual = ocean_of(cascades), elsewhere = ocean_of(cascades);
        std::vector<CascadeMemory> memory(static_cast<std::size_t>(cascades));
        std::vector<TextureTargets> targets;
        for (CascadeMemory& cascade : memory) targets.push_back(cascade.targets());
        for (const double time_s : {0.4, 1.7, 9.2}) {
            const Frame& expected = usual.frame_at(time_s);
            elsewhere.schedule(time_s, targets);
            const Frame& frame = elsewhere.complete();
            for (std::size_t i = 0; i < memory.size(); ++i) {
                EXPECT_TRUE(memory[i].holds(expected.cascades[i]))
                    << cascades << " cascades, cascade " << i << ", " << time_s;
                EXPECT_TRUE(frame.cascades[i].displacement_rgba16f.empty() &&
                            frame.cascades[i].gradient_rgba8.empty() && frame.cascades[i].slopes_rgba8.empty() &&
                            frame.cascades[i].moments_rgba8.empty());
                EXPECT_EQ(frame.cascades[i].height.at(3, 5), expected.cascades[i].height.at(3, 5));
            }
        }
        // The same slots again without targets: the frame has its own textures again.
        for (const double time_s : {2.5, 3.5})
            EXPECT_EQ(hash_of(elsewhere.frame_at(time_s)), hash_of(usual.frame_at(time_s)));
    }
}

TEST_P(TextureTargetsOnEachIsa, MapsWithoutATargetStayInTheFrame) {
    Ocean usual = ocean_of(1), elsewhere = ocean_of(1);
    CascadeMemory memory;
    TextureTargets only_slopes{.slopes_rgba8 = memory.targets().slopes_rgba8};
    const Frame& expected = usual.frame_at(1);
    elsewhere.schedule(1, {&only_slopes, 1});
    const Cascade& cascade = elsewhere.complete().cascades[0];
    EXPECT_TRUE(cascade.slopes_rgba8.empty());
    EXPECT_TRUE(std::equal(cascade.displacement_rgba16f.begin(), cascade.displacement_rgba16f.end(),
                           expected.cascades[0].displacement_rgba16f.begin(),
                           expected.cascades[0].displacement_rgba16f.end()));
    EXPECT_TRUE(std::equal(cascade.gradient_rgba8.begin(), cascade.gradient_rgba8.end(),
                           expected.cascades[0].gradient_rgba8.begin(), expected.cascades[0].gradient_rgba8.end()));
    EXPECT_TRUE(std::equal(cascade.moments_rgba8.begin(), cascade.moments_rgba8.end(),
                           expected.cascades[0].moments_rgba8.begin(), expected.cascades[0].moments_rgba8.end()));
}

std::string invalid_value_of(Ocean& ocean, std::span<const TextureTargets> targets) {
    return message_of([&] { ocean.schedule(1, targets); });
}

TEST(TextureTargets, InvalidTargetsAreRejectedBeforeTheFrameIsComputed) {
    Ocean ocean({.resolution = target_n, .patch_size_m = 130}, {.executor = make_serial_executor()});
    const std::uint64_t before = hash_of(ocean.frame_at(5));
    CascadeMemory memory;
    const TextureTargets whole = memory.targets();
    EXPECT_EQ(invalid_value_of(ocean, {&whole, 1}),
              "slopes_rgba8 is requested, but the ocean was created without slopes");
    const TextureTargets two[2] = {};
    EXPECT_EQ(invalid_value_of(ocean, two), "there are targets of 2 cascades, expected 1");
    TextureTargets odd{.displacement_rgba16f = whole.displacement_rgba16f + 4};
    EXPECT_EQ(invalid_value_of(ocean, {&odd, 1}), "displacement_rgba16f is at an address that is no multiple of 64");
    Ocean with_slopes({.resolution = target_n, .patch_size_m = 130},
                      {.executor = make_serial_executor(), .slopes = true});
    for (const std::size_t bytes : {1, 2, 3})
        for (const std::size_t level : {0, 2})
            for (const auto& [name, chain] : {std::pair{"gradient_rgba8", &TextureTargets::gradient_rgba8},
                                              std::pair{"slopes_rgba8", &TextureTargets::slopes_rgba8},
                                              std::pair{"moments_rgba8", &TextureTargets::moments_rgba8}}) {
                TextureTargets off = memory.targets();
                std::uint32_t*& texels = (off.*chain)[level];
                texels = reinterpret_cast<std::uint32_t*>(reinterpret_cast<std::uintptr_t>(texels) + bytes);
                EXPECT_EQ(invalid_value_of(with_slopes, {&off, 1}), "level " + std::to_string(level) + " of " + name +
                                                                        " is at an address that is no multiple of 4");
            }
    TextureTargets torn{.gradient_rgba8 = whole.gradient_rgba8};
    torn.gradient_rgba8[3] = nullptr;
    EXPECT_EQ(invalid_value_of(ocean, {&torn, 1}), "gradient_rgba8 lacks level 3, expected 6 levels");
    EXPECT_EQ(hash_of(ocean.complete()), before);

    TextureTargets good{.displacement_rgba16f = whole.displacement_rgba16f};
    EXPECT_EQ(invalid_value_of(ocean, {&good, 1}), "");
    std::vector<std::uint16_t> halves(4 * target_n * target_n);
    EXPECT_THROW(copy_frame(ocean.complete(), FrameBuffers{.displacement_rgba16f = halves}), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
