// What `pelagic export` was asked for, checked.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pelagic/simd/isa.hpp"
#include "pelagic/tools/image_writer.hpp"
#include "pelagic/tools/sea_options.hpp"

namespace pelagic::tools {

/// --threads and --isa: how a command computes, never what.
struct ComputeOptions {
    int threads = 0;
    std::optional<Isa> isa;
};

/// Declares and checks --threads and --isa.
class ComputeFlags {
   public:
    void add_to(CLI::App& app);
    ComputeOptions resolve() const;  ///< throws InputError
    bool names_isa() const;          ///< here or by PELAGIC_ISA

   private:
    std::optional<std::string> threads_, isa_;
};

struct ExportOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    std::filesystem::path folder;
    double start_s = 0;
    int frames = 1;
    std::optional<double> fps;  ///< none: the frames are one loop
    bool displacement = true;
    bool gradient = true;
    bool foam = false;
    bool mips = false;
    bool half = false;
    ImageFormat format = ImageFormat::exr_and_png;
    bool resume = false;
    bool sync = true;  ///< a frame counts as done once the disk has it
    bool lock = true;  ///< the folder is locked, so that no other export works in it
    std::optional<std::filesystem::path> trace;

    double time_of(int frame) const {
        if (fps) return start_s + frame / *fps;
        return start_s + frame * (sea.sea.loop_period_s / frames);
    }
};

class ExportFlags {
   public:
    void add_to(CLI::App& app);
    /// Throws InputError, one line that names option, value and range, and FileError without the library that writes images;
    /// writes nothing.
    ExportOptions resolve() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
    bool mips_ = false, half_ = false, resume_ = false, no_sync_ = false, no_lock_ = false;
};

}  // namespace pelagic::tools
