#include "pelagic/floating/hull.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/floating/lewis_sections.hpp"
#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/floating/wet_surface.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr NumericField<HullOptions> hull_field_table[] = {
    // generated from schema/hull.toml: table
    {"mass_kg", &HullOptions::mass_kg, 1e-6, 1e10, "[1e-6, 1e10]"},
    {"heave_damping", &HullOptions::heave_damping, 0, 0.999, "[0, 0.999]"},
    {"roll_damping", &HullOptions::roll_damping, 0, 0.999, "[0, 0.999]"},
    {"pressure_coefficient", &HullOptions::pressure_coefficient, 0, 10, "[0, 10]"},
    {"suction_coefficient", &HullOptions::suction_coefficient, 0, 10, "[0, 10]"},
    {"friction_coefficient", &HullOptions::friction_coefficient, 0, 1, "[0, 1]"},
    {"air_coefficient", &HullOptions::air_coefficient, 0, 10, "[0, 10]"},
    {"water_density_kgpm3", &HullOptions::water_density_kgpm3, 500, 2000, "[500, 2000]"},
    {"air_density_kgpm3", &HullOptions::air_density_kgpm3, 0, 10, "[0, 10]"},
    {"skeg_m2", &HullOptions::skeg_m2, 0, 1e4, "[0, 1e4]"},
    {"skeg_x_m", &HullOptions::skeg_x_m, -1000, 1000, "[-1000, 1000]"},
    {"skeg_y_m", &HullOptions::skeg_y_m, -1000, 1000, "[-1000, 1000]"},
    // end of generated
};

/// Returns whether all pivots of a symmetric matrix are at least 0, within rounding.
bool is_positive(HullMatrix matrix) {
    double largest = 0;
    for (std::size_t i = 0; i < 6; ++i) largest = std::max(largest, std::fabs(matrix[i][i]));
    for (std::size_t pivot = 0; pivot < 6; ++pivot) {
        if (!(matrix[pivot][pivot] >= -1e-12 * largest)) return false;
        for (std::size_t row = pivot + 1; row < 6; ++row) {
            if (matrix[pivot][pivot] <= 1e-12 * largest) {
                if (std::fabs(matrix[row][pivot]) > 1e-12 * largest) return false;
                continue;
            }
            const double factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t column = pivot; column < 6; ++column)
                matrix[row][column] -= factor * matrix[pivot][column];
        }
    }
    return true;
}

/// Returns whether no component is beyond +-max. False for NaN.
bool is_small(const glm::dvec3& v, double max) {
    return std::fabs(v.x) <= max && std::fabs(v.y) <= max && std::fabs(v.z) <= max;
}

std::string check_added_mass(const HullMatrix& matrix) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            const std::string name = "added_mass[" + std::to_string(i) + "][" + std::to_string(j) + "]";
            if (!(std::fabs(matrix[i][j]) <= 1e15)) return invalid_value_message(name, matrix[i][j], "[-1e15, 1e15]");
            if (matrix[i][j] != matrix[j][i])
                return invalid_value_message(name, matrix[i][j], number_text(matrix[j][i]) + ", a symmetric matrix");
        }
    return is_positive(matrix) ? "" : "added_mass is not positive semi-definite, expected no negative eigenvalue";
}

/// Returns the added mass of a plate that moves along its normal in unbounded water, sides a <= b:
/// rho pi/4 a^2 b (Newman, table 4.3), times b / (b + 0.7 a) for its ends. The result is within 3 %
/// of the table of DNV-RP-C205, appendix D.
double plate_added_mass_kg(double density_kgpm3, double side_m, double other_m) {
    const double a = std::min(side_m, other_m), b = std::max(side_m, other_m);
    return density_kgpm3 * std::numbers::pi / 4 * a * a * b * b / (b + 0.7 * a);
}

}  // namespace

std::span<const NumericField<HullOptions>> hull_fields() { return hull_field_table; }

