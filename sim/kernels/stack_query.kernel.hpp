#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/surface_query.kernel.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/gather.kernel.hpp"

namespace pelagic::kernels {

/// W positions in one cascade, cell and position within the cell: world + offset.
template <class Arch>
struct StackPositions {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    I x, z;
    V u, v;

    PELAGIC_INLINE StackPositions(const StackCascade& cascade, std::size_t at, V offset_x, V offset_z) {
        const V along(cascade.along), across(cascade.across);
        split(cascade.world.cell_x + at,
              V::load_aligned(cascade.world.u + at) + (along * offset_x + across * offset_z), x, u);
        split(cascade.world.cell_z + at,
              V::load_aligned(cascade.world.v + at) + (along * offset_z - across * offset_x), z, v);
    }

   private:
    PELAGIC_INLINE static void split(const std::int32_t* world, V moved, I& cell, V& within) {
        const V cut = xsimd::to_float(xsimd::to_int(moved));
        const V whole = cut - xsimd::select(cut > moved, V(1.f), V(0.f));
        cell = I::load_aligned(world) + xsimd::to_int(whole);
        within = moved - whole;
    }
};

/// The weight of a cascade at W points. Without weights no multiplication is executed.
template <class Arch, bool HasWeights>
struct CascadeWeight {
    using V = xsimd::batch<float, Arch>;
    V weight;

    PELAGIC_INLINE CascadeWeight(const StackCascade& cascade, std::size_t at)
        : weight(HasWeights ? V::load_aligned(cascade.weight + at) : V(1.f)) {}
    PELAGIC_INLINE V of(V value) const { return HasWeights ? weight * value : value; }
};

/// W searches for a reference position.
template <class Arch, class Interpolation, bool HasWeights>
class StackSearch {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    /// Starts at the offsets of an earlier search.
    PELAGIC_INLINE void begin_at_offset(const InvertStackJob& job, std::size_t at) {
        x_ = V::load_aligned(job.offset_x + at);
        z_ = V::load_aligned(job.offset_z + at);
    }
    PELAGIC_INLINE_LARGE void evaluate(const InvertStackJob& job, std::size_t cascades, std::size_t at) {
        V off_x = x_, off_z = z_;
        V x_x(1.f), x_z(0.f), z_x(0.f), z_z(1.f);
        for (std::size_t t = 0; t < cascades; ++t) {
            const StackCascade& cascade = job.cascades[t];
            const TexelOffsets<Arch> texels(cascade.surface);
            const StackPositions<Arch> position(cascade, at, x_, z_);
            if (t >= cascades_loaded_)
                cells_[t].load(cascade.surface, texels, position.x, position.z);
            else
                cells_[t].follow(cascade.surface, texels, position.x, position.z);
            const Horizontal<Arch> dx = cells_[t].dx(position.u, position.v, V(1.f)),
                                   dz = cells_[t].dz(position.u, position.v, V(1.f));
            const CascadeWeight<Arch, HasWeights> weight(cascade, at);
            const V along = weight.of(V(cascade.along)), across = weight.of(V(cascade.across));
            off_x = off_x + weight.of(dx.value);
            off_z = off_z + weight.of(dz.value);
            x_x = x_x + (along * dx.along_u - across * dx.along_v);
            x_z = x_z + (across * dx.along_u + along * dx.along_v);
            z_x = z_x + (along * dz.along_u - across * dz.along_v);
            z_z = z_z + (across * dz.along_u + along * dz.along_v);
        }
        cascades_loaded_ = cascades;
        squared_ = off_x * off_x + off_z * off_z;
        const V determinant = x_x * z_z - x_z * z_x;
        const auto newton = determinant > V(InvertStackJob::min_determinant);
        const V inverse = divided<Arch>(V(1.f), xsimd::select(newton, determinant, V(1.f)));
        step_x_ = xsimd::select(newton, (z_z * off_x - x_z * off_z) * inverse, off_x);
        step_z_ = xsimd::select(newton, (x_x * off_z - z_x * off_x) * inverse, off_z);
    }

    PELAGIC_INLINE auto open(V enough) const { return squared_ > enough; }

