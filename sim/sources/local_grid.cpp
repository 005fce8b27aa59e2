#include "pelagic/sim/sources/local_grid.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/refusal.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/surface/item_stage.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double farthest_m = 1e8;
constexpr std::int64_t most_ticks = std::int64_t{1} << 50;
/// Blocks of lines don't start a power of two apart.
constexpr std::size_t block_margin = 112;
/// Foam fades as fast as the sea's own: 9 bytes in a tenth of a second.
constexpr std::int64_t foam_fade_per_s = 90;
constexpr double gauss_reach = 3;  ///< in radii

/// The border takes e^-8 of amplitudes on the way through it and its neighbour across the torus, of waves as long as it is wide; of
/// shorter and slower ones more. It rises as the square of the way in, gently enough to send hardly anything back.
double damping_at_edge(const LocalWaterOptions& options) {
    const double speed = options.step == LocalStep::verlet
                             ? options.wave_speed_mps
                             : group_velocity(two_pi / options.border_m, options.depth_m);
    return 12 * speed / options.border_m;
}

/// Texels within `reach` of `middle`, of those from `first` on that a window has.
std::pair<std::int64_t, std::int64_t> reached(double middle_m, double reach_m, const LocalWindow& window,
                                              std::int64_t first) {
    const auto low = static_cast<std::int64_t>(std::ceil((middle_m - reach_m) / window.texel_m()));
    const auto high = static_cast<std::int64_t>(std::floor((middle_m + reach_m) / window.texel_m())) + 1;
    const std::int64_t end = first + window.resolution();
    return {std::clamp(low, first, end), std::clamp(high, first, end)};
}

struct SavedHeader {
    std::int64_t first_x, first_z, ticks, next_source, sources;
};

/// A source as it is saved: numbers without gaps between them.
struct SavedSource {
    std::int64_t number, since, shape, mode;
    double x, z, radius, length, heading, height, rate, velocity_x, velocity_z;
};

}  // namespace

double LocalGrid::courant_number(const LocalWaterOptions& options) {
    return options.wave_speed_mps / (options.side_m / options.resolution) / options.ticks_per_s;
}

LocalGrid::LocalGrid(const LocalWaterOptions& options, Isa isa, const HostMemory& memory)
    : options_(options),
      kernels_(kernels_for(isa)),
      window_(options.resolution, options.side_m / options.resolution) {
    if (const std::string reason = check(options); !reason.empty()) throw std::invalid_argument(reason);
    const DefaultFloatEnvironment environment;
    for (auto& plane : planes_) plane = AlignedBuffer<float>(local_plane_floats(n()), memory);
    tick_before_ = AlignedBuffer<float>(local_plane_floats(n()), memory);
    foam_ = AlignedBuffer<std::uint8_t>(n() * n(), memory);
    has_foam_.resize(n());
    for (std::size_t axis = 0; axis < 2; ++axis) {
        left_[axis] = AlignedBuffer<float>(n(), memory);
        shown_[axis] = AlignedBuffer<float>(n(), memory);
    }
    if (options.step == LocalStep::spectral) {
        plan_.emplace_back(options.resolution);
        lines_ = AlignedBuffer<float>(n() / kernels_.lanes * block_stride(), memory);
        phases_ = AlignedBuffer<float>(n() * (n() + 2), memory);
        bake_phases();
    }
    first_ = {window_.first_around(0), window_.first_around(0)};
    lay_border();
}

std::size_t LocalGrid::block_stride() const { return 2 * kernels_.lanes * n() + block_margin; }

void LocalGrid::bake_phases() {
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
                const double left = det::exp(-decay * tick_s()) * over_all;
                to[lane] = static_cast<float>(phase.cosine * left);
                to[lanes + lane] = static_cast<float>(phase.sine * left);
            }
        }
    }
}

void LocalGrid::lay_border() {
    const bool has_border = options_.border_m > 0;
    const double edge = has_border ? damping_at_edge(options_) : 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t i = 0; i < n(); ++i) {
            const double texels_in = static_cast<double>(std::min(i, n() - 1 - i));
            const double from_edge = (texels_in + 0.5) * texel_m();
            const double within = from_edge < options_.border_m ? 1 - from_edge / options_.border_m : 0;
            const std::size_t at = window_.in_torus(first_[axis] + static_cast<std::int64_t>(i));
            left_[axis][at] = static_cast<float>(within > 0 ? det::exp(-edge * within * within * tick_s()) : 1);
            // The two outermost texels are flat, so that slopes are, too, where the window ends.
            const double shown = (texels_in - 1) * texel_m() / (0.5 * options_.border_m);
            shown_[axis][at] = static_cast<float>(has_border ? std::clamp(shown, 0.0, 1.0) : 1);
        }
    }
}