std::string Hull::check(const HullMesh& mesh, const HullOptions& options) {
    if (std::string reason = check_fields(options, hull_field_table); !reason.empty()) return reason;
    if (options.centre_of_mass_m)
        for (int axis = 0; axis < 3; ++axis) {
            const double low = mesh.lower_m()[axis], high = mesh.upper_m()[axis],
                         at = (*options.centre_of_mass_m)[axis];
            if (!(at >= low && at <= high))
                return invalid_value_message(
                    std::string("centre_of_mass_m.") + "xyz"[axis], at,
                    "a position within the mesh, " + number_text(low) + " to " + number_text(high));
        }
    if (options.inertia_kgm2)
        for (int axis = 0; axis < 3; ++axis)
            if (!((*options.inertia_kgm2)[axis] >= 1e-15 && (*options.inertia_kgm2)[axis] <= 1e16))
                return invalid_value_message(std::string("inertia_kgm2.") + "xyz"[axis],
                                             (*options.inertia_kgm2)[axis], "[1e-15, 1e16]");
    if (options.coefficients)
        for (const auto& [name, is_given] : {std::pair("added_mass", options.added_mass.has_value()),
                                             {"heave_damping", options.heave_damping > 0}})
            if (is_given) return std::string(name) + " cannot be combined with coefficients";
    return options.added_mass ? check_added_mass(*options.added_mass) : "";
}

std::string Hull::check(const HullState& state) {
    if (!is_small(state.position_m, 1e8)) return "the hull's position_m is out of range [-1e8, 1e8]";
    if (!is_small(state.velocity_mps, 1e4)) return "the hull's velocity_mps is out of range [-1e4, 1e4]";
    if (!is_small(state.angular_velocity_radps, 1e4))
        return "the hull's angular_velocity_radps is out of range [-1e4, 1e4]";
    const double norm = glm::dot(state.orientation, state.orientation);
    if (!(std::fabs(norm - 1) < 1e-3)) return "the hull's orientation is not a unit quaternion";
    if (!(std::fabs(state.wake_velocity_y_mps) <= 1e4) || !is_small(state.wake_rotation_radps, 1e4) ||
        !(state.submersion >= 0 && state.submersion <= 1))
        return "what the hull's state remembers of its previous step is out of range";
    return {};
}

std::string Hull::check(const HullInputs& inputs) {
    if (!is_small(inputs.force.force_n, 1e15)) return "the hull's input force_n is out of range [-1e15, 1e15]";
    if (!is_small(inputs.force.torque_nm, 1e15)) return "the hull's input torque_nm is out of range [-1e15, 1e15]";
    if (!is_small(inputs.wind_mps, 1e3)) return "the hull's input wind_mps is out of range [-1e3, 1e3]";
    return {};
}

void Hull::check_step(const WaterKinematics& water, const HullInputs& inputs, double step_s) {
    if (inputs.wake && !water.frame_or_null())
        throw std::invalid_argument("a hull's wake needs the water of a frame");
    if (!(step_s >= 0 && std::isfinite(step_s)))
        throw std::invalid_argument(invalid_value_message("step_s", step_s, "[0, inf) s"));
}

