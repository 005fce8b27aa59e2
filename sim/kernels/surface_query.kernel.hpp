#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/gather.kernel.hpp"
#include "pelagic/simd/windows.kernel.hpp"

namespace pelagic::kernels {

/// Where texels lie, W at a time; SurfaceTexels says how. Numbers of texels may lie outside the patch.
template <class Arch>
class TexelPlaces {
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    explicit TexelPlaces(const SurfaceTexels& surface)
        : last_(I(surface.resolution - 1)),
          in_block_(I(surface.block_columns - 1)),
          row_stride_(I(surface.row_stride)),
          block_stride_(I(surface.block_stride)),
          block_shift_(surface.block_shift) {}

    PELAGIC_INLINE I column(I i) const {
        const I wrapped = i & last_;
        return (wrapped >> block_shift_) * block_stride_ + (wrapped & in_block_);
    }
    PELAGIC_INLINE I row(I j) const { return (j & last_) * row_stride_; }

   private:
    I last_, in_block_, row_stride_, block_stride_;
    int block_shift_;
};

template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> between(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                 xsimd::batch<float, Arch> t) {
    return a + t * (b - a);
}

/// Values of one plane at the corners of a cell: first index along x, second along z.
template <class Arch>
struct Corners {
    xsimd::batch<float, Arch> v00, v10, v01, v11;
};

template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> bilinear(const Corners<Arch>& c, xsimd::batch<float, Arch> u,
                                                  xsimd::batch<float, Arch> v) {
    return between<Arch>(between<Arch>(c.v00, c.v10, u), between<Arch>(c.v01, c.v11, u), v);
}

/// Where the corners of W cells lie.
template <class Arch>
class CellGather {
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE CellGather(const TexelPlaces<Arch>& places, I x, I z)
        : CellGather(places.column(x), places.column(x + I(1)), places.row(z), places.row(z + I(1))) {}

    PELAGIC_INLINE Corners<Arch> corners(const float* plane) const {
        return {at00_.from(plane), at10_.from(plane), at01_.from(plane), at11_.from(plane)};
    }

   private:
    PELAGIC_INLINE CellGather(I column, I next_column, I row, I next_row)
        : at00_(column + row), at10_(next_column + row), at01_(column + next_row), at11_(next_column + next_row) {}

    Gather<Arch> at00_, at10_, at01_, at11_;
};

/// One sideways component inside a cell, in texels: its value and its slopes.
template <class Arch>
struct Sideways {
    using V = xsimd::batch<float, Arch>;
    V value, along_u, along_v;

    PELAGIC_INLINE Sideways(const Corners<Arch>& c, V u, V v, V texels_per_m) {
        const V low = between<Arch>(c.v00, c.v10, u), high = between<Arch>(c.v01, c.v11, u);
        value = between<Arch>(low, high, v) * texels_per_m;
        along_u = between<Arch>(c.v10 - c.v00, c.v11 - c.v01, v) * texels_per_m;
        along_v = (high - low) * texels_per_m;
    }
};

/// The sideways displacement at the corners of W cells. A search's last steps stay inside of them, and load nothing.
template <class Arch>
class SidewaysCells {
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE void load(const SurfaceTexels& surface, const TexelPlaces<Arch>& places, I x, I z) {
        const CellGather<Arch> cell(places, x, z);
        dx = cell.corners(surface.dx);
        dz = cell.corners(surface.dz);
        x_ = x;
        z_ = z;
    }
    PELAGIC_INLINE void follow(const SurfaceTexels& surface, const TexelPlaces<Arch>& places, I x, I z) {
        if (!xsimd::all((x == x_) & (z == z_))) load(surface, places, x, z);
    }

    I x() const { return x_; }
    I z() const { return z_; }

    Corners<Arch> dx, dz;

   private:
    I x_, z_;
};

/// W searches for a rest point.
template <class Arch>
class Inversion {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    /// The search begins at the point itself.
    PELAGIC_INLINE void begin(const InvertSurfaceJob& job, std::size_t at) {
        world_x_ = x_ = I::load_aligned(job.world.cell_x + at);
        world_z_ = z_ = I::load_aligned(job.world.cell_z + at);
        world_u_ = u_ = V::load_aligned(job.world.u + at);
        world_v_ = v_ = V::load_aligned(job.world.v + at);
    }

