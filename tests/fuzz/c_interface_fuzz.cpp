// Calls the C interface in random order with random values, on two oceans at once. Undefined
// behaviour by the caller (dead handles, short arrays) is avoided; every other call must return a
// status.
#include <pelagic/pelagic.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>

#include "pelagic/tests/fuzz/fuzz.hpp"

namespace {

class Bytes : public pelagic::FuzzBytes {
   public:
    using FuzzBytes::FuzzBytes;

    /// Returns mostly a small number, sometimes any bits.
    double number() {
        const auto byte = take<std::uint8_t>();
        return byte == 255 ? take<double>() : (byte - 100) * 0.25;
    }
};

void must_be_a_status(pelagic_status status) {
    if (status < PELAGIC_OK || status == PELAGIC_INTERNAL_ERROR || status > PELAGIC_APPLICATION_ERROR) std::abort();
    if (status != PELAGIC_OK && *pelagic_last_error() == 0) std::abort();
}

/// Returns a struct, sometimes with another size.
template <class T>
T of_any_size(T value, Bytes& bytes) {
    if (bytes.take<std::uint8_t>() == 255) {
        // Sizes up to 4096 bytes are those of newer applications and are read, so this much memory
        // must be valid. Larger sizes are rejected without reading.
        const auto size = bytes.take<std::uint32_t>();
        if (size <= sizeof(T) || size > 4096) value.struct_size = size;
    }
    return value;
}

/// A struct that the library writes, with bytes that it must not read.
template <class T>
T output(Bytes& bytes) {
    T value;
    std::memset(&value, bytes.take<std::uint8_t>(), sizeof value);
    return value;
}

void in_turn(void*, std::size_t count, void (*job)(void*, std::size_t), void* work) {
    for (std::size_t i = 0; i < count; ++i) job(work, i);
}
void at_once(void*, void (*task)(void*), void* work) { task(work); }

pelagic_sea any_sea(Bytes& bytes) {
    auto sea = of_any_size(pelagic_sea_make(), bytes);
    sea.resolution = 16;
    sea.patch_size_m = 250;
    double* const fields[] = {
        &sea.patch_size_m,   &sea.wind_speed_mps, &sea.wind_direction_rad,  &sea.fetch_m,         &sea.depth_m,
        &sea.choppiness,     &sea.roughness,      &sea.short_wave_cutoff,   &sea.wind_alignment,  &sea.loop_period_s,
        &sea.swell_height_m, &sea.swell_period_s, &sea.swell_direction_rad, &sea.swell_spread_rad,
        &sea.lean};
    for (int changes = bytes.take<std::uint8_t>() % 4; changes > 0; --changes)
        *fields[bytes.take<std::uint8_t>() % std::size(fields)] = bytes.number();
    if (bytes.take<std::uint8_t>() == 255) {
        // Large resolutions are slow but valid.
        const auto resolution = bytes.take<std::int32_t>();
        if (resolution <= 64 || resolution > 2048) sea.resolution = resolution;
        sea.spectrum = bytes.take<std::int32_t>();
    } else {
        sea.spectrum = bytes.take<std::uint8_t>() % 4;
    }
    sea.seed = bytes.take<std::uint16_t>();
    // One byte for both, so that the corpus keeps its layout.
    const auto look = bytes.take<std::uint8_t>();
    sea.spreading = look % 5;
    sea.cascades = look / 5 % 6;
    if (sea.cascades > 1 && look < 250) {
        sea.patch_size_m = 0;
        if (sea.resolution == 16) sea.resolution = 32;
    }
    // Some seeds select seas of few waves, so that the layout of other inputs stays the same.
    if (const std::uint32_t kind = sea.seed / 256 % 16; kind >= 12) {
        sea.waves = static_cast<std::int32_t>(kind % 4);
        sea.wave_count = bytes.take<std::uint8_t>() % 70;
        double* const wave_fields[] = {&sea.longest_wave_m, &sea.shortest_wave_m, &sea.wave_strength,
                                       &sea.wave_height_m, &sea.wave_drag, &sea.regular_height_m,
                                       &sea.regular_period_s};
        *wave_fields[bytes.take<std::uint8_t>() % std::size(wave_fields)] = bytes.number();
    }
    must_be_a_status(pelagic_sea_check(&sea));
    return sea;
}

/// Creates a batch, rings and a callback, as far as they are valid.
std::vector<pelagic_input*> any_inputs(Bytes& bytes) {
    std::vector<pelagic_input*> inputs;
    const auto keep = [&](pelagic_status status, pelagic_input* made) {
        must_be_a_status(status);
        if (made) inputs.push_back(made);
    };
    auto waves = of_any_size(pelagic_waves_make(), bytes);
    double of_waves[4][3];
    for (auto& field : of_waves)
        for (double& value : field) value = bytes.number();
    const auto count = bytes.take<std::uint8_t>();
    waves.count = count == 255 ? SIZE_MAX : count % 4;
    waves.amplitude_m = of_waves[0], waves.wavelength_m = of_waves[1], waves.direction_rad = of_waves[2];
    if (count % 2) waves.phase_rad = of_waves[3];
    waves.choppiness = bytes.number();
    pelagic_input* made = nullptr;
    keep(pelagic_input_create_waves(&waves, &made), made);
    if (made) must_be_a_status(pelagic_input_set_waves(made, &waves));
    auto ripple = of_any_size(pelagic_ripple_make(), bytes);
    for (double* const field :
         {&ripple.x_m, &ripple.z_m, &ripple.wavelength_m, &ripple.amplitude_m, &ripple.reach_m, &ripple.phase_rad})
        *field = bytes.number();
    made = nullptr;
    keep(pelagic_input_create_ripple(&ripple, &made), made);
    auto callback = of_any_size(pelagic_input_callback_make(), bytes);
    static float value;
    value = static_cast<float>(bytes.number());
    callback.add = [](void* user, const pelagic_input_rows* rows) {
        rows->height[rows->resolution - 1] = *static_cast<const float*>(user);
    };
    callback.user = &value;
    callback.cascades = bytes.take<std::uint8_t>();
    callback.largest_slope = bytes.number();
    made = nullptr;
    keep(pelagic_input_create_callback(&callback, &made), made);
    return inputs;
}

template <class T, std::size_t count>
void change(Bytes& bytes, T& options, double T::*const (&fields)[count]) {
    for (int changes = bytes.take<std::uint8_t>() % 4; changes > 0; --changes)
        options.*fields[bytes.take<std::uint8_t>() % count] = bytes.number();
}

pelagic_dynamic_waves_options any_dynamic_waves(Bytes& bytes) {
    auto dynamic_waves = of_any_size(pelagic_dynamic_waves_options_make(), bytes);
    dynamic_waves.resolution = 64;
    const auto kind = bytes.take<std::uint8_t>();
    dynamic_waves.step = kind % 3;
    if (kind > 250) {
        // Large resolutions are slow but valid.
        const auto resolution = bytes.take<std::int32_t>();
        if (resolution <= 64 || resolution > 1024) dynamic_waves.resolution = resolution;
        dynamic_waves.ticks_per_s = bytes.take<std::int32_t>();
    }
    change(bytes, dynamic_waves,
           {&pelagic_dynamic_waves_options::side_m, &pelagic_dynamic_waves_options::border_m,
            &pelagic_dynamic_waves_options::depth_m, &pelagic_dynamic_waves_options::viscosity_m2ps,
            &pelagic_dynamic_waves_options::wave_speed_mps, &pelagic_dynamic_waves_options::decay_per_s,
            &pelagic_dynamic_waves_options::foam_height_m});
    return dynamic_waves;
}

/// \param heights heights of the floor; must live until the ocean has been created
pelagic_shore_options any_shore(Bytes& bytes, std::array<float, 64>& heights) {
    auto shore = of_any_size(pelagic_shore_options_make(), bytes);
    shore.resolution = 64;
    for (float& height : heights) height = static_cast<float>(bytes.number());
    const auto kind = bytes.take<std::uint8_t>();
    shore.columns = kind % 9;
    shore.rows = kind / 9 % 9;
    shore.heights_m = kind > 250 ? nullptr : heights.data();
    shore.metres_per_sample = 20;
    change(
        bytes, shore,
        {&pelagic_shore_options::corner_x_m, &pelagic_shore_options::corner_z_m,
         &pelagic_shore_options::metres_per_sample, &pelagic_shore_options::fade_m, &pelagic_shore_options::swash_m});
    return shore;
}

pelagic_ocean* any_ocean(Bytes& bytes) {
    auto executor_options = of_any_size(pelagic_executor_options_make(), bytes);
    constexpr std::int32_t kinds[] = {PELAGIC_EXECUTOR_SERIAL, PELAGIC_EXECUTOR_APPLICATION, PELAGIC_EXECUTOR_TBB,
                                      -7};
    executor_options.kind = kinds[bytes.take<std::uint8_t>() % std::size(kinds)];
    executor_options.threads = bytes.take<std::int8_t>();
    if (bytes.take<std::uint8_t>() % 8) executor_options.parallel_for = in_turn;
    if (bytes.take<std::uint8_t>() % 2) executor_options.submit = at_once;
    pelagic_executor* executor = nullptr;
    must_be_a_status(pelagic_executor_create(&executor_options, &executor));

    // Not the default executor: its threads would take longer to start than all calls.
    pelagic_executor* serial = nullptr;
    if (!executor) {
        auto plain = pelagic_executor_options_make();
        plain.kind = PELAGIC_EXECUTOR_SERIAL;
        must_be_a_status(pelagic_executor_create(&plain, &serial));
    }
    auto options = of_any_size(pelagic_ocean_options_make(), bytes);
    options.executor = executor ? executor : serial;
    const auto queries = bytes.take<std::uint8_t>();
    options.queries = queries % 4;
    const auto parts = bytes.take<std::uint8_t>();
    // Only some byte values ask for water of its own velocity, or below the surface.
    options.velocities = parts % 2 * (queries / 64 == 2 ? PELAGIC_VELOCITIES_WATER : PELAGIC_VELOCITIES_DRAWN);
    options.depth = queries / 64 == 3;
    const int set = parts / 16 == 7 ? PELAGIC_TEXTURES_OFF : PELAGIC_TEXTURES_ON;
    options.slopes = parts / 2 % 2 * set;
    options.gradients = parts / 4 % 2 * set;
    options.foam = parts / 8 % 2;
    options.query_tolerance_m = bytes.take<std::uint8_t>() == 255 ? bytes.number() : 0;
    const char* const isas[] = {nullptr, nullptr, nullptr, "sse4.2", "avx2", "", "neon"};
    options.isa = isas[bytes.take<std::uint8_t>() % std::size(isas)];
    const pelagic_sea sea = any_sea(bytes);
    // Only some byte values add inputs, so that the layout of other inputs stays the same.
    const std::vector<pelagic_input*> inputs = parts / 16 == 15 ? any_inputs(bytes) : std::vector<pelagic_input*>();
    options.input_count = inputs.size();
    options.inputs = inputs.data();
    pelagic_dynamic_waves_options dynamic_waves{};
    if (queries / 4 % 4 == 3) dynamic_waves = any_dynamic_waves(bytes), options.dynamic_waves = &dynamic_waves;
    pelagic_shore_options shore{};
    std::array<float, 64> floor{};
    if (queries / 16 % 4 == 3) shore = any_shore(bytes, floor), options.shore = &shore;
    pelagic_ocean* ocean = nullptr;
    must_be_a_status(pelagic_ocean_create(&sea, &options, &ocean));
    for (pelagic_input* const input : inputs) pelagic_input_destroy(input);
    pelagic_executor_destroy(executor);
    pelagic_executor_destroy(serial);
    return ocean;
}

void any_query(Bytes& bytes, pelagic_ocean* ocean) {
    constexpr std::size_t max = 40;
    double x[max], z[max];
    float out[10][2 * max];
    std::uint8_t converged[2 * max];
    auto points = of_any_size(pelagic_points_make(), bytes);
    const auto count = bytes.take<std::uint8_t>();
    points.count = count == 255 ? SIZE_MAX - bytes.take<std::uint8_t>() : count % max;
    for (std::size_t i = 0; i < points.count % max; ++i) x[i] = bytes.number(), z[i] = bytes.number();
    points.x = count == 254 ? nullptr : x;
    points.z = z;
    auto samples = of_any_size(pelagic_samples_make(), bytes);
    float** const wanted[10] = {&samples.height_m,       &samples.normal_x,
                                &samples.normal_y,       &samples.normal_z,
                                &samples.jacobian,       &samples.velocity_x_mps,
                                &samples.velocity_y_mps, &samples.velocity_z_mps,
                                &samples.error_m,        &samples.foam};
    const auto which = bytes.take<std::uint16_t>();
    for (int i = 0; i < 10; ++i)
        if (which >> i & 1) *wanted[i] = out[i];
    samples.converged = converged;
    must_be_a_status(pelagic_ocean_query(ocean, &points, &samples));
    const double times_s[3] = {bytes.number(), bytes.number(), bytes.number()};
    const double* const next_s = which >> 10 & 1 ? times_s + 2 : nullptr;
    must_be_a_status(pelagic_ocean_query_series(ocean, times_s, 1 + (which >> 11 & 1), next_s, &points, &samples, nullptr));

    auto water_points = pelagic_water_points_make();
    water_points.count = points.count, water_points.interpolation = points.interpolation;
    water_points.x = points.x, water_points.y = points.z, water_points.z = points.x;
    water_points.tolerance_m = points.tolerance_m, water_points.footprint_m = times_s[0];
    auto water = pelagic_water_samples_make();
    water.depth_m = out[0], water.pressure_pa = out[1];
    water.velocity_x_mps = out[2], water.acceleration_y_mps2 = out[3];
    must_be_a_status(pelagic_ocean_sample_water(ocean, &water_points, &water));
}

void any_ray(Bytes& bytes, const pelagic_ocean* ocean) {
    auto ray = of_any_size(pelagic_ray_make(), bytes);
    for (double& along : ray.origin_m) along = bytes.number();
    for (double& along : ray.direction) along = bytes.number();
    ray.reach_m = bytes.number();
    auto hit = output<pelagic_hit>(bytes);
    must_be_a_status(pelagic_ocean_first_hit(ocean, &ray, &hit));
}

void any_frame_at(Bytes& bytes, pelagic_ocean* ocean) {
    static std::vector<float> plane(64 * 64);
    static std::vector<std::uint32_t> chain(64 * 64 * 2);
    // As many structs as an ocean has cascades, of the size that the first struct states. This
    // array has enough memory for them.
    alignas(pelagic_frame_buffers) static std::array<std::byte, 4 * 4096> cascades;
    cascades = {};
    const auto first = of_any_size(pelagic_frame_buffers_make(), bytes);
    pelagic_ocean_info info{};
    std::size_t side = 16;
    if (ocean && pelagic_ocean_describe(ocean, &info) == PELAGIC_OK) side = static_cast<std::size_t>(info.resolution);
    const auto texels = bytes.take<std::uint8_t>(), parts = bytes.take<std::uint8_t>();
    for (std::size_t cascade = 0; cascade < 4; ++cascade) {
        pelagic_frame_buffers buffers = first;
        if (parts >= 252 && cascade == parts - 252u) buffers.struct_size += 8;
        if (cascade == 0 && parts != 251) buffers.cascade_count = static_cast<std::uint32_t>(info.cascade_count);
        buffers.plane_count = side * side + (texels == 255);
        buffers.height = plane.data();
        if (parts % 4 == 0) buffers.velocity_x = plane.data();
        buffers.slopes_count = buffers.rgba8_count = (4 * side * side - 1) / 3;
        if (parts / 4 % 4 == 1) buffers.slopes_rgba8 = chain.data();
        if (parts / 4 % 4 == 2) buffers.moments_rgba8 = chain.data();
        if (parts / 4 % 4 == 3) buffers.gradient_rgba8 = chain.data();
        const std::size_t place = cascade * (first.struct_size <= 4096 ? first.struct_size : 0);
        if (place + sizeof buffers <= cascades.size()) std::memcpy(cascades.data() + place, &buffers, sizeof buffers);
    }
    pelagic_bounds bounds{};
    must_be_a_status(pelagic_ocean_frame_at(
        ocean, bytes.number(), reinterpret_cast<const pelagic_frame_buffers*>(cascades.data()), &bounds));
}

/// Reads every byte of the arrays of a cascade.
void any_cascade(Bytes& bytes, const pelagic_ocean* ocean) {
    auto cascade = output<pelagic_cascade>(bytes);
    const auto index = bytes.take<std::int8_t>();
    const pelagic_status status = pelagic_ocean_cascade(ocean, index, &cascade);
    must_be_a_status(status);
    if (status != PELAGIC_OK) return;
    const auto n = static_cast<std::size_t>(cascade.resolution);
    const std::size_t last = cascade.level_offset[cascade.levels - 1];
    std::uint64_t sum = cascade.displacement_rgba16f[4 * n * n - 1];
    for (const std::uint32_t* chain : {cascade.gradient_rgba8, cascade.slopes_rgba8, cascade.moments_rgba8})
        if (chain) sum += chain[last];
    if (cascade.compression_r8) sum += cascade.compression_r8[n * n - 1];
    for (const std::uint32_t* chain : cascade.snapshots_rgba8)
        if (chain) sum += chain[last];
    if (sum >> 62 != 0) std::abort();  // never true, so that the compiler keeps the reads
}

pelagic_disturbance any_disturbance(Bytes& bytes) {
    auto disturbance = of_any_size(pelagic_disturbance_make(), bytes);
    const auto kind = bytes.take<std::uint8_t>();
    disturbance.shape = kind % 3;
    disturbance.mode = kind / 3 % 5;
    disturbance.height_m = bytes.number();
    change(bytes, disturbance,
           {&pelagic_disturbance::x_m, &pelagic_disturbance::z_m, &pelagic_disturbance::radius_m,
            &pelagic_disturbance::length_m, &pelagic_disturbance::heading_rad, &pelagic_disturbance::height_m,
            &pelagic_disturbance::rate_per_s, &pelagic_disturbance::velocity_x_mps,
            &pelagic_disturbance::velocity_z_mps});
    return disturbance;
}

/// Returns the ocean's dynamic waves, or null if there are none.
pelagic_dynamic_waves* waves_of(const pelagic_ocean* ocean) {
    pelagic_dynamic_waves* waves = nullptr;
    must_be_a_status(pelagic_ocean_dynamic_waves(const_cast<pelagic_ocean*>(ocean), &waves));
    return waves;
}

/// Saves the state and restores it with four changed bytes, in the header, the texels or the
/// sources, or truncated.
void any_saved_water(Bytes& bytes, pelagic_ocean* ocean) {
    static std::vector<std::uint8_t> saved;
    std::size_t count = 0;
    const pelagic_status measured = pelagic_dynamic_waves_save_state(waves_of(ocean), nullptr, 0, &count);
    must_be_a_status(measured);
    if (measured == PELAGIC_OK) {
        saved.resize(count);
        must_be_a_status(pelagic_dynamic_waves_save_state(waves_of(ocean), saved.data(), saved.size(), &count));
    }  // else the state of an earlier call, perhaps of another ocean
    const auto changed = bytes.take<std::uint8_t>();
    std::vector<std::uint8_t> mutated = saved;
    if (mutated.size() > 600 && changed % 4) {
        const std::size_t at = bytes.take<std::uint16_t>();
        // After the digest of the options, because a wrong digest stops the reading.
        const std::size_t place = changed % 4 == 1   ? 8 + at % 64
                                  : changed % 4 == 2 ? at % (mutated.size() - sizeof(std::uint32_t))
                                                     : mutated.size() - sizeof(std::uint32_t) - at % 500;
        const auto instead = bytes.take<std::uint32_t>();
        std::memcpy(mutated.data() + place, &instead, sizeof instead);
    }
    if (changed >= 250 && !mutated.empty()) mutated.resize(mutated.size() - changed % mutated.size());
    must_be_a_status(pelagic_dynamic_waves_restore_state(waves_of(ocean), mutated.data(), mutated.size()));
}

/// Reads the frame's dynamic waves and shore, up to the last byte.
void any_water(const pelagic_ocean* ocean, Bytes& bytes) {
    std::uint64_t hash = 0;
    must_be_a_status(pelagic_dynamic_waves_hash(waves_of(ocean), &hash));
    auto dynamic_waves = output<pelagic_dynamic_waves_view>(bytes);
    auto shore = output<pelagic_shore_surface>(bytes);
    double sum = 0;
    const pelagic_status of_dynamic_waves = pelagic_dynamic_waves_get_view(waves_of(ocean), &dynamic_waves);
    must_be_a_status(of_dynamic_waves);
    if (of_dynamic_waves == PELAGIC_OK) {
        const auto last =
            static_cast<std::size_t>(dynamic_waves.resolution) * static_cast<std::size_t>(dynamic_waves.resolution) -
            1;
        sum += dynamic_waves.height_m[last] + dynamic_waves.vertical_velocity_mps[last] + dynamic_waves.foam[last];
    }
    const pelagic_status of_shore = pelagic_ocean_shore(ocean, &shore);
    must_be_a_status(of_shore);
    if (of_shore == PELAGIC_OK) {
        const auto last = static_cast<std::size_t>(shore.columns) * static_cast<std::size_t>(shore.rows) - 1;
        sum += shore.height_m[last] + shore.vertical_velocity_mps[last] + shore.reach_m[last] + shore.foam[last] +
               shore.depth_m[last] + shore.potential_m2ps[last] + static_cast<double>(shore.weights_rgba8[last]);
    }
    if (sum != sum) std::abort();  // The input has no NaN, so the output must have none.
}

void any_dynamic_waves_command(Bytes& bytes, pelagic_ocean* ocean) {
    std::uint32_t number = 0;
    switch (bytes.take<std::uint8_t>() % 7) {
        case 0: {
            const pelagic_disturbance disturbance = any_disturbance(bytes);
            must_be_a_status(pelagic_dynamic_waves_add_impulse(waves_of(ocean), &disturbance));
            break;
        }
        case 1: {
            const pelagic_disturbance source = any_disturbance(bytes);
            must_be_a_status(pelagic_dynamic_waves_add_source(waves_of(ocean), &source, &number));
            break;
        }
        case 2: {
            number = bytes.take<std::uint8_t>();
            const pelagic_disturbance source = any_disturbance(bytes);
            must_be_a_status(pelagic_dynamic_waves_set_source(waves_of(ocean), number, &source));
            break;
        }
        case 3:
            must_be_a_status(pelagic_dynamic_waves_remove_source(waves_of(ocean), bytes.take<std::uint8_t>()));
            break;
        case 4: {
            const double x = bytes.number(), z = bytes.number();
            must_be_a_status(pelagic_dynamic_waves_set_center(waves_of(ocean), x, z));
            break;
        }
        case 5: any_saved_water(bytes, ocean); break;
        default: any_water(ocean, bytes);
    }
}

void any_call(Bytes& bytes, pelagic_ocean*& ocean) {
    std::int32_t is_ready = 0;
    std::uint64_t hash = 0;
    auto frame = output<pelagic_frame>(bytes);
    const auto which = bytes.take<std::uint8_t>();
    if (which >= 200) return any_dynamic_waves_command(bytes, ocean);
    switch (which % 13) {
        case 0: must_be_a_status(pelagic_ocean_schedule(ocean, bytes.number())); break;
        case 1: must_be_a_status(pelagic_ocean_complete(ocean, &frame)); break;
        case 2: must_be_a_status(pelagic_ocean_poll(ocean, &is_ready)); break;
        case 3:
            for (std::int32_t kind = -1; kind <= PELAGIC_HASH_SPRAY + 1; ++kind)
                must_be_a_status(pelagic_ocean_frame_hash(ocean, bytes.take<std::uint8_t>(), kind, &hash));
            break;
        case 4: {
            const pelagic_sea sea = any_sea(bytes);
            must_be_a_status(pelagic_ocean_schedule_sea(ocean, &sea));
            break;
        }
        case 5: must_be_a_status(pelagic_ocean_poll_sea(ocean, &is_ready)); break;
        case 6: must_be_a_status(pelagic_ocean_complete_sea(ocean)); break;
        case 7: any_query(bytes, ocean); break;
        case 8: any_ray(bytes, ocean); break;
        case 9: any_frame_at(bytes, ocean); break;
        case 10: any_cascade(bytes, ocean); break;
        case 11: {
            auto water = of_any_size(pelagic_water_frame_make(), bytes);
            water.sea_level_m = bytes.number();
            water.current_x_mps = bytes.number();
            water.current_z_mps = bytes.number();
            must_be_a_status(pelagic_ocean_set_water_frame(ocean, &water));
            const double x_m = bytes.number(), z_m = bytes.number();
            must_be_a_status(pelagic_ocean_set_origin(ocean, x_m, z_m));
            break;
        }
        default: pelagic_ocean_destroy(ocean); ocean = any_ocean(bytes);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    pelagic_ocean* oceans[2] = {any_ocean(bytes), nullptr};
    while (!bytes.is_empty()) any_call(bytes, oceans[bytes.take<std::uint8_t>() % 8 == 0]);
    for (pelagic_ocean* ocean : oceans) pelagic_ocean_destroy(ocean);
    return 0;
}
