// Inputs and outputs of the SIMD kernels for analytic and pond waves.
#pragma once

#include <cstddef>

#include "pelagic/simd/isa.hpp"

namespace pelagic {

inline constexpr int max_analytic_waves = 64;

/// Points that the pond kernel processes together: a multiple of the lanes of every instruction
/// set.
inline constexpr std::size_t analytic_group = 16;

/// Phase of a wave: turns = x turns_per_m_x + z turns_per_m_z + start, where start is a function of
/// time.
struct WavePhase {
    double turns_per_m_x, turns_per_m_z;
};

/// A wave A cos(phase) with wave vector k. Each member is a factor of the sine or cosine of the
/// phase.
struct GerstnerTerms {
    WavePhase phase;
    float turns_per_m_x, turns_per_m_z;  ///< as in `phase`
    float height;                        ///< cosine: A, m
    float horizontal_x, horizontal_z;    ///< sine: -choppiness A k_x/|k|, m
    float slope_x, slope_z;              ///< sine: -A k_x
    /// cosine: derivatives of the displacement, -choppiness A k_x k_z/|k|
    float contraction_xx, contraction_xz, contraction_zz;
    float vertical_velocity;  ///< sine: A w, m/s
    float drift_x, drift_z;   ///< cosine: choppiness A w k_x/|k|, m/s
};

/// Output arrays. Normal and Jacobian are null together if they are not needed, and so is the
/// velocity.
struct WaveOutputs {
    float* height;
    float *horizontal_x, *horizontal_z;
    float *normal_x = nullptr, *normal_y = nullptr, *normal_z = nullptr, *jacobian = nullptr;
    float *velocity_x = nullptr, *velocity_y = nullptr, *velocity_z = nullptr;
};

/// `count` points, a multiple of AnalyticKernels::lanes.
struct GerstnerJob {
    const GerstnerTerms* waves;
    const double* starts;  ///< phase of each wave at the origin, turns in [-1/2, 1/2]
    int wave_count;
    std::size_t count;
    const double *x, *z;
    WaveOutputs out;
    /// Parameters of the search for reference points (proof in analytic_surface.cpp).
    float contraction;  ///< a fixed-point step multiplies the error by at most this
    /// 1/m; the error after a Newton step is at most this times the squared error.
    float curvature;
    float target_m;
    int max_steps;
};

/// One octave of exp(sin - 1) waves.
struct PondTerms {
    WavePhase phase;
    float direction_x, direction_z;  ///< unit vector of the direction of travel
    float turns_per_m;               ///< |k| / 2 pi
    float k;                         ///< rad/m
    float height;                    ///< m
    float drag;                      ///< displacement of the octaves after it, m
    float frequency;                 ///< rad/s
    float half_waves_per_m;          ///< 2 / wavelength
};

/// Output arrays. All except the height are null together if they are not needed.
struct PondOutputs {
    float* height;
    float *normal_x = nullptr, *normal_y = nullptr, *normal_z = nullptr;
    float* vertical_velocity = nullptr;
    float* slope_variance = nullptr;
};

/// `count` points, a multiple of analytic_group.
struct PondJob {
    const PondTerms* octaves;
    const double* starts;
    int octave_count;
    std::size_t count;
    const double *x, *z;
    const float* footprint;  ///< m, or null: 0
    PondOutputs out;
};

struct AnalyticKernels {
    std::size_t lanes;
    void (*gerstner_undisplaced)(const GerstnerJob&);  ///< points are reference points
    void (*gerstner_in_world)(const GerstnerJob&);     ///< points are displaced positions
    void (*pond)(const PondJob&);
};

/// Returns the kernels for an instruction set. \pre runs_here(isa)
const AnalyticKernels& analytic_kernels_for(Isa isa);

}  // namespace pelagic
