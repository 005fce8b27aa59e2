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

/// Computes offsets of W texels in the layout of SurfaceTexels. Texel indices may lie outside the
/// cascade.
template <class Arch>
class TexelOffsets {
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    explicit TexelOffsets(const SurfaceTexels& surface)
        : surface_(surface),
          last_(I(surface.resolution - 1)),
          in_block_(I(surface.block_columns - 1)),
          row_stride_(I(surface.row_stride)),
          block_stride_(I(surface.block_stride)),
          block_shift_(surface.block_shift) {}

    PELAGIC_INLINE I column(I i) const {
        const I wrapped = i & last_;
        return (wrapped >> block_shift_) * block_stride_ + (wrapped & in_block_);
    }
    PELAGIC_INLINE I row(I j) const { return (j & last_) * row_stride_; }

    PELAGIC_INLINE std::uint32_t column(std::int32_t i) const {
        const std::int32_t wrapped = i & (surface_.resolution - 1);
        return static_cast<std::uint32_t>((wrapped >> surface_.block_shift) * surface_.block_stride +
                                          (wrapped & (surface_.block_columns - 1)));
    }
    PELAGIC_INLINE std::uint32_t row(std::int32_t j) const {
        return static_cast<std::uint32_t>((j & (surface_.resolution - 1)) * surface_.row_stride);
    }

   private:
    const SurfaceTexels& surface_;
    I last_, in_block_, row_stride_, block_stride_;
    int block_shift_;
};

template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> between(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                 xsimd::batch<float, Arch> t) {
    return a + t * (b - a);
}

/// Values of one plane at the corners of a cell. The first index is along x, the second along z.
template <class Arch>
struct Corners {
    xsimd::batch<float, Arch> v00, v10, v01, v11;
};

template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> bilinear(const Corners<Arch>& c, xsimd::batch<float, Arch> u,
                                                  xsimd::batch<float, Arch> v) {
    return between<Arch>(between<Arch>(c.v00, c.v10, u), between<Arch>(c.v01, c.v11, u), v);
}

/// Gathers values at the corners of W cells.
template <class Arch>
class CellGather {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE CellGather(const TexelOffsets<Arch>& offsets, I x, I z)
        : CellGather(offsets.column(x), offsets.column(x + I(1)), offsets.row(z), offsets.row(z + I(1))) {}

    template <std::size_t Planes>
    PELAGIC_INLINE void corners(const float* const (&planes)[Planes], Corners<Arch> (&corners)[Planes]) const {
        V v00[Planes], v10[Planes], v01[Planes], v11[Planes];
        at00_.from(planes, v00);
        at10_.from(planes, v10);
        at01_.from(planes, v01);
        at11_.from(planes, v11);
        for (std::size_t p = 0; p < Planes; ++p) corners[p] = {v00[p], v10[p], v01[p], v11[p]};
    }

   private:
    PELAGIC_INLINE CellGather(I column, I next_column, I row, I next_row)
        : at00_(column + row), at10_(next_column + row), at01_(column + next_row), at11_(next_column + next_row) {}

    Gather<Arch> at00_, at10_, at01_, at11_;
};

/// The 4 x 4 texels around a cell in one plane, by row and column. LinearPosition does not read the
/// four corners.
template <class Arch>
struct CellSurroundings {
    xsimd::batch<float, Arch> at[4][4];
};

/// Reads the texels around a cell that is the same in all lanes: one load fills a register.
/// Neighbouring points often share a cell, above all in cascades with large texels.
template <class Arch>
class SharedCell {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    /// Always false with four lanes, because the comparison would take 4 to 6 % of the instructions
    /// of scattered points.
    PELAGIC_INLINE static bool is_shared(I x, I z) {
        if constexpr (V::size < 8)
            return false;
        else
            return xsimd::all((x == I(x.get(0))) & (z == I(z.get(0))));
    }

    /// \pre is_shared(x, z)
    PELAGIC_INLINE SharedCell(const TexelOffsets<Arch>& offsets, I x, I z) {
        for (std::int32_t k = 0; k < 4; ++k) {
            columns_[k] = offsets.column(x.get(0) + k - 1);
            rows_[k] = offsets.row(z.get(0) + k - 1);
        }
    }

