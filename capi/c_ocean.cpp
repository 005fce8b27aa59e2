#include "pelagic/capi/c_ocean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "pelagic/capi/c_executor.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/c_wave_input.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/jobs/platform.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic::capi {

QueryFrames::Reader::Reader(QueryFrames& frames, std::uint64_t number) {
    if (number == 0) {
        enter_current(frames);
        return;
    }
    for (Slot& slot : frames.slots_) {
        slot_ = &slot;
        ++slot.readers;
        if (slot.number == number) return;
        leave();
    }
    slot_ = nullptr;
}

void QueryFrames::Reader::enter_current(QueryFrames& frames) {
    for (;;) {
        slot_ = frames.current_;
        if (!slot_) return;
        ++slot_->readers;
        if (slot_ == frames.current_) return;
        leave();
    }
}

void QueryFrames::Reader::leave() {
    if (slot_ && --slot_->readers == 0) wake_all(slot_->readers);
}

std::uint64_t QueryFrames::set_current(const Frame& frame, const std::optional<SurfaceQuery>& query) {
    newest_ = 1 - newest_;
    Slot& slot = slots_[newest_];
    slot.frame = frame;
    slot.query = query;
    slot.number = ++count_;
    current_ = &slot;
    return count_;
}

void QueryFrames::wait_for_old_readers() {
    slots_[1 - newest_].number = 0;
    const std::atomic<std::uint32_t>& readers = slots_[1 - newest_].readers;
    for (std::uint32_t now = readers; now != 0; now = readers) wait_while(readers, now);
}

void need_no_frame_in_flight(const pelagic_ocean& ocean) {
    if (ocean.frame_in_flight) throw WrongOrder("a frame is in flight; call pelagic_ocean_complete first");
}

void need_frame(const pelagic_ocean& ocean) {
    if (!ocean.current) throw WrongOrder("there is no frame yet; call pelagic_ocean_complete first");
}

std::optional<Isa> isa_of(const char* name) {
    if (!name) return {};
    const std::optional<Isa> isa = isa_named(name);
    if (!isa) reject(invalid_value_message("isa", name, "sse4.2, avx2, avx512 or neon"));
    return isa;
}

Allocator allocator_of(pelagic_allocate allocate, pelagic_release release, void* user) {
    if (!allocate != !release) reject("allocate or release is NULL, expected both or neither");
    return {user, allocate, release};
}

void write_saved(const std::vector<std::uint8_t>& saved, std::uint8_t* bytes, std::size_t room, std::size_t* count) {
    std::size_t& there = needed(count, "count");
    if (bytes && room < saved.size())
        reject(invalid_value_message("room", room, number_text(saved.size()) + " or more"));
    if (bytes) std::copy(saved.begin(), saved.end(), bytes);
    there = saved.size();
}

