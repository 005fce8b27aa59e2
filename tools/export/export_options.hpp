// Parsed and checked options of `pelagic export`.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/export/frame_times.hpp"
#include "pelagic/tools/export/mesh_options.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/maps/map_options.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"
#include "pelagic/tools/options/water_frame_options.hpp"

namespace pelagic::tools {

/// Layout of a flipbook: frames row by row, starting at the upper left.
struct FlipbookGrid {
    int columns, rows;
};

struct ExportOptions {
    ResolvedSea sea;
    ComputeOptions compute;
    std::filesystem::path folder;
    FrameTimes times;  ///< of the whole export
    MapOptions maps;
    MeshOptions meshes;
    std::optional<EventOptions> events;  ///< none: no dynamic waves
    WaterFrame water_frame;              ///< recorded only: files are in the water's frame
    std::optional<Shard> shard;          ///< none: this process makes all frames
    std::optional<FlipbookGrid> flipbook;
    bool preview = false;  ///< makes a preview instead of frames
    bool resume = false;
    bool overwrite = false;  ///< replaces a finished export in the folder
    bool sync = true;        ///< syncs each frame to the disk before it counts as done
    bool lock = true;        ///< locks the folder against other exports
    std::optional<std::filesystem::path> trace;

    bool has_foam() const { return maps.has(MapKind::foam) || meshes.any(); }

    /// Returns the numbers of the frames that this process makes.
    std::vector<int> frames_here() const {
        return shard ? times.numbers(shard->begin(times.count()), shard->end(times.count()))
                     : times.numbers(0, times.count());
    }
};

class ExportFlags {
   public:
    void add_to(CLI::App& app);
    /// Parses and checks the options. Writes no files.
    /// \throws InputError  one line with option, value and range
    /// \throws FileError  if the library that writes images is missing
    ExportOptions resolve() const;

    /// Parses and checks the options except those of the sea, which the caller passes. Does not
    /// load the library that writes images. Throws InputError.
    ExportOptions resolve_with(const ResolvedSea& sea) const;

   private:
    FrameTimes times(const ResolvedSea& sea) const;
    MapOptions maps(const std::optional<NamePattern>& names) const;
    FoamPatch foam_patch() const;
    /// Returns the text of an option; none if it is not given.
    const std::optional<std::string>& typed(const std::string& flag) const { return typed_.at(flag); }

    SeaOptions sea_{paper_loop_period_s};
    MeshFlags meshes_;
    EventFlags events_;
    WaterFrameFlags water_frame_;
    ComputeFlags compute_;
    /// text of each option by name, without dashes; none if not given
    std::map<std::string, std::optional<std::string>> typed_;
    bool mips_ = false, half_ = false, tiled_ = false, preview_ = false, resume_ = false, overwrite_ = false,
         no_sync_ = false, no_lock_ = false;
};

}  // namespace pelagic::tools
