#include "pelagic/sim/foam/snapshots.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

constexpr std::size_t snapshot_rows_per_job = 16;
// Two rows of floats and one of bytes at the largest resolution.
constexpr std::size_t snapshot_stack_bytes = 3 * 4 * SnapshotJob::max_resolution + stack_margin;

std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// Drift at a tick along an axis, [0, N): whole texels and a fraction.
struct AxisShift {
    std::size_t whole;
    double fraction;
};

/// \param loop  texels in a loop, of either sign
AxisShift shift_at(int loop, const TickClock& clock, std::int64_t number, int resolution) {
    const std::int64_t ticks = clock.ticks_per_loop(), moved = std::int64_t{loop} * clock.in_loop(number);
    const std::int64_t whole = (moved >= 0 ? moved : moved - (ticks - 1)) / ticks;
    return {static_cast<std::size_t>(whole) & static_cast<std::size_t>(resolution - 1),
            static_cast<double>(moved - whole * ticks) / static_cast<double>(ticks)};
}

/// Returns the modified Bessel function I_0(2 sqrt(q)). \pre q is in [0, 5]
double bessel_0(double q) {
    double sum = 1, term = 1;
    for (int n = 1; n <= 16; ++n) sum += term *= q / (n * n);
    return sum;
}

/// Returns the weights of texels -3 to 4 for a point at u between texels 0 and 1: sin(pi x) / x
/// with the window of Kaiser (1974). The common factor sin(pi u) cancels, because the sum is 1.
std::array<float, SnapshotJob::taps> shift_weights(double u) {
    constexpr int half = SnapshotJob::taps / 2;
    constexpr double shape = 4.2;  // smallest error for waves of three texels or more
    std::array<float, SnapshotJob::taps> weights{};
    std::array<double, SnapshotJob::taps> terms;
    if (u == 0) {
        weights[half - 1] = 1;
        return weights;
    }
    double sum = 0;
    for (int i = 0; i < SnapshotJob::taps; ++i) {
        const double x = u - (i - half + 1);
        sum += terms[static_cast<std::size_t>(i)] =
            (i % 2 == 0 ? 1 : -1) * bessel_0(shape * shape / 4 * (1 - x * x / (half * half))) / x;
    }
    for (std::size_t i = 0; i < terms.size(); ++i) weights[i] = static_cast<float>(terms[i] / sum);
    return weights;
}

}  // namespace

PresentCompression bytes_of_compression(const Cascade& cascade, float slope_unit) {
    return {.factor = -(cascade.compression_scale * slope_unit) / SnapshotFoam::step,
            .offset = -SnapshotFoam::lowest / SnapshotFoam::step,
            .front_x = cascade.compression_front_x,
            .front_z = cascade.compression_front_z};
}

FoamSnapshots::FoamSnapshots(FrameSlots& slots, const Kernels& kernels)
    : slots_(slots), kernels_(kernels), cascades_(slots.cascade_count()) {
    const int n = slots.resolution();
    for (CascadeSnapshots& cascade : std::span(cascades_).first(
             std::min(cascades_.size(), std::size_t{CascadePlan::max_foam_cascades}))) {
        cascade.compression =
            AlignedBuffer<float>(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), slots.memory());
        for (Image& image : cascade.images)
            for (AlignedBuffer<std::uint32_t>& chain : image.chains)
                chain = AlignedBuffer<std::uint32_t>(mip_offset(n, mip_levels(n)), slots.memory());
    }
}

std::vector<StageId> FoamSnapshots::add_tick_stages(JobGraph& graph, std::span<const StageId> surfaces_done) {
    std::vector<StageId> read;
    const std::size_t jobs = static_cast<std::size_t>(slots_.resolution()) / snapshot_rows_per_job;
    for (std::size_t cascade = 0; cascade < surfaces_done.size(); ++cascade) {
        read.push_back(
            graph.add({.name = stage_name("tick compression", cascade),
                       .count = jobs,
                       .waits_for = {surfaces_done[cascade]},
                       .body = for_each_item([this, cascade](std::size_t job) { compress_rows(cascade, job); }),
                       .stack_bytes = stack_margin}));
        const StageId stored =
            graph.add({.name = stage_name("tick snapshot", cascade),
                       .count = jobs,
                       .waits_for = {read.back()},
                       .body = for_each_item([this, cascade](std::size_t job) { store_rows(cascade, job); }),
                       .stack_bytes = snapshot_stack_bytes});
        graph.add({.name = stage_name("tick snapshot tail", cascade),
                   .count = 1,
                   .waits_for = {stored},
                   .body = for_each_item([this, cascade](std::size_t) { make_levels(cascade); }),
                   .stack_bytes = stack_margin});
    }
    return read;
}

