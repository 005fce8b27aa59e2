#include "pelagic/sim/dynamic_waves/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <stdexcept>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::int64_t max_grid_ticks = std::int64_t{1} << 50;
/// Foam decays as fast as that of the cascades: 9 bytes in a tenth of a second.
constexpr std::int64_t foam_fade_per_s = 90;

/// Returns the damping rate at the grid's edge. It rises as the square of the distance into the
/// border, gently enough to reflect almost nothing. A wave as long as the border is wide is
/// attenuated by e^-8 while it crosses the border and the adjacent border across the torus. Shorter
/// and slower waves are attenuated more.
double damping_at_edge(const DynamicWavesOptions& options) {
    const double speed = options.step == DynamicWavesStep::verlet
                             ? options.wave_speed_mps
                             : group_velocity(two_pi / options.border_m, options.depth_m);
    return 12 * speed / options.border_m;
}

struct SavedGridHeader {
    std::int64_t first_x, first_z, ticks;
};

}  // namespace

double DynamicWaveGrid::courant_number(const DynamicWavesOptions& options) {
    return options.wave_speed_mps / (options.side_m / options.resolution) / options.ticks_per_s;
}

DynamicWaveGrid::DynamicWaveGrid(const DynamicWavesOptions& options, Isa isa, const Allocator& memory)
    : options_(options),
      kernels_(kernels_for(isa)),
      placement_(options.resolution, options.side_m / options.resolution) {
    assert(check(options).empty());
    const DefaultFloatEnvironment environment;
    for (auto& plane : planes_) plane = AlignedBuffer<float>(dynamic_plane_floats(n()), memory);
    tick_before_ = AlignedBuffer<float>(dynamic_plane_floats(n()), memory);
    difference_before_ = AlignedBuffer<float>(dynamic_plane_floats(n()), memory);
    foam_ = AlignedBuffer<std::uint8_t>(n() * n(), memory);
    has_foam_.resize(n());
    for (std::size_t axis = 0; axis < 2; ++axis) {
        damping_[axis] = AlignedBuffer<float>(n(), memory);
        shown_[axis] = AlignedBuffer<float>(n(), memory);
    }
    if (options.step == DynamicWavesStep::spectral) {
        plan_.emplace_back(options.resolution);
        phases_ = AlignedBuffer<float>(n() * (n() + 2), memory);
        bake_phases();
    }
    placement_.move_to(placement_.first_around(0, 0));
    lay_border();
}

void DynamicWaveGrid::bake_phases() {
    const std::size_t lanes = kernels_.lanes, half = n() / 2;
    const double step = two_pi / options_.side_m;
    const Water water(options_.depth_m, sea_surface_tension_m3ps2);
    const double over_all = 1.0 / (static_cast<double>(n()) * static_cast<double>(n()));
    float* to = phases_.data();
    for (std::size_t block = 0; block < n(); block += lanes) {
        for (std::size_t x = 0; x <= half; ++x, to += 2 * lanes) {
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                const std::size_t line = block + lane;
                const double kx = step * static_cast<double>(x);
                const double kz = step * static_cast<double>(std::min(line, n() - line));
                const double k2 = kx * kx + kz * kz;
                const double omega = k2 > 0 ? angular_frequency(std::sqrt(k2), water) : 0;
                const auto phase = det::sine_cosine_of_turns(omega * tick_s() / two_pi);
                const double decay = 2 * options_.viscosity_m2ps * k2 + options_.decay_per_s;
                const double attenuation = det::exp(-decay * tick_s()) * over_all;
                to[lane] = static_cast<float>(phase.cosine * attenuation);
                to[lanes + lane] = static_cast<float>(phase.sine * attenuation);
            }
        }
    }
}

void DynamicWaveGrid::lay_border() {
    const bool has_border = options_.border_m > 0;
    const double edge = has_border ? damping_at_edge(options_) : 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t i = 0; i < n(); ++i) {
            const double texels_in = static_cast<double>(std::min(i, n() - 1 - i));
            const double from_edge = (texels_in + 0.5) * texel_m();
            const double within = from_edge < options_.border_m ? 1 - from_edge / options_.border_m : 0;
            const std::size_t at = placement_.in_torus(placement_.first()[axis] + static_cast<std::int64_t>(i));
            damping_[axis][at] = static_cast<float>(within > 0 ? det::exp(-edge * within * within * tick_s()) : 1);
            const auto last = static_cast<std::int64_t>(n()) - 1, texel = static_cast<std::int64_t>(i);
            shown_[axis][at] = static_cast<float>(shown_part(options_, std::min(texel, last - texel)));
        }
    }
}

