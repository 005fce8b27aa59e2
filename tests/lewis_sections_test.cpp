// Coefficients of Lewis sections, compared with those of a panel method (tests/potential_flow) and with
// closed forms, and the response in waves to which they lead.
#include "pelagic/floating/lewis_sections.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/potential_flow.hpp"
#include "pelagic/tests/potential_flow_bodies.hpp"

namespace pelagic {
namespace {

SectionCoefficients coefficients_of(const FloatingBody& body) {
    return lewis_coefficients(body.mesh, body.centre_of_mass_m, body.waterline_y_m, water_kgpm3);
}

/// Returns an entry of a table of matrices at a frequency between those of the table.
double at_omega(const RadiationTable& table, const std::vector<HullMatrix>& matrices, double omega_radps,
                std::size_t row, std::size_t column) {
    std::size_t i = 0;
    while (i + 2 < table.omega_radps.size() && table.omega_radps[i + 1] < omega_radps) ++i;
    const double fraction = (omega_radps - table.omega_radps[i]) / (table.omega_radps[i + 1] - table.omega_radps[i]);
    return matrices[i][row][column] + fraction * (matrices[i + 1][row][column] - matrices[i][row][column]);
}

double omega_of(const TruthRow& row) { return std::sqrt(gravity_mps2 * row["wave_number_radpm"]); }

/// Compares a pair of columns up to 1.2 times the wave number of the resonance of heave.
void expect_close(const FloatingBody& body, const char* name, std::size_t mode, double added_share,
                  double damping_share) {
    SCOPED_TRACE(std::string(body.name) + " " + name);
    const SectionCoefficients found = coefficients_of(body);
    const std::string number = std::to_string(mode + 1) + std::to_string(mode + 1);
    for (const TruthRow& row : truths_of(body.name)) {
        const double omega = omega_of(row);
        if (row.is_limit() || row["wave_number_radpm"] > 1.2 * found.heave_wave_number_radpm ||
            omega < found.table.omega_radps[0])
            continue;
        SCOPED_TRACE(row["wave_number_radpm"]);
        const double added = row["a" + number], damping = row["b" + number];
        EXPECT_NEAR(at_omega(found.table, found.table.added_mass, omega, mode, mode), added, added_share * added);
        EXPECT_NEAR(at_omega(found.table, found.table.damping, omega, mode, mode), damping, damping_share * damping);
    }
}

TEST(LewisSections, CoefficientsOfHeaveAreThoseOfAPanelMethod) {
    expect_close(hemisphere_body(), "heave", 1, 0.12, 0.15);
    expect_close(spar_body(), "heave", 1, 0.03, 0.15);
    expect_close(barge_body(), "heave", 1, 0.10, 0.24);
    expect_close(dinghy_body(), "heave", 1, 0.20, 0.25);
}

TEST(LewisSections, CoefficientsOfPitchAreThoseOfAPanelMethod) {
    expect_close(barge_body(), "pitch", 5, 0.30, 0.75);
    expect_close(dinghy_body(), "pitch", 5, 0.38, 0.75);
    // The spar's is that of surge in depth, and its waves are those of surge.
    const FloatingBody spar = spar_body();
    const double known = truths_of("spar")[1]["a66"];
    EXPECT_NEAR(coefficients_of(spar).added_mass[5][5], known, 0.15 * known);
}

TEST(LewisSections, OtherModesAreThoseOfZeroFrequency) {
    for (const FloatingBody& body : {hemisphere_body(), spar_body(), barge_body(), dinghy_body()}) {
        SCOPED_TRACE(body.name);
        const TruthRow still = truths_of(body.name)[1];
        const HullMatrix added = coefficients_of(body).added_mass;
        EXPECT_NEAR(added[2][2], still["a33"], 0.06 * still["a33"]) << "sway";
        EXPECT_NEAR(added[4][4], still["a55"], 0.12 * still["a55"] + 1e-6 * still["a33"]) << "yaw";
        EXPECT_NEAR(added[0][0], still["a11"], 0.35 * still["a11"]) << "surge";
    }
    const FloatingBody spar = spar_body();
    const TruthRow still = truths_of("spar")[1];
    const HullMatrix added = coefficients_of(spar).added_mass;
    EXPECT_NEAR(added[0][5], still["a16"], 0.2 * std::fabs(still["a16"])) << "2 m above the centre of mass";
    EXPECT_NEAR(added[2][3], still["a34"], 0.2 * std::fabs(still["a34"]));
}

TEST(LewisSections, MatricesAreSymmetricAndPositive) {
    for (const FloatingBody& body : {hemisphere_body(), spar_body(), barge_body(), dinghy_body()}) {
        SCOPED_TRACE(body.name);
        const SectionCoefficients found = coefficients_of(body);
        EXPECT_EQ(Hull::check(body.mesh, {.mass_kg = 1, .added_mass = found.added_mass}), "");
        EXPECT_EQ(Hull::check(body.mesh, {.mass_kg = 1, .added_mass = found.damping}), "") << "damping";
        for (const HullMatrix& damping : found.table.damping)
            EXPECT_EQ(Hull::check(body.mesh, {.mass_kg = 1, .added_mass = damping}), "");
        EXPECT_NEAR(found.displaced_m3, body.volume_m3, 1e-2 * body.volume_m3);
    }
}

/// Returns what Hull::check() says of a matrix whose diagonal is scaled to 1, where it is not 0.
std::string check_scaled(const HullMesh& mesh, const HullMatrix& matrix) {
    HullMatrix scaled = matrix;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            if (matrix[i][i] > 0 && matrix[j][j] > 0) scaled[i][j] /= std::sqrt(matrix[i][i]) * std::sqrt(matrix[j][j]);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j) scaled[j][i] = scaled[i][j];  // rounding
    return Hull::check(mesh, {.mass_kg = 1, .added_mass = scaled});
}

TEST(LewisSections, AnyDraughtGivesUsableMatrices) {
    const HullMesh meshes[] = {box_mesh({4, 1, 3}),    box_mesh({0.01, 3, 5}), wedge_mesh(6, 2, 1.5),
                               boat_mesh(4, 1.7, 0.8), sphere_mesh(1, 12, 8),  cylinder_mesh(0.5, 30, 12, 1),
                               box_mesh({400, 1, 400})};
    for (const HullMesh& mesh : meshes)
        for (const double share : {1e-3, 0.01, 0.3, 0.6, 0.99}) {
            SCOPED_TRACE(share);
            const double waterline = mesh.lower_m().y + share * (mesh.upper_m().y - mesh.lower_m().y);
            const SectionCoefficients found = lewis_coefficients(mesh, mesh.centre_m(), waterline, water_kgpm3);
            EXPECT_GT(found.added_mass[1][1], 0);
            EXPECT_EQ(check_scaled(mesh, found.added_mass), "");
            EXPECT_EQ(check_scaled(mesh, found.damping), "");
            EXPECT_EQ(check(found.table), "");
        }
    const HullMesh box = box_mesh({4, 1, 3});
    for (const double waterline : {-0.5, -3.0, 0.5, 7.0}) {
        const SectionCoefficients found = lewis_coefficients(box, glm::dvec3(0), waterline, water_kgpm3);
        EXPECT_TRUE(std::isfinite(found.added_mass[1][1])) << waterline;
    }
}

TEST(LewisSections, ScaleWithTheHull) {
    // Froude's law: lengths times 8 are masses times 512, frequencies over sqrt(8).
    const auto box = [](double scale) {
        return lewis_coefficients(box_mesh(scale * glm::dvec3(4, 1, 1.5)), glm::dvec3(0), 0.125 * scale, water_kgpm3);
    };
    const SectionCoefficients small = box(1), large = box(8);
    EXPECT_NEAR(large.added_mass[1][1] / small.added_mass[1][1], 512, 1e-6);
    EXPECT_NEAR(large.damping[1][1] / small.damping[1][1], 512 / std::sqrt(8.0), 1e-6);
    EXPECT_NEAR(large.heave_omega_radps / small.heave_omega_radps, 1 / std::sqrt(8.0), 1e-9);
}

TEST(LewisSections, LongHullsHaveTheAddedMassOfTheirSections) {
    // A half-submerged circle: rho pi r^2 / 2 a metre in heave and sway (Lewis), without roll. A hull of
    // length 60 r has 1 % less.
    const FloatingBody body = {"", lying_cylinder_mesh(1, 60, 48), glm::dvec3(0), 0, 30 * std::numbers::pi};
    const SectionCoefficients found = coefficients_of(body);
    const double of_sections = water_kgpm3 * std::numbers::pi / 2 * 60;
    EXPECT_NEAR(found.table.infinite_added_mass[1][1], of_sections, 0.02 * of_sections);
    EXPECT_NEAR(found.added_mass[2][2], of_sections, 0.02 * of_sections);
    EXPECT_LT(found.added_mass[3][3], 0.01 * of_sections);
    // A thin keel of draught T: rho pi T^2 / 2 a metre, at 4 / (3 pi) T below the water.
    const SectionCoefficients keel = lewis_coefficients(box_mesh({60, 2.2, 0.02}), glm::dvec3(0), 0.9, water_kgpm3);
    const double sway = water_kgpm3 * std::numbers::pi / 2 * 4 * 60;
    EXPECT_NEAR(keel.added_mass[2][2], sway, 0.05 * sway);
    EXPECT_NEAR(keel.added_mass[2][3] / keel.added_mass[2][2], 0.9 - 8 / (3 * std::numbers::pi), 0.03);
}

/// Returns the response of heave to waves towards +x by a model of constant coefficients: the pressure of
/// the undisturbed waves on the wet surface, and A and B times the water's acceleration and velocity, mean
/// over the displaced volume. The surface is divided into small triangles.
double heave_response(const FloatingBody& body, const SectionCoefficients& found, double k, int parts) {
    const double omega = std::sqrt(gravity_mps2 * k);
    const std::complex<double> i(0, 1);
    std::complex<double> pressure = 0, waterplane = 0;
    for (const auto& [a, b, c] : body.mesh.triangles()) {
        const glm::dvec3 p = body.mesh.vertices()[a], u = body.mesh.vertices()[b] - p, v = body.mesh.vertices()[c] - p;
        const double up = 0.5 * glm::cross(u, v).y / (parts * parts);
        for (int row = 0; row < parts; ++row)
            for (int cell = 0; cell < 2 * (parts - row) - 1; ++cell) {
                const double third = cell % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
                const glm::dvec3 at = p + (row + third) / parts * u + (cell / 2 + third) / parts * v;
                if (at.y > body.waterline_y_m) continue;
                const std::complex<double> wave = std::exp(-i * k * (at.x - body.centre_of_mass_m.x));
                pressure -= up * wave * std::exp(k * (at.y - body.waterline_y_m));
                waterplane -= up * wave;
            }
    }
    const double weight = water_kgpm3 * gravity_mps2, mass = water_kgpm3 * found.displaced_m3;
    // The pressure on the closed volume is the mass times the acceleration.
    const std::complex<double> acceleration = weight * (pressure - waterplane) / mass;
    const double added = found.added_mass[1][1], damping = found.damping[1][1];
    const std::complex<double> force =
        weight * pressure + added * acceleration + damping * acceleration / (i * omega);
    return std::abs(force / (-omega * omega * (mass + added) + i * omega * damping + weight * found.waterplane_m2));
}

TEST(LewisSections, HeaveInWavesIsThatOfAPanelMethod) {
    struct Case {
        FloatingBody body;
        int parts;
        double max_wave_number, share;
    };
    const Case cases[] = {{hemisphere_body(), 1, 0.71, 0.06}, {hemisphere_body(), 1, 1.01, 0.15},
                          {spar_body(), 40, 0.042, 0.04},     {spar_body(), 40, 0.071, 0.15},
                          {barge_body(), 60, 0.05, 0.04}};
    for (const Case& of : cases) {
        SCOPED_TRACE(of.body.name);
        const SectionCoefficients found = coefficients_of(of.body);
        for (const TruthRow& row : truths_of(of.body.name)) {
            const double k = row["wave_number_radpm"];
            if (row.is_limit() || k > of.max_wave_number) continue;
            SCOPED_TRACE(k);
            const double known = std::abs(row.complex("heave"));
            // Without viscous losses the spar's peak is 12, and that of A and B 3 % away twice as high.
            if (known > 5) continue;
            EXPECT_NEAR(heave_response(of.body, found, k, of.parts), known, of.share * known);
        }
    }
}

}  // namespace
}  // namespace pelagic
