#include "pelagic/tests/unfused/unfused_sea.hpp"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic::unfused {
namespace {

Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex plus_i_times(Complex a, Complex b) { return {a.re - b.im, a.im + b.re}; }
Complex minus_i_times(Complex a, Complex b) { return {a.re + b.im, a.im - b.re}; }

void butterfly_4(Complex* x) {
    const Complex even_sum = x[0] + x[2], even_difference = x[0] - x[2];
    const Complex odd_sum = x[1] + x[3], odd_difference = x[1] - x[3];
    x[0] = even_sum + odd_sum;
    x[1] = plus_i_times(even_difference, odd_difference);
    x[2] = even_sum - odd_sum;
    x[3] = minus_i_times(even_difference, odd_difference);
}

void butterfly_8(Complex* x) {
    Complex even[4] = {x[0], x[2], x[4], x[6]};
    Complex odd[4] = {x[1], x[3], x[5], x[7]};
    butterfly_4(even);
    butterfly_4(odd);
    constexpr float root_half = 0.70710678f;
    odd[1] = {(odd[1].re - odd[1].im) * root_half, (odd[1].re + odd[1].im) * root_half};
    odd[3] = {(odd[3].re - odd[3].im) * root_half, (odd[3].re + odd[3].im) * root_half};
    for (int k = 0; k < 2; ++k) {
        x[k] = even[k] + odd[k];
        x[k + 2] = plus_i_times(even[k + 2], odd[k + 2]);
        x[k + 4] = even[k] - odd[k];
        x[k + 6] = minus_i_times(even[k + 2], odd[k + 2]);
    }
}

/// Applies the inverse transform to `line` in place, in the steps of the plan.
void transform(std::vector<Complex>& line, const FftTables& fft) {
    std::vector<Complex> data(line.size());
    for (std::size_t i = 0; i < line.size(); ++i) data[fft.positions[i]] = line[i];
    for (std::size_t s = 0; s < fft.step_count; ++s) {
        const FftStep& step = fft.steps[s];
        for (int first = 0; first < fft.size; first += step.radix * step.span) {
            for (int j = 0; j < step.span; ++j) {
                Complex x[8];
                for (int l = 0; l < step.radix; ++l) {
                    x[l] = data[static_cast<std::size_t>(first + j + l * step.span)];
                    // only the last step multiplies by 1
                    if (l == 0 || (j == 0 && s + 1 < fft.step_count)) continue;
                    const float* root = fft.twiddles + step.first_twiddle + 2 * (j * step.radix + l);
                    x[l] = {x[l].re * root[0] - x[l].im * root[1], x[l].re * root[1] + x[l].im * root[0]};
                }
                if (step.radix == 8)
                    butterfly_8(x);
                else
                    butterfly_4(x);
                for (int k = 0; k < step.radix; ++k) data[static_cast<std::size_t>(first + j + k * step.span)] = x[k];
            }
        }
    }
    line = data;
}

float clamped(float v, float min, float max) { return std::min(std::max(v, min), max); }

std::uint32_t signed_byte(float scaled) { return static_cast<std::uint32_t>(static_cast<int>(scaled + 128.f)); }

}  // namespace

Rotation rotation_of_turns(std::uint32_t phase) {
    const std::uint32_t rounded = phase + 0x20000000u;
    const std::uint32_t quadrant = rounded >> 30;
    const auto rest = static_cast<std::int32_t>(rounded & 0x3FFFFFFFu) - 0x20000000;
    const float r = static_cast<float>(rest) * 0x1p-32f;
    const float z = r * r;
    float sine = r * (6.2831855f + z * (-41.341663f + z * (81.592545f + z * -75.40161f)));
    float cosine = 1.f + z * (-19.739208f + z * (64.93937f + z * (-85.44882f + z * 59.424107f)));
    if (quadrant % 2 == 1) std::swap(sine, cosine);
    return {quadrant >= 2 ? -sine : sine, quadrant == 1 || quadrant == 2 ? -cosine : cosine};
}

UnfusedSea::UnfusedSea(const SeaState& sea)
    : sea_(sea), n_(static_cast<std::size_t>(sea.resolution)), plan_(sea.resolution) {
    spectrum();
    for (std::vector<Complex>* field : {&fields_.h, &fields_.p, &fields_.r}) field->resize(n_ / 2 * n_);
    for (std::vector<float>* plane : {&dx_, &height_, &dz_}) plane->resize(n_ * n_);
    halves_.resize(4 * n_ * n_);
    texels_.resize(mip_offset(sea.resolution, mip_levels(sea.resolution)));
    const auto view = [&](const std::vector<float>& plane) {
        return PlaneView{plane.data(), sea.resolution, sea.resolution, sea.resolution, 0};
    };
    cascade_.dx = view(dx_);
    cascade_.height = view(height_);
    cascade_.dz = view(dz_);
    cascade_.displacement_rgba16f = halves_;
    cascade_.gradient_rgba8 = texels_;
    frame_.cascades = {&cascade_, 1};
}

