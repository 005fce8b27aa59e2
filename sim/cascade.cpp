#include "sim/cascade.hpp"

#include <algorithm>
#include <utility>

#include "sim/surface_look.hpp"
#include "sim/wave_blocks.hpp"
#include "simd/float_environment.hpp"

namespace pelagic {
namespace {

// Items a job. Jobs of 5 to 50 microseconds at N = 256 balance well and hide what scheduling costs.
constexpr std::size_t spectrum_batch = 2;
constexpr std::size_t finalize_batch = 16;
constexpr std::size_t gradients_batch = 8;

// A row is N texels and one lane block of padding: room for the wrapped neighbours x = -1 (the end of the row above)
// and x = N, and no power-of-two stride.
std::size_t plane_stride(int resolution) { return static_cast<std::size_t>(resolution) + lane_block; }

std::size_t plane_floats(int resolution) { return lane_block + plane_stride(resolution) * resolution; }

/// A stage whose items are independent, each in the default floating-point environment.
template <class Item>
JobBody for_each_item(Item item) {
    return [item](std::size_t begin, std::size_t end) {
        const DefaultFloatEnvironment environment;
        for (std::size_t i = begin; i < end; ++i) item(i);
    };
}

}  // namespace

Cascade::Slot::Slot(int n)
    : resolution(n),
      planes(3 * plane_floats(n)),
      rgba16f(4 * static_cast<std::size_t>(n) * n),
      rgba8(mip_offset(n, mip_levels(n))) {
    const auto view = [&](std::size_t c) {
        return PlaneView{plane(c), n, static_cast<std::ptrdiff_t>(plane_stride(n))};
    };
    frame.dx = view(0);
    frame.height = view(1);
    frame.dz = view(2);
    frame.displacement_rgba16f = {rgba16f.data(), rgba16f.size()};
    frame.gradient_rgba8 = {rgba8.data(), rgba8.size()};
}

float* Cascade::Slot::plane(std::size_t c) { return planes.data() + c * plane_floats(resolution) + lane_block; }

Cascade::Cascade(const SeaState& sea, const Kernels& kernels)
    : sea_(sea),
      kernels_(kernels),
      plan_(sea.resolution),
      fft_(plan_.tables()),
      spectrum_(sea.resolution),
      waves_(waves_floats(sea.resolution)),
      lines_(lines_floats(sea.resolution)),
      mip_averages_(sea.resolution),
      row_bounds_(static_cast<std::size_t>(sea.resolution) / finalize_batch),
      slots_{Slot(sea.resolution), Slot(sea.resolution)} {}

void Cascade::add_spectrum_stage(JobGraph& graph) {
    graph.add({.name = "spectrum",
               .count = line_count(sea_.resolution),
               .batch = spectrum_batch,
               .body = for_each_item([this](std::size_t line) { spectrum(line); })});
}

void Cascade::add_frame_stages(JobGraph& graph) {
    const std::size_t n = static_cast<std::size_t>(sea_.resolution);
    const StageId evolved = graph.add({.name = "evolve",
                                       .count = line_blocks(sea_.resolution),
                                       .body = for_each_item([this](std::size_t block) { evolve(block); })});
    const StageId rows_done = graph.add({.name = "rows",
                                         .count = line_blocks(sea_.resolution),
                                         .waits_for = {evolved},
                                         .body = for_each_item([this](std::size_t block) { rows(block); })});
    const StageId columns_done = graph.add({.name = "columns",
                                            .count = (column_blocks(sea_.resolution) + 1) / 2,
                                            .waits_for = {rows_done},
                                            .body = for_each_item([this](std::size_t pair) { columns(pair); })});
    const StageId finalized = graph.add({.name = "finalize",
                                         .count = n,
                                         .batch = finalize_batch,
                                         .waits_for = {columns_done},
                                         .body = [this](std::size_t begin, std::size_t end) {
                                             const DefaultFloatEnvironment environment;
                                             finalize(begin, end);
                                         }});
    const StageId gradients_done = graph.add({.name = "gradients",
                                              .count = n / 2,
                                              .batch = gradients_batch,
                                              .waits_for = {finalized},
                                              .body = for_each_item([this](std::size_t pair) { gradients(pair); })});
    const StageId bands_done = graph.add({.name = "mipmaps",
                                          .count = mip_bands(sea_.resolution),
                                          .waits_for = {gradients_done},
                                          .body = for_each_item([this](std::size_t band) { mipmaps(band); })});
    // clang-format off: it would indent the body beyond the name.
    graph.add({.name = "mipmaps tail",
               .count = 1,
               .waits_for = {bands_done},
               .body = for_each_item([this](std::size_t) { mipmaps_tail(); })});
    // clang-format on
}

void Cascade::begin_frame(double time_s) {
    const DefaultFloatEnvironment environment;
    back_ = 1 - back_;
    back().frame.time_s = time_s;
    fraction_ = loop_fraction(time_s, sea_.loop_period_s);
}

const Frame& Cascade::end_frame() {
    RowBounds all = row_bounds_.front();
    for (const RowBounds& rows : row_bounds_) {
        all.height_min = std::min(all.height_min, rows.height_min);
        all.height_max = std::max(all.height_max, rows.height_max);
        all.sideways_x_max = std::max(all.sideways_x_max, rows.sideways_x_max);
        all.sideways_z_max = std::max(all.sideways_z_max, rows.sideways_z_max);
    }
    back().frame.bounds = {all.height_min, all.height_max, all.sideways_x_max, all.sideways_z_max};
    return back().frame;
}

void Cascade::begin_spectrum(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    bake_.emplace(Bake{sea, WaveSpectrum(sea), PackedSpectrum(sea.resolution)});
}

void Cascade::adopt_spectrum() {
    spectrum_ = std::move(bake_->spectrum);
    sea_ = bake_->sea;
    bake_.reset();
}

void Cascade::spectrum(std::size_t line) { bake_spectrum_line(bake_->sea, bake_->model, line, bake_->spectrum); }

void Cascade::evolve(std::size_t block) {
    const std::size_t n = static_cast<std::size_t>(sea_.resolution);
    kernels_.evolve({.modes = spectrum_.modes.data() + block * n,
                     .count = n,
                     .fraction = fraction_.turns,
                     .waves = waves_.data() + block * waves_block_floats(sea_.resolution)});
}

void Cascade::rows(std::size_t block) {
    const std::size_t first_line = block * lane_block;
    kernels_.rows({.waves = waves_.data() + block * waves_block_floats(sea_.resolution),
                   .first_line = first_line,
                   .line_count = std::min(lane_block, line_count(sea_.resolution) - first_line),
                   .fft = &fft_,
                   .lines = lines_.data()});
}

void Cascade::columns(std::size_t block_pair) {
    ColumnsJob job{.lines = {}, .fft = &fft_, .surface = {}};
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t block = 2 * block_pair + i;
        if (block == column_blocks(sea_.resolution)) break;
        job.lines[i] = lines_.data() + block * lines_block_floats(sea_.resolution);
        job.surface[i] = waves_.data() + block * surface_block_floats(sea_.resolution);
    }
    kernels_.columns(job);
}

