// Dynamic waves: a grid of the sea in which applications make waves, beside those of the wind. It follows somebody, its texels rest
// in the world, and its ticks are fixed, whatever frames do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

enum class DynamicWavesStep {
    /// Each wave goes on by its own phase: deep or shallow water's dispersion, exactly, at any length of a tick. Wakes have Kelvin's
    /// angle.
    spectral,
    /// h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt / dx)^2 <= 0.4: one speed for all waves, for ponds
    /// and rings.
    verlet
};

struct DynamicWavesOptions {
    DynamicWavesStep step = DynamicWavesStep::spectral;
    int resolution = 256;  ///< N, texels along a side; 64, 128, 256, 512 or 1024
    double side_m = 64;    ///< [1, 10000]
    int ticks_per_s = 60;  ///< [10, 240]
    double border_m = 12;  ///< of each side, where waves end; 0: none, waves come round, else [0.001, side_m / 4]
    double depth_m = 1e4;  ///< spectral; [0.01, 11000]
    double viscosity_m2ps = 2e-3;  ///< spectral: nu, of eddies rather than molecules; [0, 1]
    double wave_speed_mps = 3;     ///< Verlet; (0, 1000], and c <= 0.4
    double decay_per_s = 0.01;     ///< of amplitudes; [0, 10]
    double foam_height_m = 0.2;    ///< water that stands higher turns white, entirely so at twice that; [0.001, 100]
};

/// Empty, or what is wrong: "resolution is 100, needs 64, 128, 256, 512 or 1024".
std::string check(const DynamicWavesOptions& options);

/// The water of a grid at a place.
struct DynamicWavesSample {
    double height_m = 0;
    double slope_x = 0, slope_z = 0;
    double vertical_velocity_mps = 0;
    double foam = 0;  ///< 0 to 1
};

/// Of the view that a frame has of the grid (DynamicWavesView): bilinear between texels, slopes by central differences at texels. Flat
/// outside, and where x or z is no number.
DynamicWavesSample sample(const DynamicWavesView& water, double x_m, double z_m);

/// XXH3 of the grid's place, heights, vertical velocities and foam, little-endian; 0 of a frame without one. hash_of() has none of it.
std::uint64_t dynamic_waves_hash_of(const Frame& frame);

}  // namespace pelagic
