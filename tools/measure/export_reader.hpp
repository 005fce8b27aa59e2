// Reading of an export: its sea.json and its heights. The folder is untrusted input. Names must be
// those that an export gives, files must be regular and within the maximum size, and numbers are
// checked before use.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

/// Opens the folder of an existing export. Throws InputError, one line that names the option.
OutputFolder open_export(const std::string& option, const std::filesystem::path& folder, Sync sync);
/// How displacement images store heights.
struct StoredHeights {
    std::size_t channel = 1;       ///< index of the channel, 0 to 2
    float metres = 1;              ///< height that the pixel value 1 represents, metres
    bool overturned_rows = false;  ///< the last row of the image is the first row of the cascade
};

/// Reads the heights of an export. Functions throw InputError if the folder holds no export that
/// can be measured, and FileError if a file cannot be read. The message is one line with the folder
/// or the file, and the reason.
class ExportReader {
   public:
    /// Reads sea.json.
    /// \param option  option that named the folder, for error messages
    ExportReader(std::string option, const std::filesystem::path& folder);

    const ResolvedSea& sea() const { return sea_; }
    std::size_t frames() const { return names_.size(); }
    /// Returns the number of frames of the export; frames() is at most max_frames.
    std::size_t frames_there() const { return frames_there_; }
    /// Returns the time between two frames in seconds; 0 if there is only one.
    double step_s() const { return step_s_; }
    /// Returns the cascades that the export has images of, the coarsest first.
    const std::vector<CascadePlan>& cascades() const { return cascades_; }
    /// Reads the heights of a cascade: N x N values, row by row, in metres.
    std::vector<float> heights(std::size_t frame, std::size_t cascade) const;

    static constexpr std::size_t max_frames = 65536;

   private:
    /// Returns the full name of the file's channel that holds the heights of a cascade.
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