namespace {

constexpr double min_tolerance_m = 1e-6, max_tolerance_m = 1000;

double query_tolerance_m(const pelagic_ocean_options& options) {
    const double wanted = options.query_tolerance_m;
    if (wanted == 0) return SurfaceQuery::default_tolerance_m;
    if (!(wanted >= min_tolerance_m && wanted <= max_tolerance_m))
        reject(invalid_value_message("query_tolerance_m", wanted, "0 or [1e-6, 1000]"));
    return wanted;
}

std::optional<bool> textures_of(const char* name, std::int32_t textures) {
    switch (textures) {
        case PELAGIC_TEXTURES_DEFAULT: return {};
        case PELAGIC_TEXTURES_ON: return true;
        case PELAGIC_TEXTURES_OFF: return false;
        default: reject(invalid_value_message(name, textures, "0, 1 or 2"));
    }
}

void need_finite(double time_s) {
    if (!std::isfinite(time_s)) reject(invalid_value_message("time_s", time_s, "a finite number"));
}

void need_frame_in_flight(const pelagic_ocean& ocean) {
    if (!ocean.frame_in_flight) throw WrongOrder("no frame is in flight; call pelagic_ocean_schedule first");
}

void need_sea_in_flight(const pelagic_ocean& ocean) {
    if (!ocean.sea_in_flight) throw WrongOrder("no sea is being baked; call pelagic_ocean_schedule_sea first");
}

pelagic_plane plane_of(const PlaneView& view) {
    return {view.data, view.resolution, view.block_columns, view.row_stride, view.block_stride};
}

pelagic_bounds bounds_of(const FrameBounds& bounds) {
    return {bounds.height_min_m, bounds.height_max_m, bounds.horizontal_x_max_m, bounds.horizontal_z_max_m};
}

constexpr int max_levels = 12;
static_assert(mip_levels(2048) == max_levels);

/// Writes the first texel of each level of a chain.
void write_offsets(int resolution, std::uint32_t (&offset)[max_levels]) {
    for (int level = 0; level < mip_levels(resolution); ++level)
        offset[level] = static_cast<std::uint32_t>(mip_offset(resolution, level));
}

/// Writes the fields that pelagic_frame and pelagic_cascade share: planes and textures.
template <class T>
void write_surface(const Cascade& cascade, T& out) {
    out.resolution = cascade.resolution();
    out.dx = plane_of(cascade.dx);
    out.height = plane_of(cascade.height);
    out.dz = plane_of(cascade.dz);
    out.velocity_x = plane_of(cascade.velocity_x);
    out.velocity_y = plane_of(cascade.velocity_y);
    out.velocity_z = plane_of(cascade.velocity_z);
    out.displacement_rgba16f = cascade.displacement_rgba16f.data();
    out.gradient_rgba8 = cascade.gradient_rgba8.data();
}

pelagic_frame c_frame_of(const Frame& frame, std::uint64_t number) {
    pelagic_frame out{};
    out.number = number;
    const Cascade& first = frame.cascades.front();
    write_surface(first, out);
    out.time_s = frame.time_s;
    out.patch_size_m = first.grid.side_m;
    if (!first.gradient_rgba8.empty()) {
        out.gradient_levels = mip_levels(first.resolution());
        write_offsets(first.resolution(), out.gradient_offset);
    }
    out.bounds = bounds_of(frame.bounds);
    out.cascade_count = static_cast<std::int32_t>(frame.cascades.size());
    out.roughness = static_cast<float>(frame.statistics.roughness);
    out.foam_drift_x_mps = frame.statistics.foam_drift_x_mps;
    out.foam_drift_z_mps = frame.statistics.foam_drift_z_mps;
    out.foam_level = frame.foam.level;
    std::copy(frame.foam.age.begin(), frame.foam.age.end(), out.foam_age);
    out.wave_height_m = frame.statistics.significant_wave_height_m;
    // A droplet of C++ has the members of one of C, without gaps.
    static_assert(sizeof(SprayDroplet) == sizeof(pelagic_droplet) &&
                  offsetof(SprayDroplet, velocity_x_mps) == offsetof(pelagic_droplet, velocity_mps) &&
                  offsetof(SprayDroplet, age_s) == offsetof(pelagic_droplet, age_s));
    out.droplets = reinterpret_cast<const pelagic_droplet*>(frame.droplets.data());
    out.droplet_count = frame.droplets.size();
    return out;
}

pelagic_cascade c_cascade_of(const Cascade& cascade) {
    pelagic_cascade out{};
    write_surface(cascade, out);
    out.side_m = cascade.grid.side_m;
    out.cosine = cascade.grid.cosine;
    out.sine = cascade.grid.sine;
    out.slopes_rgba8 = cascade.slopes_rgba8.data();
    out.moments_rgba8 = cascade.moments_rgba8.data();
    out.slope_range = cascade.slope_ranges.slope;
    out.variance_range = cascade.slope_ranges.variance;
    out.levels = mip_levels(cascade.resolution());
    write_offsets(cascade.resolution(), out.level_offset);
    out.bounds = bounds_of(cascade.bounds);
    out.compression_r8 = cascade.compression_r8.data();
    for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
        out.snapshots_rgba8[image] = cascade.snapshots_rgba8[image].data();
        out.snapshots_version[image] = cascade.snapshots_version[image];
    }
    out.drift_columns = cascade.drift_columns;
    out.drift_rows = cascade.drift_rows;
    out.compression_scale = cascade.compression_scale;
    out.compression_front_x = cascade.compression_front_x;
    out.compression_front_z = cascade.compression_front_z;
    return out;
}

/// Makes a frame the one that queries, cascade, copy and hash read. Returns its number.
std::uint64_t set_current(pelagic_ocean& ocean, const Frame& frame) {
    ocean.current = &frame;
    std::optional<SurfaceQuery> query;
    if (ocean.ocean.contents().queries) query.emplace(frame, ocean.query_tolerance_m);
    return ocean.query_frames.set_current(frame, query);
}

