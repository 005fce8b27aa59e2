#include "pelagic/sim/frames/frame_assembly.hpp"

#include <algorithm>
#include <utility>

#include "pelagic/sim/cascades/pond.hpp"
#include "pelagic/sim/cascades/spectral_cascade.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

std::size_t cascade_count_of(const SeaState& sea) { return static_cast<std::size_t>(cascades_of(sea)); }

}  // namespace

FrameAssembly::FrameAssembly(const Forecast& forecast, Isa isa, const FrameContents& contents,
                             const Allocator& memory)
    : isa_(isa),
      weather_(forecast),
      slots_(cascade_count_of(forecast.first), resolution_of(forecast.first), kernels_for(isa).lanes, contents,
             memory, forecast.first.waves == WaveModel::regular),
      at_tick_(slots_.cascade_count()) {
    for (std::size_t cascade = 0; cascade < slots_.cascade_count(); ++cascade) {
        sources_.push_back(source_of(forecast.first.waves, cascade));
        surfaces_.push_back(std::make_unique<SurfaceStages>(slots_, cascade, kernels_for(isa)));
    }
}

void FrameAssembly::add(std::unique_ptr<FramePart> part) {
    if (const TicksDue* const ticks = part->ticks()) ticks_.push_back(ticks);
    parts_.push_back(std::move(part));
}

void FrameAssembly::add_frame_stages(JobGraph& graph, std::span<const StageId> after) {
    std::vector<StageId> surfaces_done;
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade) {
        std::vector<StageId> waits_for;
        if (!after.empty()) waits_for = {after[cascade]};
        if (has_bands(cascade)) {
            ColumnSource& source = *sources_[cascade]->columns();
            surfaces_[cascade]->add_bands_to(graph, source.add_line_stage(graph, Pass::frame, waits_for),
                                             [&source](std::size_t pair) { source.transform(pair); });
            continue;
        }
        surfaces_done.push_back(add_source(graph, Pass::frame, cascade, waits_for));
        surfaces_[cascade]->add_to(graph, surfaces_done.back());
    }
    add_parts(graph, Pass::frame, surfaces_done);
}

std::vector<StageId> FrameAssembly::add_tick_stages(JobGraph& graph) {
    std::vector<StageId> surfaces_done;
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade)
        surfaces_done.push_back(add_source(graph, Pass::tick, cascade, {}));
    add_parts(graph, Pass::tick, surfaces_done);
    return surfaces_done;
}

/// Adds the stages that fill a cascade, and those of the parts that change it.
StageId FrameAssembly::add_source(JobGraph& graph, Pass pass, std::size_t cascade,
                                  const std::vector<StageId>& waits_for) {
    FilledBy filled = sources_[cascade]->add_stages(graph, pass, waits_for);
    for (const auto& part : parts_) filled = part->add_cascade_stages(graph, pass, cascade, filled);
    return filled.displacement;
}

void FrameAssembly::add_parts(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    for (const auto& part : parts_) part->add_stages(graph, pass, surfaces_done);
}

void FrameAssembly::swap_buffers() {
    for (const auto& part : parts_) part->swap_buffers();
    slots_.swap();
}

void FrameAssembly::begin_frame(double time_s, const WaterFrame& water, std::span<const TextureTargets> targets) {
    const DefaultFloatEnvironment environment(time_s);
    slots_.write_textures_to(targets);
    Frame& frame = slots_.frame();
    const SeaMoment moment = weather_.moment_at(time_s);
    frame.time_s = time_s;
    frame.sea = weather_.sea_at(moment);
    frame.sea_changes = !moment.is_steady();
    frame.statistics = weather_.statistics_at(moment);
    frame.isa = isa_;
    frame.water_frame = water;
    begin(Pass::frame, time_s, moment, frame.statistics, slots_.cascades());
}

const TicksDue* FrameAssembly::next_tick() const {
    const TicksDue* next = nullptr;
    for (const TicksDue* const due : ticks_)
        if (due->count > 0 && (!next || due->time_s < next->time_s)) next = due;
    return next;
}

