#include "pelagic/sim/surface/frame_slots.hpp"

#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

Tile views_of(const TileBuffers& buffers, int n, std::size_t lanes) {
    const auto view = [&](const AlignedBuffer<float>& planes, std::size_t component) {
        return PlaneView{planes.data() + component * lanes, n, static_cast<int>(lanes),
                         static_cast<std::ptrdiff_t>(surface_components * lanes),
                         static_cast<std::ptrdiff_t>(column_block_floats(n, lanes))};
    };
    Tile tile;
    tile.dx = view(buffers.surface, surface_dx);
    tile.height = view(buffers.surface, surface_height);
    tile.dz = view(buffers.surface, surface_dz);
    if (buffers.velocity.size() > 0) {
        tile.velocity_x = view(buffers.velocity, surface_dx);
        tile.velocity_y = view(buffers.velocity, surface_height);
        tile.velocity_z = view(buffers.velocity, surface_dz);
    }
    if (buffers.folds) tile.folds = buffers.folds->squares();
    tile.displacement_rgba16f = {buffers.rgba16f.data(), buffers.rgba16f.size()};
    tile.gradient_rgba8 = {buffers.rgba8.data(), buffers.rgba8.size()};
    tile.slopes_rgba8 = {buffers.slopes.data(), buffers.slopes.size()};
    tile.moments_rgba8 = {buffers.moments.data(), buffers.moments.size()};
    return tile;
}

}  // namespace

TileBuffers::TileBuffers(std::size_t tiles, int n, std::size_t lanes, const FrameExtras& extras)
    : surface(column_blocks(n, lanes) * column_block_floats(n, lanes), extras.memory),
      velocity(extras.velocities ? surface.size() : 0, extras.memory),
      rgba16f(4 * static_cast<std::size_t>(n) * n, extras.memory),
      rgba8(extras.gradients ? mip_offset(n, mip_levels(n)) : 0, extras.memory),
      slopes(extras.slopes ? mip_offset(n, mip_levels(n)) : 0, extras.memory),
      moments(slopes.size(), extras.memory) {
    if (extras.folds && tiles == 1) folds.emplace(n, extras.memory);
    if (extras.folds && tiles > 1) squeeze.emplace(n, extras.memory);
}

std::size_t TileBuffers::bytes() const {
    return surface.bytes() + velocity.bytes() + rgba16f.bytes() + rgba8.bytes() + slopes.bytes() + moments.bytes() +
           (folds ? folds->bytes() : 0) + (squeeze ? squeeze->bytes() : 0);
}

FrameSlots::FrameSlots(std::size_t tiles, int resolution, std::size_t lanes, const FrameExtras& extras) {
    for (Slot& slot : slots_) {
        slot.buffers.reserve(tiles);  // views point into the elements
        for (std::size_t i = 0; i < tiles; ++i)
            slot.tiles.push_back(
                views_of(slot.buffers.emplace_back(tiles, resolution, lanes, extras), resolution, lanes));
        slot.frame.tiles = slot.tiles;
    }
}

std::size_t FrameSlots::bytes() const {
    std::size_t bytes = 0;
    for (const Slot& slot : slots_)
        for (const TileBuffers& buffers : slot.buffers) bytes += buffers.bytes() + sizeof(TileBuffers) + sizeof(Tile);
    return bytes;
}

}  // namespace pelagic