StageId DynamicWaveGrid::add_tick_stages(JobGraph& graph, const std::vector<StageId>& waits_for) {
    const std::size_t row_jobs = n() / rows_per_item;
    const StageId prepared = graph.add({.name = "dynamic waves splashes",
                                        .count = row_jobs,
                                        .waits_for = waits_for,
                                        .body = for_each_item([this](std::size_t job) { prepare_rows(job); })});
    const StageId stepped = options_.step == DynamicWavesStep::verlet ? add_verlet_stage(graph, prepared)
                                                                      : add_spectral_stages(graph, prepared);
    return graph.add({.name = "dynamic waves foam",
                      .count = row_jobs,
                      .waits_for = {stepped},
                      .body = for_each_item([this](std::size_t job) { finish_rows(job); })});
}

StageId DynamicWaveGrid::add_verlet_stage(JobGraph& graph, StageId prepared) {
    return graph.add({.name = "dynamic waves verlet",
                      .count = n() / rows_per_item,
                      .waits_for = {prepared},
                      .body = for_each_item([this](std::size_t job) {
                          const double courant = courant_number(options_);
                          const double attenuation = det::exp(-options_.decay_per_s * tick_s());
                          kernels_.verlet_rows({.now = first_texel(height_),
                                                .before = first_texel(1 - height_),
                                                .resolution = n(),
                                                .first_row = job * rows_per_item,
                                                .rows = rows_per_item,
                                                .coupling = static_cast<float>(courant * courant * attenuation),
                                                .damping = static_cast<float>(attenuation * attenuation)});
                      })});
}

StageId DynamicWaveGrid::add_spectral_stages(JobGraph& graph, StageId prepared) {
    const std::size_t blocks = n() / kernels_.lanes, stack_bytes = 8 * n() * kernels_.lanes;
    const auto columns = [this](std::size_t job, FftTables& tables) -> DynamicColumnsJob {
        tables = plan_.front().tables();
        return {first_texel(height_), first_texel(1 - height_), border(), job * kernels_.lanes, &tables};
    };
    const StageId transformed = graph.add({.name = "dynamic waves columns",
                                           .count = blocks,
                                           .waits_for = {prepared},
                                           .body = for_each_item([this, columns](std::size_t job) {
                                               FftTables tables;
                                               kernels_.dynamic_columns(columns(job, tables));
                                           }),
                                           .stack_bytes = stack_bytes + stack_margin});
    const StageId moved =
        graph.add({.name = "dynamic waves lines",
                   .count = blocks,
                   .waits_for = {transformed},
                   .body = for_each_item([this](std::size_t job) {
                       const FftTables tables = plan_.front().tables();
                       const std::size_t first = job * kernels_.lanes * dynamic_row_stride(n());
                       kernels_.dynamic_lines({.h = first_texel(height_) + first,
                                               .w = first_texel(1 - height_) + first,
                                               .phases = phases_.data() + job * (n() + 2) * kernels_.lanes,
                                               .fft = &tables});
                   }),
                   .stack_bytes = 2 * stack_bytes + stack_margin});
    return graph.add({.name = "dynamic waves columns back",
                      .count = blocks,
                      .waits_for = {moved},
                      .body = for_each_item([this, columns](std::size_t job) {
                          FftTables tables;
                          kernels_.dynamic_columns_back(columns(job, tables));
                      }),
                      .stack_bytes = 2 * stack_bytes + stack_margin});
}

void DynamicWaveGrid::flatten_row(std::int64_t z) {
    for (AlignedBuffer<float>* plane : {&planes_[0], &planes_[1], &tick_before_, &difference_before_})
        std::fill_n(plane->data() + dynamic_row_margin + placement_.in_torus(z) * dynamic_row_stride(n()), n(), 0.f);
    std::fill_n(foam_.data() + placement_.in_torus(z) * n(), n(), std::uint8_t{0});
}

void DynamicWaveGrid::flatten_column(std::int64_t x) {
    for (std::size_t z = 0; z < n(); ++z) {
        const std::size_t at = dynamic_row_margin + z * dynamic_row_stride(n()) + placement_.in_torus(x);
        planes_[0][at] = planes_[1][at] = tick_before_[at] = difference_before_[at] = 0;
        foam_[z * n() + placement_.in_torus(x)] = 0;
    }
}

