// Times frames and their jobs on this machine: what `pelagic bench` measures.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic::tools {

/// "1x256", "4x128".
inline std::string sea_name(int cascades, int resolution) {
    return std::to_string(cascades) + "x" + std::to_string(resolution);
}

struct TimingPlan {
    std::vector<SeaState> seas;
    std::vector<Isa> isas;           ///< weakest first; the last one is also timed on more threads than one
    std::vector<int> threads = {1};  ///< 1, and then others
    double seconds = 30;             ///< for all; more on a machine that is too slow for a few turns of each
};

/// Milliseconds: median and quartiles over the turns.
struct Quartiles {
    double median, low, high;
};

/// A job of a frame, of all cascades together.
struct JobTiming {
    std::string job;
    Quartiles ms;
    double gb_per_s;                     ///< compulsory bytes (stage_work.hpp) over the median
    std::optional<double> instructions;  ///< a texel, by this processor's counter
};

struct FrameTiming {
    int cascades, resolution;
    Isa isa;
    int threads;
    Quartiles ms;
    double gb_per_s;
    std::optional<double> instructions;  ///< as a job's; on one thread only
    std::vector<JobTiming> jobs;         ///< on one thread only
    std::size_t memory_bytes;            ///< that the ocean holds: two frames and the spectrum
    std::size_t upload_bytes;            ///< of a frame's textures, all levels

    std::string sea() const { return sea_name(cascades, resolution); }
};

struct Timings {
    std::vector<FrameTiming> frames;  ///< by sea, then instruction set, then threads
    std::string no_counter;           ///< why instructions are not counted; empty if they are
};

/// 1, 2, 4, ... and `most`.
std::vector<int> thread_counts(int max);

/// All instruction sets take turns with a sea's frame on one thread, a direct call, so that what else the machine does meets
/// all of them alike; then all numbers of threads. A turn is some frames of each, after two of warming up or more. On one thread as
/// many frames follow whose jobs are timed, a clock reading before and after each block.
/// \param progress  told after each turn: the sea, and what is done of all, 0 to 1
Timings time_frames(const TimingPlan& plan, const std::function<void(const std::string&, double)>& progress);

}  // namespace pelagic::tools
