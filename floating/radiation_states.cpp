#include "pelagic/floating/radiation_states.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "pelagic/floating/matrix6.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::size_t resonator_count = RadiationFit::resonator_count;

/// Damping of a resonator of strength 1.
double unit_damping(double omega_radps, double resonance_radps, double damping_ratio) {
    const double square = omega_radps * omega_radps, difference = resonance_radps * resonance_radps - square;
    const double loss = 2 * damping_ratio * resonance_radps;
    return loss * square / (difference * difference + loss * loss * square);
}

/// Added mass of a resonator of strength 1: Im(s / (s^2 + 2 zeta w s + w^2)) / omega at s = i omega.
double unit_added_mass(double omega_radps, double resonance_radps, double damping_ratio) {
    const double square = omega_radps * omega_radps, difference = resonance_radps * resonance_radps - square;
    const double loss = 2 * damping_ratio * resonance_radps;
    return difference / (difference * difference + loss * loss * square);
}

void add_scaled(HullMatrix& sum, double factor, const HullMatrix& matrix) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) sum[i][j] += factor * matrix[i][j];
}

/// A resonator whose strength is sought, and its damping at the table's frequencies, weighted.
struct Candidate {
    double omega_radps, damping_ratio;
    std::vector<double> curve;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// The diagonal of the table's damping: six right sides over the frequencies, each of unit norm, weighted by
/// the square root of the interval that a frequency stands for.
struct Diagonal {
    std::vector<std::vector<double>> modes;
    std::vector<double> weights;
};

Diagonal diagonal_of(const RadiationTable& table) {
    Diagonal diagonal;
    const std::vector<double>& omega = table.omega_radps;
    for (std::size_t i = 0; i < omega.size(); ++i) {
        const double before = omega[i > 0 ? i - 1 : 0], after = omega[std::min(i + 1, omega.size() - 1)];
        diagonal.weights.push_back(std::sqrt((after - before) / 2));
    }
    // Modes that hardly radiate, such as the roll of a sphere about its centre, do not guide the choice.
    double largest[2] = {0, 0};
    for (const HullMatrix& damping : table.damping)
        for (std::size_t mode = 0; mode < 6; ++mode)
            largest[mode / 3] = std::max(largest[mode / 3], damping[mode][mode]);
    for (std::size_t mode = 0; mode < 6; ++mode) {
        std::vector<double> curve;
        double peak = 0;
        for (std::size_t i = 0; i < omega.size(); ++i) {
            peak = std::max(peak, table.damping[i][mode][mode]);
            curve.push_back(table.damping[i][mode][mode] * diagonal.weights[i]);
        }
        if (!(peak > 1e-3 * largest[mode / 3])) continue;
        const double norm = std::sqrt(dot(curve, curve));
        for (double& value : curve) value /= norm;
        diagonal.modes.push_back(std::move(curve));
    }
    return diagonal;
}

std::vector<Candidate> candidates_for(const RadiationTable& table, const std::vector<double>& weights) {
    constexpr std::size_t frequencies = 28;
    constexpr double ratios[] = {0.12, 0.25, 0.45, 0.7, 1};
    const double low = 0.5 * table.omega_radps.front(), high = 1.5 * table.omega_radps.back();
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < frequencies; ++i)
        for (const double ratio : ratios) {
            Candidate of{low * det::pow(high / low, static_cast<double>(i) / (frequencies - 1)), ratio, {}};
            for (std::size_t at = 0; at < weights.size(); ++at)
                of.curve.push_back(weights[at] * unit_damping(table.omega_radps[at], of.omega_radps, ratio));
            candidates.push_back(std::move(of));
        }
    return candidates;
}

/// Products of the candidates with each other and with the right sides.
struct Products {
    Products(const std::vector<Candidate>& candidates, const Diagonal& diagonal)
        : size(candidates.size()), modes(diagonal.modes.size()) {
        for (const Candidate& a : candidates) {
            for (const Candidate& b : candidates) curves.push_back(dot(a.curve, b.curve));
            for (const std::vector<double>& mode : diagonal.modes) sides.push_back(dot(a.curve, mode));
        }
    }
    std::size_t size, modes;
    std::vector<double> curves, sides;
};

