#include "pelagic/sim/shore/shore_source.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::size_t group_texels = ShoreRowsJob::group_texels;
constexpr std::size_t groups_per_item = 64;

// Upper bound of the directions for which the shelter of short waves is computed. They are those of
// long waves with adjacent frequencies, which travel in different directions.
constexpr std::size_t max_shelter_waves = 8;

// Intervals of a cascade's table of attenuation by depth, uniform in the square root of the depth.
constexpr int depth_intervals = 256;

// Run-up distance on any ground, for interpolation at the waterline. Beyond it, waves run up only
// where the ground is at most max_ground_over_swash times the swash height.
constexpr int steep_swash_texels = 2;
constexpr double max_ground_over_swash = 1.5;

/// Deviations of a crest that 5 % of all crests exceed: sqrt(2 ln 20), by Rayleigh. They reach the
/// swash height, and so do the highest 2 % of a sea of few waves.
constexpr double crest_of_5_percent = 2.448;

// Lower amplitudes are set to 0, so that no sum has denormal numbers, which are slow.
constexpr double min_shore_amplitude_m = 1e-9;

constexpr double min_envelope_m = 1e-6;

/// Upper bound of the second-order crest divided by the first-order one. Above it, troughs would
/// have a secondary crest.
constexpr double max_sharp = 0.25;

// Crest heights of a cascade, in standard deviations. The probability of a higher one at a position
// and time is 1 in 10 million for the first. It is 1 in 30,000 for the second, which is used for
// cascades under a crest of the long waves.
constexpr double highest_crest = 5.2, high_crest = 4;

/// Overshoot of Keys' interpolation at each end of the texels' range, as a fraction of the range.
/// In one dimension the positive weights sum to at most 9/8, and the negative ones to at least
/// -1/8.
constexpr double max_overshoot = 0.28125;