const Frame& UnfusedSea::frame_at(double time_s) {
    frame_.time_s = time_s;
    evolve(loop_fraction(time_s, sea_.loop_period_s).turns);
    rows();
    columns();
    finalize();
    gradients();
    mipmaps();
    return frame_;
}

void UnfusedSea::spectrum() {
    const CascadeWaves waves(sea_, plan_cascades(sea_).front());
    const double spacing = 6.28318530717958647693 / sea_.patch_size_m, lean = lean_of(sea_);
    double level = 0;
    for (int n = 0; n < sea_.resolution / 2; ++n) {
        for (int position = 0; position < sea_.resolution; ++position) {
            const int m = position < sea_.resolution / 2 ? position : position - sea_.resolution;
            const bool is_none = m == -sea_.resolution / 2 || (m == 0 && n == 0);
            if (is_none) {
                waves_.push_back({});
                continue;
            }
            const std::complex<double> along = waves.amplitude(m, n);
            const std::complex<double> against = std::conj(waves.amplitude(-m, -n));
            const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
            const double k = length * spacing;
            const double tanh_kd = det::tanh(length * spacing * sea_.depth_m), coth_kd = std::min(1 / tanh_kd, 20.0);
            const double forward = coth_kd / std::sqrt(1 + lean * lean);
            level += (n == 0 ? 1 : 2) * (std::norm(along) + std::norm(against)) * k * forward;
            waves_.push_back(
                {static_cast<float>(along.real() + against.real()), static_cast<float>(along.imag() + against.imag()),
                 static_cast<float>(along.imag() - against.imag()), static_cast<float>(against.real() - along.real()),
                 static_cast<float>(m / length * forward), static_cast<float>(n / length * forward),
                 static_cast<float>(lean),
                 loop_harmonic(angular_frequency(length * spacing, sea_.depth_m), sea_.loop_period_s)});
        }
    }
    level_m_ = static_cast<float>(sea_.choppiness * level);
}

void UnfusedSea::evolve(std::uint32_t fraction) {
    for (std::size_t i = 0; i < waves_.size(); ++i) {
        const Wave& wave = waves_[i];
        const Rotation rotation = rotation_of_turns(wave.harmonic * fraction);
        const Rotation leaning{rotation.sine + wave.lean_tangent * rotation.cosine,
                               rotation.cosine - wave.lean_tangent * rotation.sine};
        const auto at = [&](const Rotation& by) {
            return Complex{wave.cos_re * by.cosine + wave.sin_re * by.sine,
                           wave.cos_im * by.cosine + wave.sin_im * by.sine};
        };
        const Complex h = at(rotation), d = at(leaning);
        const float x_re = wave.direction_x * d.re, x_im = wave.direction_x * d.im;
        const float z_re = wave.direction_z * d.re, z_im = wave.direction_z * d.im;
        fields_.h[i] = h;
        fields_.p[i] = {x_im + z_re, z_im - x_re};
        fields_.r[i] = {x_re + z_im, x_im - z_re};
    }
}

void UnfusedSea::rows() {
    for (std::vector<Complex>* field : {&fields_.h, &fields_.p, &fields_.r}) {
        for (std::size_t row = 0; row < n_ / 2; ++row) {
            const auto first = field->begin() + static_cast<std::ptrdiff_t>(row * n_);
            std::vector<Complex> line(first, first + static_cast<std::ptrdiff_t>(n_));
            transform(line, plan_.tables());
            std::copy(line.begin(), line.end(), first);
        }
    }
}

void UnfusedSea::columns() {
    const auto store = [&](std::vector<float>& plane, std::size_t x, const std::vector<Complex>& line,
                           bool imaginary) {
        for (std::size_t z = 0; z < n_; ++z) plane[at(x, z)] = imaginary ? line[z].im : line[z].re;
    };
    std::vector<Complex> line(n_);
    for (std::size_t x = 0; x < n_; ++x) {
        line[n_ / 2] = {};
        line[0] = fields_.p[at(x, 0)];
        for (std::size_t n = 1; n < n_ / 2; ++n) {
            const Complex r = fields_.r[at(x, n)];
            line[n] = fields_.p[at(x, n)];
            line[n_ - n] = {r.im, r.re};
        }
        transform(line, plan_.tables());
        store(dx_, x, line, false);
        store(dz_, x, line, true);
    }
    for (std::size_t x = 0; x < n_; ++x) {
        if (x / partner_distance % 2 == 1) continue;
        const std::size_t partner = x + partner_distance;
        const auto second = [&](std::size_t n) { return partner < n_ ? fields_.h[at(partner, n)] : Complex{}; };
        line[n_ / 2] = {};
        line[0] = {fields_.h[at(x, 0)].re + level_m_, partner < n_ ? second(0).re + level_m_ : 0};
        for (std::size_t n = 1; n < n_ / 2; ++n) {
            const Complex a = fields_.h[at(x, n)], b = second(n);
            line[n] = {a.re - b.im, a.im + b.re};
            line[n_ - n] = {a.re + b.im, b.re - a.im};
        }
        transform(line, plan_.tables());
        store(height_, x, line, false);
        if (partner < n_) store(height_, partner, line, true);
    }
}

