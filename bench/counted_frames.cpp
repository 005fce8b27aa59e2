#include "pelagic/bench/counted_frames.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "pelagic/bench/peers/fftw_frame.hpp"

namespace pelagic::bench {

std::map<std::string, double> counted_frames(int resolution, Isa isa) {
    if (isa == Isa::avx512) return {};
    const std::filesystem::path plans =
        std::filesystem::temp_directory_path() / ("pelagic-plans-" + std::to_string(getpid()));
    peers::write_fftw_plans(plans);
    const std::string command = std::string("python3 '" PELAGIC_COUNT_SCRIPT "' --of '" PELAGIC_COUNT_FRAMES "' ") +
                                std::string(name_of(isa)) + " " + std::to_string(resolution) + " '" + plans.string() +
                                "'";
    std::map<std::string, double> counts;
    if (const std::unique_ptr<std::FILE, int (*)(std::FILE*)> lines{popen(command.c_str(), "r"), pclose}) {
        char name[32];
        double count = 0;
        while (std::fscanf(lines.get(), "%31s %lf", name, &count) == 2) counts[name] = count;
    }
    std::filesystem::remove(plans);
    return counts;
}

}  // namespace pelagic::bench