double eased(double fraction) {
    const double u = std::clamp(fraction, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

/// Returns the factor, at most 1, that limits `value` to a maximum.
double attenuation_to(double max, double value) { return value > max ? max / value : 1; }

/// Calls visit(texel) for the neighbours of a texel along both axes.
template <class Visit>
void for_neighbours(const SeaBed& bed, int i, int j, Visit visit) {
    const std::size_t here = bed.at(i, j), columns = static_cast<std::size_t>(bed.columns);
    if (i > 0) visit(here - 1);
    if (i + 1 < bed.columns) visit(here + 1);
    if (j > 0) visit(here - columns);
    if (j + 1 < bed.rows) visit(here + columns);
}

/// Returns the height above still water of the run-up that 2 % of the waves exceed, with the set-up
/// (H. F. Stockdon et al. 2006, "Empirical parameterization of setup, swash, and runup", equations
/// 18 and 19). \param slope  of the beach at the waterline
double run_up_of_2_percent(double wave_height_m, double wavelength_m, double slope) {
    const double scale = std::sqrt(wave_height_m * wavelength_m);
    if (!(scale > 0)) return 0;
    if (slope * wavelength_m < 0.3 * scale) return 0.043 * scale;
    return 1.1 * scale * (0.35 * slope + 0.5 * std::sqrt(0.563 * slope * slope + 0.004));
}

/// Returns the median slope of the ground between water and land, 0 if the bed has no land.
double waterline_slope(const SeaBed& bed) {
    std::vector<double> slopes;
    for (int j = 1; j + 1 < bed.rows; ++j)
        for (int i = 1; i + 1 < bed.columns; ++i) {
            if (bed.is_water(bed.at(i, j))) continue;
            bool is_edge = false;
            for_neighbours(bed, i, j, [&](std::size_t texel) { is_edge |= bed.is_water(texel); });
            if (!is_edge) continue;
            const double x = bed.depth_m[bed.at(i + 1, j)] - bed.depth_m[bed.at(i - 1, j)];
            const double z = bed.depth_m[bed.at(i, j + 1)] - bed.depth_m[bed.at(i, j - 1)];
            slopes.push_back(std::sqrt(x * x + z * z) / (2 * bed.texel_m));
        }
    if (slopes.empty()) return 0;
    const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::nth_element(slopes.begin(), middle, slopes.end());
    return *middle;
}

/// Calls visit(texel, neighbours) for the texels of sand that waves may reach, from the water on: a
/// texel comes after those of its neighbours that are in `neighbours`.
/// \param swash_texels  largest distance from the water, in texels
template <class Visit>
void for_sand(const SeaBed& bed, double swash_m, int swash_texels, Visit visit) {
    std::vector<std::uint8_t> is_known(bed.texels());
    std::vector<std::size_t> edge, next, from;
    for (std::size_t texel = 0; texel < bed.texels(); ++texel)
        if ((is_known[texel] = bed.is_water(texel))) edge.push_back(texel);
    const auto columns = static_cast<std::size_t>(bed.columns);
    const auto for_those_around = [&](std::size_t texel, auto visit_neighbour) {
        for_neighbours(bed, static_cast<int>(texel % columns), static_cast<int>(texel / columns), visit_neighbour);
    };
    for (int texel_away = 1; texel_away <= swash_texels && !edge.empty(); ++texel_away) {
        next.clear();
        for (const std::size_t texel : edge)
            for_those_around(texel, [&](std::size_t here) {
                if (is_known[here]) return;
                if (texel_away > steep_swash_texels && 0 - bed.depth_m[here] > max_ground_over_swash * swash_m) return;
                next.push_back(here);
            });
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        for (const std::size_t here : next) {
            from.clear();
            for_those_around(here, [&](std::size_t texel) {
                if (is_known[texel]) from.push_back(texel);
            });
            visit(here, from);
        }
        for (const std::size_t here : next) is_known[here] = 1;
        std::swap(edge, next);
    }
}

/// Extrapolates phase and height from water to sand. With each texel, the phase lag grows.
void run_up(const SeaBed& bed, std::vector<double>& phase, std::vector<double>& height, double k, double swash_m,
            int swash_texels) {
    for_sand(bed, swash_m, swash_texels, [&](std::size_t here, const std::vector<std::size_t>& from) {
        if (phase[here] < Refraction::nowhere) return;
        double nearest = 0 - Refraction::nowhere, highest = 0;
        for (const std::size_t texel : from) {
            if (!(phase[texel] < Refraction::nowhere)) continue;
            nearest = std::max(nearest, phase[texel]);
            highest = std::max(highest, height[texel]);
        }
        if (highest > 0) phase[here] = nearest + k * bed.texel_m, height[here] = highest;
    });
}

}  // namespace

ShoreSource::ShoreSource(const ShoreOptions& options, const SeaState& sea, const std::vector<CascadePlan>& plans,
                         const Kernels& kernels, Executor& executor, const Allocator& memory, bool at_ticks)
    : bed_(options),
      sea_(sea),
      fade_m_(options.fade_m > 0 ? options.fade_m : 0.125 * std::min(bed_.columns, bed_.rows) * bed_.texel_m),
      kernels_(kernels),
      waves_(shore_waves(sea, plans.front())),
      amplitudes_(bed_.texels() * 2 * waves_.size(), memory),
      has_waves_(bed_.texels() / group_texels),
      highest_envelope_(bed_.texels(), memory),
      breaking_envelope_(bed_.texels(), memory),
      sharpness_(bed_.texels(), memory),
      depth_(bed_.texels(), memory),
      level_(bed_.texels(), memory),
      weights_(bed_.texels(), memory),
      bake_(std::make_unique<Bake>()),
      at_ticks_(at_ticks) {
    for (auto& moments : moments_.values) moments.resize(waves_.size());
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel)
        depth_.data()[texel] = static_cast<float>(bed_.depth_m[texel]);
    const std::size_t shelters = std::min(max_shelter_waves, waves_.size());
    const auto first = waves_.begin() + static_cast<std::ptrdiff_t>((waves_.size() - shelters) / 2);
    bake_->shelter_waves.assign(first, first + static_cast<std::ptrdiff_t>(shelters));
    bake_->shelters.resize(shelters);
    bake_->deepest_m = std::max(1.0, *std::max_element(bed_.depth_m.begin(), bed_.depth_m.end()));
    bake_->variances.push_back(DepthAttenuation(sea, plans.front()).variance());
    bake_->weights.assign(plans.size(), std::vector<float>(bed_.texels()));
    bake_->deviation_m.resize(bed_.texels());
    bake_->attenuation.resize(bed_.texels());
    bake_->fade.resize(bed_.texels());
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel)
        bake_->fade[texel] = det::sine_cosine_of_turns(0.25 * inside(texel)).sine;
    std::vector<double> depths_m;
    for (int i = 0; i <= depth_intervals; ++i) {
        const double root = static_cast<double>(i) / depth_intervals;
        depths_m.push_back(bake_->deepest_m * root * root);
    }
    for (std::size_t cascade = 1; cascade < plans.size(); ++cascade) {
        const DepthAttenuation attenuation(sea, plans[cascade]);
        bake_->variances.push_back(attenuation.variance());
        bake_->depth_attenuations.push_back(attenuation.at(depths_m));
    }
    double variance = 0;
    for (const double of_cascade : bake_->variances) variance += of_cascade;
    const double slope = waterline_slope(bed_), peak_m = WaveReach::of(sea).peak_m;
    swash_m_ = std::max(options.swash_m, 0.0);
    if (options.swash_m < 0 && peak_m > 0)
        swash_m_ = run_up_of_2_percent(4 * std::sqrt(variance),
                                       peak_m / det::tanh(two_pi / peak_m * sea.depth_m), slope);
    // Twice the length of the run-up, and no plain of any width.
    swash_texels_ = steep_swash_texels;
    if (slope > 0)
        swash_texels_ += static_cast<int>(std::min(2 * swash_m_ / (slope * bed_.texel_m), 1.0 * bed_.columns));
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel)
        highest_envelope_.data()[texel] = static_cast<float>(std::max(highest_on_sand_m(texel), min_envelope_m));
    const std::size_t items = (has_waves_.size() + groups_per_item - 1) / groups_per_item;
    for (Slot& slot : slots_) {
        slot.allocate(bed_.texels(), items, memory);
        slot.potential = AlignedBuffer<float>(bed_.texels(), memory);
        slot.reach = AlignedBuffer<float>(bed_.texels(), memory);
    }
    JobGraph graph;
    add_bake_stages(graph);
    executor.prepare(graph)->run();
    end_bake();
}