void DynamicWaveGrid::set_center(double x_m, double z_m) {
    assert(std::fabs(x_m) <= farthest_position_m && std::fabs(z_m) <= farthest_position_m);
    const DefaultFloatEnvironment environment(x_m, z_m);
    const std::array<std::int64_t, 2> moved = placement_.first_around(x_m, z_m);
    if (moved == placement_.first()) return;
    const std::int64_t side = options_.resolution;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::int64_t from = placement_.first()[axis], to = moved[axis];
        const auto flatten = axis == 0 ? &DynamicWaveGrid::flatten_column : &DynamicWaveGrid::flatten_row;
        const std::int64_t entered = to > from ? std::max(to, from + side) : to;
        const std::int64_t end = to > from ? to + side : std::min(from, to + side);
        for (std::int64_t texel = entered; texel < end; ++texel) (this->*flatten)(texel);
    }
    placement_.move_to(moved);
    lay_border();
}

void DynamicWaveGrid::begin_tick() {
    const DefaultFloatEnvironment environment;
    sources_.begin_tick(placement_, ticks_, tick_s());
}

void DynamicWaveGrid::end_tick() {
    ++ticks_;
    height_ = stepped_plane();
    sources_.end_tick();
}

void DynamicWaveGrid::prepare_rows(std::size_t job) {
    const std::size_t first = job * rows_per_item;
    // Without the margins of rows, which neighbouring jobs also read.
    for (std::size_t z = first; z < first + rows_per_item; ++z) {
        const std::size_t row = dynamic_row_margin + z * dynamic_row_stride(n());
        const float* const now = planes_[height_].data() + row;
        float *const before = tick_before_.data() + row, *const change = difference_before_.data() + row;
        for (std::size_t x = 0; x < n(); ++x) {
            change[x] = now[x] - before[x];
            before[x] = now[x];
        }
    }
    const bool is_verlet = options_.step == DynamicWavesStep::verlet;
    if (is_verlet)
        kernels_.damp_rows({.planes = {first_texel(0), first_texel(1)},
                            .resolution = n(),
                            .first_row = first,
                            .rows = rows_per_item,
                            .border = border()});
    sources_.push_rows(placement_, first, rows_per_item,
                       {first_texel(height_), verlets_other(height_), tick_before_.data() + dynamic_row_margin});
    if (is_verlet) repeat_ends(height_, first);
}

void DynamicWaveGrid::finish_rows(std::size_t job) {
    const std::size_t first = job * rows_per_item, plane = stepped_plane();
    sources_.lift_rows(placement_, first, rows_per_item,
                       {first_texel(plane), verlets_other(plane), tick_before_.data() + dynamic_row_margin});
    foam_rows(first);
}

void DynamicWaveGrid::foam_rows(std::size_t first_row) {
    const std::int64_t rate = options_.ticks_per_s;
    const float threshold = static_cast<float>(options_.foam_height_m);
    kernels_.dynamic_foam(
        {.heights = first_texel(stepped_plane()),
         .resolution = n(),
         .first_row = first_row,
         .rows = rows_per_item,
         .threshold = threshold,
         .scale = 255 / threshold,
         .fade = static_cast<int>((ticks_ + 1) * foam_fade_per_s / rate - ticks_ * foam_fade_per_s / rate),
         .foam = foam_.data(),
         .has_foam = has_foam_.data()});
    sources_.foam_rows(placement_, first_row, rows_per_item, threshold, {foam_.data(), has_foam_.data()});
}

void DynamicWaveGrid::repeat_ends(std::size_t plane, std::size_t first_row) {
    for (std::size_t z = first_row; z < first_row + rows_per_item; ++z) {
        float* const row = first_texel(plane) + z * dynamic_row_stride(n());
        row[-1] = row[n() - 1];
        row[n()] = row[0];
    }
}

void DynamicWaveGrid::interpolate(float fraction, std::size_t item, const Interpolated& to) const {
    const std::size_t first = item * rows_per_item;
    kernels_.interpolate_ticks({.before = tick_before_.data() + dynamic_row_margin,
                                .now = first_texel(height_),
                                .difference_before = difference_before_.data() + dynamic_row_margin,
                                .resolution = n(),
                                .first_row = first,
                                .rows = rows_per_item,
                                .fraction = fraction,
                                .ticks_per_s = static_cast<float>(options_.ticks_per_s),
                                .shown_x = shown_[0].data(),
                                .shown_z = shown_[1].data(),
                                .height = to.height_m,
                                .vertical_velocity = to.vertical_velocity_mps,
                                .lowest = to.lowest_m,
                                .highest = to.highest_m});
    std::copy_n(foam_.data() + first * n(), rows_per_item * n(), to.foam + first * n());
}

