#include "pelagic/sim/sea_waves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/direction.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {

std::vector<WaveComponent> highest_waves_of(const SeaState& asked, double share) {
    const DefaultFloatEnvironment environment(share);
    SeaState sea = checked(asked);
    if (sea.waves == WaveModel::pond)
        require(invalid_value_message("waves", name_of(sea.waves), "spectrum, analytic or regular"));
    if (!(share >= 0 && share <= 1)) require(invalid_value_message("share", share, "[0, 1]"));
    // the harmonic of a surface that is not displaced, as in ExactWater
    if (sea.waves == WaveModel::regular) sea.choppiness = 0;
    std::vector<WaveComponent> all;
    for (const CascadePlan& plan : plan_cascades(sea)) {
        const CascadeWaves waves(sea, plan);
        const auto add = [&](const Wave& wave, int m, int n) {
            // h = h0 e^{i (k.x - omega t)} + its conjugate
            const double amplitude_m = 2 * std::sqrt(std::norm(wave.amplitude));
            if (amplitude_m == 0) return;
            const double k = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n) * plan.spacing();
            const auto [kx, kz] = plan.grid.in_world(m * plan.spacing(), n * plan.spacing());
            const double omega =
                loop_harmonic(waves.frequency(k), sea.loop_period_s) * (two_pi / sea.loop_period_s);
            all.push_back({amplitude_m, kx, kz, omega, angle_of(wave.amplitude.real(), wave.amplitude.imag())});
        };
        for (int n = 0; n < plan.resolution / 2; ++n)
            for (int m = 0; m < plan.resolution / 2; ++m) {
                if (!waves.holds(m, n)) continue;
                const CascadeWaves::MirroredPair pair = waves.pair(m, n);
                add(pair.plus.along, m, n);
                add(pair.plus.against, -m, -n);
                if (m == 0 || n == 0) continue;  // line 0 is its own mirror
                add(pair.minus.along, -m, n);
                add(pair.minus.against, m, -n);
            }
    }
    std::stable_sort(all.begin(), all.end(), [](const WaveComponent& a, const WaveComponent& b) {
        return a.amplitude_m > b.amplitude_m;
    });
    double sum = 0, kept = 0;
    for (const WaveComponent& wave : all) sum += wave.amplitude_m * wave.amplitude_m;
    std::size_t count = 0;
    for (; count < all.size() && kept < share * sum; ++count) kept += all[count].amplitude_m * all[count].amplitude_m;
    all.resize(count);
    return environment.result(all);
}

}  // namespace pelagic
