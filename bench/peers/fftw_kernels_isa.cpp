// Compiled once for each instruction set, with the rules of sim/kernels/kernels_isa.cpp.
#include "pelagic/bench/peers/fftw_kernels.hpp"
#include "pelagic/bench/peers/interleaved.kernel.hpp"
#include "pelagic/sim/kernels/columns_finalize.kernel.hpp"
#include "pelagic/sim/kernels/evolve_rows.kernel.hpp"
#include "pelagic/sim/kernels/gradients.kernel.hpp"

#define PELAGIC_JOINED(a, b) a##b
#define PELAGIC_TABLE(name) PELAGIC_JOINED(fftw_kernels_, name)

namespace pelagic::peers {
namespace {

using Arch = xsimd::PELAGIC_ISA_ARCH;
using V = xsimd::batch<float, Arch>;
using U = xsimd::batch<std::uint32_t, Arch>;
using kernels::Complex;

void store(float* row, std::size_t number, const Complex<Arch>& value) {
    const Pair<Arch> numbers = interleaved<Arch>(value.re, value.im);
    numbers.first.store_unaligned(row + 2 * number);
    numbers.second.store_unaligned(row + 2 * number + V::size);
}

/// Stores lane i at index -(number + i) modulo `size`. Index 0 is its own negative and is written
/// elsewhere.
void store_negatives(float* row, std::size_t size, std::size_t number, const Complex<Arch>& value) {
    const Pair<Arch> numbers = reversed<Arch>(interleaved<Arch>(value.re, value.im));
    float* to = row + 2 * (size - number - V::size + 1);
    if (number > 0) {
        numbers.first.store_unaligned(to);
        numbers.second.store_unaligned(to + V::size);
        return;
    }
    float all[2 * V::size];
    numbers.first.store_unaligned(all);
    numbers.second.store_unaligned(all + V::size);
    for (std::size_t i = 0; i < 2 * (V::size - 1); ++i) to[i] = all[i];
}

template <class Store>
void evolve(const FftwEvolveJob& job, Store store_waves) {
    const std::size_t n = job.half_size;
    const auto row = [&](std::size_t quantity, std::size_t x) {
        return V::load_unaligned(job.waves.planes + quantity * n + x);
    };
    for (std::size_t x = 0; x < n; x += V::size) {
        const auto rotation =
            kernels::rotation_of_turns<Arch>(U::load_unaligned(job.waves.harmonics + x) * U(job.fraction));
        const V along = row(8, x), across = row(9, x);
        for (std::size_t sign = 0; sign < (job.is_one_row ? 1u : 2u); ++sign) {
            const std::size_t first = 4 * sign;
            const Complex<Arch> h{row(first, x) * rotation.cosine + row(first + 2, x) * rotation.sine,
                                  row(first + 1, x) * rotation.cosine + row(first + 3, x) * rotation.sine};
            store(job.height[sign], x, h);
            const V z = sign == 0 ? across : V(0.f) - across;
            // i h times the components of the direction.
            store_waves(sign, x, Complex<Arch>{V(0.f) - along * h.im, along * h.re},
                        Complex<Arch>{V(0.f) - z * h.im, z * h.re});
        }
    }
}

void evolve_packed(const FftwEvolveJob& job) {
    evolve(job, [&](std::size_t sign, std::size_t x, const Complex<Arch>& dx, const Complex<Arch>& dz) {
        // Dx + i Dz of the wave, and of its mirror image: conj(Dx) + i conj(Dz).
        store(job.horizontal[sign], x, {dx.re - dz.im, dx.im + dz.re});
        store_negatives(job.horizontal[1 - sign], 2 * job.half_size, x, {dx.re + dz.im, dz.re - dx.im});
    });
}

void evolve_separate(const FftwEvolveJob& job) {
    evolve(job, [&](std::size_t sign, std::size_t x, const Complex<Arch>& dx, const Complex<Arch>& dz) {
        store(job.dx[sign], x, dx);
        store(job.dz[sign], x, dz);
    });
}

void finalize(const FftwFinalizeJob& job) {
    const V factor(job.choppiness);
    V min(3.4e38f), max(-3.4e38f), max_x(0.f), max_z(0.f);
    for (std::size_t i = 0; i < job.texels; i += V::size) {
        Pair<Arch> horizontal{V::load_unaligned(job.dx + i), V::load_unaligned(job.dz + i)};
        if (job.horizontal)
            horizontal = deinterleaved<Arch>(V::load_unaligned(job.horizontal + 2 * i),
                                             V::load_unaligned(job.horizontal + 2 * i + V::size));
        const V dx = horizontal.first * factor, dz = horizontal.second * factor;
        dx.store_unaligned(job.dx + i);
        dz.store_unaligned(job.dz + i);
        const V height = V::load_unaligned(job.height + i);
        min = xsimd::min(min, height);
        max = xsimd::max(max, height);
        max_x = xsimd::max(max_x, xsimd::abs(dx));
        max_z = xsimd::max(max_z, xsimd::abs(dz));
    }
    *job.bounds = {kernels::min_lane<Arch>(min), kernels::max_lane<Arch>(max), kernels::max_lane<Arch>(max_x),
                   kernels::max_lane<Arch>(max_z)};
}

/// Three planes with tight rows.
class PlaneSurface {
   public:
    explicit PlaneSurface(const GradientsJob& job)
        : data_(job.surface), plane_stride_(job.block_stride), resolution_(job.resolution) {}