StageId LocalGrid::add_tick_stages(JobGraph& graph, const std::vector<StageId>& waits_for) {
    const std::size_t row_jobs = n() / rows_an_item;
    const StageId prepared = graph.add({.name = "local splashes",
                                        .count = row_jobs,
                                        .waits_for = waits_for,
                                        .body = for_each_item([this](std::size_t job) { prepare_rows(job); })});
    const StageId stepped =
        options_.step == LocalStep::verlet ? add_verlet_stage(graph, prepared) : add_spectral_stages(graph, prepared);
    return graph.add({.name = "local foam",
                      .count = row_jobs,
                      .waits_for = {stepped},
                      .body = for_each_item([this](std::size_t job) { finish_rows(job); })});
}

StageId LocalGrid::add_verlet_stage(JobGraph& graph, StageId prepared) {
    return graph.add({.name = "local verlet",
                      .count = n() / rows_an_item,
                      .waits_for = {prepared},
                      .body = for_each_item([this](std::size_t job) {
                          const double courant = courant_number(options_);
                          kernels_.verlet_rows({.now = first_texel(height_),
                                                .before = first_texel(1 - height_),
                                                .resolution = n(),
                                                .first_row = job * rows_an_item,
                                                .rows = rows_an_item,
                                                .coupling = static_cast<float>(courant * courant),
                                                .left = static_cast<float>(1 - options_.decay_per_s * tick_s())});
                      })});
}

StageId LocalGrid::add_spectral_stages(JobGraph& graph, StageId prepared) {
    const std::size_t blocks = n() / kernels_.lanes, stack_bytes = 8 * n() * kernels_.lanes;
    const auto columns = [this](std::size_t job, FftTables& tables) -> LocalColumnsJob {
        tables = plan_.front().tables();
        return {
            first_texel(height_), first_texel(1 - height_), border(), job * kernels_.lanes, &tables, lines_.data(),
            block_stride()};
    };
    const StageId transformed = graph.add({.name = "local columns",
                                           .count = blocks,
                                           .waits_for = {prepared},
                                           .body = for_each_item([this, columns](std::size_t job) {
                                               FftTables tables;
                                               kernels_.local_columns(columns(job, tables));
                                           }),
                                           .stack_bytes = stack_bytes + stack_margin});
    const StageId moved =
        graph.add({.name = "local lines",
                   .count = blocks,
                   .waits_for = {transformed},
                   .body = for_each_item([this](std::size_t job) {
                       const FftTables tables = plan_.front().tables();
                       kernels_.local_lines({.lines = lines_.data() + job * block_stride(),
                                             .phases = phases_.data() + job * (n() + 2) * kernels_.lanes,
                                             .fft = &tables});
                   }),
                   .stack_bytes = 2 * stack_bytes + stack_margin});
    return graph.add({.name = "local columns back",
                      .count = blocks,
                      .waits_for = {moved},
                      .body = for_each_item([this, columns](std::size_t job) {
                          FftTables tables;
                          kernels_.local_columns_back(columns(job, tables));
                      }),
                      .stack_bytes = 2 * stack_bytes + stack_margin});
}

void LocalGrid::flatten_row(std::int64_t z) {
    for (std::size_t plane = 0; plane < 2; ++plane)
        std::fill_n(first_texel(plane) + window_.in_torus(z) * local_row_stride(n()), n(), 0.f);
    std::fill_n(tick_before_.data() + local_margin + window_.in_torus(z) * local_row_stride(n()), n(), 0.f);
    std::fill_n(foam_.data() + window_.in_torus(z) * n(), n(), std::uint8_t{0});
}

void LocalGrid::flatten_column(std::int64_t x) {
    for (std::size_t z = 0; z < n(); ++z) {
        const std::size_t at = local_margin + z * local_row_stride(n()) + window_.in_torus(x);
        planes_[0][at] = planes_[1][at] = tick_before_[at] = 0;
        foam_[z * n() + window_.in_torus(x)] = 0;
    }
}