double ShoreSource::inside(std::size_t texel) const {
    const auto columns = static_cast<std::size_t>(bed_.columns);
    const int i = static_cast<int>(texel % columns), j = static_cast<int>(texel / columns);
    const int to_edge = std::min(std::min(i, bed_.columns - 1 - i), std::min(j, bed_.rows - 1 - j));
    return eased(to_edge * bed_.texel_m / fade_m_);
}

void ShoreSource::add_bake_stages(JobGraph& graph) {
    const std::size_t waves = waves_.size();
    const StageId waves_done = graph.add({.name = "shore refraction",
                                          .count = waves + bake_->shelter_waves.size(),
                                          .body = for_each_item([this, waves](std::size_t item) {
                                              item < waves ? bake_wave(item) : bake_shelter(item - waves);
                                          }),
                                          .stack_bytes = stack_margin});
    const auto rows = static_cast<std::size_t>(bed_.rows);
    const StageId weights_done = graph.add({.name = "shore weights",
                                            .count = rows,
                                            .batch = 16,
                                            .waits_for = {waves_done},
                                            .body = for_each_item([this](std::size_t row) { bake_weights(row); }),
                                            .stack_bytes = stack_margin});
    const StageId breaking_done = graph.add({.name = "shore breaking",
                                             .count = 1,
                                             .waits_for = {weights_done},
                                             .body = for_each_item([this](std::size_t) { bake_breaking(); }),
                                             .stack_bytes = stack_margin});
    graph.add({.name = "shore heights",
               .count = rows,
               .batch = 16,
               .waits_for = {breaking_done},
               .body = for_each_item([this](std::size_t row) { bake_heights(row); }),
               .stack_bytes = stack_margin});
}

void ShoreSource::bake_wave(std::size_t number) {
    const ShoreWave& wave = waves_[number];
    std::unique_ptr<Workspace> workspace = take_workspace();
    Refraction& refraction = workspace->refraction;
    refraction.propagate(
        {.omega = wave.omega, .along_x = wave.along_x, .along_z = wave.along_z, .depth_m = sea_.depth_m});
    std::vector<double>&phase = workspace->phase, &height = workspace->height;
    phase = refraction.phase();
    height = refraction.height();
    const double k =
        std::min(wave_number(wave.omega, SeaBed::min_depth_m), two_pi / (Refraction::min_texels * bed_.texel_m));
    run_up(bed_, phase, height, k, swash_m_, swash_texels_);
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel) {
        const double amplitude_m = wave.amplitude_m * height[texel] * bake_->fade[texel];
        if (!(amplitude_m > min_shore_amplitude_m)) continue;
        const auto [sine, cosine] =
            det::sine_cosine_of_turns((phase[texel] + refraction.corner_phase()) / two_pi + wave.phase_turns);
        float* const at = amplitudes_.data() + amplitude_offset(texel, number);
        at[0] = static_cast<float>(amplitude_m * cosine);
        at[group_texels] = static_cast<float>(amplitude_m * sine);
    }
    if (number != waves_.size() / 2) return return_workspace(std::move(workspace));
    bake_limits(refraction, wave.omega);
    bake_->main_wave = std::move(workspace);
}