    PELAGIC_INLINE void step(V reach) {
        x_ = within(x_ - step_x_, reach);
        z_ = within(z_ - step_z_, reach);
    }
    /// Steps all lanes that have not converged. Converged lanes do not change, whatever the other
    /// lanes do.
    PELAGIC_INLINE void step(V reach, V enough) {
        x_ = xsimd::select(open(enough), within(x_ - step_x_, reach), x_);
        z_ = xsimd::select(open(enough), within(z_ - step_z_, reach), z_);
    }

    PELAGIC_INLINE void store(const InvertStackJob& job, std::size_t at) const {
        x_.store_aligned(job.offset_x + at);
        z_.store_aligned(job.offset_z + at);
        square_root<Arch>(squared_).store_aligned(job.error + at);
        for (std::size_t t = 0; t < job.cascade_count; ++t) {
            static_assert(FindContractionJob::block_rows == 4);
            const int n = job.cascades[t].surface.resolution;
            const I column = cells_[t].x() & I(n - 1), row = cells_[t].z() >> 2 & I(n / 4 - 1);
            (row * I(n) + column).store_aligned(job.blocks[t] + at);
        }
    }

   private:
    PELAGIC_INLINE static V within(V offset, V reach) {
        return xsimd::min(xsimd::max(offset, V(0.f) - reach), reach);
    }

    typename Interpolation::template Cells<Arch> cells_[max_cascades];
    std::size_t cascades_loaded_ = 0;
    V x_ = V(0.f), z_ = V(0.f);
    V squared_, step_x_, step_z_;
};

/// Several registers of searches, so that the loads of one overlap the arithmetic of the others.
template <class Arch, class Interpolation, bool HasWeights, std::size_t Registers>
class StackSearches {
    using V = xsimd::batch<float, Arch>;

   public:
    StackSearches(const InvertStackJob& job, std::size_t at)
        : job_(job), at_(at), enough_(job.target * job.target), reach_(job.reach) {}

    PELAGIC_INLINE void begin_at_offset() {
        for (std::size_t r = 0; r < Registers; ++r) searches_[r].begin_at_offset(job_, first_lane(r));
    }
    PELAGIC_INLINE void step_with_first_cascades() {
        for (std::size_t r = 0; r < Registers; ++r)
            searches_[r].evaluate(job_, InvertStackJob::first_cascades, first_lane(r));
        for (auto& search : searches_) search.step(reach_);
    }
    /// Runs steps until all lanes have converged. Returns false if some have not in the last step.
    PELAGIC_INLINE bool converge(int step, int last_step) {
        for (;; ++step) {
            for (std::size_t r = 0; r < Registers; ++r) searches_[r].evaluate(job_, job_.cascade_count, first_lane(r));
            auto open = searches_[0].open(enough_);
            for (std::size_t r = 1; r < Registers; ++r) open = open | searches_[r].open(enough_);
            if (!xsimd::any(open)) return true;
            if (step == last_step) return false;
            for (auto& search : searches_) search.step(reach_, enough_);
        }
    }
    /// Steps the lanes that have not converged, and adds their numbers to `open`.
    PELAGIC_INLINE std::size_t step_open(std::uint32_t* open) {
        std::size_t count = 0;
        for (std::size_t r = 0; r < Registers; ++r) {
            alignas(64) float is_open[V::size];
            xsimd::select(searches_[r].open(enough_), V(1.f), V(0.f)).store_aligned(is_open);
            for (std::size_t lane = 0; lane < V::size; ++lane) {
                open[count] = static_cast<std::uint32_t>(first_lane(r) + lane);
                count += is_open[lane] != 0;
            }
            searches_[r].step(reach_, enough_);
        }
        return count;
    }
    PELAGIC_INLINE void store() const {
        for (std::size_t r = 0; r < Registers; ++r) searches_[r].store(job_, first_lane(r));
    }

   private:
    PELAGIC_INLINE std::size_t first_lane(std::size_t r) const { return at_ + r * V::size; }

    const InvertStackJob& job_;
    std::size_t at_;
    V enough_, reach_;
    StackSearch<Arch, Interpolation, HasWeights> searches_[Registers];
};

/// Searches that few lanes of their registers still need. They continue in registers of their own.
/// Lanes are independent, so this changes no result.
template <class Arch, class Interpolation, bool HasWeights>
class OpenSearches {
    static constexpr std::size_t lanes = xsimd::batch<float, Arch>::size, together = 2 * lanes;

