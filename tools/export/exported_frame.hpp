// Computation of the frames of an export.
#pragma once

#include <memory>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

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
