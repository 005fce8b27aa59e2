// An export read back: its sea.json and its heights. Nothing in the folder is trusted: names are those that an export gives, files
// are regular ones and no larger than such a file can be, and numbers are looked at before they are used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

/// The folder of an export that is there. Throws InputError, one line that names the option.
OutputFolder open_export(const std::string& option, const std::filesystem::path& folder, Sync sync);
/// How the displacement images keep heights.
struct StoredHeights {
    std::size_t channel = 1;       ///< of three
    float metres = 1;              ///< that a pixel's 1 stands for
    bool overturned_rows = false;  ///< the image's last row is the cascade's first
};

/// Throws InputError where the folder holds no export that can be measured, and FileError where a file can't be read: one line
/// that names the folder or the file, and the reason.
class ExportReader {
   public:
    /// Reads sea.json. \param option  that named the folder, for messages
    ExportReader(std::string option, const std::filesystem::path& folder);

    const ResolvedSea& sea() const { return sea_; }
    std::size_t frames() const { return names_.size(); }
    /// How many the export has: those beyond max_frames are left out.
    std::size_t frames_there() const { return frames_there_; }
    /// Between two frames; 0 if there is one.
    double step_s() const { return step_s_; }
    /// The cascades that the export has images of, the coarsest first.
    const std::vector<CascadePlan>& cascades() const { return cascades_; }
    /// The heights of a cascade, N x N, row by row, metres.
    std::vector<float> heights(std::size_t frame, std::size_t cascade) const;

    static constexpr std::size_t max_frames = 65536;

   private:
    /// That holds a cascade's heights, by its name in the file.
    std::string channel_of(std::size_t cascade) const;

    std::string option_;
    OutputFolder folder_;
    ResolvedSea sea_;
    std::vector<CascadePlan> cascades_;
    StoredHeights stored_;
    bool is_packed_ = false;                       ///< all maps of a frame are in one file
    std::vector<std::vector<std::string>> names_;  ///< [frame][cascade]
    std::size_t frames_there_ = 0;
    double step_s_ = 0;
};

}  // namespace pelagic::tools
