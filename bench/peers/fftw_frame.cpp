#include "pelagic/bench/peers/fftw_frame.hpp"

#include <fftw3.h>

#include <array>
#include <span>
#include <stdexcept>
#include <string>

namespace pelagic::peers {
namespace {

fftwf_complex* numbers(float* data) { return reinterpret_cast<fftwf_complex*>(data); }

unsigned flags_of(FftwPlanning planning) {
    return planning == FftwPlanning::read ? FFTW_PATIENT | FFTW_WISDOM_ONLY : FFTW_PATIENT;
}

fftwf_plan real_plan(std::size_t size, float* spectrum, float* plane, FftwPlanning planning) {
    const int n = static_cast<int>(size);
    return fftwf_plan_dft_c2r_2d(n, n, numbers(spectrum), plane, flags_of(planning));
}

}  // namespace

void write_fftw_plans(const std::string& file) {
    if (!fftwf_export_wisdom_to_filename(file.c_str()))
        throw std::runtime_error("can't write FFTW's plans to " + file);
}

void read_fftw_plans(const std::string& file) {
    if (!fftwf_import_wisdom_from_filename(file.c_str()))
        throw std::runtime_error("can't read FFTW's plans from " + file);
}

struct FftwFrame::Plans {
    std::array<fftwf_plan, 3> all{};
    ~Plans() {
        for (const fftwf_plan plan : all)
            if (plan) fftwf_destroy_plan(plan);
    }
};

FftwFrame::FftwFrame(const SeaState& sea, Isa isa, FieldArrangement arrangement, FftwPlanning planning)
    : LibraryFrame(sea, isa, arrangement), plans_(std::make_unique<Plans>()) {
    if (arrangement == FieldArrangement::packed) {
        const int n = sea.resolution;
        plans_->all = {real_plan(size_, height_spectrum_.data(), plane(1), planning),
                       fftwf_plan_dft_2d(n, n, numbers(horizontal_spectrum_.data()), numbers(horizontal_.data()),
                                         FFTW_BACKWARD, flags_of(planning))};
    } else {
        plans_->all = {real_plan(size_, height_spectrum_.data(), plane(1), planning),
                       real_plan(size_, dx_spectrum_.data(), plane(0), planning),
                       real_plan(size_, dz_spectrum_.data(), plane(2), planning)};
    }
    for (const fftwf_plan plan : std::span(plans_->all).first(arrangement == FieldArrangement::packed ? 2 : 3))
        if (!plan) throw std::runtime_error("FFTW has no plan for N = " + std::to_string(sea.resolution));
    clear_spectra();  // planning writes to the arrays
}

FftwFrame::~FftwFrame() = default;

void FftwFrame::transform() {
    for (const fftwf_plan plan : plans_->all)
        if (plan) fftwf_execute(plan);
}

}  // namespace pelagic::peers