bool FrameAssembly::has_tick_after_next() const {
    const TicksDue* const next = next_tick();
    return std::any_of(ticks_.begin(), ticks_.end(), [&](const TicksDue* due) {
        return due->count > 1 || (due->count == 1 && due->time_s != next->time_s);
    });
}

void FrameAssembly::begin_tick() {
    const DefaultFloatEnvironment environment;
    const TicksDue tick = *next_tick();  // a copy: parts change theirs
    SeaMoment moment = weather_.moment_at(tick.time_s);
    moment.time_s = tick.time_in_loop_s;
    moment.whitecaps_only = std::all_of(ticks_.begin(), ticks_.end(), [&](const TicksDue* due) {
        return due->whitecaps_only || !due->begins_at(tick.time_s);
    });
    begin(Pass::tick, tick.time_s, moment, weather_.statistics_at(moment), at_tick_);
}

/// \param moment  the seas of the pass, and the time of its waves
void FrameAssembly::begin(Pass pass, double time_s, const SeaMoment& moment, const SeaStatistics& statistics,
                          std::span<Cascade> cascades) {
    for (std::size_t cascade = 0; cascade < cascades.size(); ++cascade) {
        sources_[cascade]->begin(pass, moment, cascades[cascade]);
        cascades[cascade].compression_scale = compression_scale(cascade, statistics);
        cascades[cascade].compression_front_x = static_cast<float>(statistics.foam_front_x);
        cascades[cascade].compression_front_z = static_cast<float>(statistics.foam_front_z);
    }
    const PassMoment at{.pass = pass,
                        .time_s = time_s,
                        .time_in_loop_s = moment.time_s,
                        .loop_period_s = weather_.forecast().first.loop_period_s,
                        .statistics = statistics,
                        .cascades = cascades,
                        .whitecaps_only = moment.whitecaps_only};
    for (const auto& part : parts_) part->begin(at);
}

bool FrameAssembly::is_done() const {
    for (const auto& part : parts_)
        if (!part->is_done()) return false;
    return true;
}

const Frame& FrameAssembly::end_frame() {
    slots_.finish_textures();
    Frame& frame = slots_.frame();
    frame.bounds = {};
    for (std::size_t cascade = 0; cascade < sources_.size(); ++cascade)
        slots_.cascade(cascade).bounds = sources_[cascade]->end_frame();
    for (const auto& part : parts_) part->end(frame);
    FrameBounds sum;
    for (const Cascade& cascade : slots_.cascades()) sum += cascade.bounds;
    frame.bounds += sum;
    weather_.need_nothing();
    return frame;
}

void FrameAssembly::drop_frame() {
    for (const auto& part : parts_) part->drop();
    slots_.swap();
    weather_.need_nothing();
}

std::size_t FrameAssembly::texels() const {
    return cascade_count() * static_cast<std::size_t>(resolution()) * static_cast<std::size_t>(resolution());
}

std::size_t FrameAssembly::bytes() const {
    std::size_t bytes = slots_.bytes();
    for (const auto& source : sources_) bytes += source->bytes();
    for (const auto& surface : surfaces_) bytes += sizeof(SurfaceStages) + surface->bytes();
    for (const auto& part : parts_) bytes += part->bytes();
    return bytes;
}

std::unique_ptr<SeaSource> FrameAssembly::source_of(WaveModel waves, std::size_t cascade) {
    if (waves == WaveModel::pond) return std::make_unique<Pond>(slots_, cascade, isa_);
    return std::make_unique<SpectralCascade>(slots_, cascade, kernels_for(isa_));
}

/// Returns whether one stage of a frame computes a cascade's columns and textures.
bool FrameAssembly::has_bands(std::size_t cascade) const {
    return !contents().planes && sources_[cascade]->columns() && TextureBands::are_worthwhile(slots_.resolution());
}

/// Returns Cascade::compression_scale at a moment.
float FrameAssembly::compression_scale(std::size_t cascade, const SeaStatistics& statistics) const {
    if (statistics.foam_level == SeaStatistics::no_foam_level) return 0;
    return static_cast<float>(weather_.foam_weight(cascade) / statistics.compression_deviation);
}

}  // namespace pelagic