Hull::Hull(HullMesh mesh, const HullOptions& options)
    : mesh_(std::move(mesh)), options_(options), mass_kg_(options.mass_kg) {
    const DefaultFloatEnvironment environment;
    require(check(mesh_, options));
    centre_of_mass_m_ = options.centre_of_mass_m.value_or(mesh_.centre_m());
    if (options.inertia_kgm2) {
        inertia_kgm2_ = *options.inertia_kgm2;
    } else {
        const glm::dmat3& s = mesh_.second_moments_m5();
        inertia_kgm2_ =
            mass_kg_ / mesh_.volume_m3() * glm::dvec3(s[1][1] + s[2][2], s[0][0] + s[2][2], s[0][0] + s[1][1]);
    }
    for (const glm::dvec3& vertex : mesh_.vertices()) arms_m_.push_back(vertex - centre_of_mass_m_);
    triangles_ = mesh_.triangles();
    find_rest();
    find_displaced_moments();
    divide_triangles();

    // A vertex represents a third of its triangles in plan, of those that look down: the others are not divided.
    weights_.assign(arms_m_.size(), 0);
    double sum = 0;
    for (const auto& [a, b, c] : triangles_) {
        const double in_plan = std::max(-glm::cross(arms_m_[b] - arms_m_[a], arms_m_[c] - arms_m_[a]).y, 0.0);
        for (const std::uint32_t vertex : {a, b, c}) weights_[vertex] += in_plan;
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            longest_edge_m_ = std::max(longest_edge_m_, wet_extent_m(arms_m_[from], arms_m_[to]));
        sum += 3 * in_plan;
    }
    for (double& weight : weights_) weight /= sum;
    SectionCoefficients sections;
    if (afloat_.floats && !options.coefficients)
        sections = lewis_coefficients(mesh_, centre_of_mass_m_, centre_of_mass_m_.y - afloat_.height_m,
                                      options.water_density_kgpm3);
    if (options.coefficients) {
        added_mass_ = options.coefficients->radiation().infinite_added_mass;
        check_mass();
        find_diffraction();
    } else if (options.added_mass)
        added_mass_ = *options.added_mass;
    else if (afloat_.floats)
        added_mass_ = sections.added_mass;
    else
        set_added_mass_of_plates();
    if (!afloat_.floats) return;
    const double weight_n = mass_kg_ * gravity_mps2;
    const double heave_n_per_m = options.water_density_kgpm3 * gravity_mps2 * afloat_.waterplane_m2;
    const auto period_s = [&](std::size_t mode, double mass, double stiffness) {
        if (!(stiffness > 0)) return 0.0;
        double added = added_mass_[mode][mode];
        // Given added mass depends on the frequency.
        for (int pass = 0; options.coefficients && pass < 8; ++pass) {
            const double omega = std::sqrt(stiffness / (mass + added));
            added = std::max(options.coefficients->radiation().added_mass(omega)[mode][mode], 0.0);
        }
        return two_pi * std::sqrt((mass + added) / stiffness);
    };
    afloat_.heave_period_s = period_s(1, mass_kg_, heave_n_per_m);
    afloat_.roll_period_s = period_s(3, inertia_kgm2_.x, weight_n * afloat_.roll_gm_m);
    afloat_.pitch_period_s = period_s(5, inertia_kgm2_.z, weight_n * afloat_.pitch_gm_m);
    heave_wave_number_ = heave_n_per_m / (mass_kg_ + added_mass_[1][1]) / gravity_mps2;
    strip_damping_ = (options.heave_damping > 0
                          ? 2 * options.heave_damping * std::sqrt(heave_n_per_m * (mass_kg_ + added_mass_[1][1]))
                          : sections.damping[1][1]) /
                     afloat_.waterplane_m2;
    roll_damping_ = 2 * options.roll_damping *
                    std::sqrt(weight_n * std::fabs(afloat_.roll_gm_m) * (inertia_kgm2_.x + added_mass_[3][3]));
}

/// Returns how far an edge that reaches below the waterline at rest extends along an axis; 0 for others.
double Hull::wet_extent_m(const glm::dvec3& a, const glm::dvec3& b) const {
    if (afloat_.floats && std::min(a.y, b.y) >= -afloat_.height_m) return 0;
    const glm::dvec3 extent = glm::abs(b - a);
    return std::max({extent.x, extent.y, extent.z});
}

/// Divides triangles at the middles of edges that reach below the waterline at rest and extend far along an axis. Both
/// triangles at an edge divide it, so the surface stays closed. Of a mesh that would have too many vertices, edges stay
/// longer.
void Hull::divide_triangles() {
    constexpr double longest_over_length = 0.1;
    constexpr std::size_t max_vertices = 4096;
    const glm::dvec3 size = mesh_.upper_m() - mesh_.lower_m();
    double longest_m = longest_over_length * std::max(std::max(size.x, size.y), size.z);
    footprint_m_ = 2 * longest_m;
    const auto divided = [&](double limit_m, std::vector<glm::dvec3>& arms,
                             std::vector<HullMesh::Triangle>& triangles) {
        for (bool is_done = false; !is_done;) {
            is_done = true;
            std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
            std::vector<HullMesh::Triangle> next;
            // returns the middle of a long edge, or the number of vertices there can be
            const auto middle = [&](std::uint32_t a, std::uint32_t b) -> std::optional<std::uint32_t> {
                if (!(wet_extent_m(arms[a], arms[b]) > limit_m * 1.000001)) return {};
                const auto [at, is_new] =
                    middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(arms.size()));
                if (is_new) arms.push_back(0.5 * (arms[a] + arms[b]));
                return at->second;
            };
            for (HullMesh::Triangle triangle : triangles) {
                std::array<std::optional<std::uint32_t>, 3> of;  // opposite of the corner
                for (std::size_t i = 0; i < 3; ++i) of[i] = middle(triangle[(i + 1) % 3], triangle[(i + 2) % 3]);
                const auto count = std::count_if(of.begin(), of.end(), [](const auto& at) { return at.has_value(); });
                if (arms.size() > max_vertices) return false;
                if (count > 0) is_done = false;
                // Turn it until the first corner's edges are alike.
                while (count == 1 ? !of[0] : count == 2 && of[0]) {
                    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
                    std::rotate(of.begin(), of.begin() + 1, of.end());
                }
                const auto [a, b, c] = triangle;
                if (count == 0) next.push_back(triangle);
                if (count == 1) next.insert(next.end(), {{a, b, *of[0]}, {a, *of[0], c}});
                if (count == 2) next.insert(next.end(), {{a, *of[2], *of[1]}, {*of[2], b, *of[1]}, {b, c, *of[1]}});
                if (count == 3)
                    next.insert(next.end(), {{a, *of[2], *of[1]}, {*of[2], b, *of[0]}, {*of[1], *of[0], c},
                                             {*of[0], *of[1], *of[2]}});
            }
            triangles = std::move(next);
        }
        return true;
    };
    if (arms_m_.size() >= max_vertices) return;
    while (true) {
        std::vector<glm::dvec3> arms = arms_m_;
        std::vector<HullMesh::Triangle> triangles = triangles_;
        if (divided(longest_m, arms, triangles)) {
            arms_m_ = std::move(arms);
            triangles_ = std::move(triangles);
            return;
        }
        longest_m *= 1.25;
    }
}

