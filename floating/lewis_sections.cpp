#include "pelagic/floating/lewis_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "pelagic/simd/direction.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t section_count = 20;

/// Complex numbers without the library's product, which treats infinities.
struct Complex {
    double re = 0, im = 0;
};
Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator*(Complex a, Complex b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
Complex operator*(double a, Complex b) { return {a * b.re, a * b.im}; }

/// A section across the hull: x from the centre of mass; beam at the waterline, draught, and area below
/// the waterline.
struct Section {
    double x_m = 0, beam_m = 0, draught_m = 0, area_m2 = 0;
};

/// The hull below the waterline.
struct Immersed {
    std::vector<std::array<glm::dvec3, 3>> triangles;  ///< y from the waterline, x and z from the centre of mass
    double volume_m3 = 0, waterplane_m2 = 0;
    double depth_moment_m4 = 0, depth_moment_m5 = 0;  ///< integrals of y and y^2 over the volume
    glm::dvec3 lower_m{}, upper_m{};
    std::array<Section, section_count> sections;
    double strip_m = 0;

    double length_m() const { return upper_m.x - lower_m.x; }
    double beam_m() const { return upper_m.z - lower_m.z; }
    double draught_m() const { return -lower_m.y; }
};

/// Appends the part of a triangle below y = 0, as up to two triangles.
void append_below(const std::array<glm::dvec3, 3>& triangle, std::vector<std::array<glm::dvec3, 3>>& below) {
    std::array<glm::dvec3, 4> corners;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
        if (from.y <= 0) corners[count++] = from;
        if ((from.y < 0 && to.y > 0) || (from.y > 0 && to.y < 0)) {
            const double along = from.y / (from.y - to.y);
            corners[count++] = {from.x + along * (to.x - from.x), 0, from.z + along * (to.z - from.z)};
        }
    }
    for (std::size_t i = 1; i + 1 < count; ++i) below.push_back({corners[0], corners[i], corners[i + 1]});
}

/// Adds what a triangle cut by the plane of a section contributes. The section's outward normal n is the
/// triangle's in that plane: beam and area are the integrals of -n_y and n_y y along the contour.
void add_cut(const std::array<glm::dvec3, 3>& triangle, double x_m, Section& section) {
    glm::dvec3 ends[2];
    int found = 0;
    for (std::size_t i = 0; i < 3 && found < 2; ++i) {
        const glm::dvec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
        if ((from.x > x_m) == (to.x > x_m)) continue;
        ends[found++] = from + (x_m - from.x) / (to.x - from.x) * (to - from);
    }
    if (found < 2) return;
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double in_plane = std::sqrt(normal.y * normal.y + normal.z * normal.z);
    if (in_plane == 0) return;
    const double dy = ends[1].y - ends[0].y, dz = ends[1].z - ends[0].z;
    const double up_m = normal.y / in_plane * std::sqrt(dy * dy + dz * dz);
    section.beam_m -= up_m;
    section.area_m2 += up_m * (ends[0].y + ends[1].y) / 2;
    section.draught_m = std::max({section.draught_m, -ends[0].y, -ends[1].y});
}

Immersed immersed(const HullMesh& mesh, const glm::dvec3& centre_of_mass_m, double waterline_y_m) {
    Immersed hull;
    const glm::dvec3 origin(centre_of_mass_m.x, waterline_y_m, centre_of_mass_m.z);
    for (const auto& [a, b, c] : mesh.triangles())
        append_below({mesh.vertices()[a] - origin, mesh.vertices()[b] - origin, mesh.vertices()[c] - origin},
                     hull.triangles);
    if (hull.triangles.empty()) return hull;
    hull.lower_m = hull.upper_m = hull.triangles[0][0];
    for (const auto& triangle : hull.triangles) {
        const auto& [a, b, c] = triangle;
        const double up_m2 = 0.5 * glm::cross(b - a, c - a).y;
        // integrals of y, y^2 / 2 and y^3 / 3 along the normal; the waterplane at y = 0 adds nothing
        hull.waterplane_m2 -= up_m2;
        hull.volume_m3 += up_m2 * (a.y + b.y + c.y) / 3;
        hull.depth_moment_m4 += up_m2 * (a.y * a.y + b.y * b.y + c.y * c.y + a.y * b.y + b.y * c.y + c.y * a.y) / 12;
        const double cubes = a.y * a.y * (a.y + b.y + c.y) + b.y * b.y * (b.y + c.y) + c.y * c.y * c.y +
                             a.y * (b.y * b.y + b.y * c.y + c.y * c.y) + b.y * c.y * c.y;
        hull.depth_moment_m5 += up_m2 * cubes / 30;
        for (const glm::dvec3& corner : triangle) {
            hull.lower_m = glm::min(hull.lower_m, corner);
            hull.upper_m = glm::max(hull.upper_m, corner);
        }
    }
    hull.strip_m = hull.length_m() / section_count;
    for (std::size_t i = 0; i < section_count; ++i) {
        Section& section = hull.sections[i];
        section.x_m = hull.lower_m.x + (static_cast<double>(i) + 0.5) * hull.strip_m;
        for (const auto& triangle : hull.triangles) add_cut(triangle, section.x_m, section);
    }
    return hull;
}