void LocalGrid::follow(double x_m, double z_m) {
    const DefaultFloatEnvironment environment;
    for (const double at : {x_m, z_m})
        if (!(at >= -farthest_m && at <= farthest_m))
            throw std::invalid_argument(refusal("the window's middle", at, "[-1e8, 1e8]"));
    const std::array<std::int64_t, 2> moved = {window_.first_around(x_m), window_.first_around(z_m)};
    if (moved == first_) return;
    const std::int64_t side = options_.resolution;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::int64_t from = first_[axis], to = moved[axis];
        const auto flatten = axis == 0 ? &LocalGrid::flatten_column : &LocalGrid::flatten_row;
        const std::int64_t entered = to > from ? std::max(to, from + side) : to;
        const std::int64_t end = to > from ? to + side : std::min(from, to + side);
        for (std::int64_t texel = entered; texel < end; ++texel) (this->*flatten)(texel);
    }
    first_ = moved;
    lay_border();
}

LocalGrid::Splash LocalGrid::splash_of(const Disturbance& of) {
    const bool is_hull = of.shape == Disturbance::Shape::hull;
    const double reach = is_hull ? std::max(of.length_m, of.radius_m) : gauss_reach * of.radius_m;
    Splash splash{.of = of,
                  .part = static_cast<float>(1 - det::exp(-of.rate_per_s * tick_s())),
                  .first_x = 0,
                  .end_x = 0,
                  .first_z = 0,
                  .end_z = 0,
                  .profile = profiles_.size(),
                  .cosine = 1,
                  .sine = 0};
    std::tie(splash.first_x, splash.end_x) = reached(of.x_m, reach, window_, first_[0]);
    std::tie(splash.first_z, splash.end_z) = reached(of.z_m, reach, window_, first_[1]);
    if (is_hull) {
        const auto heading = det::sine_cosine_of_turns(of.heading_rad / two_pi);
        splash.cosine = heading.cosine;
        splash.sine = heading.sine;
        return splash;
    }
    const auto profile = [&](double middle_m, std::int64_t first, std::int64_t end) {
        for (std::int64_t texel = first; texel < end; ++texel) {
            const double away = (static_cast<double>(texel) * texel_m() - middle_m) / of.radius_m;
            profiles_.push_back(static_cast<float>(det::exp(-away * away)));
        }
    };
    profile(of.x_m, splash.first_x, splash.end_x);
    profile(of.z_m, splash.first_z, splash.end_z);
    return splash;
}

void LocalGrid::disturb(const Disturbance& disturbance) {
    if (const std::string reason = check(disturbance); !reason.empty()) throw std::invalid_argument(reason);
    if (waiting_.size() == most_disturbances)
        throw std::invalid_argument(refusal("the number of disturbances of a tick", most_disturbances + 1,
                                            "at most " + number_text(most_disturbances)));
    waiting_.push_back(disturbance);
}

void LocalGrid::set_source(std::uint32_t number, const Disturbance& source) {
    if (const std::string reason = check(source); !reason.empty()) throw std::invalid_argument(reason);
    const auto at = std::lower_bound(sources_.begin(), sources_.end(), number,
                                     [](const Source& known, std::uint32_t wanted) { return known.number < wanted; });
    if (at != sources_.end() && at->number == number) {
        *at = {number, source, ticks_};
        return;
    }
    if (sources_.size() == most_disturbances)
        throw std::invalid_argument(
            refusal("the number of sources", most_disturbances + 1, "at most " + number_text(most_disturbances)));
    sources_.insert(at, {number, source, ticks_});
}

void LocalGrid::remove_source(std::uint32_t number) {
    std::erase_if(sources_, [number](const Source& source) { return source.number == number; });
}

void LocalGrid::begin_tick() {
    const DefaultFloatEnvironment environment;
    for (const Source& source : sources_) {
        Disturbance moved = source.disturbance;
        const double since_s = static_cast<double>(ticks_ - source.since) * tick_s();
        moved.x_m += since_s * moved.velocity_x_mps;
        moved.z_m += since_s * moved.velocity_z_mps;
        if (check(moved).empty()) add_splash(moved);  // else it has left the world
    }
    for (const Disturbance& disturbance : waiting_) add_splash(disturbance);
    waiting_.clear();
}