/// Returns how much of the right sides' squares a choice of candidates with strengths of at least 0 explains, by
/// descent along the strengths in turn.
double explained(const Products& products, const std::vector<std::size_t>& chosen) {
    constexpr int max_sweeps = 150;
    constexpr double settled = 1e-7;  // of the right side's norm, 1
    const std::size_t n = chosen.size();
    std::array<std::array<double, resonator_count>, resonator_count> curves{};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) curves[i][j] = products.curves[chosen[i] * products.size + chosen[j]];
    double sum = 0;
    for (std::size_t mode = 0; mode < products.modes; ++mode) {
        std::array<double, resonator_count> strength{}, sides{};
        for (std::size_t i = 0; i < n; ++i) sides[i] = products.sides[chosen[i] * products.modes + mode];
        const auto fitted = [&](std::size_t i) {
            double all = 0;
            for (std::size_t j = 0; j < n; ++j) all += curves[i][j] * strength[j];
            return all;
        };
        double change = 1;
        for (int sweep = 0; sweep < max_sweeps && change > settled; ++sweep) {
            change = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const double next = std::max(strength[i] + (sides[i] - fitted(i)) / curves[i][i], 0.0);
                const double step = next - strength[i];
                change += step * step * curves[i][i];
                strength[i] = next;
            }
        }
        for (std::size_t i = 0; i < n; ++i) sum += strength[i] * (2 * sides[i] - fitted(i));
    }
    return sum;
}

/// Chooses resonators one after the other, and then replaces each by a better one while there is one.
std::vector<std::size_t> choose(const Products& products) {
    std::vector<std::size_t> chosen;
    const auto best_at = [&](std::size_t place) {
        std::size_t best = chosen[place];
        double most = explained(products, chosen);
        for (std::size_t candidate = 0; candidate < products.size; ++candidate) {
            chosen[place] = candidate;
            const double now = explained(products, chosen);
            if (now > most) {
                most = now;
                best = candidate;
            }
        }
        chosen[place] = best;
    };
    for (std::size_t place = 0; place < resonator_count; ++place) {
        chosen.push_back(0);
        best_at(place);
    }
    for (std::size_t place = 0; place < resonator_count; ++place) best_at(place);
    return chosen;
}

/// Replaces the negative eigenvalues of a symmetric matrix by 0. Jacobi's rotations.
HullMatrix without_negative(HullMatrix matrix) {
    HullMatrix vectors{};
    for (std::size_t i = 0; i < 6; ++i) vectors[i][i] = 1;
    for (int sweep = 0; sweep < 12; ++sweep)
        for (std::size_t p = 0; p < 6; ++p)
            for (std::size_t q = p + 1; q < 6; ++q) {
                const double off = matrix[p][q];
                if (std::fabs(off) <= 1e-17 * (std::fabs(matrix[p][p]) + std::fabs(matrix[q][q]))) continue;
                const double slope = (matrix[q][q] - matrix[p][p]) / (2 * off);
                const double tangent =
                    (slope < 0 ? -1 : 1) / (std::fabs(slope) + std::sqrt(slope * slope + 1));
                const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
                for (std::size_t k = 0; k < 6; ++k) {
                    const double a = matrix[k][p], b = matrix[k][q];
                    matrix[k][p] = cosine * a - sine * b;
                    matrix[k][q] = sine * a + cosine * b;
                }
                for (std::size_t k = 0; k < 6; ++k) {
                    const double a = matrix[p][k], b = matrix[q][k];
                    matrix[p][k] = cosine * a - sine * b;
                    matrix[q][k] = sine * a + cosine * b;
                    const double c = vectors[k][p], d = vectors[k][q];
                    vectors[k][p] = cosine * c - sine * d;
                    vectors[k][q] = sine * c + cosine * d;
                }
            }
    HullMatrix result{};
    for (std::size_t e = 0; e < 6; ++e) {
        const double value = std::max(matrix[e][e], 0.0);
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) result[i][j] += value * vectors[i][e] * vectors[j][e];
    }
    return result;
}