/// Finds the height at which the upright hull displaces its mass, by bisection.
void Hull::find_rest() {
    floating_volume_m3_ = mass_kg_ / options_.water_density_kgpm3;
    afloat_.floats = floating_volume_m3_ < mesh_.volume_m3();
    if (!afloat_.floats) {
        floating_volume_m3_ = mesh_.volume_m3();
        return;
    }
    const auto at_height = [&](double height_m) {
        Hydrostatics wet;
        const auto vertex = [&](std::uint32_t i) {
            const double depth_m = -(height_m + arms_m_[i].y);
            return HullVertex{arms_m_[i], glm::dvec3{}, depth_m, depth_m};
        };
        for (const auto& [a, b, c] : mesh_.triangles())
            cut_at_waterline(
                {vertex(a), vertex(b), vertex(c)}, [&](const HullTriangle& t) { wet.add(t, t.area_m2()); },
                [](const HullTriangle&) {});
        return wet;
    };
    double low = centre_of_mass_m_.y - mesh_.upper_m().y, high = centre_of_mass_m_.y - mesh_.lower_m().y;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (at_height(middle).force_m3.y > floating_volume_m3_ ? low : high) = middle;
    }
    const Hydrostatics wet = at_height(high);
    afloat_.height_m = high;
    afloat_.draught_m = centre_of_mass_m_.y - mesh_.lower_m().y - high;
    afloat_.waterplane_m2 = wet.waterplane_m2;
    const double volume = wet.force_m3.y, buoyancy_m = -high - wet.depth_moment_m4 / volume;
    const double x = wet.x_m3 / wet.waterplane_m2, z = wet.z_m3 / wet.waterplane_m2;
    const double xx_m4 = wet.xx_m4 - x * wet.x_m3, zz_m4 = wet.zz_m4 - z * wet.z_m3;
    afloat_.roll_gm_m = buoyancy_m + zz_m4 / volume;
    afloat_.pitch_gm_m = buoyancy_m + xx_m4 / volume;
    // breadth of the box with the waterplane's area and second moment
    const double breadth_m = std::sqrt(12 * std::min(xx_m4, zz_m4) / wet.waterplane_m2);
    const double of_draught = breadth_m * wet.waterplane_m2 / (3 * volume);
    middle_weight_ = std::min(1.0, of_draught * of_draught);
}

/// Integrates the squares of the positions in the displaced water, from its middle, by Gauss' theorem:
/// x^3 / 3 along x over its surface, of which the waterplane is level.
void Hull::find_displaced_moments() {
    const double surface_m = afloat_.floats ? -afloat_.height_m : mesh_.upper_m().y;
    glm::dvec3 first{}, second{};
    double volume = 0;
    const auto add = [&](const HullTriangle& triangle) {
        const glm::dvec3 area = triangle.area_m2();
        const glm::dvec3 below(0, surface_m, 0), a = triangle.a.arm_m - below, b = triangle.b.arm_m - below,
                         c = triangle.c.arm_m - below;
        for (int i = 0; i < 3; ++i) {
            const double squares = a[i] * a[i] + b[i] * b[i] + c[i] * c[i] + a[i] * b[i] + b[i] * c[i] + c[i] * a[i];
            const double cubes = a[i] * a[i] * (a[i] + b[i] + c[i]) + b[i] * b[i] * (a[i] + b[i] + c[i]) +
                                 c[i] * c[i] * (a[i] + b[i] + c[i]) + a[i] * b[i] * c[i];
            first[i] += area[i] * squares / 12;
            second[i] += area[i] * cubes / 30;
        }
        volume += area.y * (a.y + b.y + c.y) / 3;
    };
    const auto vertex = [&](std::uint32_t i) {
        const double depth_m = surface_m - arms_m_[i].y;
        return HullVertex{arms_m_[i], glm::dvec3{}, depth_m, depth_m};
    };
    for (const auto& [a, b, c] : mesh_.triangles())
        cut_at_waterline({vertex(a), vertex(b), vertex(c)}, add, [](const HullTriangle&) {});
    displaced_m5_ = second - first * first / volume;
}

