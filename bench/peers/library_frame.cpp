#include "pelagic/bench/peers/library_frame.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"

namespace pelagic::peers {
namespace {

constexpr double two_pi = 6.28318530717958647693;
constexpr std::size_t wave_rows = 10;

}  // namespace

LibraryFrame::LibraryFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement)
    : arrangement_(arrangement),
      size_(static_cast<std::size_t>(sea.resolution)),
      texels_(size_ * size_),
      height_spectrum_(2 * size_ * (size_ / 2 + 1)),
      planes_(3 * texels_),
      sea_(sea),
      kernels_(kernels_for(isa)),
      own_kernels_(fftw_kernels_for(isa)),
      waves_((size_ / 2) * wave_rows * (size_ / 2)),
      harmonics_((size_ / 2) * (size_ / 2)),
      mip_averages_(sea.resolution),
      halves_(4 * texels_),
      bytes_(mip_offset(sea.resolution, mip_levels(sea.resolution))) {
    if (arrangement == FieldArrangement::packed) {
        horizontal_spectrum_ = AlignedBuffer<float>(2 * texels_);
        horizontal_ = AlignedBuffer<float>(2 * texels_);
    } else {
        dx_spectrum_ = AlignedBuffer<float>(height_spectrum_.size());
        dz_spectrum_ = AlignedBuffer<float>(height_spectrum_.size());
    }
    clear_spectra();
    bake_spectrum();
    frame_ = {{plane(0), texels_},
              {plane(1), texels_},
              {plane(2), texels_},
              {halves_.data(), halves_.size()},
              {bytes_.data(), bytes_.size()}};
}

void LibraryFrame::clear_spectra() {
    for (AlignedBuffer<float>* spectrum : {&height_spectrum_, &horizontal_spectrum_, &dx_spectrum_, &dz_spectrum_})
        std::fill(spectrum->data(), spectrum->data() + spectrum->size(), 0.f);
}

void LibraryFrame::bake_spectrum() {
    const CascadeWaves waves(sea_, plan_cascades(sea_).front());
    const double spacing = two_pi / sea_.patch_size_m;
    const std::size_t half = size_ / 2;
    for (std::size_t row = 0; row < half; ++row) {
        for (std::size_t column = 0; column < half; ++column) {
            const int m = static_cast<int>(column), n = static_cast<int>(row);
            float* wave = waves_.data() + row * wave_rows * half + column;
            for (const int sign : {1, -1}) {
                const std::complex<double> along = waves.amplitude(m, sign * n);
                const std::complex<double> against = std::conj(waves.amplitude(-m, -sign * n));
                for (const double part : {along.real() + against.real(), along.imag() + against.imag(),
                                          along.imag() - against.imag(), against.real() - along.real()}) {
                    *wave = static_cast<float>(part);
                    wave += half;
                }
            }
            const double length = std::hypot(m, n);
            if (length == 0) continue;
            const double orbit = orbit_ratio(length * spacing, sea_.depth_m);
            wave[0] = static_cast<float>(m / length * orbit);
            wave[half] = static_cast<float>(n / length * orbit);
            harmonics_[row * half + column] =
                loop_harmonic(angular_frequency(length * spacing, sea_.depth_m), sea_.loop_period_s);
        }
    }
}

void LibraryFrame::evolve(std::uint32_t fraction) {
    const std::size_t half = size_ / 2;
    for (std::size_t row = 0; row < half; ++row) {
        const std::size_t rows[2] = {row, (size_ - row) % size_};
        FftwEvolveJob job{.waves = {waves_.data() + row * wave_rows * half, harmonics_.data() + row * half},
                          .half_size = half,
                          .fraction = fraction,
                          .is_one_row = row == 0,
                          .height = {},
                          .horizontal = {},
                          .dx = {},
                          .dz = {}};
        for (std::size_t i = 0; i < 2; ++i) {
            job.height[i] = height_spectrum_.data() + rows[i] * 2 * (half + 1);
            if (arrangement_ == FieldArrangement::packed) {
                job.horizontal[i] = horizontal_spectrum_.data() + rows[i] * 2 * size_;
                continue;
            }
            job.dx[i] = dx_spectrum_.data() + rows[i] * 2 * (half + 1);
            job.dz[i] = dz_spectrum_.data() + rows[i] * 2 * (half + 1);
        }
        if (arrangement_ == FieldArrangement::packed)
            own_kernels_.evolve_packed(job);
        else
            own_kernels_.evolve_separate(job);
    }
}

void LibraryFrame::gradients() {
    const auto roughness = static_cast<float>(sea_.roughness);
    const double two_texels_m = 2 * sea_.patch_size_m / sea_.resolution;
    GradientsJob job{.surface = planes_.data(),
                     .resolution = size_,
                     .first_row = 0,
                     .first_column = 0,
                     .block_stride = texels_,
                     .two_texels_m = static_cast<float>(two_texels_m),
                     .jacobian_factor = static_cast<float>(1 / (two_texels_m * two_texels_m)),
                     .normal_length = mean_normal_length(roughness),
                     .smoothness_bits = smoothness_bits(roughness),
                     .rgba16f = halves_.data(),
                     .levels = {},
                     .averages = mip_averages_.level(GradientsJob::block_levels),
                     .average_stride = mip_averages_.stride(GradientsJob::block_levels)};
    for (int level = 0; level <= GradientsJob::block_levels; ++level)
        job.levels[level] = bytes_.data() + mip_offset(sea_.resolution, level);
    for (job.first_row = 0; job.first_row < size_; job.first_row += GradientsJob::block_rows)
        for (job.first_column = 0; job.first_column < size_; job.first_column += GradientsJob::block_columns)
            own_kernels_.gradients(job);
    for (int level = GradientsJob::block_levels + 1; level < mip_levels(sea_.resolution); ++level)
        kernels_.mip_level({.finer = mip_averages_.level(level - 1),
                            .finer_stride = mip_averages_.stride(level - 1),
                            .side = size_ >> level,
                            .averages = mip_averages_.level(level),
                            .stride = mip_averages_.stride(level),
                            .texels = bytes_.data() + mip_offset(sea_.resolution, level)});
}

const PeerFrame& LibraryFrame::frame_at(double time_s) {
    evolve(loop_fraction(time_s, sea_.loop_period_s).turns);
    transform();
    own_kernels_.finalize({.horizontal = arrangement_ == FieldArrangement::packed ? horizontal_.data() : nullptr,
                           .texels = texels_,
                           .choppiness = static_cast<float>(sea_.choppiness),
                           .dx = plane(0),
                           .height = plane(1),
                           .dz = plane(2),
                           .bounds = &bounds_});
    gradients();
    return frame_;
}

}  // namespace pelagic::peers