/// The Lewis form of a section: depth + i z = m (s + b1 / s + b3 / s^3) with s = exp(i theta), theta from
/// the keel at 0 to the waterline at pi/2. b1 is -a1 of Lewis.
struct LewisForm {
    double m = 0, b1 = 0, b3 = 0;
};

/// The area coefficient is limited to that of forms without loops and re-entrant keels (Journee and
/// Massie, section 7.2.3).
LewisForm lewis_form(const Section& section) {
    const double ratio = section.beam_m / (2 * section.draught_m);
    const double fullness = std::clamp(section.area_m2 / (section.beam_m * section.draught_m),
                                       3 * pi / 32 * (2 - std::min(ratio, 1 / ratio)),
                                       pi / 32 * (10 + ratio + 1 / ratio));
    const double q = (ratio - 1) / (ratio + 1), of_ellipse = 4 * fullness / pi;
    const double c = 3 + of_ellipse + (1 - of_ellipse) * q * q;
    const double a3 = (3 - c + std::sqrt(std::max(9 - 2 * c, 0.0))) / c, a1 = q * (1 + a3);
    return {section.beam_m / (2 * (1 + a1 + a3)), -a1, a3};
}

/// Added masses of a metre of a section over the density, about the waterline: of heave at infinite
/// frequency; of sway, roll and both at zero frequency. Roll turns y to z.
struct SectionMasses {
    explicit SectionMasses(const LewisForm& form) {
        const double m = form.m, b1 = form.b1, b3 = form.b3;
        heave_m2 = pi / 2 * m * m * ((1 - b1) * (1 - b1) + 3 * b3 * b3);
        sway_m2 = pi / 2 * m * m * ((1 + b1) * (1 + b1) + 3 * b3 * b3);
        const double two = 2 * b1 * (1 + b3), four = 4 * b3;
        sway_roll_m3 =
            -m * m * m * ((1 + b1) * (4.0 / 3 * two - 8.0 / 15 * four) + b3 * (4.0 / 5 * two + 8.0 / 7 * four));
        const double turn = -b1 * (1 + b3);
        roll_m4 = 16 / pi * m * m * m * m * (turn * turn + 8.0 / 9 * turn * b3 + 16.0 / 9 * b3 * b3);
    }
    double heave_m2, sway_m2, sway_roll_m3, roll_m4;
};

/// Returns exp(-w).
Complex exp_of_minus(Complex w) {
    const auto [sine, cosine] = det::sine_cosine_of_turns(w.im / two_pi);
    const double size = det::exp(-w.re);
    return {size * cosine, -size * sine};
}

/// Returns the exponential integral Ei(w) in the first quadrant, by its series. \pre |w| <= 15
Complex exponential_integral(Complex w) {
    constexpr double euler = 0.57721566490153286;
    Complex sum{euler + 0.5 * det::log(w.re * w.re + w.im * w.im), angle_of(w.re, w.im)}, term{1, 0};
    const double size2 = w.re * w.re + w.im * w.im;
    double term2 = 1;
    for (int n = 1; n <= 70 && term2 > 1e-36; ++n) {
        term = 1.0 / n * (w * term);
        term2 *= size2 / (n * n);
        sum = sum + 1.0 / n * term;
    }
    return sum;
}

/// Least squares by Gram-Schmidt orthogonalisation of the columns.
template <std::size_t points, std::size_t columns>
class LeastSquares {
   public:
    using Column = std::array<double, points>;
    /// Returns the factor of the last column that fits the right side best.
    static double last_factor(std::array<Column, columns> matrix, const Column& right) {
        for (std::size_t j = 0; j < columns; ++j)
            for (std::size_t i = 0; i < j; ++i) subtract(matrix[j], matrix[i]);
        const Column& last = matrix[columns - 1];
        const double square = dot(last, last);
        return square > 0 ? dot(last, right) / square : 0;
    }