/// Finds the strengths, positive semi-definite matrices, by descent along each in turn: the best for a resonator is
/// that of the residual without negative eigenvalues. Modes are scaled to a damping of 1.
void fit_strengths(const RadiationTable& table, const std::vector<double>& weights, RadiationFit& fit) {
    std::array<double, 6> scale{};
    double largest[2] = {0, 0};
    for (std::size_t mode = 0; mode < 6; ++mode) {
        for (const HullMatrix& damping : table.damping) scale[mode] = std::max(scale[mode], damping[mode][mode]);
        largest[mode / 3] = std::max(largest[mode / 3], scale[mode]);
    }
    for (std::size_t mode = 0; mode < 6; ++mode) {
        const double least = 1e-9 * largest[mode / 3];
        scale[mode] = scale[mode] > least ? std::sqrt(scale[mode]) : 0;
    }
    const std::size_t rows = table.omega_radps.size();
    std::vector<HullMatrix> residual(rows);
    for (std::size_t at = 0; at < rows; ++at)
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j)
                if (scale[i] > 0 && scale[j] > 0)
                    residual[at][i][j] = weights[at] * table.damping[at][i][j] / (scale[i] * scale[j]);
    std::array<std::vector<double>, resonator_count> curves;
    std::array<double, resonator_count> squares{};
    for (std::size_t n = 0; n < resonator_count; ++n) {
        for (std::size_t at = 0; at < rows; ++at)
            curves[n].push_back(weights[at] * unit_damping(table.omega_radps[at], fit.resonators[n].omega_radps,
                                                           fit.resonators[n].damping_ratio));
        squares[n] = dot(curves[n], curves[n]);
    }
    constexpr int sweeps = 300;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t n = 0; n < resonator_count; ++n) {
            HullMatrix& strength = fit.resonators[n].strength;
            HullMatrix wanted = strength;
            for (std::size_t at = 0; at < rows; ++at) add_scaled(wanted, curves[n][at] / squares[n], residual[at]);
            const HullMatrix now = without_negative(wanted);
            HullMatrix change = now;
            add_scaled(change, -1, strength);
            for (std::size_t at = 0; at < rows; ++at) add_scaled(residual[at], -curves[n][at], change);
            strength = now;
        }
    for (RadiationFit::Resonator& resonator : fit.resonators)
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) resonator.strength[i][j] *= scale[i] * scale[j];
    // symmetric to the last bit
    for (RadiationFit::Resonator& resonator : fit.resonators)
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < i; ++j) resonator.strength[i][j] = resonator.strength[j][i];
}

/// The mean of y in a step is answer * (y - step/2 w^2 z + step/2 u) with the mean velocity u.
double answer_of(const RadiationFit::Resonator& resonator, double step_s) {
    const double turn = step_s * resonator.omega_radps;
    return 1 / (1 + turn * resonator.damping_ratio + turn * turn / 4);
}

std::string check_matrix(const std::string& name, const HullMatrix& matrix) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            const std::string entry = name + "[" + std::to_string(i) + "][" + std::to_string(j) + "]";
            if (!(std::fabs(matrix[i][j]) <= 1e15)) return invalid_value_message(entry, matrix[i][j], "[-1e15, 1e15]");
            if (matrix[i][j] != matrix[j][i])
                return invalid_value_message(entry, matrix[i][j], number_text(matrix[j][i]) + ", a symmetric matrix");
        }
    return {};
}

}  // namespace

std::string check(const RadiationTable& table) {
    const std::size_t rows = table.omega_radps.size();
    if (rows < 4 || rows > 256)
        return invalid_value_message("the number of frequencies of the radiation table", rows, "4 to 256");
    if (table.damping.size() != rows || table.added_mass.size() != rows)
        return "the radiation table has " + std::to_string(table.damping.size()) + " matrices of damping and " +
               std::to_string(table.added_mass.size()) + " of added mass, expected one a frequency, " +
               std::to_string(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const std::string row = "[" + std::to_string(i) + "]";
        if (!(table.omega_radps[i] > 0 && table.omega_radps[i] <= 1e4))
            return invalid_value_message("omega_radps" + row, table.omega_radps[i], "(0, 1e4] rad/s");
        if (i > 0 && !(table.omega_radps[i] > table.omega_radps[i - 1]))
            return invalid_value_message("omega_radps" + row, table.omega_radps[i],
                                         "more than the frequency before, " + number_text(table.omega_radps[i - 1]));
        if (std::string reason = check_matrix("added_mass" + row, table.added_mass[i]); !reason.empty()) return reason;
        if (std::string reason = check_matrix("damping" + row, table.damping[i]); !reason.empty()) return reason;
        for (std::size_t mode = 0; mode < 6; ++mode)
            if (table.damping[i][mode][mode] < 0)
                return invalid_value_message("damping" + row + "[" + std::to_string(mode) + "][" +
                                                 std::to_string(mode) + "]",
                                             table.damping[i][mode][mode], "[0, 1e15]");
    }
    return check_matrix("infinite_added_mass", table.infinite_added_mass);
}

