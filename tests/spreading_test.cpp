// Directional spreading: every model conserves energy and has the widths that its paper states.
#include "pelagic/sim/spectrum/spreading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace pelagic {
namespace {

using std::numbers::pi;

/// Integrates f(theta) D(theta) over the circle by the trapezoidal rule. For smooth periodic
/// functions it is exact to many digits once it resolves them.
template <class Densities>
double over_all_directions(Densities densities, const std::function<double(double)>& f, int steps = 4000) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = 2 * pi * (i + 0.5) / steps - pi;
        sum += f(angle) * densities(std::cos(angle)).along;
    }
    return sum * 2 * pi / steps;
}

std::function<OppositeDensities(double)> densities_of(const DirectionalLobe& lobe) {
    return [lobe](double cosine) { return lobe.densities(cosine); };
}

double one(double) { return 1; }

TEST(Spreading, OfEveryModelIntegratesToOneAtEveryFrequency) {
    for (const SpreadingModel model : values_of<SpreadingModel>()) {
        if (model == SpreadingModel::paper) continue;
        for (const double inverse_wave_age : {0.5, 0.83, 1.0, 2.0, 5.0, 100.0}) {
            const MeasuredSpreading spreading(model, 0.9, inverse_wave_age);
            for (double over_peak = 0.2; over_peak < 60; over_peak *= 1.17)
                // The worst case is cos^(2 s) with s = 0.01, whose cusp has an error of 1e-5.
                EXPECT_NEAR(over_all_directions(densities_of(spreading.at(0.9 * over_peak)), one), 1, 2e-5)
                    << name_of(model) << " at " << over_peak << " peaks, U/c " << inverse_wave_age;
        }
    }
    for (const double alignment : {0.0, 0.3, 0.5, 1.0}) {
        const PaperSpreading paper(alignment);
        EXPECT_NEAR(over_all_directions([&](double cosine) { return paper.densities(cosine); }, one), 1, 1e-5);
    }
}

TEST(Spreading, ReturnsOppositeWavesTogether) {
    std::vector<DirectionalLobe> lobes = {DirectionalLobe(), DirectionalLobe::cosine_2s(7.3),
                                          DirectionalLobe::sech_squared(1.24)};
    for (const DirectionalLobe& lobe : lobes)
        for (const double cosine : {-1.0, -0.7, -0.0, 0.2, 1.0})
            EXPECT_EQ(lobe.densities(cosine).against, lobe.densities(-cosine).along) << cosine;
}

// Closed forms: cos(theta/2)^2 / pi = (1 + cos theta) / (2 pi); with s = 0 all directions are
// equal.
TEST(Spreading, LobesMatchTheClosedForms) {
    for (double angle = 0; angle <= pi; angle += 0.05) {
        const double cosine = std::cos(angle);
        EXPECT_NEAR(DirectionalLobe::cosine_2s(1).densities(cosine).along, (1 + cosine) / (2 * pi), 1e-10);
        EXPECT_NEAR(DirectionalLobe::cosine_2s(0).densities(cosine).along, 1 / (2 * pi), 1e-10);
        EXPECT_EQ(DirectionalLobe().densities(cosine).along, 1 / (2 * pi));
        for (const double s : {0.03, 2.5, 11.5, 90.0, 6565.0}) {
            const double peak = std::exp(std::lgamma(s + 1) - std::lgamma(s + 0.5)) / (2 * std::sqrt(pi));
            const double expected = peak * std::pow(std::cos(angle / 2), 2 * s);
            EXPECT_NEAR(DirectionalLobe::cosine_2s(s).densities(cosine).along, expected, 1e-10 * peak) << s;
        }
        for (const double beta : {0.4, 1.24, 2.44}) {
            const double peak = beta / (2 * std::tanh(beta * pi));
            EXPECT_NEAR(DirectionalLobe::sech_squared(beta).densities(cosine).along,
                        peak / std::pow(std::cosh(beta * angle), 2), 1e-12)
                << beta << " at " << angle;
        }
    }
}