std::unique_ptr<ShoreSource::Workspace> ShoreSource::take_workspace() {
    const std::lock_guard lock(bake_->mutex);
    if (bake_->workspaces.empty()) return std::make_unique<Workspace>(bed_);
    std::unique_ptr<Workspace> workspace = std::move(bake_->workspaces.back());
    bake_->workspaces.pop_back();
    return workspace;
}

void ShoreSource::return_workspace(std::unique_ptr<Workspace> workspace) {
    const std::lock_guard lock(bake_->mutex);
    bake_->workspaces.push_back(std::move(workspace));
}

/// Computes the limit of the envelope, 0.78 d / 2. Waves that broke on a bar do not grow again
/// behind it, so the limit is the minimum of 0.78 d / 2 / Ks along the wave's path, times Ks.
void ShoreSource::bake_limits(const Refraction& wave, double omega) {
    double open_m = 0;
    for (const ShoreWave& each : waves_) open_m += each.amplitude_m;
    std::vector<double> max(bed_.texels(), Refraction::nowhere);
    for (const std::uint32_t texel : wave.order()) {
        const double depth_m = bed_.depth_m[texel];
        max[texel] = 0.5 * breaking_height_over_depth * depth_m / wave.shoaling(texel);
        if (wave.comes_in_at(texel)) continue;
        const Refraction::Upstream from = wave.upstream(texel);
        if (from.share_x + from.share_z > 0)
            max[texel] = std::min(max[texel], (from.share_x > 0 ? from.share_x * max[from.x] : 0) +
                                                  (from.share_z > 0 ? from.share_z * max[from.z] : 0));
    }
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel) {
        if (!bed_.is_water(texel)) continue;
        const double depth_m = bed_.depth_m[texel], shoaling = wave.shoaling(texel);
        const double stands_m =
            max[texel] < Refraction::nowhere ? max[texel] * shoaling : 0.5 * breaking_height_over_depth * depth_m;
        highest_envelope_.data()[texel] = static_cast<float>(std::max(stands_m, min_envelope_m));
        // Stokes 1847, second order: crests are higher by k a^2 (3 - t^2) / (4 t^3), t = tanh(k d).
        const double k = wave_number(omega, depth_m), t = det::tanh(k * depth_m);
        const double sharp = sea_.choppiness * k * (3 - t * t) / (4 * t * t * t);
        sharpness_.data()[texel] = static_cast<float>(
            std::min(sharp, max_sharp / std::min(std::max(stands_m, min_envelope_m), open_m * shoaling)));
    }
}

void ShoreSource::bake_shelter(std::size_t number) {
    const ShoreWave& wave = bake_->shelter_waves[number];
    std::unique_ptr<Workspace> workspace = take_workspace();
    workspace->refraction.propagate_straight(wave.along_x, wave.along_z);
    const std::vector<double>& height = workspace->refraction.height();
    std::vector<float>& energy = bake_->shelters[number];
    energy.resize(bed_.texels());
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel)
        energy[texel] = static_cast<float>(height[texel] * height[texel]);
    return_workspace(std::move(workspace));
}

std::size_t ShoreSource::amplitude_offset(std::size_t texel, std::size_t wave) const {
    return (texel / group_texels * waves_.size() + wave) * 2 * group_texels + texel % group_texels;
}

ShoreSource::Variance ShoreSource::variance_of_waves(std::size_t texel) const {
    double squares = 0, squares_of_sums = 0, sum_re = 0, sum_im = 0;
    for (std::size_t wave = 0; wave < waves_.size(); ++wave) {
        const float* const at = amplitudes_.data() + amplitude_offset(texel, wave);
        const double re = static_cast<double>(at[0]), im = static_cast<double>(at[group_texels]);
        squares += re * re + im * im;
        sum_re += re, sum_im += im;
        if (wave + 1 < waves_.size() && waves_[wave + 1].harmonic == waves_[wave].harmonic) continue;
        squares_of_sums += sum_re * sum_re + sum_im * sum_im;
        sum_re = sum_im = 0;
    }
    return {.of_all = 0.5 * squares, .here = 0.5 * squares_of_sums};
}