RadiationFit fit_radiation(const RadiationTable& table) {
    const DefaultFloatEnvironment environment;
    require(check(table));
    RadiationFit fit;
    fit.infinite_added_mass = table.infinite_added_mass;
    const Diagonal diagonal = diagonal_of(table);
    if (diagonal.modes.empty()) return fit;  // nothing radiates
    const std::vector<Candidate> candidates = candidates_for(table, diagonal.weights);
    const std::vector<std::size_t> chosen = choose(Products(candidates, diagonal));
    for (std::size_t n = 0; n < resonator_count; ++n) {
        fit.resonators[n].omega_radps = candidates[chosen[n]].omega_radps;
        fit.resonators[n].damping_ratio = candidates[chosen[n]].damping_ratio;
    }
    fit_strengths(table, diagonal.weights, fit);
    return environment.result(fit);
}

HullMatrix RadiationFit::damping(double omega_radps) const {
    const DefaultFloatEnvironment environment(omega_radps);
    HullMatrix sum{};
    for (const Resonator& of : resonators)
        add_scaled(sum, unit_damping(omega_radps, of.omega_radps, of.damping_ratio), of.strength);
    return environment.result(sum);
}

HullMatrix RadiationFit::added_mass(double omega_radps) const {
    const DefaultFloatEnvironment environment(omega_radps);
    HullMatrix sum = infinite_added_mass;
    for (const Resonator& of : resonators)
        add_scaled(sum, unit_added_mass(omega_radps, of.omega_radps, of.damping_ratio), of.strength);
    return environment.result(sum);
}

HullMatrix RadiationFit::retardation(double t_s) const {
    const DefaultFloatEnvironment environment(t_s);
    HullMatrix sum{};
    for (const Resonator& of : resonators) {
        const double turn = of.omega_radps * t_s, zeta = of.damping_ratio;
        double y = det::exp(-turn) * (1 - turn);  // critical damping
        if (zeta < 1) {
            const double slowed = std::sqrt(1 - zeta * zeta);
            const auto [sine, cosine] = det::sine_cosine_of_turns(slowed * turn / two_pi);
            y = det::exp(-zeta * turn) * (cosine - zeta / slowed * sine);
        }
        add_scaled(sum, y, of.strength);
    }
    return environment.result(sum);
}

RadiationStep begin_step(const RadiationFit& fit, const RadiationState& state, double step_s) {
    const DefaultFloatEnvironment environment(step_s);
    RadiationStep step;
    for (std::size_t n = 0; n < resonator_count; ++n) {
        const RadiationFit::Resonator& of = fit.resonators[n];
        const double answer = answer_of(of, step_s), spring = step_s / 2 * of.omega_radps * of.omega_radps;
        Vector6 free{};
        for (std::size_t i = 0; i < 6; ++i) free[i] = answer * (state.rate[n][i] - spring * state.sum[n][i]);
        const Vector6 force = product(of.strength, free);
        for (std::size_t i = 0; i < 6; ++i) step.force[i] -= force[i];
        add_scaled(step.damping, answer * step_s / 2, of.strength);
    }
    return environment.result(step);
}

void complete_step(const RadiationFit& fit, RadiationState& state, double step_s, const Vector6& mean_velocity) {
    const DefaultFloatEnvironment environment(step_s);
    for (std::size_t n = 0; n < resonator_count; ++n) {
        const RadiationFit::Resonator& of = fit.resonators[n];
        const double answer = answer_of(of, step_s), spring = step_s / 2 * of.omega_radps * of.omega_radps;
        for (std::size_t i = 0; i < 6; ++i) {
            const double mean =
                answer * (state.rate[n][i] - spring * state.sum[n][i] + step_s / 2 * mean_velocity[i]);
            state.rate[n][i] = 2 * mean - state.rate[n][i];
            state.sum[n][i] += step_s * mean;
        }
    }
}

double stored_energy(const RadiationFit& fit, const RadiationState& state) {
    const DefaultFloatEnvironment environment;
    double sum = 0;
    for (std::size_t n = 0; n < resonator_count; ++n) {
        const RadiationFit::Resonator& of = fit.resonators[n];
        sum += dot(state.rate[n], product(of.strength, state.rate[n])) / 2;
        sum += of.omega_radps * of.omega_radps * dot(state.sum[n], product(of.strength, state.sum[n])) / 2;
    }
    return environment.result(sum);
}

}  // namespace pelagic