   private:
    static double dot(const Column& a, const Column& b) {
        double sum = 0;
        for (std::size_t i = 0; i < points; ++i) sum += a[i] * b[i];
        return sum;
    }
    static void subtract(Column& from, const Column& direction) {
        const double square = dot(direction, direction);
        if (square == 0) return;
        const double factor = dot(from, direction) / square;
        for (std::size_t i = 0; i < points; ++i) from[i] -= factor * direction[i];
    }
};

/// Returns the amplitude of the waves that a heaving section makes over that of its motion.
///
/// The flow is a source at the origin and multipoles without waves; its stream function at the contour
/// is that of the motion, Im Z. For the source that is Im(-exp(-w) Ei(w)), w = k Z, with outgoing waves
/// -pi Im exp(-w) in quadrature.
double wave_amplitude_ratio(const LewisForm& form, double wave_number_radpm) {
    constexpr std::size_t multipoles = 6, points = 16;
    using Fit = LeastSquares<points, multipoles + 1>;
    std::array<Fit::Column, multipoles + 1> columns;
    Fit::Column in_phase, in_quadrature;
    const double km = wave_number_radpm * form.m;
    for (std::size_t p = 0; p < points; ++p) {
        // sines and cosines of theta and its multiples
        constexpr std::size_t powers = 2 * multipoles + 4;
        std::array<double, powers> sine, cosine;
        for (std::size_t n = 0; n < powers; ++n) {
            const auto both = det::sine_cosine_of_turns(static_cast<double>(n * (p + 1)) / (4 * points));
            sine[n] = both.sine;
            cosine[n] = both.cosine;
        }
        const Complex z{form.m * ((1 + form.b1) * cosine[1] + form.b3 * cosine[3]),
                        form.m * ((1 - form.b1) * sine[1] - form.b3 * sine[3])};
        const Complex w = wave_number_radpm * Complex{std::max(z.re, 0.0), z.im};
        const Complex wave = exp_of_minus(w);
        in_phase[p] = -(wave * exponential_integral(w)).im;
        in_quadrature[p] = -pi * wave.im;
        for (std::size_t i = 1; i <= multipoles; ++i) {
            const std::size_t odd = 2 * i - 1;
            columns[i - 1][p] = -sine[2 * i] - km * (sine[odd] / static_cast<double>(odd) -
                                                     form.b1 * sine[odd + 2] / static_cast<double>(odd + 2) -
                                                     3 * form.b3 * sine[odd + 4] / static_cast<double>(odd + 4));
        }
        columns[multipoles][p] = z.im;
    }
    const double a = Fit::last_factor(columns, in_phase), b = Fit::last_factor(columns, in_quadrature);
    return pi * wave_number_radpm / std::sqrt(a * a + b * b);
}

/// Carlson's elliptic integral R_D(x, y, z), by duplication (B. C. Carlson, Numer. Math. 33, 1979).
double carlson_rd(double x, double y, double z) {
    double sum = 0, factor = 1;
    for (int i = 0; i < 30; ++i) {
        const double xy = std::sqrt(x * y), yz = std::sqrt(y * z), zx = std::sqrt(z * x), mean = xy + yz + zx;
        sum += factor / (std::sqrt(z) * (z + mean));
        factor /= 4;
        x = (x + mean) / 4;
        y = (y + mean) / 4;
        z = (z + mean) / 4;
    }
    const double mean = (x + y + 3 * z) / 5;
    return 3 * sum + factor / (mean * std::sqrt(mean));
}

/// Added mass of an ellipsoid in unbounded water (Lamb, sections 114 and 115).
struct Ellipsoid {
    Ellipsoid(double a_m, double b_m, double c_m) : a(a_m), b(b_m), c(c_m) {}
    double a, b, c;

    /// Returns Lamb's coefficient of the axis that is the last argument.
    double lamb(double x, double y, double along) const {
        return 2.0 / 3 * a * b * c * carlson_rd(x * x, y * y, along * along);
    }
    double alpha() const { return lamb(b, c, a); }
    double gamma() const { return lamb(a, b, c); }
    /// Returns the added over the displaced mass for motion along a and along c.
    double along_a() const { return alpha() / (2 - alpha()); }
    double along_c() const { return gamma() / (2 - gamma()); }
    /// Returns the added mass along c over that of sections across a.
    double of_strips_along_c() const { return along_c() * c / b; }
    /// Returns the added mass of rotation about b over that of sections across a that move along c; 0
    /// unless a is longer than c.
    double of_strips_about_b() const {
        if (a <= 1.0001 * c) return 0;
        const double difference = a * a - c * c, sum = a * a + c * c, excess = gamma() - alpha();
        return difference * difference * excess / (2 * difference - sum * excess) * c / (a * a * b);
    }
};