void LocalGrid::add_splash(const Disturbance& disturbance) {
    const Splash splash = splash_of(disturbance);
    if (splash.first_x < splash.end_x && splash.first_z < splash.end_z) splashes_.push_back(splash);
}

void LocalGrid::end_tick() {
    ++ticks_;
    height_ = stepped_plane();
    splashes_.clear();
    profiles_.clear();
}

void LocalGrid::prepare_rows(std::size_t job) {
    const std::size_t first = job * rows_an_item, floats = rows_an_item * local_row_stride(n());
    std::copy_n(first_texel(height_) + first * local_row_stride(n()), floats,
                tick_before_.data() + local_margin + first * local_row_stride(n()));
    const bool is_verlet = options_.step == LocalStep::verlet;
    if (is_verlet)
        kernels_.damp_rows({.planes = {first_texel(0), first_texel(1)},
                            .resolution = n(),
                            .first_row = first,
                            .rows = rows_an_item,
                            .border = border()});
    for (const Splash& splash : splashes_) splash_rows(splash, first);
    if (is_verlet) repeat_ends(height_, first);
}

/// Calls at_texel(floats from the first texel, shape, shape over its height) for what a splash reaches in the rows of a job.
template <class AtTexel>
void LocalGrid::for_texels(const Splash& splash, std::size_t first_row, AtTexel at_texel) const {
    const Disturbance& of = splash.of;
    const float height = static_cast<float>(of.height_m);
    for (std::int64_t z = splash.first_z; z < splash.end_z; ++z) {
        const std::size_t row = window_.in_torus(z);
        if (row < first_row || row >= first_row + rows_an_item) continue;
        const std::size_t begin = row * local_row_stride(n());
        if (of.shape == Disturbance::Shape::gauss) {
            const float* const along_x = profiles_.data() + splash.profile;
            const float along_z = along_x[splash.end_x - splash.first_x + z - splash.first_z];
            for (std::int64_t x = splash.first_x; x < splash.end_x; ++x) {
                const float gauss = along_x[x - splash.first_x] * along_z;
                at_texel(begin + window_.in_torus(x), height * gauss, gauss);
            }
            continue;
        }
        const double away_z = static_cast<double>(z) * texel_m() - of.z_m;
        for (std::int64_t x = splash.first_x; x < splash.end_x; ++x) {
            const double away_x = static_cast<double>(x) * texel_m() - of.x_m;
            const double along = (away_x * splash.cosine + away_z * splash.sine) / of.length_m;
            const double across = (away_z * splash.cosine - away_x * splash.sine) / of.radius_m;
            const double inside = 1 - along * along - across * across;
            if (inside <= 0) continue;
            const float part = static_cast<float>(std::sqrt(inside));
            at_texel(begin + window_.in_torus(x), height * part, part);
        }
    }
}

void LocalGrid::splash_rows(const Splash& splash, std::size_t first_row) {
    float* const h = first_texel(height_);
    switch (splash.of.mode) {
        case Disturbance::Mode::press: {
            // A step moves what the water lacks of its shape at rest; Verlet's knows it at two moments.
            float* const before = options_.step == LocalStep::verlet ? first_texel(1 - height_) : nullptr;
            return for_texels(splash, first_row, [=](std::size_t texel, float shape, float) {
                h[texel] -= shape;
                if (before) before[texel] -= shape;
            });
        }
        case Disturbance::Mode::pull:
            return for_texels(splash, first_row,
                              [=, part = splash.part](std::size_t texel, float shape, float weight) {
                                  h[texel] += part * weight * (shape - h[texel]);
                              });
        case Disturbance::Mode::add:
            return for_texels(splash, first_row, [=](std::size_t texel, float shape, float) { h[texel] += shape; });
    }
}

/// Puts back what splash_rows() took for a press, and looks for foam.
void LocalGrid::finish_rows(std::size_t job) {
    float* const h = first_texel(stepped_plane());
    float* const other = options_.step == LocalStep::verlet ? first_texel(1 - stepped_plane()) : nullptr;
    for (const Splash& splash : splashes_) {
        if (splash.of.mode != Disturbance::Mode::press) continue;
        for_texels(splash, job * rows_an_item, [=](std::size_t texel, float shape, float) {
            h[texel] += shape;
            if (other) other[texel] += shape;
        });
    }
    foam_rows(job * rows_an_item);
}