std::vector<std::uint8_t> DynamicWaveGrid::saved() const {
    const SavedGridHeader header = {first_x(), first_z(), ticks_};
    const std::size_t row_bytes = n() * sizeof(float);
    std::vector<std::uint8_t> bytes(sizeof header + saved_texel_bytes() + sources_.saved_bytes());
    std::uint8_t* to = bytes.data();
    const auto put = [&to](const void* from, std::size_t count) {
        std::memcpy(to, from, count);
        to += count;
    };
    put(&header, sizeof header);
    for (const AlignedBuffer<float>* plane :
         {&planes_[height_], &planes_[1 - height_], &tick_before_, &difference_before_})
        for (std::size_t z = 0; z < n(); ++z)
            put(plane->data() + dynamic_row_margin + z * dynamic_row_stride(n()), row_bytes);
    put(foam_.data(), foam_.size());
    sources_.save({to, sources_.saved_bytes()});
    return bytes;
}

void DynamicWaveGrid::restore(std::span<const std::uint8_t> saved) {
    SavedGridHeader header{};
    const std::size_t row_bytes = n() * sizeof(float);
    if (saved.size() < sizeof header + saved_texel_bytes())
        throw std::invalid_argument(
            invalid_value_message("the saved state", number_text(saved.size()) + " bytes",
                                  number_text(sizeof header + saved_texel_bytes()) + " and those of its sources"));
    std::memcpy(&header, saved.data(), sizeof header);
    const double max_texels = farthest_position_m / texel_m() + options_.resolution;
    for (const std::int64_t first : {header.first_x, header.first_z})
        if (!(std::fabs(static_cast<double>(first)) <= max_texels))
            throw std::invalid_argument(
                invalid_value_message("the saved state's first texel", first, "one within [-1e9, 1e9] m"));
    if (header.ticks < 0 || header.ticks > max_grid_ticks)
        throw std::invalid_argument(invalid_value_message("the saved state's ticks", header.ticks, "[0, 2^50]"));
    const std::uint8_t* from = saved.data() + sizeof header;
    for (std::size_t i = 0; i < saved_planes * n() * n(); ++i) {
        float texel;
        std::memcpy(&texel, from + i * sizeof texel, sizeof texel);
        if (!(std::fabs(texel) <= 1e6f))  // also true for NaN
            throw std::invalid_argument(invalid_value_message("a saved texel of the water", texel, "[-1e6, 1e6]"));
    }
    sources_ =
        DynamicWaveSources::restored(saved.subspan(sizeof header + saved_texel_bytes()), header.ticks, options_);

    placement_.move_to({header.first_x, header.first_z});
    ticks_ = header.ticks;
    for (AlignedBuffer<float>* plane : {&planes_[height_], &planes_[1 - height_], &tick_before_, &difference_before_})
        for (std::size_t z = 0; z < n(); ++z, from += row_bytes)
            std::memcpy(plane->data() + dynamic_row_margin + z * dynamic_row_stride(n()), from, row_bytes);
    std::memcpy(foam_.data(), from, foam_.size());
    // an upper bound, which the next tick corrects
    std::fill(has_foam_.begin(), has_foam_.end(), std::uint8_t{1});
    lay_border();
}

std::uint64_t DynamicWaveGrid::hash() const {
    const std::vector<std::uint8_t> bytes = saved();
    return XXH3_64bits(bytes.data(), bytes.size() - sources_.saved_bytes());
}

std::size_t DynamicWaveGrid::bytes() const {
    std::size_t bytes = foam_.bytes() + tick_before_.bytes() + difference_before_.bytes() + sources_.bytes() +
                        has_foam_.capacity() + phases_.bytes();
    for (const auto& plane : planes_) bytes += plane.bytes();
    for (std::size_t axis = 0; axis < 2; ++axis) bytes += damping_[axis].bytes() + shown_[axis].bytes();
    for (const FftPlan& plan : plan_) bytes += plan.bytes();
    return bytes;
}

}  // namespace pelagic