/// Heave and pitch: values of 1,1; 1,5 and 5,5.
using HeavePitch = std::array<double, 3>;

/// Waves are shorter than any that matter, and the series of Ei loses digits, beyond this k times size.
constexpr double max_wave_size = 15;

/// What three dimensions add to the loss of force, 1 - f / (rho g B), of a short hull: fitted to the forces on
/// a hemisphere (A. Hulme, J. Fluid Mech. 121, 1982). In a deep hull the loss is that of the pressure with
/// depth, to which three dimensions add nothing.
constexpr double diffraction_in_3d = 0.28;

/// Returns the damping by the waves of a hull whose sections have the forces f(x) in waves, N/m for
/// waves of 1 m.
HeavePitch damping_of(const Immersed& hull, const std::array<double, section_count>& force_npm, double omega_radps,
                      double density_kgpm3) {
    const double k = omega_radps * omega_radps / gravity_mps2;
    // Of half a turn: the other half has conjugate forces. A long hull makes narrow lobes.
    const int directions = std::clamp(static_cast<int>(1.5 * k * hull.length_m()), 12, 300);
    HeavePitch sums{};
    for (int i = 0; i < directions; ++i) {
        const double cosine = det::sine_cosine_of_turns((i + 0.5) / (2 * directions)).cosine;
        // of a strip along its length: sin(a) / a with half of its phase
        const double half = std::fabs(k * cosine * hull.strip_m / 2);
        const double sinc = half > 1e-9 ? det::sine_cosine_of_turns(half / two_pi).sine / half : 1;
        Complex heave, pitch;
        for (std::size_t s = 0; s < section_count; ++s) {
            const double x = hull.sections[s].x_m;
            const auto [im, re] = det::sine_cosine_of_turns(-k * cosine * x / two_pi);
            const Complex force = force_npm[s] * hull.strip_m * sinc * Complex{re, im};
            heave = heave + force;
            pitch = pitch + x * force;
        }
        sums[0] += heave.re * heave.re + heave.im * heave.im;
        sums[1] += heave.re * pitch.re + heave.im * pitch.im;
        sums[2] += pitch.re * pitch.re + pitch.im * pitch.im;
    }
    const double factor =
        k * omega_radps / (4 * pi * density_kgpm3 * gravity_mps2 * gravity_mps2) * two_pi / directions;
    for (double& sum : sums) sum *= factor;
    return sums;
}

/// Returns 2/pi PV integral of B(s) / (s^2 - omega^2) ds at each frequency, for frequencies at equal
/// ratios. B(omega) is subtracted from B(s), because the integral of 1 / (s^2 - omega^2) is 0.
std::vector<HeavePitch> added_by_damping(const std::vector<double>& omega, const std::vector<HeavePitch>& damping) {
    const std::size_t count = omega.size();
    const double ratio = omega[1] / omega[0], step = det::log(ratio), half = std::sqrt(ratio);
    const double low = omega[0] / half, high = omega[count - 1] * half;
    std::vector<HeavePitch> added(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double at = omega[i];
        const double beyond = (det::log((at + low) / (at - low)) - det::log((high + at) / (high - at))) / (2 * at);
        const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, count - 1);
        for (std::size_t mode = 0; mode < 3; ++mode) {
            double sum = damping[i][mode] * beyond;
            for (std::size_t j = 0; j < count; ++j)
                if (j != i)
                    sum += (damping[j][mode] - damping[i][mode]) / (omega[j] * omega[j] - at * at) * omega[j] * step;
            // the limit of the integrand at s = omega: B'(omega) / (2 omega)
            sum += (damping[after][mode] - damping[before][mode]) / static_cast<double>(after - before) / (2 * at);
            added[i][mode] = 2 / pi * sum;
        }
    }
    return added;
}

HeavePitch mixed(const HeavePitch& a, const HeavePitch& b, double fraction) {
    HeavePitch result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + fraction * (b[i] - a[i]);
    return result;
}