   public:
    /// The last step before searches move to registers of their own. Most searches need no other.
    static constexpr int last_step = 2;

    explicit OpenSearches(const InvertStackJob& job) : job_(job) {}

    /// Adds the open searches of two registers.
    template <std::size_t Registers>
    PELAGIC_INLINE void add(StackSearches<Arch, Interpolation, HasWeights, Registers>& searches) {
        count_ += searches.step_open(open_ + count_);
    }
    void run_full() {
        if (count_ < together) return;
        count_ -= together;
        run<2>(open_ + count_, together);
    }
    void run_rest() {
        if (count_ > lanes)
            run<2>(open_, count_);
        else if (count_ > 0)
            run<1>(open_, count_);
    }

   private:
    template <std::size_t Registers>
    void run(const std::uint32_t* open, std::size_t count) {
        Inputs in;
        InvertStackJob job = job_;
        job.offset_x = in.offset_x, job.offset_z = in.offset_z, job.error = in.error;
        for (std::size_t t = 0; t < job.cascade_count; ++t) {
            StackCascade& cascade = job.cascades[t];
            cascade.world = {in.cell_x[t], in.cell_z[t], in.u[t], in.v[t]};
            if (HasWeights) cascade.weight = in.weight[t];
            job.blocks[t] = in.blocks[t];
        }
        for (std::size_t i = 0; i < Registers * lanes; ++i) {
            const std::size_t from = open[i < count ? i : 0];
            in.offset_x[i] = job_.offset_x[from], in.offset_z[i] = job_.offset_z[from];
            for (std::size_t t = 0; t < job.cascade_count; ++t) {
                const StackCascade& cascade = job_.cascades[t];
                in.cell_x[t][i] = cascade.world.cell_x[from], in.cell_z[t][i] = cascade.world.cell_z[from];
                in.u[t][i] = cascade.world.u[from], in.v[t][i] = cascade.world.v[from];
                if (HasWeights) in.weight[t][i] = cascade.weight[from];
            }
        }
        StackSearches<Arch, Interpolation, HasWeights, Registers> searches(job, 0);
        searches.begin_at_offset();
        searches.converge(last_step + 1, InvertStackJob::max_steps);
        searches.store();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t to = open[i];
            job_.offset_x[to] = in.offset_x[i], job_.offset_z[to] = in.offset_z[i], job_.error[to] = in.error[i];
            for (std::size_t t = 0; t < job.cascade_count; ++t) job_.blocks[t][to] = in.blocks[t][i];
        }
    }

    struct Inputs {
        alignas(64) std::int32_t cell_x[max_cascades][together], cell_z[max_cascades][together];
        alignas(64) std::int32_t blocks[max_cascades][together];
        alignas(64) float u[max_cascades][together], v[max_cascades][together], weight[max_cascades][together];
        alignas(64) float offset_x[together], offset_z[together], error[together];
    };

    const InvertStackJob& job_;
    std::uint32_t open_[2 * together + 1];
    std::size_t count_ = 0;
};

template <class Arch, class Interpolation, bool HasWeights>
void invert_stack_points(const InvertStackJob& job) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    OpenSearches<Arch, Interpolation, HasWeights> open(job);
    const auto search = [&](auto searches) PELAGIC_INLINE_LAMBDA {
        if (!Interpolation::begins_at_the_point)
            searches.begin_at_offset();
        else if (job.cascade_count > InvertStackJob::first_cascades)
            searches.step_with_first_cascades();
        if (!searches.converge(0, open.last_step)) open.add(searches);
        searches.store();
        open.run_full();
    };
    std::size_t at = 0;
    for (; at + 2 * lanes <= job.count; at += 2 * lanes)
        search(StackSearches<Arch, Interpolation, HasWeights, 2>(job, at));
    if (at < job.count) search(StackSearches<Arch, Interpolation, HasWeights, 1>(job, at));
    open.run_rest();
}

template <class Arch, class Interpolation>
void invert_stack(const InvertStackJob& job) {
    if (job.cascades[0].weight)
        invert_stack_points<Arch, Interpolation, true>(job);
    else
        invert_stack_points<Arch, Interpolation, false>(job);
}

/// Value of one plane and its slopes along the world's axes, summed over the cascades.
template <class Arch>
struct SlopeSum {
    using V = xsimd::batch<float, Arch>;
    V value = V(0.f), x = V(0.f), z = V(0.f);

