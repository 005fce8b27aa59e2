#include "pelagic/sim/frame_buffers.hpp"

#include <cstring>
#include <stdexcept>
#include <string_view>

#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

template <class T>
void copy_all(std::span<const T> from, std::span<T> to) {
    if (!to.empty()) std::memcpy(to.data(), from.data(), from.size_bytes());
}

std::string check_tile(const FrameBuffers& buffers, int resolution, bool has_velocities) {
    const std::size_t texels = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
    struct Field {
        std::string_view name;
        std::size_t size, needed;
        bool is_velocity;
    };
    const Field fields[] = {
        {"dx", buffers.dx.size(), texels, false},
        {"height", buffers.height.size(), texels, false},
        {"dz", buffers.dz.size(), texels, false},
        {"velocity_x", buffers.velocity_x.size(), texels, true},
        {"velocity_y", buffers.velocity_y.size(), texels, true},
        {"velocity_z", buffers.velocity_z.size(), texels, true},
        {"displacement_rgba16f", buffers.displacement_rgba16f.size(), 4 * texels, false},
        {"gradient_rgba8", buffers.gradient_rgba8.size(), mip_offset(resolution, mip_levels(resolution)), false},
    };
    for (const Field& field : fields) {
        if (field.size == 0) continue;
        if (field.is_velocity && !has_velocities)
            return std::string(field.name) + " is wanted, needs an ocean with velocities";
        if (field.size != field.needed)
            return std::string(field.name) + " has " + number_text(field.size) + " elements, needs " +
                   number_text(field.needed);
    }
    return {};
}

}  // namespace

std::string check(std::span<const FrameBuffers> tiles, std::size_t tile_count, int resolution, bool has_velocities) {
    if (tiles.size() != tile_count)
        return "there are buffers of " + number_text(tiles.size()) + " tiles, needs " + number_text(tile_count);
    for (const FrameBuffers& buffers : tiles)
        if (std::string reason = check_tile(buffers, resolution, has_velocities); !reason.empty()) return reason;
    return {};
}

void copy_plane(const PlaneView& plane, std::span<float> out) {
    if (out.empty()) return;
    const auto side = static_cast<std::size_t>(plane.resolution);
    if (!plane.data || out.size() != side * side)
        throw std::invalid_argument("the plane has " + number_text(plane.data ? side * side : 0) +
                                    " elements, and room for " + number_text(out.size()) + " was given");
    for (int j = 0; j < plane.resolution; ++j) plane.copy_row(j, out.data() + static_cast<std::size_t>(j) * side);
}

void copy_frame(const Frame& frame, std::span<const FrameBuffers> tiles) {
    const Tile& first = frame.tiles.front();
    if (const std::string reason =
            check(tiles, frame.tiles.size(), first.resolution(), first.velocity_x.data != nullptr);
        !reason.empty())
        throw std::invalid_argument(reason);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Tile& from = frame.tiles[i];
        const FrameBuffers& to = tiles[i];
        copy_plane(from.dx, to.dx);
        copy_plane(from.height, to.height);
        copy_plane(from.dz, to.dz);
        copy_plane(from.velocity_x, to.velocity_x);
        copy_plane(from.velocity_y, to.velocity_y);
        copy_plane(from.velocity_z, to.velocity_z);
        copy_all(from.displacement_rgba16f, to.displacement_rgba16f);
        copy_all(from.gradient_rgba8, to.gradient_rgba8);
    }
}

}  // namespace pelagic