void add_heave_pitch(HullMatrix& matrix, const HeavePitch& values) {
    matrix[1][1] += values[0];
    matrix[1][5] += values[1];
    matrix[5][1] += values[1];
    matrix[5][5] += values[2];
}

/// Adds the mass of a mode of translation that is distributed in depth as the displaced volume, with the
/// rotation that moves points above the centre of mass by `sign` times their height.
void add_in_depth(HullMatrix& matrix, std::size_t translation, std::size_t rotation, double sign, double mass_kgpm3,
                  const Immersed& hull, double waterline_m) {
    const double first = hull.depth_moment_m4 + waterline_m * hull.volume_m3;
    const double second =
        hull.depth_moment_m5 + waterline_m * (2 * hull.depth_moment_m4 + waterline_m * hull.volume_m3);
    matrix[translation][translation] += mass_kgpm3 * hull.volume_m3;
    matrix[translation][rotation] += sign * mass_kgpm3 * first;
    matrix[rotation][translation] += sign * mass_kgpm3 * first;
    matrix[rotation][rotation] += mass_kgpm3 * second;
}

/// Returns the added over the displaced mass in surge: that of a Lewis form of the waterplane's length, beam and
/// area, of unit depth and unbounded water, times the factor of an ellipsoid, whose length is less for blunt ends.
double surge_ratio(const Immersed& hull) {
    const double length = hull.length_m(), beam = hull.beam_m(), draught = hull.draught_m();
    double largest_m2 = 0;
    for (const Section& section : hull.sections) largest_m2 = std::max(largest_m2, section.area_m2);
    if (!(largest_m2 > 0)) return 0;
    const double prismatic = hull.volume_m3 / (largest_m2 * length);
    const double curved_m = std::clamp(3 * (1 - prismatic) * length / 2,
                                       std::min(0.3 * length, 0.35 * std::min(beam, 2 * draught)), length / 2);
    const SectionMasses half(lewis_form({0, beam, length / 2, hull.waterplane_m2 / 2}));
    const Ellipsoid ends(curved_m, beam / 2, draught);
    return 2 * half.heave_m2 / hull.waterplane_m2 * ends.along_a() * curved_m / (beam / 2);
}

/// Returns whether a section reaches through the water's surface. One that does not has a beam of rounding errors.
bool is_immersed(const Section& section) {
    return section.draught_m > 0 && section.beam_m > 1e-4 * section.draught_m && section.area_m2 > 0;
}

}  // namespace