void LocalGrid::foam_rows(std::size_t first_row) {
    const std::int64_t rate = options_.ticks_per_s;
    const float threshold = static_cast<float>(options_.foam_height_m);
    kernels_.local_foam(
        {.heights = first_texel(stepped_plane()),
         .resolution = n(),
         .first_row = first_row,
         .rows = rows_an_item,
         .threshold = threshold,
         .scale = 255 / threshold,
         .fade = static_cast<int>((ticks_ + 1) * foam_fade_per_s / rate - ticks_ * foam_fade_per_s / rate),
         .foam = foam_.data(),
         .has_foam = has_foam_.data()});
}

void LocalGrid::repeat_ends(std::size_t plane, std::size_t first_row) {
    for (std::size_t z = first_row; z < first_row + rows_an_item; ++z) {
        float* const row = first_texel(plane) + z * local_row_stride(n());
        row[-1] = row[n() - 1];
        row[n()] = row[0];
    }
}

void LocalGrid::show(float part, std::size_t item, const Shown& to) const {
    const std::size_t first = item * rows_an_item;
    kernels_.local_show({.before = tick_before_.data() + local_margin,
                         .now = first_texel(height_),
                         .resolution = n(),
                         .first_row = first,
                         .rows = rows_an_item,
                         .part = part,
                         .ticks_per_s = static_cast<float>(options_.ticks_per_s),
                         .shown_x = shown_[0].data(),
                         .shown_z = shown_[1].data(),
                         .height = to.height_m,
                         .rise = to.rise_mps,
                         .lowest = to.lowest_m,
                         .highest = to.highest_m});
    std::copy_n(foam_.data() + first * n(), rows_an_item * n(), to.foam + first * n());
}

std::vector<std::uint8_t> LocalGrid::saved() const {
    const SavedHeader header = {first_[0], first_[1], ticks_, next_source_,
                                static_cast<std::int64_t>(sources_.size())};
    const std::size_t row_bytes = n() * sizeof(float);
    std::vector<std::uint8_t> bytes(sizeof header + 3 * n() * row_bytes + foam_.size() +
                                    sources_.size() * sizeof(SavedSource));
    std::uint8_t* to = bytes.data();
    const auto put = [&to](const void* from, std::size_t count) {
        std::memcpy(to, from, count);
        to += count;
    };
    put(&header, sizeof header);
    for (const AlignedBuffer<float>* plane : {&planes_[height_], &planes_[1 - height_], &tick_before_})
        for (std::size_t z = 0; z < n(); ++z)
            put(plane->data() + local_margin + z * local_row_stride(n()), row_bytes);
    put(foam_.data(), foam_.size());
    for (const Source& source : sources_) {
        const Disturbance& of = source.disturbance;
        const SavedSource saved = {source.number,
                                   source.since,
                                   static_cast<std::int64_t>(of.shape),
                                   static_cast<std::int64_t>(of.mode),
                                   of.x_m,
                                   of.z_m,
                                   of.radius_m,
                                   of.length_m,
                                   of.heading_rad,
                                   of.height_m,
                                   of.rate_per_s,
                                   of.velocity_x_mps,
                                   of.velocity_z_mps};
        put(&saved, sizeof saved);
    }
    return bytes;
}

std::vector<LocalGrid::Source> LocalGrid::restored_sources(const std::uint8_t* from, std::size_t count,
                                                           std::int64_t next_source, std::int64_t ticks) {
    std::vector<Source> sources;
    for (std::size_t i = 0; i < count; ++i, from += sizeof(SavedSource)) {
        SavedSource saved;
        std::memcpy(&saved, from, sizeof saved);
        const std::int64_t least = sources.empty() ? 1 : std::int64_t{sources.back().number} + 1;
        if (saved.number < least || saved.number >= next_source)
            throw std::invalid_argument(refusal("a saved source's number", saved.number, "more than the one before"));
        if (saved.since < 0 || saved.since > ticks)
            throw std::invalid_argument(refusal("a saved source's tick", saved.since, "one of the water's"));
        if (saved.shape < 0 || saved.shape > static_cast<std::int64_t>(Disturbance::Shape::hull))
            throw std::invalid_argument(refusal("a saved source's shape", saved.shape, "0 or 1"));
        if (saved.mode < 0 || saved.mode > static_cast<std::int64_t>(Disturbance::Mode::add))
            throw std::invalid_argument(refusal("a saved source's mode", saved.mode, "0, 1 or 2"));
        const Disturbance source = {.shape = static_cast<Disturbance::Shape>(saved.shape),
                                    .mode = static_cast<Disturbance::Mode>(saved.mode),
                                    .x_m = saved.x,
                                    .z_m = saved.z,
                                    .radius_m = saved.radius,
                                    .length_m = saved.length,
                                    .heading_rad = saved.heading,
                                    .height_m = saved.height,
                                    .rate_per_s = saved.rate,
                                    .velocity_x_mps = saved.velocity_x,
                                    .velocity_z_mps = saved.velocity_z};
        if (const std::string reason = check(source); !reason.empty()) throw std::invalid_argument(reason);
        sources.push_back({static_cast<std::uint32_t>(saved.number), source, saved.since});
    }
    return sources;
}

