#include "pelagic/sim/sources/local_grid.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <tuple>

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
constexpr std::size_t rows_a_job = 16;
/// Blocks of lines don't start a power of two apart.
constexpr std::size_t block_margin = 112;
/// Foam fades as fast as the sea's own: 9 bytes in a tenth of a second.
constexpr std::int64_t foam_fade_per_s = 90;
constexpr double gauss_reach = 3;  ///< in radii

constexpr std::array fields = {
    NumericField<LocalGridOptions>{"resolution", &LocalGridOptions::resolution, 64, 1024, "64, 128, 256, 512 or 1024",
                                   Among::powers_of_two},
    NumericField<LocalGridOptions>{"side_m", &LocalGridOptions::side_m, 1, 10000, "[1, 10000]"},
    NumericField<LocalGridOptions>{"ticks_per_s", &LocalGridOptions::ticks_per_s, 10, 240, "[10, 240]"},
    NumericField<LocalGridOptions>{"border_m", &LocalGridOptions::border_m, 0, 2500, "[0, side_m / 4]"},
    NumericField<LocalGridOptions>{"depth_m", &LocalGridOptions::depth_m, 0.01, 11000, "[0.01, 11000]"},
    NumericField<LocalGridOptions>{"viscosity_m2ps", &LocalGridOptions::viscosity_m2ps, 0, 1, "[0, 1]"},
    NumericField<LocalGridOptions>{"wave_speed_mps", &LocalGridOptions::wave_speed_mps, 0, 1000, "(0, 1000]",
                                   Among::above_least},
    NumericField<LocalGridOptions>{"decay_per_s", &LocalGridOptions::decay_per_s, 0, 10, "[0, 10]"},
    NumericField<LocalGridOptions>{"foam_height_m", &LocalGridOptions::foam_height_m, 0, 100, "(0, 100]",
                                   Among::above_least},
};

/// Metres that Verlet's waves run in a tick, in texels.
double courant_number(const LocalGridOptions& options) {
    return options.wave_speed_mps / (options.side_m / options.resolution) / options.ticks_per_s;
}

/// The border takes e^-8 of amplitudes on the way through it and its neighbour across the torus, of waves as long as it is wide; of
/// shorter and slower ones more. It rises as the square of the way in, gently enough to send hardly anything back.
double damping_at_edge(const LocalGridOptions& options) {
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
    std::int64_t first_x, first_z, ticks;
};

}  // namespace

std::string check(const LocalGridOptions& options) {
    if (std::string reason = check_fields(options, fields); !reason.empty()) return reason;
    if (options.border_m > options.side_m / 4)
        return refusal("border_m", options.border_m,
                       "at most a quarter of side_m, " + number_text(options.side_m / 4));
    const double courant = courant_number(options);
    if (options.step == LocalStep::verlet && courant * courant > LocalGrid::most_coupling)
        return refusal("wave_speed_mps", options.wave_speed_mps,
                       "c = (wave_speed_mps / (ticks_per_s texel))^2 to be " + number_text(LocalGrid::most_coupling) +
                           " at most, which is " + rounded_text(courant * courant, 3));
    return {};
}

LocalGrid::LocalGrid(const LocalGridOptions& options, Isa isa, const HostMemory& memory)
    : options_(options),
      kernels_(kernels_for(isa)),
      window_(options.resolution, options.side_m / options.resolution) {
    if (const std::string reason = check(options); !reason.empty()) throw std::invalid_argument(reason);
    const DefaultFloatEnvironment environment;
    for (auto& plane : planes_) plane = AlignedBuffer<float>(local_plane_floats(n()), memory);
    foam_ = AlignedBuffer<std::uint8_t>(n() * n(), memory);
    has_foam_.resize(n());
    for (auto& left : left_) left = AlignedBuffer<float>(n(), memory);
    if (options.step == LocalStep::spectral) {
        plan_.emplace_back(options.resolution);
        lines_ = AlignedBuffer<float>(n() / kernels_.lanes * block_stride(), memory);
        phases_ = AlignedBuffer<float>(n() * (n() + 2), memory);
        bake_phases();
    }
    first_ = {window_.first_around(0), window_.first_around(0)};
    lay_border();
    waiting_.reserve(most_disturbances);
    splashes_.reserve(most_disturbances);
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
    const double edge = options_.border_m > 0 ? damping_at_edge(options_) : 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t i = 0; i < n(); ++i) {
            const double from_edge = (static_cast<double>(std::min(i, n() - 1 - i)) + 0.5) * texel_m();
            const double within = from_edge < options_.border_m ? 1 - from_edge / options_.border_m : 0;
            const double left = within > 0 ? det::exp(-edge * within * within * tick_s()) : 1;
            left_[axis][window_.in_torus(first_[axis] + static_cast<std::int64_t>(i))] = static_cast<float>(left);
        }
    }
}