void UnfusedSea::finalize() {
    const float factor = 0.f - static_cast<float>(sea_.choppiness);
    FrameBounds bounds{height_[0], height_[0], 0, 0};
    for (std::size_t i = 0; i < n_ * n_; ++i) {
        dx_[i] = dx_[i] * factor;
        dz_[i] = dz_[i] * factor;
        bounds.height_min_m = std::min(bounds.height_min_m, height_[i]);
        bounds.height_max_m = std::max(bounds.height_max_m, height_[i]);
        bounds.horizontal_x_max_m = std::max(bounds.horizontal_x_max_m, std::fabs(dx_[i]));
        bounds.horizontal_z_max_m = std::max(bounds.horizontal_z_max_m, std::fabs(dz_[i]));
    }
    cascade_.bounds = bounds;
}

void UnfusedSea::gradients() {
    const double spacing = 2 * sea_.patch_size_m / sea_.resolution;
    const auto two_texels = static_cast<float>(spacing);
    const auto jacobian_factor = static_cast<float>(1 / (spacing * spacing));
    const auto roughness = static_cast<float>(sea_.roughness);
    averages_.resize(n_ * n_);
    for (std::size_t z = 0; z < n_; ++z) {
        for (std::size_t x = 0; x < n_; ++x) {
            const auto along_x = [&](const std::vector<float>& plane) {
                return plane[at((x + 1) % n_, z)] - plane[at((x + n_ - 1) % n_, z)];
            };
            const auto along_z = [&](const std::vector<float>& plane) {
                return plane[at(x, (z + 1) % n_)] - plane[at(x, (z + n_ - 1) % n_)];
            };
            const float j_xx = two_texels + along_x(dx_), j_zz = two_texels + along_z(dz_);
            const float n_x = along_z(height_) * along_x(dz_) - along_x(height_) * j_zz;
            const float n_y = j_xx * j_zz - along_z(dx_) * along_x(dz_);
            const float n_z = along_x(height_) * along_z(dx_) - along_z(height_) * j_xx;
            const float squared = std::max(n_x * n_x + n_y * n_y + n_z * n_z, 1e-30f);
            const float inverse = 1.f / std::sqrt(squared);

            const float clamped_jacobian = clamped(n_y * jacobian_factor, -1.f, 1.f);
            const float to_byte = inverse * 127.5f;
            const std::size_t texel = at(x, z);
            texels_[texel] = signed_byte(n_x * to_byte) | signed_byte(n_z * to_byte) << 8 |
                             signed_byte(clamped_jacobian * 127.5f) << 16 |
                             static_cast<std::uint32_t>(smoothness_bits(roughness));
            const float values[] = {dx_[texel], height_[texel], dz_[texel], 0};
            for (std::size_t i = 0; i < 4; ++i) halves_[4 * texel + i] = Imath::half(values[i]).bits();
            const float scaled = inverse * mean_normal_length(roughness);
            averages_[texel] = {n_x * scaled, n_y * scaled, n_z * scaled, clamped_jacobian};
        }
    }
}

void UnfusedSea::mipmaps() {
    for (int level = 1; level < mip_levels(sea_.resolution); ++level) {
        const std::size_t side = n_ >> level;
        std::vector<Average> coarser(side * side);
        for (std::size_t i = 0; i < coarser.size(); ++i) {
            const Average* above = &averages_[2 * (i / side) * 2 * side + 2 * (i % side)];
            const Average* below = above + 2 * side;
            const auto mean = [&](float Average::*part) {
                return ((above[0].*part + below[0].*part) + (above[1].*part + below[1].*part)) * 0.25f;
            };
            const Average average{mean(&Average::n_x), mean(&Average::n_y), mean(&Average::n_z),
                                  mean(&Average::jacobian)};
            const float length =
                std::sqrt(average.n_x * average.n_x + average.n_y * average.n_y + average.n_z * average.n_z);
            const float to_byte = 127.5f / std::max(length, 1e-15f);
            const float t = clamped((length - 2.f / 3.f) * 3.f, 0.f, 1.f);
            const float rough = std::max(1.f - t * (0.85f + t * 0.15f), 0.f);
            const float smoothness = 1.f - std::sqrt(rough);
            texels_[mip_offset(sea_.resolution, level) + i] =
                signed_byte(average.n_x * to_byte) | signed_byte(average.n_z * to_byte) << 8 |
                signed_byte(average.jacobian * 127.5f) << 16 |
                static_cast<std::uint32_t>(smoothness * 255.f + 0.5f) << 24;
            coarser[i] = average;
        }
        averages_ = std::move(coarser);
    }
}

}  // namespace pelagic::unfused