    struct RowPair {
        const float* first;
        std::size_t plane_stride, row_stride;

        PELAGIC_INLINE V at(SurfaceComponent component, std::size_t row) const {
            return V::load_unaligned(first + component * plane_stride + row * row_stride);
        }
        void next() { first += V::size; }
    };
    RowPair rows(std::size_t x, std::size_t z) const {
        return {data_ + z * resolution_ + x, plane_stride_, resolution_};
    }

    template <class Take>
    PELAGIC_INLINE void differences_of_row(std::size_t z, std::size_t first_column, std::size_t columns,
                                           Take take) const {
        const std::size_t last = resolution_ - 1;
        const float* row = data_ + z * resolution_;
        const float* above = data_ + ((z - 1) & last) * resolution_;
        const float* below = data_ + ((z + 1) & last) * resolution_;
        kernels::Seam<Arch> left[surface_components];
        const auto load = [&](const float* from, std::size_t component, std::size_t x) {
            return V::load_unaligned(from + component * plane_stride_ + x);
        };
        const std::size_t before = (first_column - V::size) & last;
        for (std::size_t component = 0; component < surface_components; ++component)
            left[component] = kernels::Seam<Arch>{load(row, component, before), load(row, component, first_column)};
        const auto step = [&](std::size_t x) {
            const std::size_t behind = (x + V::size) & last;
            kernels::Differences<Arch> along[surface_components];
            for (std::size_t component = 0; component < surface_components; ++component) {
                const V here = load(row, component, x);
                const kernels::Seam<Arch> right{here, load(row, component, behind)};
                along[component].x = kernels::lanes_behind<1, Arch>(here, right) -
                                     kernels::lanes_before<1, Arch>(left[component], here);
                along[component].z = load(below, component, x) - load(above, component, x);
                left[component] = right;
            }
            take(along);
        };
        for (std::size_t x = first_column; x < first_column + columns; x += V::size) step(x);
    }

   private:
    const float* data_;
    std::size_t plane_stride_, resolution_;
};

void gradients(const GradientsJob& job) { kernels::gradients_of<Arch>(job, PlaneSurface(job)); }

}  // namespace

extern const FftwKernels PELAGIC_TABLE(PELAGIC_ISA_NAME);

const FftwKernels PELAGIC_TABLE(PELAGIC_ISA_NAME) = {evolve_packed, evolve_separate, finalize, gradients};

}  // namespace pelagic::peers
