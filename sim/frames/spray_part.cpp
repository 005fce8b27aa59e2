#include "pelagic/sim/frames/spray_part.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::size_t spray_rows_per_job = 8;
constexpr double farthest_spray_m = 1e8;

struct SavedSpray {
    std::uint64_t checksum;  ///< XXH3 of all that follows
    std::uint64_t count;     ///< droplets, the oldest first
};

std::uint64_t checksum_of_spray(std::span<const std::uint8_t> saved) {
    const std::span<const std::uint8_t> checked = saved.subspan(sizeof(SavedSpray::checksum));
    return XXH3_64bits(checked.data(), checked.size());
}

void add_all(const DropletRing& from, DropletRing& to) {
    for (std::size_t i = from.count(); i-- > 0;) to.add(from.newest(i));
}

const SprayOptions& checked_spray(const SprayOptions& options) {
    require(check(options));
    return options;
}

/// Returns whether a droplet of an emitter can have these values: within the ranges of SprayEmitter
/// and WaterFrame, and twice that for sums.
bool is_launched(const StoredDroplet& droplet) {
    const auto& [flight, tick, launch_s, lifetime_s, radius_m, growth_mps, opacity] = droplet;
    bool is_bounded = tick == 0 && std::abs(launch_s) <= 1e9 && flight.relaxation_s > 0 && flight.relaxation_s <= 1 &&
                      lifetime_s > 0 && lifetime_s <= static_cast<float>(max_spray_lifetime_s) && radius_m > 0 &&
                      radius_m <= 1 && growth_mps >= 0 && growth_mps <= 2 && opacity >= 0 && opacity <= 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
        is_bounded = is_bounded && std::abs(flight.start_m[axis]) <= 2e10 &&
                     std::abs(flight.start_mps[axis]) <= 300 && std::abs(flight.wind_mps[axis]) <= 300;
    return is_bounded;
}

}  // namespace

SprayPart::SprayPart(const SprayOptions& options, FrameSlots& slots, const Weather& weather, const ShoreSource* shore)
    : frames_(slots),
      weather_(weather),
      shore_(shore),
      ticks_(weather, {.count = CrestSpray::kept_ticks, .per_foam_tick = 2}),
      crests_(checked_spray(options), slots.memory()),
      emitted_(slots.memory()),
      waiting_(slots.memory()) {
    for (Slot& slot : slots_) slot.droplets = AlignedBuffer<SprayDroplet>(max_spray_droplets, frames_.memory());
}

void SprayPart::set_center(double x_m, double z_m) {
    const auto require_place = [](const char* name, double value) {
        if (!(std::abs(value) <= farthest_spray_m))
            throw std::invalid_argument(invalid_value_message(name, value, "[-1e8, 1e8]"));
    };
    require_place("x_m", x_m);
    require_place("z_m", z_m);
    next_.x_m = x_m;
    next_.z_m = z_m;
}

void SprayPart::emit(std::span<const SprayEmitter> emitters) {
    std::size_t all = 0;
    for (const SprayEmitter& emitter : emitters) {
        require(check(emitter));
        all += static_cast<std::size_t>(emitter.count);
    }
    if (all > max_spray_droplets)
        throw std::invalid_argument(invalid_value_message("count", all, "[0, 8192] for all emitters of a call"));
    const DefaultFloatEnvironment environment;
    for (std::size_t i = 0; i < emitters.size(); ++i)
        leave_emitter(emitters[i], i, crests_.options().seed, wind_at(emitters[i].time_s), next_.water, waiting_);
}

std::vector<std::uint8_t> SprayPart::save_state() const {
    DropletRing all(Allocator{});
    add_all(emitted_, all);
    add_all(waiting_, all);
    SavedSpray saved{0, all.count()};
    std::vector<std::uint8_t> bytes(sizeof saved + all.count() * sizeof(StoredDroplet));
    std::memcpy(bytes.data(), &saved, sizeof saved);
    for (std::size_t i = 0; i < all.count(); ++i)
        std::memcpy(bytes.data() + sizeof saved + i * sizeof(StoredDroplet), &all.newest(all.count() - 1 - i),
                    sizeof(StoredDroplet));
    saved.checksum = checksum_of_spray(bytes);
    std::memcpy(bytes.data(), &saved.checksum, sizeof saved.checksum);
    return bytes;
}