    template <bool HasWeights>
    PELAGIC_INLINE void add(const CellSlopes<Arch>& cascade, const CascadeWeight<Arch, HasWeights>& weight,
                            V half_along, V half_across) {
        value = value + weight.of(cascade.value);
        x = x + (half_along * cascade.x - half_across * cascade.z);
        z = z + (half_across * cascade.x + half_along * cascade.z);
    }
};

template <class Arch, class Interpolation, bool HasWeights>
PELAGIC_INLINE void sample_stack_lanes(const SampleStackJob& job, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    const V offset_x = V::load_aligned(job.offset_x + at), offset_z = V::load_aligned(job.offset_z + at);
    const SampleSurfaceJob::Outputs& out = job.out;
    SlopeSum<Arch> dx, height, dz;
    V velocity_x(0.f), velocity_y(0.f), velocity_z(0.f);
    for (std::size_t t = 0; t < job.cascade_count; ++t) {
        const StackCascade& cascade = job.cascades[t];
        const TexelOffsets<Arch> texels(cascade.surface);
        const StackPositions<Arch> position(cascade, at, offset_x, offset_z);
        const typename Interpolation::template Position<Arch> sampled(position.u, position.v);
        const CascadeWeight<Arch, HasWeights> weight(cascade, at);
        if (out.normal_x) {
            const V half_along = weight.of(V(0.5f * cascade.along)),
                    half_across = weight.of(V(0.5f * cascade.across));
            const auto add = [&](const auto& cell) PELAGIC_INLINE_LAMBDA {
                CellSurroundings<Arch> around[3];
                cell.read({cascade.surface.dx, cascade.surface.height, cascade.surface.dz}, around);
                dx.add(sampled.slopes(around[0]), weight, half_along, half_across);
                height.add(sampled.slopes(around[1]), weight, half_along, half_across);
                dz.add(sampled.slopes(around[2]), weight, half_along, half_across);
            };
            if (SharedCell<Arch>::is_shared(position.x, position.z))
                add(SharedCell<Arch>(texels, position.x, position.z));
            else
                add(CellReader<Arch>(texels, position.x, position.z));
        } else if (out.height) {
            V values[1];
            sampled.read(texels, position.x, position.z, {cascade.surface.height}, values);
            height.value = height.value + weight.of(values[0]);
        }
        if (out.velocity_x) {
            V values[3];
            sampled.read(texels, position.x, position.z,
                          {cascade.surface.velocity_x, cascade.surface.velocity_y, cascade.surface.velocity_z},
                          values);
            velocity_x = velocity_x + weight.of(values[0]);
            velocity_y = velocity_y + weight.of(values[1]);
            velocity_z = velocity_z + weight.of(values[2]);
        }
    }
    if (out.height) height.value.store_aligned(out.height + at);
    if (out.normal_x) {
        const V x_x = V(1.f) + dx.x, z_z = V(1.f) + dz.z;
        const V n_x = height.z * dz.x - height.x * z_z;
        const V n_y = x_x * z_z - dx.z * dz.x;
        const V n_z = height.x * dx.z - height.z * x_x;
        const V length = square_root<Arch>(xsimd::max(n_x * n_x + n_y * n_y + n_z * n_z, V(1e-30f)));
        const V inverse = divided<Arch>(V(1.f), length);
        (n_x * inverse).store_aligned(out.normal_x + at);
        (n_y * inverse).store_aligned(out.normal_y + at);
        (n_z * inverse).store_aligned(out.normal_z + at);
        n_y.store_aligned(out.jacobian + at);
    }
    if (out.velocity_x) {
        velocity_x.store_aligned(out.velocity_x + at);
        velocity_y.store_aligned(out.velocity_y + at);
        velocity_z.store_aligned(out.velocity_z + at);
    }
}

template <class Arch, class Interpolation>
void sample_stack(const SampleStackJob& job) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    if (job.cascades[0].weight)
        for (std::size_t at = 0; at < job.count; at += lanes) sample_stack_lanes<Arch, Interpolation, true>(job, at);
    else
        for (std::size_t at = 0; at < job.count; at += lanes) sample_stack_lanes<Arch, Interpolation, false>(job, at);
}

}  // namespace pelagic::kernels