    template <std::size_t Planes>
    PELAGIC_INLINE void corners(const float* const (&planes)[Planes], Corners<Arch> (&corners)[Planes]) const {
        for (std::size_t p = 0; p < Planes; ++p)
            corners[p] = {at(planes[p], 1, 1), at(planes[p], 1, 2), at(planes[p], 2, 1), at(planes[p], 2, 2)};
    }
    template <std::size_t Planes>
    PELAGIC_INLINE void read(const float* const (&planes)[Planes], CellSurroundings<Arch> (&texels)[Planes]) const {
        for (std::size_t p = 0; p < Planes; ++p)
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column) texels[p].at[row][column] = at(planes[p], row, column);
    }

   private:
    PELAGIC_INLINE V at(const float* plane, int row, int column) const {
        return V(plane[rows_[row] + columns_[column]]);
    }

    std::uint32_t columns_[4], rows_[4];
};

/// Value of one plane inside a cell, and its slopes along both axes per two texels.
template <class Arch>
struct CellSlopes {
    using V = xsimd::batch<float, Arch>;
    V x, z;
    V value;
};

/// Reads four columns around W cells. The columns lie in one or two groups of W columns. A group is
/// contiguous in memory for every block size. Four columns of the first group are loaded; the load
/// never extends past the end of the group. The first `shift` of these columns precede the wanted
/// ones. They are replaced by columns of the second group, and all four are rotated into order.
/// Nothing is read beyond a group.
template <class Arch>
class CellReader {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    static constexpr int lanes = static_cast<int>(V::size);

   public:
    PELAGIC_INLINE CellReader(const TexelOffsets<Arch>& offsets, I x, I z) {
        const I shift = xsimd::max(((x - I(1)) & I(lanes - 1)) - I(lanes - 4), I(0));
        const I shifts[4] = {lane_in_all<0, Arch>(shift), lane_in_all<1, Arch>(shift), lane_in_all<2, Arch>(shift),
                             lane_in_all<3, Arch>(shift)};
        const I order = I::load_aligned(lane_numbers);
        for (int k = 0; k < 4; ++k) {
            is_second_[k] = xsimd::to_float(order) < xsimd::to_float(shifts[k]);
            lanes_[k] = order + shifts[k];
        }
        const I first = offsets.column(x - I(1)) - shift, second = offsets.column((x + I(2)) & I(-lanes));
        for (int row = 0; row < 4; ++row) {
            const I at = offsets.row(z + I(row - 1));
            (first + at).store_aligned(reinterpret_cast<std::int32_t*>(first_[row]));
            (second + at).store_aligned(reinterpret_cast<std::int32_t*>(second_[row]));
        }
        keep_in_memory(first_);
        keep_in_memory(second_);
    }

    template <std::size_t Planes>
    PELAGIC_INLINE_LARGE void read(const float* const (&planes)[Planes],
                                   CellSurroundings<Arch> (&texels)[Planes]) const {
        read_row(0, planes, texels);
        read_row(1, planes, texels);
        read_row(2, planes, texels);
        read_row(3, planes, texels);
    }

   private:
    template <std::size_t Planes>
    PELAGIC_INLINE void read_row(int row, const float* const (&planes)[Planes],
                                 CellSurroundings<Arch> (&texels)[Planes]) const {
        for (int k = 0; k < 4; ++k) {
            for (std::size_t plane = 0; plane < Planes; ++plane) {
                const V first = fours_loaded<Arch>(planes[plane], first_[row] + k);
                const V second = fours_loaded<Arch>(planes[plane], second_[row] + k);
                texels[plane].at[row][k] =
                    lanes_rotated<Arch>(xsimd::select(is_second_[k], second, first), lanes_[k]);
            }
        }
        for (std::size_t plane = 0; plane < Planes; ++plane) fours_rotated<Arch>(texels[plane].at[row]);
    }

    alignas(64) static constexpr std::int32_t lane_numbers[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    xsimd::batch_bool<float, Arch> is_second_[4];
    I lanes_[4];
    alignas(64) std::uint32_t first_[4][V::size], second_[4][V::size];
};

/// Bilinear interpolation between texels. Slopes are central differences at the corners of the
/// cell, also interpolated.
template <class Arch>
class LinearPosition {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE LinearPosition(V u, V v) : u_(u), v_(v) {}

    PELAGIC_INLINE CellSlopes<Arch> slopes(const CellSurroundings<Arch>& texels) const {
        const auto& [a, b, c, d] = texels.at;
        return {.x = bilinear<Arch>({b[2] - b[0], b[3] - b[1], c[2] - c[0], c[3] - c[1]}, u_, v_),
                .z = bilinear<Arch>({c[1] - a[1], c[2] - a[2], d[1] - b[1], d[2] - b[2]}, u_, v_),
                .value = bilinear<Arch>({b[1], b[2], c[1], c[2]}, u_, v_)};
    }
    /// Reads values of planes at W cells, without slopes.
    template <std::size_t Planes>
    PELAGIC_INLINE void read(const TexelOffsets<Arch>& offsets, I x, I z, const float* const (&planes)[Planes],
                             V (&values)[Planes]) const {
        const CellGather<Arch> cell(offsets, x, z);
        Corners<Arch> corners[Planes];
        cell.corners(planes, corners);
        for (std::size_t plane = 0; plane < Planes; ++plane) values[plane] = bilinear<Arch>(corners[plane], u_, v_);
    }

