#include "pelagic/sim/frames/frame_parts.hpp"

#include <utility>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/wave_inputs.hpp"
#include "pelagic/sim/frames/dynamic_waves_part.hpp"
#include "pelagic/sim/frames/foam_part.hpp"
#include "pelagic/sim/shore/shore_source.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"

namespace pelagic {

std::string check_parts(const Forecast& forecast, const OceanOptions& options) {
    struct Option {
        const char* name;
        bool is_on;
    };
    for (const Option& option : {Option{"queries", options.queries},
                                 {"velocities", options.velocities},
                                 {"dynamic_waves", options.dynamic_waves.has_value()},
                                 {"shore", options.shore.has_value()},
                                 {"inputs", !options.inputs.empty()}})
        if (option.is_on && !options.planes)
            return std::string(option.name) + " cannot be combined with an ocean without planes";
    if (!options.shore) return {};
    if (std::string reason = check(*options.shore, forecast.first); !reason.empty()) return reason;
    return forecast.changes.empty() ? std::string() : "a forecast with changes cannot be combined with a shore";
}

// Dynamic waves come first, so that their ticks start before the frame's stages.
DynamicWaves* add_parts(FrameAssembly& frames, const Forecast& forecast, const OceanOptions& options,
                        const std::shared_ptr<Executor>& executor, Isa isa) {
    const Kernels& kernels = kernels_for(isa);
    FrameSlots& slots = frames.slots();
    DynamicWaves* dynamic_waves = nullptr;
    if (options.dynamic_waves) {
        const DynamicWaves::Resources resources{
            .executor = executor, .isa = isa, .trace = options.trace, .memory = options.memory};
        auto part = std::make_unique<DynamicWavesPart>(*options.dynamic_waves, resources, executor->runs_ahead());
        dynamic_waves = &part->waves();
        frames.add(std::move(part));
    }
    if (options.queries) frames.add(std::make_unique<FoldStages>(slots, kernels));
    if (options.shore)
        frames.add(std::make_unique<ShoreSource>(*options.shore, forecast.first, plan_cascades(forecast), kernels,
                                                 *executor, options.memory));
    if (!options.inputs.empty())
        frames.add(std::make_unique<WaveInputs>(options.inputs, slots, isa, options.velocities));
    if (options.foam)
        frames.add(std::make_unique<FoamPart>(slots, frames.weather(), kernels, options.inputs.empty(),
                                              options.memory));
    return dynamic_waves;
}

}  // namespace pelagic