void Cascade::finalize(std::size_t first_row, std::size_t end_row) {
    kernels_.finalize({.surface = waves_.data(),
                       .resolution = static_cast<std::size_t>(sea_.resolution),
                       .first_row = first_row,
                       .end_row = end_row,
                       .choppiness = static_cast<float>(sea_.choppiness),
                       .planes = {back().plane(0), back().plane(1), back().plane(2)},
                       .stride = static_cast<std::ptrdiff_t>(plane_stride(sea_.resolution)),
                       .bounds = &row_bounds_[first_row / finalize_batch]});
}

void Cascade::gradients(std::size_t row_pair) {
    const auto roughness = static_cast<float>(sea_.roughness);
    GradientsJob job{.planes = {back().plane(0), back().plane(1), back().plane(2)},
                     .stride = static_cast<std::ptrdiff_t>(plane_stride(sea_.resolution)),
                     .resolution = static_cast<std::size_t>(sea_.resolution),
                     .row_pair = row_pair,
                     .half_texels_per_metre = static_cast<float>(sea_.resolution / (2 * sea_.patch_size_m)),
                     .normal_length = mean_normal_length(roughness),
                     .smoothness = smoothness_of(roughness),
                     .rgba8 = back().rgba8.data(),
                     .rgba16f = back().rgba16f.data(),
                     .mip_row = {}};
    for (std::size_t plane = 0; plane < 4; ++plane) job.mip_row[plane] = mip_averages_.row(1, plane, row_pair);
    kernels_.gradients(job);
}

void Cascade::mipmaps(std::size_t band) {
    mipmap_band(mip_averages_, sea_.resolution, band, back().rgba8.data(), kernels_);
}

void Cascade::mipmaps_tail() { mipmap_tail(mip_averages_, sea_.resolution, back().rgba8.data(), kernels_); }

std::size_t Cascade::bytes() const {
    return plan_.bytes() + spectrum_.modes.bytes() + waves_.bytes() + lines_.bytes() + mip_averages_.bytes() +
           row_bounds_.capacity() * sizeof(RowBounds) + slots_[0].bytes() + slots_[1].bytes();
}

}  // namespace pelagic
