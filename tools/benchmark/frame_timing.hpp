// Measurement of frame and job times for `pelagic bench`.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// Returns the name of a sea in tables: "1x256", "4x128".
inline std::string sea_name(int cascades, int resolution) {
    return std::to_string(cascades) + "x" + std::to_string(resolution);
}

struct TimingPlan {
    std::vector<SeaState> seas;
    std::vector<Isa> isas;           ///< weakest first; the last is also timed on several threads
    std::vector<int> threads = {1};  ///< numbers of threads, the first is 1
    bool planes = true;              ///< OceanOptions::planes
    double seconds = 30;             ///< total time; longer on slow machines (minimum of turns)
};

/// Median and quartiles over the turns in milliseconds.
struct Quartiles {
    double median, low, high;
};

/// \pre there are values
Quartiles quartiles_of(std::vector<double> values);

/// Timing of a job of a frame, summed over all cascades.
struct JobTiming {
    std::string job;
    Quartiles ms;
    double gb_per_s;                     ///< compulsory bytes (stage_work.hpp) / median
    std::optional<double> instructions;  ///< per texel, from this processor's counter
};

struct FrameTiming {
    int cascades, resolution;
    Isa isa;
    int threads;
    bool planes;
    Quartiles ms;
    double gb_per_s;
    std::optional<double> instructions;  ///< per texel; on one thread only
    std::vector<JobTiming> jobs;         ///< on one thread only
    std::size_t memory_bytes;            ///< memory of the ocean: two frames and the spectrum
    std::size_t upload_bytes;            ///< size of a frame's textures with all levels

    std::string sea() const { return sea_name(cascades, resolution); }
};

struct Timings {
    std::vector<FrameTiming> frames;  ///< sorted by sea, instruction set and threads
    std::string no_counter;           ///< reason why instructions are not counted; else empty
};

/// Maximum number of threads of a headset. Further cores of a headset are slow or used by the renderer.
inline constexpr int max_headset_threads = 3;

/// Returns the seas of a headset: 1x128, 1x256, 3x64, 3x128 and 4x128 (cascades x N).
std::vector<SeaState> headset_seas();

/// Returns 1, 2, 4, ... and `max`.
std::vector<int> thread_counts(int max);

/// Times frames. For each sea, all instruction sets take turns on one thread, so that other load
/// affects them equally; then all numbers of threads take turns. A turn is two or more warm-up
/// frames and some timed frames. On one thread, an equal number of frames with timed jobs follows,
/// with clock reads before and after each block.
/// \param progress  called after each turn with the sea and the completed fraction, 0 to 1
Timings time_frames(const TimingPlan& plan, const std::function<void(const std::string&, double)>& progress);

}  // namespace pelagic::tools
