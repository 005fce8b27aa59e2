// `pelagic export`: a sea as image files, one set a frame, and sea.json.
#pragma once

#include <memory>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

/// What an ocean is told so that its frames have what the files need. \param trace  may be none
OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace);

/// the dynamic waves the options' events, on the ocean's executor; null without events.
std::unique_ptr<EventPlayer> event_player(const ExportOptions& options, const OceanOptions& how);

/// The frame as it is exported: with the window beside its cascades, whose bounds and figures stay those of the sea alone.
Frame exported_frame(const Frame& frame, EventPlayer* player);

/// Throws InputError and FileError. Prints a summary on stdout, progress on stderr if that is a terminal.
void run_export(const ExportOptions& options);

}  // namespace pelagic::tools
