#include "pelagic/tools/export/exported_frame.hpp"

namespace pelagic::tools {

OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace) {
    return {.executor = make_default_executor(options.compute.threads),
            .isa = options.compute.isa,
            .trace = trace,
            .velocities = options.maps.has(MapKind::velocity),
            .gradients = options.maps.has(MapKind::gradient),
            .foam = options.has_foam()};
}

std::unique_ptr<EventPlayer> event_player(const ExportOptions& options, const OceanOptions& how) {
    return options.events ? std::make_unique<EventPlayer>(*options.events, how.executor, how.isa) : nullptr;
}

Frame exported_frame(const Frame& frame, EventPlayer* player) {
    Frame exported = frame;
    if (player) exported.dynamic_waves = player->at(frame.time_s);
    return exported;
}

}  // namespace pelagic::tools
