#include "pelagic/sim/buffers/frame_slots.hpp"

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

constexpr TextureTargets::Chain TextureTargets::*chains[] = {
    &TextureTargets::gradient_rgba8, &TextureTargets::slopes_rgba8, &TextureTargets::moments_rgba8};

TextureTargets textures_in(CascadeBuffers& buffers, int n) {
    const auto chain = [n](AlignedBuffer<std::uint32_t>& texels) {
        return texels.size() > 0 ? chain_in(texels.data(), n) : TextureTargets::Chain{};
    };
    return {buffers.rgba16f.data(), chain(buffers.rgba8), chain(buffers.slopes), chain(buffers.moments)};
}

/// Sets the cascade's views of textures that are written to its own buffers; all others become
/// empty.
void view_textures(Cascade& cascade, const CascadeBuffers& buffers, const TextureTargets& elsewhere) {
    const auto view = []<class T>(const AlignedBuffer<T>& texels, bool is_elsewhere) {
        return is_elsewhere ? std::span<const T>() : std::span<const T>(texels.data(), texels.size());
    };
    cascade.displacement_rgba16f = view(buffers.rgba16f, elsewhere.displacement_rgba16f);
    cascade.gradient_rgba8 = view(buffers.rgba8, elsewhere.gradient_rgba8[0]);
    cascade.slopes_rgba8 = view(buffers.slopes, elsewhere.slopes_rgba8[0]);
    cascade.moments_rgba8 = view(buffers.moments, elsewhere.moments_rgba8[0]);
}

std::size_t surface_floats(int n, std::size_t lanes) {
    return column_blocks(n, lanes) * column_block_floats(n, lanes);
}

Cascade views_of(const CascadeBuffers& buffers, int n, std::size_t lanes) {
    const auto view = [&](const AlignedBuffer<float>& planes, std::size_t component) {
        return PlaneView{planes.size() > 0 ? planes.data() + component * lanes : nullptr, n, static_cast<int>(lanes),
                         static_cast<std::ptrdiff_t>(surface_components * lanes),
                         static_cast<std::ptrdiff_t>(column_block_floats(n, lanes))};
    };
    Cascade cascade;
    cascade.dx = view(buffers.surface, surface_dx);
    cascade.height = view(buffers.surface, surface_height);
    cascade.dz = view(buffers.surface, surface_dz);
    if (buffers.velocity.size() > 0) {
        cascade.velocity_x = view(buffers.velocity, surface_dx);
        cascade.velocity_y = view(buffers.velocity, surface_height);
        cascade.velocity_z = view(buffers.velocity, surface_dz);
    }
    if (buffers.folds) cascade.folds = buffers.folds->squares();
    view_textures(cascade, buffers, {});
    return cascade;
}

}  // namespace

CascadeBuffers::CascadeBuffers(bool is_one, bool has_foam, int n, std::size_t lanes,
                               const FrameContents& contents, const Allocator& memory)
    : surface(contents.planes ? surface_floats(n, lanes) : 0, memory),
      velocity(contents.has_drawn_velocities() ? surface_floats(n, lanes) : 0, memory),
      rgba16f(4 * static_cast<std::size_t>(n) * n, memory),
      rgba8(contents.gradients ? mip_offset(n, mip_levels(n)) : 0, memory),
      slopes(contents.slopes ? mip_offset(n, mip_levels(n)) : 0, memory),
      moments(slopes.size(), memory),
      compression(has_foam ? static_cast<std::size_t>(n) * static_cast<std::size_t>(n) : 0, memory) {
    if (contents.has_water_levels()) water = std::make_unique<WaterPlanes>(memory);
    if (contents.queries && is_one) folds.emplace(n, memory);
    if (contents.queries && !is_one) contraction.emplace(n, memory);
}

std::size_t CascadeBuffers::bytes() const {
    return surface.bytes() + velocity.bytes() + rgba16f.bytes() + rgba8.bytes() + slopes.bytes() + moments.bytes() +
           compression.bytes() + (water ? water->bytes() : 0) + (folds ? folds->bytes() : 0) +
           (contraction ? contraction->bytes() : 0);
}

FrameSlots::FrameSlots(std::size_t cascades, int resolution, std::size_t lanes, const FrameContents& contents,
                       const Allocator& memory, bool is_rotated)
    : contents_(contents), memory_(memory) {
    const bool is_one = cascades == 1 && !is_rotated;
    for (Slot& slot : slots_) {
        slot.buffers.reserve(cascades);  // views point into the elements
        for (std::size_t i = 0; i < cascades; ++i) {
            const bool has_foam = contents.foam && i < CascadePlan::max_foam_cascades;
            CascadeBuffers& buffers =
                slot.buffers.emplace_back(is_one, has_foam, resolution, lanes, contents, memory);
            slot.cascades.push_back(views_of(buffers, resolution, lanes));
            slot.own_textures.push_back(textures_in(buffers, resolution));
        }
        slot.textures = slot.own_textures;
        slot.elsewhere.resize(cascades);
        slot.frame.cascades = slot.cascades;
        slot.frame.has_foam = contents.foam;
    }
    if (!contents.planes) working_.emplace(cascades, surface_floats(resolution, lanes), memory);
}

void FrameSlots::write_textures_to(std::span<const TextureTargets> cascades) {
    Slot& slot = slots_.back();
    const std::size_t last = last_level();
    for (std::size_t i = 0; i < slot.cascades.size(); ++i) {
        const TextureTargets& elsewhere = slot.elsewhere[i] = cascades.empty() ? TextureTargets{} : cascades[i];
        TextureTargets& textures = slot.textures[i] = slot.own_textures[i];
        if (elsewhere.displacement_rgba16f) textures.displacement_rgba16f = elsewhere.displacement_rgba16f;
        for (const auto chain : chains) {
            if (!(elsewhere.*chain)[0]) continue;
            textures.*chain = elsewhere.*chain;
            // The last level stays in the own buffer, because finish_textures() reads it.
            (textures.*chain)[last] = (slot.own_textures[i].*chain)[last];
        }
        view_textures(slot.cascades[i], slot.buffers[i], elsewhere);
    }
}

void FrameSlots::finish_textures() {
    Slot& slot = slots_.back();
    const std::size_t last = last_level();
    for (std::size_t i = 0; i < slot.cascades.size(); ++i) {
        const TextureTargets& own = slot.own_textures[i];
        for (const auto chain : chains)
            if (std::uint32_t* const texel = (slot.elsewhere[i].*chain)[last]) *texel = *(own.*chain)[last];
        if (!own.slopes_rgba8[last]) continue;
        Cascade& cascade = slot.cascades[i];
        const SurfaceSlopes all =
            slopes_of_texel(*own.slopes_rgba8[last], *own.moments_rgba8[last], cascade.slope_ranges);
        cascade.slope_variance = all.var_xx + all.var_zz;
    }
}

std::size_t FrameSlots::bytes() const {
    std::size_t bytes = working_ ? working_->bytes() : 0;
    for (const Slot& slot : slots_)
        for (const CascadeBuffers& buffers : slot.buffers)
            bytes += buffers.bytes() + sizeof(CascadeBuffers) + sizeof(Cascade);
    return bytes;
}

}  // namespace pelagic
