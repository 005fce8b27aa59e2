// Structs with a size field: those of older applications are smaller than the library's, those of
// newer ones larger.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "pelagic/capi/c_status.hpp"
#include "pelagic/pelagic.h"

namespace pelagic::capi {

/// A larger struct_size is taken for an uninitialised one.
inline constexpr std::uint32_t max_struct_bytes = 4096;

/// Size of a struct's first version up to its last field. Padding may follow, whose size may
/// differ.
template <class T>
inline constexpr std::size_t min_struct_bytes = 0;
#define PELAGIC_LAST_FIELD_AT_FIRST(type, field) \
    template <>                                  \
    inline constexpr std::size_t min_struct_bytes<type> = offsetof(type, field) + sizeof(type::field)
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_sea, loop_period_s);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_statistics, repeats_after_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_executor_options, user);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_ocean_options, query_tolerance_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_ocean_info, executor);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_frame, bounds);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_cascade, whitecap_jacobian);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_frame_buffers, gradient_rgba8);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_texture_targets, moments_rgba8);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_change, over_s);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_forecast, largest_peak_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_dynamic_waves_options, foam_height_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_dynamic_waves_resources, memory_user);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_disturbance, velocity_z_mps);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_rain, height_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_dynamic_waves_view, height_max_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_shore_options, swash_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_shore_surface, height_max_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_waves, choppiness);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_ripple, phase_rad);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_input_callback, largest_slope);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_points, z);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_samples, converged);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_ray, reach_m);
PELAGIC_LAST_FIELD_AT_FIRST(pelagic_hit, position_m);
#undef PELAGIC_LAST_FIELD_AT_FIRST

/// Returns the application's struct_size. Throws std::invalid_argument for null and an invalid
/// size.
template <class T>
std::size_t struct_bytes(const T* pointer, const char* name) {
    static_assert(min_struct_bytes<T> > 0, "say which field was its last at first");
    const std::uint32_t bytes = needed(pointer, name).struct_size;
    if (bytes < min_struct_bytes<T> || bytes > max_struct_bytes)
        reject(invalid_value_message(std::string(name) + ".struct_size", bytes,
                                     number_text(sizeof(T)) + ", the size of the struct"));
    return bytes;
}

/// Reads the application's struct; fields that it does not have are 0. Throws std::invalid_argument
/// as struct_bytes(), and for fields that the library does not define and reserved fields, unless
/// they are 0.
template <class T>
T read_struct(const T* pointer, const char* name) {
    const std::size_t bytes = struct_bytes(pointer, name);
    T ours{};
    std::memcpy(&ours, pointer, std::min(bytes, sizeof ours));
    const auto* const all = reinterpret_cast<const unsigned char*>(pointer);
    if (std::any_of(all + std::min(bytes, sizeof ours), all + bytes, [](unsigned char byte) { return byte != 0; }))
        reject(std::string(name) + " sets fields of a later version, expected 0 there");
    if constexpr (requires { ours.reserved; })
        if (ours.reserved != 0) reject(std::string(name) + ".reserved is set, expected 0");
    if constexpr (requires { ours.reserved_1; })
        if (ours.reserved_1 != 0) reject(std::string(name) + ".reserved_1 is set, expected 0");
    return ours;
}

/// Writes the application's struct except struct_size, up to its size. Fields that the library does
/// not define become 0. \pre struct_bytes() accepted it
template <class T>
void write_struct(const T& ours, T* pointer) {
    const std::size_t bytes = pointer->struct_size;
    auto* const all = reinterpret_cast<unsigned char*>(pointer);
    constexpr std::size_t head = sizeof ours.struct_size;
    std::memcpy(all + head, reinterpret_cast<const unsigned char*>(&ours) + head,
                std::min(bytes, sizeof ours) - head);
    if (bytes > sizeof ours) std::memset(all + sizeof ours, 0, bytes - sizeof ours);
}

}  // namespace pelagic::capi
