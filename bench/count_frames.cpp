// Runs frames of Pelagic and its peers between marks, for instruction counts by instructions.py.
//
//   pelagic_count_frames ISA N PLANS    PLANS: a file of write_fftw_plans()
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "pelagic/bench/instructions/count_marks.hpp"
#include "pelagic/bench/peers/fftw_frame.hpp"
#include "pelagic/bench/peers/kiss_frame.hpp"
#include "pelagic/bench/peers/paper_frame.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic {
namespace {

/// Counts the second frame; the first one touches all memory.
template <class Frames>
void count_frame(const std::string& name, int resolution, Frames&& frames) {
    frames.frame_at(0.5);
    bench::counted(name, static_cast<double>(resolution) * resolution, [&] { frames.frame_at(1); });
}

void count_frames(Isa isa, int resolution, const std::string& plans) {
    const SeaState sea{.resolution = resolution, .patch_size_m = 250, .lean = 0, .roughness = 0.1};
    count_frame("ours", resolution, Ocean(sea, {.executor = make_serial_executor(), .isa = isa, .planes = false}));
    peers::read_fftw_plans(plans);
    using peers::FftwFrame, peers::FftwPlanning, peers::FieldArrangement, peers::KissFrame;
    count_frame("fftw_packed", resolution, FftwFrame(sea, isa, FieldArrangement::packed, FftwPlanning::read));
    count_frame("fftw_separate", resolution, FftwFrame(sea, isa, FieldArrangement::separate, FftwPlanning::read));
    count_frame("kiss_packed", resolution, KissFrame(sea, isa, FieldArrangement::packed));
    count_frame("kiss_separate", resolution, KissFrame(sea, isa, FieldArrangement::separate));
    count_frame("paper", resolution, peers::PaperFrame(sea));
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    try {
        if (argc != 4) throw std::invalid_argument("needs an instruction set, N and FFTW's plans");
        pelagic::count_frames(pelagic::choose_isa(pelagic::isa_named(argv[1])), std::stoi(argv[2]), argv[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pelagic_count_frames: %s\n", error.what());
        return 2;
    }
}
