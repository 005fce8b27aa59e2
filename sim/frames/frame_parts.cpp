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
                                 {"velocities", options.velocities != Velocities::none},
                                 {"depth", options.depth},
                                 {"dynamic_waves", options.dynamic_waves.has_value()},
                                 {"shore", options.shore.has_value()},
                                 {"spray", options.spray.has_value()},
                                 {"inputs", !options.inputs.empty()}})
        if (option.is_on && !options.planes)
            return std::string(option.name) + " cannot be combined with an ocean without planes";
    if (const FrameContents contents = contents_of(options, forecast.first); !contents.slopes) {
        if (contents.foam) return "foam cannot be combined with an ocean without slopes";
        if (!contents.gradients) return "gradients and slopes are off, expected one of them on";
    }
    if (forecast.first.waves == WaveModel::pond && options.velocities == Velocities::water)
        return "velocities water cannot be combined with waves pond, which have no motion of their own";
    if (!options.shore) return {};
    if (std::string reason = check(*options.shore, forecast.first); !reason.empty()) return reason;
    return forecast.changes.empty() ? std::string() : "a forecast with changes cannot be combined with a shore";
}

// Displacement as half floats is computed together with one of the maps, so a frame has gradients or
// slopes. The compression of foam is computed together with slopes.
FrameContents contents_of(const OceanOptions& options, const SeaState& sea) {
    const bool is_stack = cascades_of(sea) > 1;
    const bool gradients = options.gradients.value_or(!is_stack || !options.slopes.value_or(true));
    return {.queries = options.queries,
            .velocities = options.velocities,
            .depth = options.depth,
            .gradients = gradients,
            .slopes = options.slopes.value_or(is_stack || options.foam || !gradients),
            .foam = options.foam,
            .planes = options.planes};
}

// Dynamic waves come first, so that their ticks start before the frame's stages.
CommandedParts add_parts(FrameAssembly& frames, const Forecast& forecast, const OceanOptions& options,
                        const std::shared_ptr<Executor>& executor, Isa isa) {
    const Kernels& kernels = kernels_for(isa);
    FrameSlots& slots = frames.slots();
    CommandedParts commanded;
    const ShoreSource* shore = nullptr;
    if (options.dynamic_waves) {
        const DynamicWaves::Resources resources{
            .executor = executor, .isa = isa, .trace = options.trace, .memory = options.memory};
        auto part = std::make_unique<DynamicWavesPart>(*options.dynamic_waves, resources, executor->runs_ahead());
        commanded.dynamic_waves = &part->waves();
        frames.add(std::move(part));
    }
    if (options.queries) frames.add(std::make_unique<FoldStages>(slots, kernels));
    if (options.shore) {
        auto part = std::make_unique<ShoreSource>(*options.shore, forecast.first, plan_cascades(forecast), kernels,
                                                  *executor, options.memory, options.spray.has_value());
        shore = part.get();
        frames.add(std::move(part));
    }
    if (!options.inputs.empty()) frames.add(std::make_unique<WaveInputs>(options.inputs, slots, isa));
    if (options.foam)
        frames.add(std::make_unique<FoamPart>(slots, frames.weather(), kernels, options.inputs.empty()));
    if (options.spray) {
        auto part = std::make_unique<SprayPart>(*options.spray, slots, frames.weather(), shore);
        commanded.spray = part.get();
        frames.add(std::move(part));
    }
    return commanded;
}

}  // namespace pelagic