void LocalGrid::restore(std::span<const std::uint8_t> saved) {
    SavedHeader header{};
    const std::size_t row_bytes = n() * sizeof(float), texel_bytes = 3 * n() * row_bytes + foam_.size();
    if (saved.size() >= sizeof header) std::memcpy(&header, saved.data(), sizeof header);
    const bool can_be = header.sources >= 0 && header.sources <= static_cast<std::int64_t>(most_disturbances);
    const std::size_t sources = can_be ? static_cast<std::size_t>(header.sources) : 0;
    if (!can_be || saved.size() != sizeof header + texel_bytes + sources * sizeof(SavedSource))
        throw std::invalid_argument(refusal("the saved water", number_text(saved.size()) + " bytes",
                                            number_text(sizeof header + texel_bytes) + " and those of its sources"));
    const double most_texels = farthest_m / texel_m() + options_.resolution;
    for (const std::int64_t first : {header.first_x, header.first_z})
        if (!(std::fabs(static_cast<double>(first)) <= most_texels))
            throw std::invalid_argument(refusal("the saved water's first texel", first, "one within [-1e8, 1e8] m"));
    if (header.ticks < 0 || header.ticks > most_ticks)
        throw std::invalid_argument(refusal("the saved water's ticks", header.ticks, "[0, 2^50]"));
    if (header.next_source < 1 || header.next_source > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(refusal("the saved water's next source", header.next_source, "[1, 2^32)"));
    const std::uint8_t* from = saved.data() + sizeof header;
    for (std::size_t i = 0; i < 3 * n() * n(); ++i) {
        float texel;
        std::memcpy(&texel, from + i * sizeof texel, sizeof texel);
        if (!(std::fabs(texel) <= 1e6f))  // of what is no number, too
            throw std::invalid_argument(refusal("a saved texel of the water", texel, "[-1e6, 1e6]"));
    }
    std::vector<Source> lasting = restored_sources(from + texel_bytes, sources, header.next_source, header.ticks);

    first_ = {header.first_x, header.first_z};
    ticks_ = header.ticks;
    next_source_ = static_cast<std::uint32_t>(header.next_source);
    sources_ = std::move(lasting);
    for (AlignedBuffer<float>* plane : {&planes_[height_], &planes_[1 - height_], &tick_before_})
        for (std::size_t z = 0; z < n(); ++z, from += row_bytes)
            std::memcpy(plane->data() + local_margin + z * local_row_stride(n()), from, row_bytes);
    std::memcpy(foam_.data(), from, foam_.size());
    std::fill(has_foam_.begin(), has_foam_.end(), std::uint8_t{1});  // or so: the next tick looks
    waiting_.clear();
    lay_border();
}

std::uint64_t LocalGrid::hash() const {
    const std::vector<std::uint8_t> bytes = saved();
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::size_t LocalGrid::bytes() const {
    std::size_t bytes = foam_.bytes() + tick_before_.bytes() + sources_.capacity() * sizeof(Source) +
                        has_foam_.capacity() + phases_.bytes() + lines_.bytes() +
                        profiles_.capacity() * sizeof(float) + waiting_.capacity() * sizeof(Disturbance) +
                        splashes_.capacity() * sizeof(Splash);
    for (const auto& plane : planes_) bytes += plane.bytes();
    for (std::size_t axis = 0; axis < 2; ++axis) bytes += left_[axis].bytes() + shown_[axis].bytes();
    for (const FftPlan& plan : plan_) bytes += plan.bytes();
    return bytes;
}

}  // namespace pelagic