/// The height grows from 0 at the waterline, where the depth limits waves, with the cube root of the
/// ground's height, and is the ground's at swash_m_, which is the largest run-up.
double ShoreSource::highest_on_sand_m(std::size_t texel) const {
    const double ground_m = 0 - bed_.depth_m[texel];
    if (!(ground_m > 0 && swash_m_ > 0)) return 0;
    return swash_m_ * det::pow(std::min(ground_m / swash_m_, 1.0), 1.0 / 3);
}

double ShoreSource::max_deviation_m(std::size_t texel) const {
    return bed_.is_water(texel) ? deviation_over_depth * bed_.depth_m[texel]
                                : highest_on_sand_m(texel) / crest_of_5_percent;
}

void ShoreSource::bake_weights(std::size_t row) {
    double all = 0;
    for (const ShoreWave& wave : bake_->shelter_waves) all += wave.variance();
    for (int i = 0; i < bed_.columns; ++i) {
        const std::size_t texel = bed_.at(i, static_cast<int>(row));
        const double shore = inside(texel), depth_m = std::max(bed_.depth_m[texel], 0.0);
        double comes = 0;
        for (std::size_t wave = 0; wave < bake_->shelter_waves.size(); ++wave)
            comes += bake_->shelter_waves[wave].variance() * static_cast<double>(bake_->shelters[wave][texel]);
        const double sheltered = all > 0 ? std::min(1.0, std::sqrt(comes / all)) : 1;
        const double coarsest = det::sine_cosine_of_turns(0.25 * shore).cosine;
        bake_->weights[0][texel] = static_cast<float>(coarsest);
        double variance = variance_of_waves(texel).of_all + coarsest * coarsest * bake_->variances[0];
        const double at = depth_intervals * std::sqrt(depth_m / bake_->deepest_m);
        const auto cell = static_cast<std::size_t>(std::min(at, depth_intervals - 1.0));
        for (std::size_t cascade = 0; cascade < bake_->depth_attenuations.size(); ++cascade) {
            const std::vector<double>& table = bake_->depth_attenuations[cascade];
            const double stands = table[cell] + (at - static_cast<double>(cell)) * (table[cell + 1] - table[cell]);
            const double weight = 1 - shore * (1 - sheltered * stands);
            bake_->weights[cascade + 1][texel] = static_cast<float>(weight);
            variance += weight * weight * bake_->variances[cascade + 1];
        }
        bake_->deviation_m[texel] = std::sqrt(variance);
    }
}

/// Limits the amplitudes of the long waves, which have shoaled without breaking, to
/// max_deviation_m(). Energy lost by breaking stays lost: the attenuation is the minimum along the
/// path of the wave at the median of the energy. Waves on sand lose only what they lose in water
/// that limits them more than the sand does.
void ShoreSource::bake_breaking() {
    std::vector<double>& attenuation = bake_->attenuation;
    const double runs_up_m = swash_m_ / crest_of_5_percent;
    std::vector<double> onto_sand(bed_.texels());
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel) {
        const double max_m = max_deviation_m(texel);
        attenuation[texel] = attenuation_to(max_m, bake_->deviation_m[texel]);
        onto_sand[texel] = attenuation_to(std::max(max_m, runs_up_m), bake_->deviation_m[texel]);
    }
    if (!bake_->main_wave) return;
    const Refraction& wave = bake_->main_wave->refraction;
    for (const std::uint32_t texel : wave.order()) {
        if (wave.comes_in_at(texel)) continue;
        const Refraction::Upstream from = wave.upstream(texel);
        if (!(from.share_x + from.share_z > 0)) continue;
        for (std::vector<double>* const each : {&attenuation, &onto_sand})
            (*each)[texel] = std::min((*each)[texel], (from.share_x > 0 ? from.share_x * (*each)[from.x] : 0) +
                                                          (from.share_z > 0 ? from.share_z * (*each)[from.z] : 0));
    }
    for_sand(bed_, swash_m_, swash_texels_, [&](std::size_t here, const std::vector<std::size_t>& from) {
        double highest = 0;
        for (const std::size_t texel : from) highest = std::max(highest, onto_sand[texel]);
        if (!(highest > 0)) return;
        onto_sand[here] = highest;
        attenuation[here] = std::min(attenuation[here], highest);
    });
}

