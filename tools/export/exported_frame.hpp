// The frames of an export, as its options compute them.
#pragma once

#include <memory>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

/// Options of an ocean whose frames have what the files need. \param trace  may be null
OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace);

/// The dynamic waves of the options' events, on the ocean's executor; null without events.
std::unique_ptr<EventPlayer> event_player(const ExportOptions& options, const OceanOptions& how);

/// The frame with the dynamic waves beside its cascades; bounds and statistics stay those of the cascades. \param player  may be null
Frame exported_frame(const Frame& frame, EventPlayer* player);

}  // namespace pelagic::tools
