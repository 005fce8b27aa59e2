// What `pelagic export` was asked for, checked.
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

namespace pelagic::tools {

/// Frames side by side in one image, from the upper left one on, row by row.
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
    std::optional<EventOptions> events;  ///< none: the water answers nobody
    std::optional<Shard> shard;          ///< none: all frames are made here
    std::optional<FlipbookGrid> flipbook;
    bool preview = false;  ///< no frames, but what shows what they will be
    bool resume = false;
    bool overwrite = false;  ///< a finished export in the folder may be replaced
    bool sync = true;        ///< a frame counts as done once the disk has it
    bool lock = true;        ///< the folder is locked, so that no other export works in it
    std::optional<std::filesystem::path> trace;

    bool has_foam() const { return maps.has(MapKind::foam) || meshes.any(); }

    /// The numbers of the frames that are made here.
    std::vector<int> frames_here() const {
        return shard ? times.numbers(shard->begin(times.count()), shard->end(times.count()))
                     : times.numbers(0, times.count());
    }
};

class ExportFlags {
   public:
    void add_to(CLI::App& app);
    /// Throws InputError, one line that names option, value and range, and FileError without the library that writes images;
    /// writes nothing.
    ExportOptions resolve() const;

    /// The same of a sea that did not come from these flags; does without the library.
    ExportOptions resolve_with(const ResolvedSea& sea) const;

   private:
    FrameTimes times(const ResolvedSea& sea) const;
    MapOptions maps(const std::optional<NamePattern>& names) const;
    /// As it was typed; none if it wasn't.
    const std::optional<std::string>& typed(const std::string& flag) const { return typed_.at(flag); }

    SeaOptions sea_;
    MeshFlags meshes_;
    EventFlags events_;
    ComputeFlags compute_;
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
    bool mips_ = false, half_ = false, tiled_ = false, preview_ = false, resume_ = false, overwrite_ = false,
         no_sync_ = false, no_lock_ = false;
};

}  // namespace pelagic::tools
