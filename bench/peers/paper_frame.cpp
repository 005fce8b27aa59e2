#include "pelagic/bench/peers/paper_frame.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "pelagic/bench/peers/scalar_half.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"

namespace pelagic::peers {
namespace {

using paper::Complex;
using paper::Fields;
using paper::GradientTexel;
using paper::Horizontal;
using paper::PackedWave;

constexpr std::uint32_t largest_resolution = 2048;  // maximum of a SeaState
constexpr float two_pi_as_float = 2 * std::numbers::pi_v<float>;

Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(Complex a, float b) { return {a.re * b, a.im * b}; }
Complex operator*(Complex a, Complex b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }

Horizontal operator+(Horizontal a, Horizontal b) { return {a.x + b.x, a.z + b.z}; }
Horizontal operator-(Horizontal a, Horizontal b) { return {a.x - b.x, a.z - b.z}; }
Horizontal operator*(Horizontal a, Complex b) { return {a.x * b, a.z * b}; }

/// Returns e^{i angle}, to 1e-7, for angles of at most some turns. Quarter turns are subtracted in
/// two parts, the first with few bits so that its product is exact (Cody and Waite). The
/// polynomials are those of Cephes' sinf and cosf (Moshier).
inline Complex rotation_of(float angle) {
    const float nearest = angle < 0 ? -0.5f : 0.5f;
    const int quarter = static_cast<int>(angle * (4 / two_pi_as_float) + nearest);
    const float quarters = static_cast<float>(quarter);
    const float r = angle - quarters * 1.5703125f - quarters * 4.83826794896619e-4f;
    const float r2 = r * r;
    const float sine = r + r * r2 * (-1.6666654611e-1f + r2 * (8.3321608736e-3f + r2 * -1.9515295891e-4f));
    const float cosine =
        1.f - 0.5f * r2 +
        r2 * r2 * (4.166664568298827e-2f + r2 * (-1.388731625493765e-3f + r2 * 2.443315711809948e-5f));
    const bool is_odd = quarter & 1;
    const float re = is_odd ? sine : cosine;
    const float im = is_odd ? cosine : sine;
    return {(quarter + 1) & 2 ? -re : re, quarter & 2 ? -im : im};
}

/// Equation 33, with the sign of an inverse transform (errata).
inline Complex twiddle_factor(std::uint32_t exponent, std::uint32_t resolution) {
    return rotation_of(two_pi_as_float * static_cast<float>(exponent) / static_cast<float>(resolution));
}

/// Equation 36; C++ has no reversebits.
inline std::uint32_t bit_reverse(std::uint32_t index, int bits) {
    index = (index >> 1 & 0x55555555) | (index & 0x55555555) << 1;
    index = (index >> 2 & 0x33333333) | (index & 0x33333333) << 2;
    index = (index >> 4 & 0x0F0F0F0F) | (index & 0x0F0F0F0F) << 4;
    index = (index >> 8 & 0x00FF00FF) | (index & 0x00FF00FF) << 8;
    index = index >> 16 | index << 16;
    return index >> (32 - bits);
}

/// A row or column of both spectra.
struct Line {
    Complex* height;
    Horizontal* horizontal;
};

/// The stack buffers of equation 38: a line and the buffer that its stages alternate with.
struct LineBuffers {
    Complex height_local[largest_resolution];
    Horizontal horizontal_local[largest_resolution];
    Complex height_temp[largest_resolution];
    Horizontal horizontal_temp[largest_resolution];