/// Of a hull that sinks, as if it were half submerged. Water on one side halves the added mass of a plate
/// that lies on the surface, and of the mirror image of a plate that stands in it.
void Hull::set_added_mass_of_plates() {
    const glm::dvec3 size = mesh_.upper_m() - mesh_.lower_m();
    const double density = options_.water_density_kgpm3, draught = size.y / 2;
    const auto half_plate = [&](double a, double b) { return plate_added_mass_kg(density, a, b) / 2; };
    const double heave = half_plate(size.x, size.z), sway = half_plate(size.x, 2 * draught);
    // Rotation: strips across the length, and a plate's rotation about its middle line, rho pi/8
    // (beam/2)^4 a metre in unbounded water (Newman, table 4.3).
    const double half_beam2 = size.z * size.z / 4;
    const double diagonal[] = {half_plate(size.z, 2 * draught),
                               heave,
                               sway,
                               density * std::numbers::pi / 16 * half_beam2 * half_beam2 * size.x,
                               sway * size.x * size.x / 12,
                               heave * size.x * size.x / 12};
    for (std::size_t i = 0; i < 6; ++i) added_mass_[i][i] = diagonal[i];
}

std::uint64_t Hull::digest() const {
    std::vector<double> numbers;
    const auto put = [&](const glm::dvec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
    for (const NumericField<HullOptions>& field : hull_field_table) numbers.push_back(field.value_in(options_));
    put(centre_of_mass_m_);
    put(inertia_kgm2_);
    for (const auto& row : added_mass_) numbers.insert(numbers.end(), row.begin(), row.end());
    for (const glm::dvec3& vertex : mesh_.vertices()) put(vertex);
    for (const HullMesh::Triangle& triangle : mesh_.triangles())
        numbers.insert(numbers.end(), triangle.begin(), triangle.end());
    const std::uint64_t digest = XXH3_64bits(numbers.data(), numbers.size() * sizeof(double));
    return options_.coefficients ? options_.coefficients->digest() ^ digest : digest;
}

glm::dvec3 Hull::mesh_origin_m(const HullState& state) const {
    const DefaultFloatEnvironment environment;
    return environment.result(state.position_m - glm::mat3_cast(state.orientation) * centre_of_mass_m_);
}

HullState Hull::at_rest(double x_m, double z_m, double heading_rad) const {
    if (!std::isfinite(heading_rad))
        throw std::invalid_argument(invalid_value_message("heading_rad", heading_rad, "a finite number"));
    const DefaultFloatEnvironment environment(x_m, z_m, heading_rad);
    HullState state;
    state.position_m = {x_m, afloat_.height_m, z_m};
    // from +x towards +z is a negative rotation about y
    const auto [sine, cosine] = det::sine_cosine_of_turns(heading_rad / (2 * two_pi));
    state.orientation = glm::dquat(cosine, 0, -sine, 0);
    state.submersion = afloat_.floats ? 1 : 0;
    return state;
}

HullState Hull::at_rest(const WaterKinematics& water, double x_m, double z_m, double heading_rad) const {
    const DefaultFloatEnvironment environment(x_m, z_m, heading_rad);
    HullState state = at_rest(x_m, z_m, heading_rad);
    const double y_m = 0;
    float depth = 0, vx = 0, vy = 0, vz = 0;
    const auto sample = [&](double at_y_m) {
        water.sample({{&x_m, 1}, {&at_y_m, 1}, {&z_m, 1}}, {.depth_m = {&depth, 1},
                                                            .velocity_x_mps = {&vx, 1},
                                                            .velocity_y_mps = {&vy, 1},
                                                            .velocity_z_mps = {&vz, 1}});
        return static_cast<double>(depth);
    };
    const double height_m = sample(y_m);
    sample(height_m);
    state.position_m.y += height_m;
    state.velocity_mps = glm::dvec3(vx, vy, vz);
    return state;
}

}  // namespace pelagic