void FoamSnapshots::begin_tick(std::size_t cascade, const Cascade& from, const TickClock& clock,
                               std::int64_t number) {
    CascadeSnapshots& to = cascades_[cascade];
    to.grid = from.grid;
    to.bytes = bytes_of_compression(from);
    to.slot = SnapshotFoam::slot_of(clock.in_loop(number));
    const AxisShift x = shift_at(to.drift.x, clock, number, slots_.resolution());
    const AxisShift z = shift_at(to.drift.z, clock, number, slots_.resolution());
    to.shift_x = x.whole;
    to.shift_z = z.whole;
    to.weights_x = shift_weights(x.fraction);
    to.weights_z = shift_weights(z.fraction);
    if (!to.is_there) return;
    Image& image = to.image();
    to.before = image.chains[image.current].data();
    if (slots_.front_cascade(cascade).snapshots_rgba8[to.slot / 4].data() == to.before)
        image.current = 1 - image.current;
    image.version = next_version();
}

void FoamSnapshots::compress_rows(std::size_t cascade, std::size_t job) {
    const CascadeSnapshots& from = cascades_[cascade];
    if (is_idle_ || !from.is_there) return;
    const int n = slots_.resolution();
    const CascadeGrid::Vector front =
        from.grid.in_cascade(double{from.bytes.front_x}, double{from.bytes.front_z});
    kernels_.compression(
        {.surface = slots_.surface(cascade),
         .resolution = static_cast<std::size_t>(n),
         .block_stride = column_block_floats(n, kernels_.lanes),
         .cosine = static_cast<float>(from.grid.cosine),
         .sine = static_cast<float>(from.grid.sine),
         .far_over_near = static_cast<float>(SlopesJob::far_weight / SlopesJob::near_weight),
         .factor = static_cast<float>(double{from.bytes.factor} * SlopesJob::near_weight / (from.grid.side_m / n)),
         .offset = from.bytes.offset,
         .front_along = static_cast<float>(front.along),
         .front_across = static_cast<float>(front.across),
         .first_row = job * snapshot_rows_per_job,
         .rows = snapshot_rows_per_job,
         .out = cascades_[cascade].compression.data()});
}

void FoamSnapshots::store_rows(std::size_t cascade, std::size_t job) {
    CascadeSnapshots& to = cascades_[cascade];
    if (is_idle_ || !to.is_there) return;
    SnapshotJob rows{.compression = to.compression.data(),
                     .resolution = static_cast<std::size_t>(slots_.resolution()),
                     .shift_x = to.shift_x,
                     .shift_z = to.shift_z,
                     .weights_x = {},
                     .weights_z = {},
                     .first_row = job * snapshot_rows_per_job,
                     .rows = snapshot_rows_per_job,
                     .byte = static_cast<std::uint32_t>(to.slot % 4),
                     .before = to.before,
                     .after = to.image().chains[to.image().current].data()};
    std::copy(to.weights_x.begin(), to.weights_x.end(), rows.weights_x);
    std::copy(to.weights_z.begin(), to.weights_z.end(), rows.weights_z);
    kernels_.snapshot(rows);
}

void FoamSnapshots::make_levels(std::size_t cascade) {
    CascadeSnapshots& to = cascades_[cascade];
    if (is_idle_ || !to.is_there) return;
    const int n = slots_.resolution();
    std::uint32_t* const chain = to.image().chains[to.image().current].data();
    for (int level = 1; level < mip_levels(n); ++level)
        kernels_.halve_snapshots({.from = chain + mip_offset(n, level - 1),
                                  .side = static_cast<std::size_t>(n) >> level,
                                  .to = chain + mip_offset(n, level)});
}

void FoamSnapshots::set_views(const TickClock& clock, const TickTime& time) {
    const double since = static_cast<double>(time.fraction) * 0x1p-32;
    SnapshotFoam& foam = slots_.frame().foam;
    for (int back = 0; back < TickClock::kept_ticks; ++back)
        foam.age[SnapshotFoam::slot_of(clock.in_loop(time.number - back))] =
            static_cast<float>((back + since) / (TickClock::kept_ticks - 1));
    for (std::size_t i = 0; i < cascades_.size(); ++i) {
        Cascade& cascade = slots_.cascade(i);
        const CascadeSnapshots& from = cascades_[i];
        const auto shift = [&](int loop) {
            const double texels = loop * ((clock.in_loop(time.number) + since) / clock.ticks_per_loop());
            return texels - std::floor(texels / slots_.resolution()) * slots_.resolution();
        };
        cascade.drift_columns = shift(from.drift.x);
        cascade.drift_rows = shift(from.drift.z);
        cascade.compression_r8 = {};
        if (from.is_there)
            cascade.compression_r8 = {slots_.buffers(i).compression.data(), slots_.buffers(i).compression.size()};
        for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
            const Image& now = from.images[image];
            const AlignedBuffer<std::uint32_t>& chain = now.chains[now.current];
            cascade.snapshots_rgba8[image] = {};
            if (from.is_there) cascade.snapshots_rgba8[image] = {chain.data(), chain.size()};
            cascade.snapshots_version[image] = from.is_there ? now.version : 0;
        }
    }
}

std::size_t FoamSnapshots::bytes() const {
    std::size_t bytes = 0;
    for (const CascadeSnapshots& cascade : cascades_) {
        bytes += sizeof(CascadeSnapshots) + cascade.compression.bytes();
        for (const Image& image : cascade.images)
            for (const AlignedBuffer<std::uint32_t>& chain : image.chains) bytes += chain.bytes();
    }
    return bytes;
}

}  // namespace pelagic