void ShoreSource::bake_heights(std::size_t row) {
    for (int i = 0; i < bed_.columns; ++i) {
        const std::size_t texel = bed_.at(i, static_cast<int>(row));
        const double shore = inside(texel), depth_m = std::max(bed_.depth_m[texel], 0.0);
        // At the edges the attenuation depends on the local depth only, as outside the rectangle.
        double variance = 0;
        for (std::size_t cascade = 0; cascade < bake_->weights.size(); ++cascade) {
            const double weight = static_cast<double>(bake_->weights[cascade][texel]);
            variance += weight * weight * bake_->variances[cascade];
        }
        const double deviation_m = std::sqrt(variance);
        const double stands = std::min({1 - shore * (1 - bake_->attenuation[texel]),
                                        attenuation_to(deviation_over_depth * depth_m, bake_->deviation_m[texel]),
                                        attenuation_to(crest_over_depth / highest_crest * depth_m, deviation_m)});
        std::uint32_t weights = 0;
        for (std::size_t cascade = 0; cascade < bake_->weights.size(); ++cascade)
            weights |=
                static_cast<std::uint32_t>(255 * (stands * static_cast<double>(bake_->weights[cascade][texel])))
                << 8 * cascade;
        weights_.data()[texel] = weights;

        // Waves of one period interfere and form standing patterns, so their variance over the loop
        // is limited too, together with that of the cascades.
        const double max_m = max_deviation_m(texel), cascades_m = stands * deviation_m;
        const double here_m = bake_->attenuation[texel] * std::sqrt(variance_of_waves(texel).here);
        const double attenuation =
            bake_->attenuation[texel] *
            attenuation_to(std::sqrt(std::max(0.0, max_m * max_m - cascades_m * cascades_m)), here_m);
        for (std::size_t wave = 0; wave < waves_.size(); ++wave) {
            float* const at = amplitudes_.data() + amplitude_offset(texel, wave);
            at[0] = static_cast<float>(attenuation * static_cast<double>(at[0]));
            at[group_texels] = static_cast<float>(attenuation * static_cast<double>(at[group_texels]));
        }

        const double breaking_m = static_cast<double>(highest_envelope_.data()[texel]);
        breaking_envelope_.data()[texel] = static_cast<float>(std::max(attenuation * breaking_m, min_envelope_m));
        if (!bed_.is_water(texel)) continue;
        const double crest_m = crest_over_depth * depth_m - high_crest * cascades_m;
        highest_envelope_.data()[texel] =
            static_cast<float>(std::max(std::min(breaking_m, crest_m / (1 + max_sharp)), min_envelope_m));
    }
}

void ShoreSource::end_bake() {
    bake_.reset();
    for (std::size_t group = 0; group < has_waves_.size(); ++group) {
        const float* const first = amplitudes_.data() + group * waves_.size() * 2 * group_texels;
        has_waves_[group] = std::any_of(first, first + waves_.size() * 2 * group_texels,
                                        [](float amplitude) { return amplitude != 0; });
    }
    int max = 0;
    const auto compare = [&](std::size_t a, std::size_t b) {
        for (int byte = 0; byte < 32; byte += 8)
            max = std::max(max, std::abs(static_cast<int>(weights_.data()[a] >> byte & 255) -
                                         static_cast<int>(weights_.data()[b] >> byte & 255)));
    };
    for (int j = 0; j < bed_.rows; ++j)
        for (int i = 0; i < bed_.columns; ++i) {
            if (i + 1 < bed_.columns) compare(bed_.at(i, j), bed_.at(i + 1, j));
            if (j + 1 < bed_.rows) compare(bed_.at(i, j), bed_.at(i, j + 1));
        }
    weights_change_per_m_ = static_cast<float>(std::sqrt(2.0) * max / 255 / bed_.texel_m);
}

void ShoreSource::add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    const bool is_tick = pass == Pass::tick;
    if (is_tick && !at_ticks_) return;
    // A tick's shore is in the memory of the frame's.
    const StageId filled =
        graph.add({.name = is_tick ? "tick shore" : "shore",
                   .count = slots_.back().lowest.size(),
                   .waits_for = at_ticks_ ? std::vector{surfaces_done.front()} : std::vector<StageId>{},
                   .body = for_each_item([this, pass](std::size_t item) { rows(pass, item); }),
                   .stack_bytes = stack_margin});
    if (is_tick) surfaces_done.front() = filled;
}