    PELAGIC_INLINE void look(const InvertSurfaceJob& job, const TexelPlaces<Arch>& places, bool is_first) {
        if (is_first)
            cells_.load(job.surface, places, x_, z_);
        else
            cells_.follow(job.surface, places, x_, z_);
        const Sideways<Arch> dx(cells_.dx, u_, v_, V(job.texels_per_m)), dz(cells_.dz, u_, v_, V(job.texels_per_m));

        // How far the displaced point is from where it should be, in texels.
        const V off_x = xsimd::to_float(x_ - world_x_) + (u_ - world_u_) + dx.value;
        const V off_z = xsimd::to_float(z_ - world_z_) + (v_ - world_v_) + dz.value;
        squared_ = off_x * off_x + off_z * off_z;

        const V j_xx = V(1.f) + dx.along_u, j_zz = V(1.f) + dz.along_v;
        const V determinant = j_xx * j_zz - dx.along_v * dz.along_u;
        const auto newton = (determinant > V(InvertSurfaceJob::least_determinant)) &
                            (xsimd::max(xsimd::abs(off_x), xsimd::abs(off_z)) < V(InvertSurfaceJob::newton_reach));
        const V inverse = divided<Arch>(V(1.f), xsimd::select(newton, determinant, V(1.f)));
        step_x_ = xsimd::select(newton, (j_zz * off_x - dx.along_v * off_z) * inverse, off_x);
        step_z_ = xsimd::select(newton, (j_xx * off_z - dz.along_u * off_x) * inverse, off_z);
    }

    PELAGIC_INLINE auto open(V enough) const { return squared_ > enough; }

    /// Lanes that are done keep their bits, however long their neighbours take.
    PELAGIC_INLINE void step(V enough) {
        move(x_, u_, step_x_, enough);
        move(z_, v_, step_z_, enough);
    }

    PELAGIC_INLINE void store(const InvertSurfaceJob& job, std::size_t at) const {
        x_.store_aligned(job.rest.cell_x + at);
        z_.store_aligned(job.rest.cell_z + at);
        u_.store_aligned(job.rest.u + at);
        v_.store_aligned(job.rest.v + at);
        square_root<Arch>(squared_).store_aligned(job.error + at);
    }

   private:
    PELAGIC_INLINE void move(I& cell, V& within, V by, V enough) const {
        const V moved = within - by;
        const V cut = xsimd::to_float(xsimd::to_int(moved));
        const V whole = cut - xsimd::select(cut > moved, V(1.f), V(0.f));
        cell = cell + xsimd::to_int(xsimd::select(open(enough), whole, V(0.f)));
        within = xsimd::select(open(enough), moved - whole, within);
    }

    SidewaysCells<Arch> cells_;
    I world_x_, world_z_, x_, z_;
    V world_u_, world_v_, u_, v_;
    V squared_, step_x_, step_z_;
};

/// Several registers of searches together: each step of one waits for its loads, and meanwhile the others go on.
template <class Arch, std::size_t Registers>
PELAGIC_INLINE void invert_registers(const InvertSurfaceJob& job, const TexelPlaces<Arch>& places, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    const V enough(job.target * job.target);
    Inversion<Arch> searches[Registers];
    for (std::size_t r = 0; r < Registers; ++r) searches[r].begin(job, at + r * V::size);
    for (int step = 0;; ++step) {
        for (Inversion<Arch>& search : searches) search.look(job, places, step == 0);
        auto open = searches[0].open(enough);
        for (std::size_t r = 1; r < Registers; ++r) open = open | searches[r].open(enough);
        if (step == InvertSurfaceJob::most_steps || !xsimd::any(open)) break;
        for (Inversion<Arch>& search : searches) search.step(enough);
    }
    for (std::size_t r = 0; r < Registers; ++r) searches[r].store(job, at + r * V::size);
}

template <class Arch>
void invert_surface(const InvertSurfaceJob& job) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    const TexelPlaces<Arch> places(job.surface);
    std::size_t at = 0;
    for (; at + 4 * lanes <= job.count; at += 4 * lanes) invert_registers<Arch, 4>(job, places, at);
    for (; at + 2 * lanes <= job.count; at += 2 * lanes) invert_registers<Arch, 2>(job, places, at);
    if (at < job.count) invert_registers<Arch, 1>(job, places, at);
}

/// Four columns in four rows of one plane, by row and column, without the corners of this square.
template <class Arch>
struct CellSurroundings {
    xsimd::batch<float, Arch> at[4][4];
};

/// Slopes of one plane along both axes, per two texels: central differences at the corners of the cell, bilinear
/// between them.
template <class Arch>
struct CellSlopes {
    using V = xsimd::batch<float, Arch>;
    V x, z;
    V value;

    PELAGIC_INLINE CellSlopes(const CellSurroundings<Arch>& texels, V u, V v) {
        const auto& [a, b, c, d] = texels.at;
        value = bilinear<Arch>({b[1], b[2], c[1], c[2]}, u, v);
        x = bilinear<Arch>({b[2] - b[0], b[3] - b[1], c[2] - c[0], c[3] - c[1]}, u, v);
        z = bilinear<Arch>({c[1] - a[1], c[2] - a[2], d[1] - b[1], d[2] - b[2]}, u, v);
    }
};

/// Reads four columns around W cells. They lie in one or two groups of W columns, each side by side in memory however large
/// the blocks are. Of the first group four are loaded that end with it at most, the first `shift` of which are too early: in
/// their place come the first four of the second group, and all are turned. Nothing is read beyond a group.
template <class Arch>
class CellReader {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    static constexpr int lanes = static_cast<int>(V::size);