   private:
    V u_, v_;
};

/// Weights of four texels in a row, from the texel before the cell to the texel after it, at t in
/// [0, 1] within the cell. The cubic has the texels' values and central differences at both ends of
/// the cell (Catmull and Rom 1974; Keys 1981, IEEE Trans. Acoust., Speech, Signal Process. 29,
/// 1153-1160, a = -1/2). At t = 0 and t = 1 it equals the texels exactly.
template <class Arch>
struct CubicWeights {
    using V = xsimd::batch<float, Arch>;
    V value[4];
    V slope[4];  ///< per two texels

    PELAGIC_INLINE explicit CubicWeights(V t) {
        const V half_t = V(0.5f) * t, half_t_squared = half_t * t, three_t = V(3.f) * t, nine_t = V(9.f) * t;
        value[0] = half_t * (t * (V(2.f) - t) - V(1.f));
        value[1] = V(1.f) + half_t_squared * (three_t - V(5.f));
        value[2] = half_t * (V(1.f) + t * (V(4.f) - three_t));
        value[3] = half_t_squared * (t - V(1.f));
        slope[0] = t * (V(4.f) - three_t) - V(1.f);
        slope[1] = t * (nine_t - V(10.f));
        slope[2] = V(1.f) + t * (V(8.f) - nine_t);
        slope[3] = t * (three_t - V(2.f));
    }
};

/// Bicubic interpolation: the product of the cubics along both axes. Slopes are its derivatives.
template <class Arch>
class CubicPosition {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE CubicPosition(V u, V v) : u_(u), v_(v) {}

    PELAGIC_INLINE CellSlopes<Arch> slopes(const CellSurroundings<Arch>& texels) const {
        V rows[4], slopes[4];
        for (int row = 0; row < 4; ++row) {
            rows[row] = sum(u_.value, texels.at[row]);
            slopes[row] = sum(u_.slope, texels.at[row]);
        }
        return {.x = sum(v_.value, slopes), .z = sum(v_.slope, rows), .value = sum(v_.value, rows)};
    }
    template <std::size_t Planes>
    PELAGIC_INLINE void read(const TexelOffsets<Arch>& offsets, I x, I z, const float* const (&planes)[Planes],
                             V (&values)[Planes]) const {
        CellSurroundings<Arch> texels[Planes];
        CellReader<Arch>(offsets, x, z).read(planes, texels);
        for (std::size_t plane = 0; plane < Planes; ++plane) {
            V rows[4];
            for (int row = 0; row < 4; ++row) rows[row] = sum(u_.value, texels[plane].at[row]);
            values[plane] = sum(v_.value, rows);
        }
    }

   private:
    PELAGIC_INLINE static V sum(const V (&weights)[4], const V (&of)[4]) {
        return (weights[0] * of[0] + weights[1] * of[1]) + (weights[2] * of[2] + weights[3] * of[3]);
    }

    CubicWeights<Arch> u_, v_;
};

/// Value and slopes of one horizontal component inside a cell, in texels.
template <class Arch>
struct Horizontal {
    using V = xsimd::batch<float, Arch>;
    V value, along_u, along_v;

    PELAGIC_INLINE Horizontal(const Corners<Arch>& c, V u, V v, V texels_per_m) {
        const V low = between<Arch>(c.v00, c.v10, u), high = between<Arch>(c.v01, c.v11, u);
        value = between<Arch>(low, high, v) * texels_per_m;
        along_u = between<Arch>(c.v10 - c.v00, c.v11 - c.v01, v) * texels_per_m;
        along_v = (high - low) * texels_per_m;
    }
    PELAGIC_INLINE Horizontal(const CellSlopes<Arch>& cell, V texels_per_m)
        : value(cell.value * texels_per_m),
          along_u(cell.x * (V(0.5f) * texels_per_m)),
          along_v(cell.z * (V(0.5f) * texels_per_m)) {}
};

/// The horizontal displacement at the corners of W cells. The last steps of a search stay inside
/// one cell and load nothing.
template <class Arch>
class LinearCells {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE void load(const SurfaceTexels& surface, const TexelOffsets<Arch>& offsets, I x, I z) {
        if (SharedCell<Arch>::is_shared(x, z))
            SharedCell<Arch>(offsets, x, z).corners({surface.dx, surface.dz}, texels_);
        else
            CellGather<Arch>(offsets, x, z).corners({surface.dx, surface.dz}, texels_);
    }
    PELAGIC_INLINE Horizontal<Arch> dx(V u, V v, V texels_per_m) const { return {texels_[0], u, v, texels_per_m}; }
    PELAGIC_INLINE Horizontal<Arch> dz(V u, V v, V texels_per_m) const { return {texels_[1], u, v, texels_per_m}; }