    Line local() { return {height_local, horizontal_local}; }
    Line temp() { return {height_temp, horizontal_temp}; }
};

/// Runs all butterfly stages of one line whose local buffers have it in bit-reversed order (3.6.2,
/// 3.6.3, 3.6.6). Returns the buffers that the last stage wrote.
Line transform(LineBuffers& buffers, std::uint32_t resolution) {
    Line local = buffers.local();
    Line temp = buffers.temp();
    for (std::uint32_t pass = 0; resolution >> (pass + 1) != 0; ++pass) {
        const std::uint32_t stride = 1u << pass;
        for (std::uint32_t butterfly = 0; butterfly < resolution / 2; ++butterfly) {
            // Equations 34 and 35.
            const std::uint32_t group = butterfly / stride;
            const std::uint32_t position_in_group = butterfly % stride;
            const std::uint32_t a = group * (stride << 1) + position_in_group;
            const std::uint32_t b = a + stride;
            const Complex twiddle = twiddle_factor(position_in_group * (resolution >> (pass + 1)), resolution);

            // Equation 39.
            const Complex height_a = local.height[a];
            const Complex height_b = local.height[b] * twiddle;
            temp.height[a] = height_a + height_b;
            temp.height[b] = height_a - height_b;
            const Horizontal horizontal_a = local.horizontal[a];
            const Horizontal horizontal_b = local.horizontal[b] * twiddle;
            temp.horizontal[a] = horizontal_a + horizontal_b;
            temp.horizontal[b] = horizontal_a - horizontal_b;
        }
        std::swap(local, temp);
    }
    return local;
}

/// One byte of equation 50, of a value in [0, 1].
inline std::uint32_t byte_of(float value) { return static_cast<std::uint32_t>(value * 255.f + 0.5f); }

/// Equations 50 and 51.
inline std::uint32_t packed(float n_x, float n_z, float jacobian, float smoothness) {
    return byte_of(n_x * 0.5f + 0.5f) | byte_of(n_z * 0.5f + 0.5f) << 8 |
           byte_of(std::clamp(jacobian * 0.5f + 0.5f, 0.f, 1.f)) << 16 | byte_of(smoothness) << 24;
}

/// Equation 53.
inline float smoothness_of_length(float length) {
    const float t = std::clamp((length - 2.f / 3.f) / (1.f / 3.f), 0.f, 1.f);
    const float roughness = std::max(1.f - t * (0.85f + 0.15f * t), 0.f);
    return 1.f - std::sqrt(roughness);
}

}  // namespace

PaperFrame::PaperFrame(const SeaState& sea)
    : sea_(sea),
      resolution_(static_cast<std::uint32_t>(sea.resolution)),
      log_resolution_(std::countr_zero(resolution_)),
      choppiness_(static_cast<float>(sea.choppiness)),
      half_texels_per_metre_(static_cast<float>(sea.resolution / (2 * sea.patch_size_m))),
      normal_length_(mean_normal_length(static_cast<float>(sea.roughness))),
      smoothness_(smoothness_of(static_cast<float>(sea.roughness))) {
    const std::size_t texels = static_cast<std::size_t>(resolution_) * resolution_;
    const std::size_t chain_texels = mip_offset(sea.resolution, mip_levels(sea.resolution));
    initial_amplitudes_.resize(texels);
    harmonics_.resize(texels);
    orbit_ratios_.resize(texels, 1);
    for (Fields* fields : {&a_, &b_}) {
        fields->height.resize(texels);
        fields->horizontal.resize(texels);
    }
    chain_.resize(chain_texels);
    for (std::vector<float>* plane : {&outputs_.dx, &outputs_.height, &outputs_.dz}) plane->resize(texels);
    outputs_.rgba16f.resize(4 * texels);
    outputs_.rgba8.resize(chain_texels);
    frame_ = {outputs_.dx, outputs_.height, outputs_.dz, outputs_.rgba16f, outputs_.rgba8};
    bake_spectrum();
}

// Equations 16 to 22 on the centred grid of equation 2. There are no waves on the Nyquist row and
// column, index 0, so it does no harm that each is its own partner in the wrapped index below.
void PaperFrame::bake_spectrum() {
    const CascadeWaves waves(sea_, plan_cascades(sea_).front());
    const int centre = sea_.resolution / 2;
    const double spacing = 2 * std::numbers::pi / sea_.patch_size_m;
    std::vector<std::complex<double>> h0(initial_amplitudes_.size());
    for (std::uint32_t index = 0; index < h0.size(); ++index) {
        const int m = static_cast<int>(index & (resolution_ - 1)) - centre;
        const int n = static_cast<int>(index >> log_resolution_) - centre;
        const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
        h0[index] = waves.amplitude(m, n);
        harmonics_[index] =
            length == 0 ? 0 : loop_harmonic(angular_frequency(length * spacing, sea_.depth_m), sea_.loop_period_s);
        if (length > 0) orbit_ratios_[index] = static_cast<float>(orbit_ratio(length * spacing, sea_.depth_m));
    }
    for (std::uint32_t index = 0; index < h0.size(); ++index) {
        const std::uint32_t partner_x = (resolution_ - index) & (resolution_ - 1);
        const std::uint32_t partner_y = (resolution_ - (index >> log_resolution_)) & (resolution_ - 1);
        const std::complex<double> along = h0[index];
        const std::complex<double> against = std::conj(h0[(partner_y << log_resolution_) + partner_x]);
        initial_amplitudes_[index] = {
            {static_cast<float>(along.real() + against.real()), static_cast<float>(along.imag() + against.imag())},
            {static_cast<float>(along.imag() - against.imag()), static_cast<float>(against.real() - along.real())}};
    }
}

const PeerFrame& PaperFrame::frame_at(double time_s) {
    turns_ = loop_fraction(time_s, sea_.loop_period_s).turns;
    const std::uint32_t texels = resolution_ * resolution_;
    for (std::uint32_t index = 0; index < texels; ++index) evolve(index);
    for (std::uint32_t row = 0; row < resolution_; ++row) horizontal_pass(row);
    for (std::uint32_t column = 0; column < resolution_; ++column) vertical_pass(column);
    for (std::uint32_t index = 0; index < texels; ++index) finalize(index);
    for (std::uint32_t index = 0; index < texels; ++index) gradient(index);
    for (int level = 1; level <= log_resolution_; ++level)
        for (std::uint32_t index = 0; index < texels >> 2 * level; ++index) halve(level, index);
    return frame_;
}

// The paper's listing of section 3.4.3. Its phase is omega t in floats, with an error of 1e-4 rad
// late in a loop. Pelagic's integer phase is exact, and its top bit as a sign keeps the angle
// within half a turn.
void PaperFrame::evolve(std::uint32_t index) {
    constexpr float radians_per_step = two_pi_as_float * 0x1p-32f;
    const auto steps = static_cast<std::int32_t>(harmonics_[index] * turns_);
    const Complex rotation = rotation_of(static_cast<float>(steps) * radians_per_step);

    const PackedWave& h0 = initial_amplitudes_[index];
    const Complex height = h0.of_cosine * rotation.re + h0.of_sine * rotation.im;
    a_.height[index] = height;

    const float half_resolution = static_cast<float>(resolution_ / 2);
    float wave_x = static_cast<float>(index & (resolution_ - 1)) - half_resolution;
    float wave_z = static_cast<float>(index >> log_resolution_) - half_resolution;
    const float inverse_length = orbit_ratios_[index] / std::sqrt(std::max(1.f, wave_x * wave_x + wave_z * wave_z));
    wave_x *= inverse_length;
    wave_z *= inverse_length;

    const Complex swapped_conjugate = {height.im, -height.re};  // -i h, equation 30
    a_.horizontal[index] = {swapped_conjugate * wave_x, swapped_conjugate * wave_z};
}

void PaperFrame::horizontal_pass(std::uint32_t row) {
    LineBuffers buffers;
    const std::uint32_t first = row << log_resolution_;
    for (std::uint32_t i = 0; i < resolution_; ++i) {
        const std::uint32_t source = first + bit_reverse(i, log_resolution_);
        buffers.height_local[i] = a_.height[source];
        buffers.horizontal_local[i] = a_.horizontal[source];
    }
    const Line result = transform(buffers, resolution_);
    for (std::uint32_t i = 0; i < resolution_; ++i) {
        b_.height[first + i] = result.height[i];
        b_.horizontal[first + i] = result.horizontal[i];
    }
}

// Equations 40 and 41.
void PaperFrame::vertical_pass(std::uint32_t column) {
    LineBuffers buffers;
    for (std::uint32_t r = 0; r < resolution_; ++r) {
        const std::uint32_t source = column + (bit_reverse(r, log_resolution_) << log_resolution_);
        buffers.height_local[r] = b_.height[source];
        buffers.horizontal_local[r] = b_.horizontal[source];
    }
    const Line result = transform(buffers, resolution_);
    for (std::uint32_t r = 0; r < resolution_; ++r) {
        a_.height[column + (r << log_resolution_)] = result.height[r];
        a_.horizontal[column + (r << log_resolution_)] = result.horizontal[r];
    }
}

// Equations 42 to 44, written as floats and as halves.
void PaperFrame::finalize(std::uint32_t index) {
    const std::uint32_t x = index & (resolution_ - 1);
    const std::uint32_t y = index >> log_resolution_;
    const float sign = ((x + y) & 1) == 0 ? 1.f : -1.f;

    const float dx = -a_.horizontal[index].x.re * choppiness_ * sign;
    const float height = a_.height[index].re * sign;
    const float dz = -a_.horizontal[index].z.re * choppiness_ * sign;
    outputs_.dx[index] = dx;
    outputs_.height[index] = height;
    outputs_.dz[index] = dz;

    std::uint16_t* halves = outputs_.rgba16f.data() + 4 * static_cast<std::size_t>(index);
    halves[0] = half_of(dx);
    halves[1] = half_of(height);
    halves[2] = half_of(dz);
}

// Equations 45 to 51, with the full normal of the displaced surface (errata).
void PaperFrame::gradient(std::uint32_t index) {
    const std::uint32_t column = index & (resolution_ - 1);
    const std::uint32_t row = index >> log_resolution_;
    const auto wrap = [&](std::uint32_t i) { return (i + resolution_) % resolution_; };
    const std::uint32_t left = (row << log_resolution_) + wrap(column - 1);
    const std::uint32_t right = (row << log_resolution_) + wrap(column + 1);
    const std::uint32_t above = (wrap(row - 1) << log_resolution_) + column;
    const std::uint32_t below = (wrap(row + 1) << log_resolution_) + column;

    const auto along_x = [&](const std::vector<float>& plane) {
        return (plane[right] - plane[left]) * half_texels_per_metre_;
    };
    const auto along_z = [&](const std::vector<float>& plane) {
        return (plane[below] - plane[above]) * half_texels_per_metre_;
    };
    const float dx_x = along_x(outputs_.dx), dx_z = along_z(outputs_.dx);
    const float h_x = along_x(outputs_.height), h_z = along_z(outputs_.height);
    const float dz_x = along_x(outputs_.dz), dz_z = along_z(outputs_.dz);

    const float jacobian = (1.f + dx_x) * (1.f + dz_z) - dx_z * dz_x;
    float n_x = h_z * dz_x - h_x * (1.f + dz_z);
    float n_y = jacobian;
    float n_z = h_x * dx_z - h_z * (1.f + dx_x);
    // A surface that is compressed to a point has no normal; the guard keeps it finite.
    const float inverse_length = 1.f / std::sqrt(std::max(n_x * n_x + n_y * n_y + n_z * n_z, 1e-30f));
    n_x *= inverse_length;
    n_y *= inverse_length;
    n_z *= inverse_length;

    const float clamped_jacobian = std::clamp(jacobian, -1.f, 1.f);
    outputs_.rgba8[index] = packed(n_x, n_z, clamped_jacobian, smoothness_);
    chain_[index] = {n_x * normal_length_, n_y * normal_length_, n_z * normal_length_, clamped_jacobian};
}

// Equations 52 and 53 for one texel of `level`, from the floats of the finer level (errata).
void PaperFrame::halve(int level, std::uint32_t index) {
    const int log_side = log_resolution_ - level;
    const std::uint32_t x = index & ((1u << log_side) - 1);
    const std::uint32_t y = index >> log_side;
    const GradientTexel* above =
        chain_.data() + mip_offset(sea_.resolution, level - 1) + (2 * y << (log_side + 1)) + 2 * x;
    const GradientTexel* below = above + (std::size_t{2} << log_side);
    const auto mean = [&](float GradientTexel::*part) {
        return (above[0].*part + above[1].*part + below[0].*part + below[1].*part) * 0.25f;
    };
    const GradientTexel texel = {mean(&GradientTexel::n_x), mean(&GradientTexel::n_y), mean(&GradientTexel::n_z),
                                 mean(&GradientTexel::jacobian)};

    const float length = std::sqrt(texel.n_x * texel.n_x + texel.n_y * texel.n_y + texel.n_z * texel.n_z);
    const float inverse_length = 1.f / std::max(length, 1e-15f);
    const std::size_t target = mip_offset(sea_.resolution, level) + index;
    chain_[target] = texel;
    outputs_.rgba8[target] =
        packed(texel.n_x * inverse_length, texel.n_z * inverse_length, texel.jacobian, smoothness_of_length(length));
}

}  // namespace pelagic::peers
