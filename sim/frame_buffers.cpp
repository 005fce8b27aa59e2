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

}  // namespace

std::string check(const FrameBuffers& buffers, int resolution, bool has_velocities) {
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

void copy_plane(const PlaneView& plane, std::span<float> out) {
    if (out.empty()) return;
    const auto side = static_cast<std::size_t>(plane.resolution);
    if (!plane.data || out.size() != side * side)
        throw std::invalid_argument("the plane has " + number_text(plane.data ? side * side : 0) +
                                    " elements, and room for " + number_text(out.size()) + " was given");
    for (int j = 0; j < plane.resolution; ++j) plane.copy_row(j, out.data() + static_cast<std::size_t>(j) * side);
}

void copy_frame(const Frame& frame, const FrameBuffers& buffers) {
    if (const std::string reason = check(buffers, frame.resolution(), frame.velocity_x.data != nullptr);
        !reason.empty())
        throw std::invalid_argument(reason);
    copy_plane(frame.dx, buffers.dx);
    copy_plane(frame.height, buffers.height);
    copy_plane(frame.dz, buffers.dz);
    copy_plane(frame.velocity_x, buffers.velocity_x);
    copy_plane(frame.velocity_y, buffers.velocity_y);
    copy_plane(frame.velocity_z, buffers.velocity_z);
    copy_all(frame.displacement_rgba16f, buffers.displacement_rgba16f);
    copy_all(frame.gradient_rgba8, buffers.gradient_rgba8);
}

}  // namespace pelagic
