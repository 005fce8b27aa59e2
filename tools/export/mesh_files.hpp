// Computation of the frames of an export, and their mesh files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/files/byte_order.hpp"

namespace pelagic::tools {

struct MeshFile {
    std::string name;
    MeshFormat format;
};

/// Returns the square of the sea in the axes and the unit of the options, with texture coordinates
/// that match the row order of the images.
Mesh exported_mesh(const Frame& frame, const ExportOptions& options);

/// Returns the mesh files of a frame, in the order of records, where they follow the images.
std::vector<MeshFile> mesh_files(const ExportOptions& options, int frame);

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh);

/// Returns the options of an ocean that computes all data that the files need.
/// \param trace  may be null
OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace);

/// Returns the player for the events of the options, on the ocean's executor; null without events.
std::unique_ptr<EventPlayer> event_player(const ExportOptions& options, const OceanOptions& how);

/// Returns the frame with the dynamic waves added beside the cascades. Bounds and statistics are
/// those of the cascades.
/// \param player  may be null
Frame exported_frame(const Frame& frame, EventPlayer* player);

}  // namespace pelagic::tools