void ShoreSource::begin(const PassMoment& at) {
    is_idle_ = at.whitecaps_only;
    if (!has_levels_) set_levels(at.cascades);
    const LoopFraction fraction = loop_fraction(at.time_in_loop_s, sea_.loop_period_s);
    for (std::size_t wave = 0; wave < waves_.size(); ++wave) {
        const std::uint32_t turns = waves_[wave].harmonic * fraction.turns;
        const auto [sine, cosine] = det::sine_cosine_of_turns(turns * 0x1p-32);
        moments_[at.pass][wave] = {static_cast<float>(cosine), static_cast<float>(sine),
                                   static_cast<float>(waves_[wave].omega),
                                   static_cast<float>(gravity_mps2 / waves_[wave].omega)};
    }
}

/// The levels need the amplitudes that the seed drew, which the first pass has.
void ShoreSource::set_levels(std::span<const Cascade> cascades) {
    for (std::size_t texel = 0; texel < bed_.texels(); ++texel) {
        double level_m = 0;
        for (std::size_t cascade = 0; cascade < cascades.size(); ++cascade) {
            const double weight = static_cast<double>(weights_.data()[texel] >> 8 * cascade & 255) / 255;
            level_m += (weight * weight - weight) * static_cast<double>(cascades[cascade].level_m);
        }
        level_.data()[texel] = static_cast<float>(inside(texel) * level_m);
    }
    has_levels_ = true;
}

void ShoreSource::rows(Pass pass, std::size_t item) {
    if (pass == Pass::tick && is_idle_) return;
    Slot& slot = slots_.back();
    const std::size_t first = item * groups_per_item;
    kernels_.shore_rows({.waves = amplitudes_.data(),
                         .moments = moments_[pass].data(),
                         .wave_count = waves_.size(),
                         .has_waves = has_waves_.data(),
                         .highest_envelope = highest_envelope_.data(),
                         .breaking_envelope = breaking_envelope_.data(),
                         .sharpness = sharpness_.data(),
                         .level = level_.data(),
                         .first_group = first,
                         .groups = std::min(groups_per_item, has_waves_.size() - first),
                         .height = slot.height.data(),
                         .vertical_velocity = slot.vertical_velocity.data(),
                         .potential = slot.potential.data(),
                         .reach = slot.reach.data(),
                         .foam = slot.foam.data(),
                         .lowest = &slot.lowest[item],
                         .highest = &slot.highest[item]});
}

void ShoreSource::end(Frame& frame) {
    frame.shore = of_pass();
    const float lowest = slots_.back().min_height(), highest = slots_.back().max_height();
    const float beyond = static_cast<float>(max_overshoot) * (highest - lowest);
    frame.shore.bounds = {.height_min_m = lowest - beyond, .height_max_m = highest + beyond};
    frame.bounds += frame.shore.bounds;
}

ShoreSurface ShoreSource::of_pass() const {
    const Slot& slot = slots_.back();
    const std::size_t texels = bed_.texels();
    return {.columns = bed_.columns,
            .rows = bed_.rows,
            .texel_m = bed_.texel_m,
            .x_m = bed_.x_m,
            .z_m = bed_.z_m,
            .depth_m = {depth_.data(), texels},
            .weights_rgba8 = {weights_.data(), texels},
            .height_m = {slot.height.data(), texels},
            .vertical_velocity_mps = {slot.vertical_velocity.data(), texels},
            .potential_m2ps = {slot.potential.data(), texels},
            .reach_m = {slot.reach.data(), texels},
            .foam = {slot.foam.data(), texels},
            .weights_change_per_m = weights_change_per_m_};
}

std::size_t ShoreSource::bytes() const {
    std::size_t bytes = sizeof *this + bed_.depth_m.size() * sizeof(double) + amplitudes_.bytes() +
                        has_waves_.size() + highest_envelope_.bytes() + breaking_envelope_.bytes() +
                        sharpness_.bytes() + depth_.bytes() + level_.bytes() + weights_.bytes() +
                        waves_.size() * (sizeof(ShoreWave) + passes * sizeof(ShoreRowsJob::Moment));
    for (const Slot& slot : slots_)
        bytes += slot.HeightFieldBuffers::bytes() + slot.potential.bytes() + slot.reach.bytes();
    return bytes;
}

}  // namespace pelagic
