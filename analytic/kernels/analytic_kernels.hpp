// What the evaluators' kernels are told: waves as constants, points as they were given, where answers go.
#pragma once

#include <cstddef>

#include "pelagic/simd/isa.hpp"

namespace pelagic {

inline constexpr int max_analytic_waves = 64;

/// Points that the octaves' kernel takes together: a multiple of every instruction set's lanes.
inline constexpr std::size_t analytic_group = 16;

/// Where a wave's phase comes from: turns = x turns_per_m_x + z turns_per_m_z + start, start changing with time.
struct WavePhase {
    double turns_per_m_x, turns_per_m_z;
};

/// A wave A cos(phase) of wave vector k. Each member is a factor of its phase's sine or cosine.
struct GerstnerTerms {
    WavePhase phase;
    float turns_per_m_x, turns_per_m_z;  ///< as in `phase`
    float height;                        ///< cosine: A, m
    float horizontal_x, horizontal_z;    ///< sine: -choppiness A k_x/|k|, m
    float slope_x, slope_z;              ///< sine: -A k_x
    float contraction_xx, contraction_xz,
        contraction_zz;       ///< cosine: derivatives of the displacement, -choppiness A k_x k_z/|k|
    float vertical_velocity;  ///< sine: A w, m/s
    float drift_x, drift_z;   ///< cosine: choppiness A w k_x/|k|, m/s
};

/// Arrays of answers. Normal and Jacobian, or the velocity, are null together where nobody wants them.
struct WaveAnswers {
    float* height;
    float *horizontal_x, *horizontal_z;
    float *normal_x = nullptr, *normal_y = nullptr, *normal_z = nullptr, *jacobian = nullptr;
    float *velocity_x = nullptr, *velocity_y = nullptr, *velocity_z = nullptr;
};

/// `count` points, a multiple of AnalyticKernels::lanes.
struct GerstnerJob {
    const GerstnerTerms* waves;
    const double* starts;  ///< of each wave, turns in [-1/2, 1/2]
    int wave_count;
    std::size_t count;
    const double *x, *z;
    WaveAnswers out;
    /// Of the search for reference points: analytic_surface.cpp proves what follows from these three.
    float contraction;  ///< a fixed-point step leaves at most this part of an error
    float curvature;    ///< a Newton step leaves at most this, 1/m, times the error's square
    float target_m;
    int max_steps;
};

/// One octave of exp(sin - 1) waves.
struct PondTerms {
    WavePhase phase;
    float way_x, way_z;      ///< unit vector along which it runs
    float turns_per_m;       ///< |k| / 2 pi
    float k;                 ///< rad/m
    float height;            ///< m
    float drag;              ///< how far it moves the octaves after it, m
    float frequency;         ///< rad/s
    float half_waves_per_m;  ///< 2 / wavelength
};

/// All but the height are null together where nobody wants them.
struct PondAnswers {
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
    PondAnswers out;
};

struct AnalyticKernels {
    std::size_t lanes;
    void (*gerstner_undisplaced)(const GerstnerJob&);  ///< points are reference points
    void (*gerstner_in_world)(const GerstnerJob&);     ///< points are where the water is drawn
    void (*pond)(const PondJob&);
};

/// \pre runs_here(isa)
const AnalyticKernels& analytic_kernels_for(Isa isa);

}  // namespace pelagic
