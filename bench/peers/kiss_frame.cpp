#include "pelagic/bench/peers/kiss_frame.hpp"

#include <kiss_fftnd.h>
#include <kiss_fftr.h>

#include <array>
#include <new>
#include <vector>

namespace pelagic::peers {
namespace {

const kiss_fft_cpx* numbers(const AlignedBuffer<float>& data) {
    return reinterpret_cast<const kiss_fft_cpx*>(data.data());
}

}  // namespace

// Debian's KISS FFT 131.1.0 has a two-dimensional complex transform, but fails to plan a real one
// from N = 64 on. to_real() therefore does the steps of kiss_fftndri(): columns, then rows.
struct KissFrame::Plans {
    explicit Plans(int n) : size(static_cast<std::size_t>(n)), columns(size * (size / 2 + 1)), row(size / 2 + 1) {
        const std::array<int, 2> sides = {n, n};
        both = kiss_fftnd_alloc(sides.data(), 2, 1, nullptr, nullptr);
        column = kiss_fft_alloc(n, 1, nullptr, nullptr);
        real_row = kiss_fftr_alloc(n, 1, nullptr, nullptr);
        if (!both || !column || !real_row) throw std::bad_alloc();
    }
    ~Plans() {
        kiss_fft_free(both);
        kiss_fft_free(column);
        kiss_fftr_free(real_row);
    }
    Plans(const Plans&) = delete;
    Plans& operator=(const Plans&) = delete;

    /// Transforms N rows of N/2 + 1 complex numbers to N x N real ones.
    void to_real(const kiss_fft_cpx* spectrum, float* plane) {
        const std::size_t stored = size / 2 + 1;
        for (std::size_t x = 0; x < stored; ++x)
            kiss_fft_stride(column, spectrum + x, columns.data() + x * size, static_cast<int>(stored));
        for (std::size_t z = 0; z < size; ++z) {
            for (std::size_t x = 0; x < stored; ++x) row[x] = columns[x * size + z];
            kiss_fftri(real_row, row.data(), plane + z * size);
        }
    }

    std::size_t size;
    kiss_fftnd_cfg both = nullptr;
    kiss_fft_cfg column = nullptr;
    kiss_fftr_cfg real_row = nullptr;
    std::vector<kiss_fft_cpx> columns, row;
};

KissFrame::KissFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement)
    : LibraryFrame(sea, isa, arrangement), plans_(std::make_unique<Plans>(sea.resolution)) {}

KissFrame::~KissFrame() = default;

void KissFrame::transform() {
    plans_->to_real(numbers(height_spectrum_), plane(1));
    if (arrangement_ == FieldArrangement::packed) {
        kiss_fftnd(plans_->both, numbers(horizontal_spectrum_), reinterpret_cast<kiss_fft_cpx*>(horizontal_.data()));
        return;
    }
    plans_->to_real(numbers(dx_spectrum_), plane(0));
    plans_->to_real(numbers(dz_spectrum_), plane(2));
}

}  // namespace pelagic::peers