std::uint64_t hash_of_kind(const Frame& frame, std::int32_t kind) {
    const auto need = [](bool has, const char* option) {
        if (!has)
            reject(std::string("the ocean has no ") + option + ": it was created without pelagic_ocean_options." +
                   option);
    };
    switch (kind) {
        case PELAGIC_HASH_FRAME: return hash_of(frame);
        case PELAGIC_HASH_FOAM: need(frame.has_foam, "foam"); return foam_hash_of(frame);
        case PELAGIC_HASH_DYNAMIC_WAVES:
            need(static_cast<bool>(frame.dynamic_waves), "dynamic_waves");
            return hash_of(frame.dynamic_waves);
        case PELAGIC_HASH_SHORE: need(static_cast<bool>(frame.shore), "shore"); return shore_hash_of(frame);
        case PELAGIC_HASH_SPRAY: return spray_hash_of(frame);
        default: reject(invalid_value_message("kind", kind, "one of PELAGIC_HASH_..."));
    }
}

FrameBuffers ours_of(const pelagic_frame_buffers& buffers) {
    const auto array = []<class T>(T* data, std::size_t count) {
        // A pointer with a count of 0 is an error, so it becomes a count of 1, which no check
        // accepts.
        return data ? std::span<T>(data, count == 0 ? 1 : count) : std::span<T>();
    };
    return {.dx = array(buffers.dx, buffers.plane_count),
            .height = array(buffers.height, buffers.plane_count),
            .dz = array(buffers.dz, buffers.plane_count),
            .velocity_x = array(buffers.velocity_x, buffers.plane_count),
            .velocity_y = array(buffers.velocity_y, buffers.plane_count),
            .velocity_z = array(buffers.velocity_z, buffers.plane_count),
            .displacement_rgba16f = array(buffers.displacement_rgba16f, buffers.rgba16f_count),
            .gradient_rgba8 = array(buffers.gradient_rgba8, buffers.rgba8_count),
            .slopes_rgba8 = array(buffers.slopes_rgba8, buffers.slopes_count),
            .moments_rgba8 = array(buffers.moments_rgba8, buffers.slopes_count)};
}

/// Converts a struct that read_struct() has read.
TextureTargets ours_of(const pelagic_texture_targets& targets) {
    return {.displacement_rgba16f = targets.displacement_rgba16f,
            .gradient_rgba8 = std::to_array(targets.gradient_rgba8),
            .slopes_rgba8 = std::to_array(targets.slopes_rgba8),
            .moments_rgba8 = std::to_array(targets.moments_rgba8)};
}

/// The application's array of structs, one for each cascade of a frame, all of the size of the
/// first.
template <class Theirs, class Ours>
class OfEachCascade {
   public:
    /// Reads the array. Throws std::invalid_argument for null and a wrong struct_size.
    OfEachCascade(const Theirs* first, const std::string& name, std::size_t cascade_count) : count_(cascade_count) {
        // Checked before reading beyond the first struct: the application may have only one.
        struct_bytes(first, name.c_str());
        if (std::max(first->cascade_count, 1u) != count_)
            reject(invalid_value_message(name + ".cascade_count", first->cascade_count,
                                         number_text(count_) + ", with as many structs one after the other"));
        std::size_t read = 0;
        read_structs(first, count_, name, [&](const Theirs& cascade, const std::string& element) {
            if (read > 0 && cascade.cascade_count != 0)
                reject(invalid_value_message(element + ".cascade_count", cascade.cascade_count, "0"));
            cascades_[read++] = ours_of(cascade);
        });
    }
    std::span<const Ours> all() const { return {cascades_.data(), count_}; }

   private:
    static constexpr std::size_t max_cascades = 4;
    std::array<Ours, max_cascades> cascades_;
    std::size_t count_;
};

using ApplicationBuffers = OfEachCascade<pelagic_frame_buffers, FrameBuffers>;
using ApplicationTargets = OfEachCascade<pelagic_texture_targets, TextureTargets>;

}  // namespace

OceanOptions ocean_options_of(const pelagic_ocean_options& from) {
    OceanOptions to;
    // generated from schema/ocean.toml: c-reads
    to.queries = from.queries != 0;
    to.depth = from.depth != 0;
    to.foam = from.foam != 0;
    // end of generated
    to.velocities = enum_of<Velocities>(from.velocities, "", "velocities", "one of PELAGIC_VELOCITIES_...");
    to.planes = from.textures_only == 0;
    to.gradients = textures_of("gradients", from.gradients);
    to.slopes = textures_of("slopes", from.slopes);
    if (from.executor) to.executor = from.executor->executor;
    to.isa = isa_of(from.isa);
    to.memory = allocator_of(from.allocate, from.release, from.memory_user);
    if (from.dynamic_waves) to.dynamic_waves = dynamic_waves_options_of(from.dynamic_waves);
    if (from.shore) to.shore = shore_options_of(from.shore);
    if (from.spray) to.spray = spray_options_of(from.spray);
    to.inputs = inputs_of(from.inputs, from.input_count);
    return to;
}