StageId LocalGrid::add_tick_stages(JobGraph& graph, const std::vector<StageId>& waits_for) {
    const std::size_t row_jobs = n() / rows_a_job;
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
                      .count = n() / rows_a_job,
                      .waits_for = {prepared},
                      .body = for_each_item([this](std::size_t job) {
                          const double courant = courant_number(options_);
                          kernels_.verlet_rows({.now = first_texel(height_),
                                                .before = first_texel(1 - height_),
                                                .resolution = n(),
                                                .first_row = job * rows_a_job,
                                                .rows = rows_a_job,
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
    std::fill_n(foam_.data() + window_.in_torus(z) * n(), n(), std::uint8_t{0});
}

void LocalGrid::flatten_column(std::int64_t x) {
    for (std::size_t z = 0; z < n(); ++z) {
        for (auto& plane : planes_) plane[local_margin + z * local_row_stride(n()) + window_.in_torus(x)] = 0;
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

void LocalGrid::begin_tick() {
    const DefaultFloatEnvironment environment;
    for (const Disturbance& disturbance : waiting_) {
        const Splash splash = splash_of(disturbance);
        if (splash.first_x < splash.end_x && splash.first_z < splash.end_z) splashes_.push_back(splash);
    }
    waiting_.clear();
}

void LocalGrid::end_tick() {
    ++ticks_;
    height_ = stepped_plane();
    splashes_.clear();
    profiles_.clear();
}

void LocalGrid::prepare_rows(std::size_t job) {
    const std::size_t first = job * rows_a_job;
    const bool is_verlet = options_.step == LocalStep::verlet;
    if (is_verlet)
        kernels_.damp_rows({.planes = {first_texel(0), first_texel(1)},
                            .resolution = n(),
                            .first_row = first,
                            .rows = rows_a_job,
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
        if (row < first_row || row >= first_row + rows_a_job) continue;
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
        for_texels(splash, job * rows_a_job, [=](std::size_t texel, float shape, float) {
            h[texel] += shape;
            if (other) other[texel] += shape;
        });
    }
    foam_rows(job * rows_a_job);
}

void LocalGrid::foam_rows(std::size_t first_row) {
    const std::int64_t rate = options_.ticks_per_s;
    const float threshold = static_cast<float>(options_.foam_height_m);
    kernels_.local_foam(
        {.heights = first_texel(stepped_plane()),
         .resolution = n(),
         .first_row = first_row,
         .rows = rows_a_job,
         .threshold = threshold,
         .scale = 255 / threshold,
         .fade = static_cast<int>((ticks_ + 1) * foam_fade_per_s / rate - ticks_ * foam_fade_per_s / rate),
         .foam = foam_.data(),
         .has_foam = has_foam_.data()});
}

void LocalGrid::repeat_ends(std::size_t plane, std::size_t first_row) {
    for (std::size_t z = first_row; z < first_row + rows_a_job; ++z) {
        float* const row = first_texel(plane) + z * local_row_stride(n());
        row[-1] = row[n() - 1];
        row[n()] = row[0];
    }
}

std::vector<std::uint8_t> LocalGrid::saved() const {
    const SavedHeader header = {first_[0], first_[1], ticks_};
    const std::size_t row_bytes = n() * sizeof(float);
    std::vector<std::uint8_t> bytes(sizeof header + 2 * n() * row_bytes + foam_.size());
    std::uint8_t* to = bytes.data();
    std::memcpy(to, &header, sizeof header);
    to += sizeof header;
    for (const std::size_t plane : {height_, 1 - height_})
        for (std::size_t z = 0; z < n(); ++z, to += row_bytes)
            std::memcpy(to, planes_[plane].data() + local_margin + z * local_row_stride(n()), row_bytes);
    std::memcpy(to, foam_.data(), foam_.size());
    return bytes;
}

void LocalGrid::restore(std::span<const std::uint8_t> saved) {
    SavedHeader header;
    const std::size_t row_bytes = n() * sizeof(float), needed = sizeof header + 2 * n() * row_bytes + foam_.size();
    if (saved.size() != needed)
        throw std::invalid_argument(refusal("the window", number_text(saved.size()) + " bytes", number_text(needed)));
    std::memcpy(&header, saved.data(), sizeof header);
    const double most_texels = farthest_m / texel_m() + options_.resolution;
    for (const std::int64_t first : {header.first_x, header.first_z})
        if (!(std::fabs(static_cast<double>(first)) <= most_texels))
            throw std::invalid_argument(refusal("the window's first texel", first, "one within [-1e8, 1e8] m"));
    if (header.ticks < 0) throw std::invalid_argument(refusal("the window's ticks", header.ticks, "0 or more"));
    const std::uint8_t* from = saved.data() + sizeof header;
    for (std::size_t i = 0; i < 2 * n() * n(); ++i) {
        float texel;
        std::memcpy(&texel, from + i * sizeof texel, sizeof texel);
        if (!std::isfinite(texel)) throw std::invalid_argument(refusal("a texel of the window", texel, "a number"));
    }
    first_ = {header.first_x, header.first_z};
    ticks_ = header.ticks;
    for (const std::size_t plane : {height_, 1 - height_})
        for (std::size_t z = 0; z < n(); ++z, from += row_bytes)
            std::memcpy(first_texel(plane) + z * local_row_stride(n()), from, row_bytes);
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
    std::size_t bytes = foam_.bytes() + has_foam_.capacity() + phases_.bytes() + lines_.bytes() +
                        profiles_.capacity() * sizeof(float) + waiting_.capacity() * sizeof(Disturbance) +
                        splashes_.capacity() * sizeof(Splash);
    for (const auto& plane : planes_) bytes += plane.bytes();
    for (const auto& left : left_) bytes += left.bytes();
    for (const FftPlan& plan : plan_) bytes += plan.bytes();
    return bytes;
}

}  // namespace pelagic