   private:
    Corners<Arch> texels_[2];
};

/// The horizontal displacement at the 4 x 4 texels around W cells.
template <class Arch>
class CubicCells {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE void load(const SurfaceTexels& surface, const TexelOffsets<Arch>& offsets, I x, I z) {
        if (SharedCell<Arch>::is_shared(x, z))
            SharedCell<Arch>(offsets, x, z).read({surface.dx, surface.dz}, texels_);
        else
            CellReader<Arch>(offsets, x, z).read({surface.dx, surface.dz}, texels_);
    }
    PELAGIC_INLINE Horizontal<Arch> dx(V u, V v, V texels_per_m) const {
        return {CubicPosition<Arch>(u, v).slopes(texels_[0]), texels_per_m};
    }
    PELAGIC_INLINE Horizontal<Arch> dz(V u, V v, V texels_per_m) const {
        return {CubicPosition<Arch>(u, v).slopes(texels_[1]), texels_per_m};
    }

   private:
    CellSurroundings<Arch> texels_[2];
};

/// Cells that are reloaded when a search moves to another cell.
template <class Arch, class Cells>
class FollowedCells : public Cells {
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE void load(const SurfaceTexels& surface, const TexelOffsets<Arch>& offsets, I x, I z) {
        Cells::load(surface, offsets, x, z);
        x_ = x;
        z_ = z;
    }
    PELAGIC_INLINE void follow(const SurfaceTexels& surface, const TexelOffsets<Arch>& offsets, I x, I z) {
        if (!xsimd::all((x == x_) & (z == z_))) load(surface, offsets, x, z);
    }

    I x() const { return x_; }
    I z() const { return z_; }

   private:
    I x_, z_;
};

/// Interpolation policies of the query kernels. A policy defines the interpolation between texels
/// and the texels that a search for a reference position loads. It also defines whether the search
/// starts at the world position or at the result of an earlier search.
struct Linear {
    template <class Arch>
    using Position = LinearPosition<Arch>;
    template <class Arch>
    using Cells = FollowedCells<Arch, LinearCells<Arch>>;
    static constexpr bool begins_at_the_point = true;
};
struct Cubic {
    template <class Arch>
    using Position = CubicPosition<Arch>;
    template <class Arch>
    using Cells = FollowedCells<Arch, CubicCells<Arch>>;
    static constexpr bool begins_at_the_point = false;
};

/// W searches for a reference position.
template <class Arch, class Interpolation>
class Inversion {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE void begin(const InvertSurfaceJob& job, std::size_t at) {
        const CellPositions& from = Interpolation::begins_at_the_point ? job.world : job.rest;
        world_x_ = I::load_aligned(job.world.cell_x + at);
        world_z_ = I::load_aligned(job.world.cell_z + at);
        world_u_ = V::load_aligned(job.world.u + at);
        world_v_ = V::load_aligned(job.world.v + at);
        x_ = I::load_aligned(from.cell_x + at);
        z_ = I::load_aligned(from.cell_z + at);
        u_ = V::load_aligned(from.u + at);
        v_ = V::load_aligned(from.v + at);
    }

    PELAGIC_INLINE_LARGE void evaluate(const InvertSurfaceJob& job, const TexelOffsets<Arch>& offsets, bool is_first) {
        if (is_first)
            cells_.load(job.surface, offsets, x_, z_);
        else
            cells_.follow(job.surface, offsets, x_, z_);
        const Horizontal<Arch> dx = cells_.dx(u_, v_, V(job.texels_per_m)),
                               dz = cells_.dz(u_, v_, V(job.texels_per_m));

        // Distance of the displaced point from the world position, in texels.
        const V off_x = xsimd::to_float(x_ - world_x_) + (u_ - world_u_) + dx.value;
        const V off_z = xsimd::to_float(z_ - world_z_) + (v_ - world_v_) + dz.value;
        squared_ = off_x * off_x + off_z * off_z;

        const V j_xx = V(1.f) + dx.along_u, j_zz = V(1.f) + dz.along_v;
        const V determinant = j_xx * j_zz - dx.along_v * dz.along_u;
        const auto newton = (determinant > V(InvertSurfaceJob::min_determinant)) &
                            (xsimd::max(xsimd::abs(off_x), xsimd::abs(off_z)) < V(InvertSurfaceJob::newton_reach));
        const V inverse = divided<Arch>(V(1.f), xsimd::select(newton, determinant, V(1.f)));
        step_x_ = xsimd::select(newton, (j_zz * off_x - dx.along_v * off_z) * inverse, off_x);
        step_z_ = xsimd::select(newton, (j_xx * off_z - dz.along_u * off_x) * inverse, off_z);
    }