WaterFrame water_frame_of(const pelagic_water_frame* water) {
    const pelagic_water_frame from = read_struct(water, "water");
    WaterFrame to;
    // generated from schema/water_frame.toml: c-reads
    to.sea_level_m = from.sea_level_m;
    to.current_x_mps = from.current_x_mps;
    to.current_z_mps = from.current_z_mps;
    // end of generated
    return to;
}

void schedule_frame(pelagic_ocean& ocean, double time_s) {
    need_no_frame_in_flight(ocean);
    need_finite(time_s);
    ocean.query_frames.wait_for_old_readers();
    ocean.ocean.schedule(time_s);
    ocean.frame_in_flight = true;
    ocean.scheduled_s = time_s;
}

std::uint64_t complete_frame(pelagic_ocean& ocean) {
    need_frame_in_flight(ocean);
    ocean.frame_in_flight = false;  // also if complete() throws
    const Frame& completed = ocean.ocean.complete();
    ocean.has_completed = true;
    return set_current(ocean, completed);
}

pelagic_frame c_frame_of(const pelagic_ocean& ocean, std::uint64_t number) {
    return c_frame_of(*ocean.current, number);
}

pelagic_ocean* new_ocean(const Forecast& forecast, const pelagic_ocean_options* options) {
    const pelagic_ocean_options wanted = options ? read_struct(options, "options") : pelagic_ocean_options_make();
    OceanOptions ours = ocean_options_of(wanted);
    if (!ours.executor) ours.executor = make_default_executor();  // queries use it, too
    auto* const ocean = new pelagic_ocean(forecast, std::move(ours), query_tolerance_m(wanted));
    for (std::size_t i = 0; i < wanted.input_count; ++i) wanted.inputs[i]->has_ocean = true;
    return ocean;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_create(const pelagic_sea* sea, const pelagic_ocean_options* options,
                                    pelagic_ocean** ocean) {
    return guarded([&] {
        pelagic_ocean*& out = needed(ocean, "ocean");
        out = nullptr;
        const Forecast forecast{.first = sea_of(sea)};
        if (const std::string reason = check(forecast.first); !reason.empty()) reject(reason);
        out = new_ocean(forecast, options);
    });
}

void pelagic_ocean_destroy(pelagic_ocean* ocean) { delete ocean; }

pelagic_status pelagic_ocean_describe(const pelagic_ocean* ocean, pelagic_ocean_info* info) {
    return guarded([&] {
        const Ocean& sea = needed(ocean, "ocean").ocean;
        pelagic_ocean_info& out = needed(info, "info");
        out.resolution = sea.resolution();
        out.cascade_count = static_cast<std::int32_t>(sea.cascade_count());
        out.threads = sea.executor().thread_limit();
        out.memory_bytes = sea.memory_bytes();
        out.isa = name_of(sea.isa()).data();          // names are literals, so they end in 0
        out.executor = sea.executor().name().data();  // a literal too
    });
}

pelagic_status pelagic_ocean_set_water_frame(pelagic_ocean* ocean, const pelagic_water_frame* water) {
    return guarded([&] {
        Ocean& sea = needed(ocean, "ocean").ocean;
        sea.set_water_frame(water_frame_of(water));
    });
}

pelagic_status pelagic_ocean_set_origin(pelagic_ocean* ocean, double x_m, double z_m) {
    return guarded([&] { needed(ocean, "ocean").ocean.set_origin(x_m, z_m); });
}

pelagic_status pelagic_ocean_schedule(pelagic_ocean* ocean, double time_s) {
    return guarded([&] { schedule_frame(needed(ocean, "ocean"), time_s); });
}

pelagic_status pelagic_ocean_schedule_into(pelagic_ocean* ocean, double time_s,
                                           const pelagic_texture_targets* targets) {
    return guarded([&] {
        need_no_frame_in_flight(needed(ocean, "ocean"));
        need_finite(time_s);
        Ocean& sea = ocean->ocean;
        const ApplicationTargets to(targets, "targets", sea.cascade_count());
        if (const std::string reason = check(to.all(), sea.cascade_count(), sea.resolution(), sea.contents());
            !reason.empty())
            reject("targets: " + reason);
        ocean->query_frames.wait_for_old_readers();
        sea.schedule(time_s, to.all());
        ocean->frame_in_flight = true;
        ocean->scheduled_s = time_s;
    });
}

pelagic_status pelagic_ocean_poll(const pelagic_ocean* ocean, int32_t* is_ready) {
    return guarded([&] {
        const Ocean& sea = needed(ocean, "ocean").ocean;
        needed(is_ready, "is_ready") = sea.is_ready();
    });
}

pelagic_status pelagic_ocean_complete(pelagic_ocean* ocean, pelagic_frame* frame) {
    return guarded([&] {
        need_frame_in_flight(needed(ocean, "ocean"));
        pelagic_frame& out = needed(frame, "frame");
        out = c_frame_of(*ocean, complete_frame(*ocean));
    });
}

pelagic_status pelagic_ocean_cascade(const pelagic_ocean* ocean, int32_t index, pelagic_cascade* cascade) {
    return guarded([&] {
        need_frame(needed(ocean, "ocean"));
        pelagic_cascade& out = needed(cascade, "cascade");
        const std::span<const Cascade> cascades = ocean->current->cascades;
        if (index < 0 || static_cast<std::size_t>(index) >= cascades.size())
            reject(invalid_value_message("index", index,
                                         cascades.size() == 1 ? "0" : "0 to " + number_text(cascades.size() - 1)));
        out = c_cascade_of(cascades[static_cast<std::size_t>(index)]);
    });
}

pelagic_status pelagic_ocean_copy(const pelagic_ocean* ocean, const pelagic_frame_buffers* buffers) {
    return guarded([&] {
        need_frame(needed(ocean, "ocean"));
        copy_frame(*ocean->current, ApplicationBuffers(buffers, "buffers", ocean->current->cascades.size()).all());
    });
}

pelagic_status pelagic_ocean_frame_at(pelagic_ocean* ocean, double time_s, const pelagic_frame_buffers* buffers,
                                      pelagic_bounds* bounds) {
    return guarded([&] {
        need_no_frame_in_flight(needed(ocean, "ocean"));
        need_finite(time_s);
        Ocean& sea = ocean->ocean;
        const ApplicationBuffers to(buffers, "buffers", sea.cascade_count());
        if (const std::string reason = check(to.all(), sea.cascade_count(), sea.resolution(), sea.contents());
            !reason.empty())
            reject(reason);
        ocean->query_frames.wait_for_old_readers();
        FrameBounds all;
        if (ocean->has_completed) {
            all = sea.frame_at(time_s, to.all());
        } else {
            const Frame& frame = sea.frame_at(time_s);
            set_current(*ocean, frame);
            copy_frame(frame, to.all());
            all = frame.bounds;
        }
        if (bounds) *bounds = bounds_of(all);
    });
}

pelagic_status pelagic_ocean_frame_hash(const pelagic_ocean* ocean, uint64_t frame, int32_t kind, uint64_t* hash) {
    return guarded([&] {
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, frame);
        if (kind == PELAGIC_HASH_SPRAY && !ocean->has_spray)
            reject("the ocean has no spray: it was created without pelagic_ocean_options.spray");
        needed(hash, "hash") = hash_of_kind(needed_frame(reader, frame), kind);
    });
}