   public:
    PELAGIC_INLINE CellReader(const TexelPlaces<Arch>& places, I x, I z) {
        const I shift = xsimd::max(((x - I(1)) & I(lanes - 1)) - I(lanes - 4), I(0));
        const I shifts[4] = {lane_in_all<0, Arch>(shift), lane_in_all<1, Arch>(shift), lane_in_all<2, Arch>(shift),
                             lane_in_all<3, Arch>(shift)};
        const I order = I::load_aligned(lane_numbers);
        for (int k = 0; k < 4; ++k) {
            is_second_[k] = xsimd::to_float(order) < xsimd::to_float(shifts[k]);
            lanes_[k] = order + shifts[k];
        }
        const I first = places.column(x - I(1)) - shift, second = places.column((x + I(2)) & I(-lanes));
        for (int row = 0; row < 4; ++row) {
            const I at = places.row(z + I(row - 1));
            (first + at).store_aligned(reinterpret_cast<std::int32_t*>(first_[row]));
            (second + at).store_aligned(reinterpret_cast<std::int32_t*>(second_[row]));
        }
    }

    PELAGIC_INLINE void read(const float* const (&planes)[3], CellSurroundings<Arch> (&texels)[3]) const {
        read_row(0, planes, texels);
        read_row(1, planes, texels);
        read_row(2, planes, texels);
        read_row(3, planes, texels);
    }

   private:
    PELAGIC_INLINE void read_row(int row, const float* const (&planes)[3],
                                 CellSurroundings<Arch> (&texels)[3]) const {
        for (int k = 0; k < 4; ++k) {
            for (int plane = 0; plane < 3; ++plane) {
                const V first = fours_loaded<Arch>(planes[plane], first_[row] + k);
                const V second = fours_loaded<Arch>(planes[plane], second_[row] + k);
                texels[plane].at[row][k] = lanes_turned<Arch>(xsimd::select(is_second_[k], second, first), lanes_[k]);
            }
        }
        for (int plane = 0; plane < 3; ++plane) fours_turned<Arch>(texels[plane].at[row]);
    }

    alignas(64) static constexpr std::int32_t lane_numbers[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    xsimd::batch_bool<float, Arch> is_second_[4];
    I lanes_[4];
    alignas(64) std::uint32_t first_[4][V::size], second_[4][V::size];
};

template <class Arch>
PELAGIC_INLINE void sample_lanes(const SampleSurfaceJob& job, const TexelPlaces<Arch>& places, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    const I x = I::load_aligned(job.rest.cell_x + at), z = I::load_aligned(job.rest.cell_z + at);
    const V u = V::load_aligned(job.rest.u + at), v = V::load_aligned(job.rest.v + at);
    const SampleSurfaceJob::Outputs& out = job.out;

    if (out.normal_x) {
        CellSurroundings<Arch> texels[3];
        CellReader<Arch>(places, x, z).read({job.surface.dx, job.surface.height, job.surface.dz}, texels);
        const CellSlopes<Arch> dx(texels[0], u, v), h(texels[1], u, v), dz(texels[2], u, v);
        // As normal_of() in gradients.kernel.hpp: times (2 L/N)^2, which the normal's length doesn't show.
        const V two_texels(job.two_texels_m);
        const V j_xx = two_texels + dx.x, j_zz = two_texels + dz.z;
        const V n_x = h.z * dz.x - h.x * j_zz;
        const V n_y = j_xx * j_zz - dx.z * dz.x;
        const V n_z = h.x * dx.z - h.z * j_xx;
        const V length = square_root<Arch>(xsimd::max(n_x * n_x + n_y * n_y + n_z * n_z, V(1e-30f)));
        const V inverse = divided<Arch>(V(1.f), length);
        h.value.store_aligned(out.height + at);
        (n_x * inverse).store_aligned(out.normal_x + at);
        (n_y * inverse).store_aligned(out.normal_y + at);
        (n_z * inverse).store_aligned(out.normal_z + at);
        (n_y * V(job.jacobian_factor)).store_aligned(out.jacobian + at);
    } else if (out.height) {
        bilinear<Arch>(CellGather<Arch>(places, x, z).corners(job.surface.height), u, v)
            .store_aligned(out.height + at);
    }
    if (out.velocity_x) {
        const CellGather<Arch> cell(places, x, z);
        bilinear<Arch>(cell.corners(job.surface.velocity_x), u, v).store_aligned(out.velocity_x + at);
        bilinear<Arch>(cell.corners(job.surface.velocity_y), u, v).store_aligned(out.velocity_y + at);
        bilinear<Arch>(cell.corners(job.surface.velocity_z), u, v).store_aligned(out.velocity_z + at);
    }
}

template <class Arch>
void sample_surface(const SampleSurfaceJob& job) {
    const TexelPlaces<Arch> places(job.surface);
    for (std::size_t at = 0; at < job.count; at += xsimd::batch<float, Arch>::size)
        sample_lanes<Arch>(job, places, at);
}

}  // namespace pelagic::kernels
