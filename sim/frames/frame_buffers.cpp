#include "pelagic/sim/frame_buffers.hpp"

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {
namespace {

template <class T>
void copy_all(std::span<const T> from, std::span<T> to) {
    if (!to.empty()) std::memcpy(to.data(), from.data(), from.size_bytes());
}

std::string check_buffers(const FrameBuffers& buffers, int resolution, const FrameContents& contents) {
    const std::size_t texels = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
    const std::size_t chain = mip_offset(resolution, mip_levels(resolution));
    struct Field {
        std::string_view name;
        std::size_t size, needed;
        bool is_there;
        std::string_view option;
    };
    const Field fields[] = {
        {"dx", buffers.dx.size(), texels, contents.planes, "planes"},
        {"height", buffers.height.size(), texels, contents.planes, "planes"},
        {"dz", buffers.dz.size(), texels, contents.planes, "planes"},
        {"velocity_x", buffers.velocity_x.size(), texels, contents.has_drawn_velocities(), "velocities"},
        {"velocity_y", buffers.velocity_y.size(), texels, contents.has_drawn_velocities(), "velocities"},
        {"velocity_z", buffers.velocity_z.size(), texels, contents.has_drawn_velocities(), "velocities"},
        {"displacement_rgba16f", buffers.displacement_rgba16f.size(), 4 * texels, true, {}},
        {"gradient_rgba8", buffers.gradient_rgba8.size(), chain, contents.gradients, "gradients"},
        {"slopes_rgba8", buffers.slopes_rgba8.size(), chain, contents.slopes, "slopes"},
        {"moments_rgba8", buffers.moments_rgba8.size(), chain, contents.slopes, "slopes"},
    };
    for (const Field& field : fields) {
        if (field.size == 0) continue;
        if (!field.is_there)
            return std::string(field.name) + " is requested, but the ocean was created without " +
                   std::string(field.option);
        if (field.size != field.needed)
            return std::string(field.name) + " has " + number_text(field.size) + " elements, expected " +
                   number_text(field.needed);
    }
    return {};
}

}  // namespace

std::string check(std::span<const FrameBuffers> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents) {
    if (cascades.size() != cascade_count)
        return "there are buffers of " + number_text(cascades.size()) + " cascades, expected " +
               number_text(cascade_count);
    for (const FrameBuffers& buffers : cascades) {
        if (std::string reason = check_buffers(buffers, resolution, contents); !reason.empty()) return reason;
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

void copy_compression(const Cascade& cascade, std::span<float> out) {
    const auto n = static_cast<std::size_t>(cascade.resolution()), last = n - 1;
    std::vector<float> dx(n * n), height(n * n), dz(n * n);
    if (out.size() != dx.size())
        throw std::invalid_argument("the compression has " + number_text(dx.size()) + " elements, and room for " +
                                    number_text(out.size()) + " was given");
    copy_plane(cascade.dx, dx);
    copy_plane(cascade.height, height);
    copy_plane(cascade.dz, dz);
    const auto near = static_cast<float>(SlopesJob::near_weight), far = static_cast<float>(SlopesJob::far_weight);
    const auto cosine = static_cast<float>(cascade.grid.cosine), sine = static_cast<float>(cascade.grid.sine);
    const auto factor = static_cast<float>(-double{cascade.compression_scale} / cascade.texel_m());
    const CascadeGrid::Vector front =
        cascade.grid.in_cascade(double{cascade.compression_front_x}, double{cascade.compression_front_z});
    const auto front_along = static_cast<float>(front.along), front_across = static_cast<float>(front.across);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const auto along = [&](const std::vector<float>& of) {
                const auto at = [&](std::size_t column) { return of[j * n + (column & last)]; };
                return near * (at(i + 1) - at(i - 1)) + far * (at(i + 2) - at(i - 2));
            };
            const auto across = [&](const std::vector<float>& of) {
                const auto at = [&](std::size_t row) { return of[(row & last) * n + i]; };
                return near * (at(j + 1) - at(j - 1)) + far * (at(j + 2) - at(j - 2));
            };
            const float trace = (cosine * along(dx) - sine * across(dx)) + (sine * along(dz) + cosine * across(dz));
            const float fronts = front_along * along(height) + front_across * across(height);
            out[j * n + i] = factor * (trace + fronts) + 0.f;  // no negative zeros
        }
}

void copy_frame(const Frame& frame, std::span<const FrameBuffers> cascades) {
    const Cascade& first = frame.cascades.front();
    require(check(cascades, frame.cascades.size(), first.resolution(),
                  {.velocities = first.velocity_x.data ? Velocities::drawn : Velocities::none,
                   .gradients = !first.gradient_rgba8.empty(),
                   .slopes = !first.slopes_rgba8.empty(),
                   .planes = first.height.data != nullptr}));
    for (std::size_t i = 0; i < cascades.size(); ++i)
        if (!cascades[i].displacement_rgba16f.empty() && frame.cascades[i].displacement_rgba16f.empty())
            throw std::invalid_argument(
                "displacement_rgba16f is wanted, but was written into the application's own memory");
    for (std::size_t i = 0; i < cascades.size(); ++i) {
        const Cascade& from = frame.cascades[i];
        const FrameBuffers& to = cascades[i];
        copy_plane(from.dx, to.dx);
        copy_plane(from.height, to.height);
        copy_plane(from.dz, to.dz);
        copy_plane(from.velocity_x, to.velocity_x);
        copy_plane(from.velocity_y, to.velocity_y);
        copy_plane(from.velocity_z, to.velocity_z);
        copy_all(from.displacement_rgba16f, to.displacement_rgba16f);
        copy_all(from.gradient_rgba8, to.gradient_rgba8);
        copy_all(from.slopes_rgba8, to.slopes_rgba8);
        copy_all(from.moments_rgba8, to.moments_rgba8);
    }
}

}  // namespace pelagic