const char* pelagic_isa_at(int32_t index) {
    const char* name = nullptr;
    guarded([&] {
        const std::vector<Isa> here = isas_here();
        if (index >= 0 && static_cast<std::size_t>(index) < here.size())
            name = name_of(here[static_cast<std::size_t>(index)]).data();  // a literal
    });
    return name;
}

pelagic_status pelagic_ocean_schedule_sea(pelagic_ocean* ocean, const pelagic_sea* sea) {
    return guarded([&] {
        if (needed(ocean, "ocean").sea_in_flight)
            throw WrongOrder("a sea is being baked; call pelagic_ocean_complete_sea first");
        ocean->ocean.schedule_sea(sea_of(sea));
        ocean->sea_in_flight = true;
    });
}

pelagic_status pelagic_ocean_poll_sea(const pelagic_ocean* ocean, int32_t* is_ready) {
    return guarded([&] {
        const Ocean& sea = needed(ocean, "ocean").ocean;
        needed(is_ready, "is_ready") = sea.sea_is_ready();
    });
}

pelagic_status pelagic_ocean_complete_sea(pelagic_ocean* ocean) {
    return guarded([&] {
        need_no_frame_in_flight(needed(ocean, "ocean"));
        need_sea_in_flight(*ocean);
        ocean->sea_in_flight = false;  // also if complete_sea() throws
        ocean->ocean.complete_sea();
    });
}