void SprayPart::restore_state(std::span<const std::uint8_t> bytes) {
    SavedSpray saved{};
    if (bytes.size() < sizeof saved)
        throw std::invalid_argument(
            invalid_value_message("the saved spray", number_text(bytes.size()) + " bytes", "more"));
    std::memcpy(&saved, bytes.data(), sizeof saved);
    const std::size_t of_droplets = bytes.size() - sizeof saved;
    bool is_valid = saved.checksum == checksum_of_spray(bytes) && saved.count <= max_spray_droplets &&
                    of_droplets == saved.count * sizeof(StoredDroplet);
    std::vector<StoredDroplet> droplets(is_valid ? saved.count : 0);
    if (!droplets.empty()) std::memcpy(droplets.data(), bytes.data() + sizeof saved, of_droplets);
    for (const StoredDroplet& droplet : droplets) is_valid = is_valid && is_launched(droplet);
    if (!is_valid)
        throw std::invalid_argument("the saved spray is damaged, expected the bytes that save_spray() returned");
    emitted_.clear();
    waiting_.clear();
    for (const StoredDroplet& droplet : droplets) emitted_.add(droplet);
}

void SprayPart::add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    if (pass == Pass::frame) {
        // after the tick, for which the first cascade of the frame waits
        graph.add({.name = "spray",
                   .count = 1,
                   .waits_for = {surfaces_done.front()},
                   .body = for_each_item([this](std::size_t) { write_frame(); }),
                   .stack_bytes = stack_margin});
        return;
    }
    const StageId searched = graph.add({.name = "tick spray cells",
                                        .count = CrestSpray::rows,
                                        .batch = spray_rows_per_job,
                                        .waits_for = {surfaces_done.begin(), surfaces_done.end()},
                                        .body = for_each_item([this](std::size_t row) {
                                            if (!is_idle_) crests_.search_row(row);
                                        }),
                                        .stack_bytes = stack_margin});
    const StageId launched = graph.add({.name = "tick spray",
                                        .count = 1,
                                        .waits_for = {searched},
                                        .body = for_each_item([this](std::size_t) {
                                            if (!is_idle_) crests_.launch();
                                        }),
                                        .stack_bytes = stack_margin});
    for (StageId& surface : surfaces_done) surface = launched;
}

void SprayPart::begin(const PassMoment& at) {
    if (at.pass == Pass::tick) {
        is_idle_ = !ticks_.due().begins_at(at.time_s);
        if (!is_idle_) begin_tick(at);
        return;
    }
    now_ = next_;
    add_all(waiting_, emitted_);
    waiting_.clear();
    ticks_.begin_frame(at.time_s);
    if (ticks_.due().count == CrestSpray::kept_ticks) crests_.clear();
    const TickTime place = ticks_.frame_tick();
    const double tick_s = ticks_.clock().tick_s();
    time_ = {at.time_s, place.number, static_cast<double>(place.fraction) * 0x1p-32 * tick_s, tick_s};
}

void SprayPart::begin_tick(const PassMoment& at) {
    const std::int64_t number = ticks_.begin_tick();
    const WaterFrame::Origin origin = now_.water.origin_at(at.time_s);
    crests_.begin_tick({.number = number,
                        .in_loop = ticks_.clock().in_loop(number),
                        .tick_s = time_.tick_s,
                        .wind = wind_at(at.time_s),
                        .foam_level = at.statistics.foam_level,
                        .x_m = now_.x_m - origin.x_m,
                        .z_m = now_.z_m - origin.z_m},
                       BreakingSurface(at.cascades, frames_.cascades(), shore_ ? shore_->of_pass() : ShoreSurface{}));
}

void SprayPart::write_frame() {
    Slot& slot = slots_.back();
    slot.count = write_droplets(emitted_, crests_.droplets(), time_, now_.water,
                                {slot.droplets.data(), slot.droplets.size()});
}

void SprayPart::end(Frame& frame) {
    ticks_.end();
    frame.droplets = {slots_.back().droplets.data(), slots_.back().count};
}

void SprayPart::drop() {
    ticks_.drop();
    slots_.swap();
}

std::size_t SprayPart::bytes() const {
    std::size_t bytes = sizeof *this + crests_.bytes() + emitted_.bytes() + waiting_.bytes();
    for (const Slot& slot : slots_) bytes += slot.droplets.bytes();
    return bytes;
}

}  // namespace pelagic
