#include "pelagic/sim/kinematics/wave_lists.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

// e^-80 is far below a float's share of 1, and e^-kd is still a normal float.
constexpr double max_mirror_kd = 40;

std::size_t padded(std::size_t count) {
    return (count + WaveBlock::partial_sums - 1) / WaveBlock::partial_sums * WaveBlock::partial_sums;
}

}  // namespace

LineOfWaves line_of_waves(const SeaState& sea, const CascadeWaves& waves, int n) {
    const CascadePlan& cascade = waves.cascade();
    LineOfWaves line;
    const auto add = [&](const OppositeWaves& opposites, int m) {
        const std::complex<double> along = opposites.along.amplitude, against = std::conj(opposites.against.amplitude);
        if (std::norm(along) + std::norm(against) == 0) return;
        const double steps = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
        const double k = steps * cascade.spacing(), kd = k * waves.water().depth_m;
        const double mirror = kd < max_mirror_kd ? det::exp(-2 * kd) : 0;
        const std::uint32_t harmonic = loop_harmonic(waves.frequency(k), sea.loop_period_s);
        const double omega = harmonic * (two_pi / sea.loop_period_s), scale = 2 / (1 + mirror);
        line.entries.push_back({.m = m,
                                .n = n,
                                .harmonic = harmonic,
                                .steps = steps,
                                .packed = {static_cast<float>((along.real() + against.real()) * scale),
                                           static_cast<float>((along.imag() + against.imag()) * scale),
                                           static_cast<float>((along.imag() - against.imag()) * scale),
                                           static_cast<float>((against.real() - along.real()) * scale)},
                                .flow_factor = static_cast<float>(omega / (steps * det::tanh(kd))),
                                .mirror = static_cast<float>(mirror)});
    };
    for (int m = 0; m < cascade.resolution / 2; ++m) {
        if (!waves.holds(m, n)) continue;
        const CascadeWaves::MirroredPair pair = waves.pair(m, n);
        add(pair.plus, m);
        if (m > 0 && n > 0) add(pair.minus, -m);  // line 0 is its own mirror
    }
    return line;
}

WaveList::Moved::Moved(const WaveList& list)
    : head_re(list.padded_size()),
      head_im(list.padded_size()),
      flow_re(list.padded_size()),
      flow_im(list.padded_size()) {}

WaveList::WaveList(const CascadeGrid& grid, std::span<const LineOfWaves> lines)
    : grid_(grid), size_(0), mirrored_(0) {
    std::vector<LineOfWaves::Entry> all;
    for (const LineOfWaves& line : lines) all.insert(all.end(), line.entries.begin(), line.entries.end());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.steps, a.n, a.m) < std::tuple(b.steps, b.n, b.m);
    });
    size_ = all.size();
    for (auto* const numbers : {&m_, &n_, &harmonics_}) *numbers = AlignedBuffer<std::uint32_t>(padded(size_));
    for (auto* const numbers : {&steps_, &mirror_, &flow_factor_, &packed_[0], &packed_[1], &packed_[2], &packed_[3]})
        *numbers = AlignedBuffer<float>(padded(size_));
    for (std::size_t i = 0; i < size_; ++i) {
        const LineOfWaves::Entry& wave = all[i];
        m_[i] = static_cast<std::uint32_t>(wave.m);
        n_[i] = static_cast<std::uint32_t>(wave.n);
        harmonics_[i] = wave.harmonic;
        steps_[i] = static_cast<float>(wave.steps);
        mirror_[i] = wave.mirror;
        flow_factor_[i] = wave.flow_factor;
        for (std::size_t part = 0; part < 4; ++part) packed_[part][i] = wave.packed[part];
        if (wave.mirror > 0) mirrored_ = i + 1;
    }
}

MoveWavesJob WaveList::move_job(std::uint32_t fraction, Moved& to) const {
    return {.harmonics = harmonics_.data(),
            .fraction = fraction,
            .packed = {packed_[0].data(), packed_[1].data(), packed_[2].data(), packed_[3].data()},
            .flow_factor = flow_factor_.data(),
            .count = padded_size(),
            .head_re = to.head_re.data(),
            .head_im = to.head_im.data(),
            .flow_re = to.flow_re.data(),
            .flow_im = to.flow_im.data()};
}

WaveBlock WaveList::block(const Moved& moved, std::size_t number) const {
    const std::size_t first = number * WaveBlock::max_count;
    return {.m = m_.data() + first,
            .n = n_.data() + first,
            .steps = steps_.data() + first,
            .mirror = first < mirrored_ ? mirror_.data() + first : nullptr,
            .head_re = moved.head_re.data() + first,
            .head_im = moved.head_im.data() + first,
            .flow_re = moved.flow_re.data() + first,
            .flow_im = moved.flow_im.data() + first,
            .count = std::min(WaveBlock::max_count, padded_size() - first)};
}

WaveList::LastWaves::LastWaves(const WaveBlock& all, std::size_t end) : block(all) {
    const std::size_t first = all.count;
    const float** const of_waves[] = {&block.head_re, &block.head_im, &block.flow_re, &block.flow_im};
    for (std::size_t part = 0; part < 4; ++part) {
        std::copy(*of_waves[part] + first, *of_waves[part] + end, moved[part]);
        *of_waves[part] = moved[part];
    }
    block.m += first, block.n += first, block.steps += first;
    if (block.mirror) block.mirror += first;
    block.count = WaveBlock::partial_sums;
}

std::size_t WaveList::waves_from(double length_m) const {
    // a wave of exactly that length remains, whatever the rounding
    const double max_steps = grid_.side_m / length_m * (1 + 1e-6);
    return static_cast<std::size_t>(
        std::partition_point(steps_.data(), steps_.data() + size_,
                             [&](float steps) { return static_cast<double>(steps) <= max_steps; }) -
        steps_.data());
}

}  // namespace pelagic