// Returns the parameter of a lobe from a density: that of the peak direction increases with it.
double parameter_of(const DirectionalLobe& lobe, DirectionalLobe (*lobe_of)(double), double high) {
    double low = 1e-6;
    while (high / low > 1 + 1e-9) {
        const double middle = std::sqrt(low * high);
        (lobe_of(middle).densities(1).along < lobe.densities(1).along ? low : high) = middle;
    }
    return low;
}
double exponent_of(const DirectionalLobe& lobe) { return parameter_of(lobe, DirectionalLobe::cosine_2s, 1e4); }
double beta_of(const DirectionalLobe& lobe) { return parameter_of(lobe, DirectionalLobe::sech_squared, 1e2); }

// Values of the papers, as given by Horvath 2015. Hasselmann's limit is the 1.05 of that paper.
TEST(Spreading, HasThePublishedWidths) {
    const MeasuredSpreading mitsuyasu(SpreadingModel::cosine_2s, 1, 1),
        hasselmann(SpreadingModel::hasselmann, 1, 1.17), donelan(SpreadingModel::donelan_banner, 1, 1);
    EXPECT_NEAR(exponent_of(mitsuyasu.at(1)), 11.5, 1e-5);
    EXPECT_NEAR(exponent_of(mitsuyasu.at(2)), 11.5 * std::pow(2, -2.5), 1e-5);
    EXPECT_NEAR(exponent_of(mitsuyasu.at(0.8)), 11.5 * std::pow(0.8, 5), 1e-5);
    EXPECT_NEAR(exponent_of(MeasuredSpreading(SpreadingModel::cosine_2s, 1, 2).at(1)), 11.5 * std::pow(2, -2.5),
                1e-5);
    EXPECT_NEAR(exponent_of(hasselmann.at(0.9)), 6.97 * std::pow(0.9, 4.06), 1e-5);
    EXPECT_NEAR(exponent_of(hasselmann.at(2)), 9.77 * std::pow(2, -2.33), 1e-5);
    EXPECT_NEAR(exponent_of(MeasuredSpreading(SpreadingModel::hasselmann, 1, 3.17).at(2)), 9.77 * std::pow(2, -5.23),
                1e-5);
    EXPECT_NEAR(beta_of(donelan.at(0.95)), 2.28 * std::pow(0.95, -1.3), 1e-6);
    EXPECT_NEAR(beta_of(donelan.at(0.6)), 2.61 * std::pow(0.6, 1.3), 1e-6);
    EXPECT_NEAR(beta_of(donelan.at(3)), std::pow(10, -0.4 + 0.8393 * std::exp(-0.567 * std::log(9.0))), 1e-6);
    // Banner's form begins where Donelan's ends.
    EXPECT_NEAR(beta_of(donelan.at(1.6)), beta_of(donelan.at(1.6 - 1e-9)), 2e-3);
}

// Kuik, van Vledder and Holthuijsen 1988: sigma^2 = 2 (1 - r1).
TEST(Spreading, OfASwellHasTheRequestedDeviation) {
    for (const double degrees : {1.0, 5.0, 15.0, 30.0, 80.0}) {
        const double sigma = degrees * pi / 180;
        const DirectionalLobe lobe = DirectionalLobe::cosine_2s(cosine_2s_exponent(sigma));
        const double r1 = over_all_directions(densities_of(lobe), [](double angle) { return std::cos(angle); });
        EXPECT_NEAR(std::sqrt(2 * (1 - r1)), sigma, 1e-5) << degrees;
    }
}

// Checks the description of --wind-alignment.
TEST(Spreading, OfThePaperMatchesItsDescription) {
    const auto share = [](double alignment, const std::function<bool(double)>& inside) {
        const PaperSpreading paper(alignment);
        return over_all_directions([&](double cosine) { return paper.densities(cosine); },
                                   [&](double angle) { return inside(angle) ? 1.0 : 0.0; });
    };
    const auto against = [](double angle) { return std::cos(angle) < 0; };
    const auto across = [](double angle) { return std::fabs(std::cos(angle)) < std::sin(15 * pi / 180); };
    EXPECT_NEAR(share(0, against), 1.0 / 3, 1e-3);
    EXPECT_NEAR(share(1, against), 0.01 / 1.01, 1e-3);
    // |cos|: 1 - cos 15 degrees. Waves from all directions would give a sixth.
    EXPECT_NEAR(share(0, across), 1 - std::cos(15 * pi / 180), 1e-3);
}

}  // namespace
}  // namespace pelagic
