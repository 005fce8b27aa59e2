#include "pelagic/sim/query/foam_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace pelagic {

FoamSampler::FoamSampler(const Frame& frame)
    : cascades_(frame.cascades), foam_(frame.foam), has_foam_(frame.has_foam) {
    for (std::size_t slot = 0; slot < SnapshotFoam::slots; ++slot)
        if (foam_.age[slot] < 1) slots_[slot_count_++] = static_cast<std::uint8_t>(slot);
    std::sort(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(slot_count_),
              [&](std::uint8_t a, std::uint8_t b) { return foam_.age[a] < foam_.age[b]; });
}

FoamSampler::Texels FoamSampler::texels_at(const Cascade& cascade, double columns, double rows) {
    const double n = cascade.resolution();
    const auto side = static_cast<std::size_t>(cascade.resolution());
    const double x = columns - std::floor(columns / n) * n, z = rows - std::floor(rows / n) * n;
    const double left = std::floor(x), upper = std::floor(z);
    const auto u = static_cast<float>(x - left), v = static_cast<float>(z - upper);
    // Rounding may move a position just below 0 to N.
    const std::size_t i = static_cast<std::size_t>(left) & (side - 1),
                      j = static_cast<std::size_t>(upper) & (side - 1);
    const std::size_t right = (i + 1) & (side - 1), lower = (j + 1) & (side - 1);
    return {{j * side + i, j * side + right, lower * side + i, lower * side + right},
            {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}};
}

float FoamSampler::at(double x_m, double z_m, const FoamWeights* weights) const {
    std::array<Texels, max_cascades> drifted;
    std::array<const Cascade*, max_cascades> cascades;
    FoamWeights factors;
    std::size_t count = 0;
    float present = 0;
    for (std::size_t i = 0; i < cascades_.size(); ++i) {
        const Cascade& cascade = cascades_[i];
        if (cascade.compression_r8.empty()) continue;
        const CascadeGrid::Place place = cascade.grid.in_cascade(x_m, z_m);
        const double columns = place.along / cascade.texel_m(), rows = place.across / cascade.texel_m();
        const Texels here = texels_at(cascade, columns, rows);
        drifted[count] = texels_at(cascade, columns - cascade.drift_columns, rows - cascade.drift_rows);
        factors[count] = weights ? (*weights)[i] : 1;
        float byte = 0;
        for (std::size_t t = 0; t < 4; ++t)
            byte += here.weight[t] * static_cast<float>(cascade.compression_r8[here.index[t]]);
        present += factors[count] * (SnapshotFoam::lowest + SnapshotFoam::step * byte);
        cascades[count++] = &cascade;
    }
    float foam = foam_.fresh(present);
    for (std::size_t s = 0; s < slot_count_ && 1 - foam_.age[slots_[s]] > foam; ++s) {
        const std::size_t image = slots_[s] / 4;
        const std::uint32_t shift = 8 * (slots_[s] % 4u);
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t* const words = cascades[i]->snapshots_rgba8[image].data();
            float byte = 0;
            for (std::size_t t = 0; t < 4; ++t)
                byte += drifted[i].weight[t] * static_cast<float>(words[drifted[i].index[t]] >> shift & 255);
            sum += factors[i] * (SnapshotFoam::lowest + SnapshotFoam::step * byte);
        }
        foam = std::max(foam, foam_.fresh(sum) - foam_.age[slots_[s]]);
    }
    return foam;
}

}  // namespace pelagic