SectionCoefficients lewis_coefficients(const HullMesh& mesh, const glm::dvec3& centre_of_mass_m, double waterline_y_m,
                                       double density_kgpm3) {
    const DefaultFloatEnvironment environment(waterline_y_m, density_kgpm3);
    SectionCoefficients result;
    const Immersed hull = immersed(mesh, centre_of_mass_m, waterline_y_m);
    result.waterplane_m2 = hull.waterplane_m2;
    result.displaced_m3 = hull.volume_m3;
    if (!(hull.volume_m3 > 0 && hull.waterplane_m2 > 0)) return result;
    const double length = hull.length_m(), beam = hull.beam_m(), draught = hull.draught_m();
    const double waterline_m = waterline_y_m - centre_of_mass_m.y;

    // The bottom's curvature counts in heave: a flat one is that of a plate, but for the sides' flow.
    const double curved_m =
        std::clamp(3 * (draught - hull.volume_m3 / hull.waterplane_m2), std::min(0.6 * draught, 0.35 * beam), draught);
    const Ellipsoid upright(length / 2, beam / 2, curved_m), sideways(length / 2, draught, beam / 2);
    const double heave_factor = upright.of_strips_along_c(), pitch_factor = upright.of_strips_about_b();
    const double sway_factor = sideways.of_strips_along_c(), yaw_factor = sideways.of_strips_about_b();
    const bool is_deep = draught > length / 2;

    HeavePitch at_infinity{};
    HullMatrix others{};
    std::array<LewisForm, section_count> forms{};
    for (std::size_t s = 0; s < section_count; ++s) {
        const Section& section = hull.sections[s];
        if (!is_immersed(section)) continue;
        forms[s] = lewis_form(section);
        const SectionMasses of(forms[s]);
        const double x = section.x_m, per_metre = density_kgpm3 * hull.strip_m;
        at_infinity[0] += per_metre * of.heave_m2;
        at_infinity[1] += per_metre * of.heave_m2 * x;
        at_infinity[2] += per_metre * of.heave_m2 * x * x;
        if (is_deep) continue;
        // Sway at the waterline, in velocities of sway, roll and yaw about the centre of mass.
        const double sway[] = {1, waterline_m, -x}, roll[] = {0, 1, 0};
        const double factor[] = {std::sqrt(sway_factor), std::sqrt(sway_factor), std::sqrt(yaw_factor)};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                others[2 + i][2 + j] += per_metre * factor[i] * factor[j] *
                                        (of.sway_m2 * sway[i] * sway[j] + of.roll_m4 * roll[i] * roll[j] +
                                         of.sway_roll_m3 * (sway[i] * roll[j] + roll[i] * sway[j]));
    }
    for (std::size_t i = 2; i < 5; ++i)
        for (std::size_t j = 2; j < i; ++j) others[j][i] = others[i][j];
    at_infinity[0] *= heave_factor;
    at_infinity[1] *= std::sqrt(heave_factor * pitch_factor);
    at_infinity[2] *= pitch_factor;
    add_in_depth(others, 0, 5, -1, density_kgpm3 * surge_ratio(hull), hull, waterline_m);
    if (is_deep) {
        const double across = Ellipsoid(beam / 2, length / 2, draught).along_a();
        add_in_depth(others, 2, 3, 1, density_kgpm3 * across, hull, waterline_m);
    }

    // Frequencies around the resonance, at equal ratios.
    constexpr std::size_t count = 25;
    constexpr double lowest = 0.15, highest = 4;
    const double stiffness = density_kgpm3 * gravity_mps2 * hull.waterplane_m2, mass = density_kgpm3 * hull.volume_m3;
    const double first_guess = std::sqrt(stiffness / (mass + at_infinity[0]));
    const double diffraction = 1 + diffraction_in_3d * (1 - heave_factor) * std::min(beam / (2 * draught), 1.0);
    std::vector<double>& omega = result.table.omega_radps;
    std::vector<HeavePitch> damping;
    for (std::size_t i = 0; i < count; ++i) {
        omega.push_back(first_guess * lowest * det::pow(highest / lowest, static_cast<double>(i) / (count - 1)));
        const double k = omega[i] * omega[i] / gravity_mps2;
        std::array<double, section_count> force_npm{};
        for (std::size_t s = 0; s < section_count; ++s) {
            const Section& section = hull.sections[s];
            if (!is_immersed(section) || k * std::max(section.beam_m / 2, section.draught_m) > max_wave_size) continue;
            const double remains = std::min(wave_amplitude_ratio(forms[s], k) / (k * section.beam_m), 1.0);
            force_npm[s] =
                density_kgpm3 * gravity_mps2 * section.beam_m * std::max(1 - diffraction * (1 - remains), 0.0);
        }
        damping.push_back(damping_of(hull, force_npm, omega[i], density_kgpm3));
    }
    std::vector<HeavePitch> added = added_by_damping(omega, damping);
    for (HeavePitch& a : added) {
        for (const std::size_t mode : {std::size_t{0}, std::size_t{2}})
            a[mode] = std::max(at_infinity[mode] + a[mode], 0.3 * at_infinity[mode]);
        const double limit = 0.99 * std::sqrt(a[0] * a[2]);
        a[1] = std::clamp(at_infinity[1] + a[1], -limit, limit);
    }

    result.table.infinite_added_mass = others;
    add_heave_pitch(result.table.infinite_added_mass, at_infinity);
    for (std::size_t i = 0; i < count; ++i) {
        result.table.added_mass.push_back(others);
        add_heave_pitch(result.table.added_mass[i], added[i]);
        result.table.damping.emplace_back();
        add_heave_pitch(result.table.damping[i], damping[i]);
    }

    const auto excess = [&](std::size_t i) { return omega[i] * omega[i] * (mass + added[i][0]) - stiffness; };
    std::size_t above = 1;
    while (above + 1 < count && excess(above) < 0) ++above;
    const double fraction = std::clamp(-excess(above - 1) / (excess(above) - excess(above - 1)), 0.0, 1.0);
    result.added_mass = others;
    add_heave_pitch(result.added_mass, mixed(added[above - 1], added[above], fraction));
    add_heave_pitch(result.damping, mixed(damping[above - 1], damping[above], fraction));
    result.heave_omega_radps = omega[above - 1] + fraction * (omega[above] - omega[above - 1]);
    result.heave_wave_number_radpm = result.heave_omega_radps * result.heave_omega_radps / gravity_mps2;
    return environment.result(std::move(result));
}

}  // namespace pelagic