    PELAGIC_INLINE auto open(V enough) const { return squared_ > enough; }

    /// Steps all lanes that have not converged. Converged lanes do not change, whatever the other
    /// lanes do.
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

    typename Interpolation::template Cells<Arch> cells_;
    I world_x_, world_z_, x_, z_;
    V world_u_, world_v_, u_, v_;
    V squared_, step_x_, step_z_;
};

/// Runs the searches of several registers together, so that the loads of one register overlap the
/// arithmetic of the others.
template <class Arch, class Interpolation, std::size_t Registers>
PELAGIC_INLINE void invert_registers(const InvertSurfaceJob& job, const TexelOffsets<Arch>& offsets, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    const V enough(job.target * job.target);
    Inversion<Arch, Interpolation> searches[Registers];
    for (std::size_t r = 0; r < Registers; ++r) searches[r].begin(job, at + r * V::size);
    for (int step = 0;; ++step) {
        for (auto& search : searches) search.evaluate(job, offsets, step == 0);
        auto open = searches[0].open(enough);
        for (std::size_t r = 1; r < Registers; ++r) open = open | searches[r].open(enough);
        if (step == InvertSurfaceJob::max_steps || !xsimd::any(open)) break;
        for (auto& search : searches) search.step(enough);
    }
    for (std::size_t r = 0; r < Registers; ++r) searches[r].store(job, at + r * V::size);
}

template <class Arch, class Interpolation>
void invert_surface(const InvertSurfaceJob& job) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    const TexelOffsets<Arch> offsets(job.surface);
    std::size_t at = 0;
    for (; at + 4 * lanes <= job.count; at += 4 * lanes) invert_registers<Arch, Interpolation, 4>(job, offsets, at);
    for (; at + 2 * lanes <= job.count; at += 2 * lanes) invert_registers<Arch, Interpolation, 2>(job, offsets, at);
    if (at < job.count) invert_registers<Arch, Interpolation, 1>(job, offsets, at);
}

template <class Arch, class Interpolation>
PELAGIC_INLINE void sample_lanes(const SampleSurfaceJob& job, const TexelOffsets<Arch>& offsets, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    const I x = I::load_aligned(job.rest.cell_x + at), z = I::load_aligned(job.rest.cell_z + at);
    const V u = V::load_aligned(job.rest.u + at), v = V::load_aligned(job.rest.v + at);
    const typename Interpolation::template Position<Arch> position(u, v);
    const SampleSurfaceJob::Outputs& out = job.out;

    if (out.normal_x) {
        CellSurroundings<Arch> texels[3];
        CellReader<Arch>(offsets, x, z).read({job.surface.dx, job.surface.height, job.surface.dz}, texels);
        const CellSlopes<Arch> dx = position.slopes(texels[0]), h = position.slopes(texels[1]),
                               dz = position.slopes(texels[2]);
        // Multiplied by (2 L/N)^2, as in store_normal() in gradients.kernel.hpp; normalisation
        // removes the factor.
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
        V height[1];
        position.read(offsets, x, z, {job.surface.height}, height);
        height[0].store_aligned(out.height + at);
    }
    if (out.velocity_x) {
        V velocity[3];
        position.read(offsets, x, z, {job.surface.velocity_x, job.surface.velocity_y, job.surface.velocity_z},
                      velocity);
        velocity[0].store_aligned(out.velocity_x + at);
        velocity[1].store_aligned(out.velocity_y + at);
        velocity[2].store_aligned(out.velocity_z + at);
    }
}

template <class Arch, class Interpolation>
void sample_surface(const SampleSurfaceJob& job) {
    const TexelOffsets<Arch> offsets(job.surface);
    for (std::size_t at = 0; at < job.count; at += xsimd::batch<float, Arch>::size)
        sample_lanes<Arch, Interpolation>(job, offsets, at);
}

}  // namespace pelagic::kernels
