#include "pelagic/floating/wamit_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/floating/matrix6.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// WAMIT's modes in the order of HullMatrix, and the factor of their direction.
constexpr std::size_t row_of_mode[] = {0, 2, 1, 3, 5, 4};
constexpr double sign_of_mode[] = {1, -1, 1, 1, -1, 1};
constexpr const char* mode_names[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

[[noreturn]] void reject(std::size_t line, const std::string& reason) {
    throw std::invalid_argument(one_line("line " + number_text(line) + ": " + reason));
}

void require_range(const char* name, double value, double min, double max, const char* accepted) {
    if (!(value >= min && value <= max)) throw std::invalid_argument(invalid_value_message(name, value, accepted));
}

void check(const WamitScale& scale) {
    require_range("length_m", scale.length_m, 1e-3, 1e4, "[1e-3, 1e4] m");
    require_range("density_kgpm3", scale.density_kgpm3, 500, 2000, "[500, 2000] kg/m^3");
    require_range("gravity_mps2", scale.gravity_mps2, 1, 100, "[1, 100] m/s^2");
    for (int axis = 0; axis < 3; ++axis) require_range("origin_m", scale.origin_m[axis], -1e3, 1e3, "[-1e3, 1e3] m");
}

/// Parses a decimal number, also with Fortran's D before the exponent. The digits become an integer, which is
/// multiplied or divided by a power of ten: the same bits from every C++ library. None for anything else.
std::optional<double> parse_decimal(std::string_view text) {
    std::size_t at = 0;
    const auto is_digit = [&] { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    const auto take_sign = [&] {
        const bool is_minus = at < text.size() && text[at] == '-';
        if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
        return is_minus;
    };
    const bool is_negative = take_sign();
    std::uint64_t digits = 0;
    int exponent = 0;
    bool has_digits = false, has_point = false;
    for (; is_digit() || (!has_point && at < text.size() && text[at] == '.'); ++at) {
        if (text[at] == '.') {
            has_point = true;
            continue;
        }
        has_digits = true;
        if (digits < 1'000'000'000'000'000) {  // 15 digits are exact
            digits = 10 * digits + static_cast<std::uint64_t>(text[at] - '0');
            exponent -= has_point ? 1 : 0;
        } else {
            exponent += has_point ? 0 : 1;
        }
    }
    if (!has_digits) return {};
    if (at < text.size()) {
        if (std::string_view("eEdD").find(text[at]) == std::string_view::npos) return {};
        ++at;
        const bool is_small = take_sign();
        if (!is_digit()) return {};
        int power = 0;
        for (; is_digit(); ++at) power = std::min(10 * power + (text[at] - '0'), 9999);
        exponent += is_small ? -power : power;
        if (at < text.size()) return {};
    }
    double value = static_cast<double>(digits);
    if (exponent < -400) exponent = -400;
    for (; exponent >= 22 && value != 0 && std::isfinite(value); exponent -= 22) value *= 1e22;
    for (; exponent <= -22 && value != 0; exponent += 22) value /= 1e22;
    for (; exponent > 0 && value != 0 && std::isfinite(value); --exponent) value *= 10;
    for (; exponent < 0 && value != 0; ++exponent) value /= 10;
    if (!std::isfinite(value)) return {};
    return is_negative ? -value : value;
}

/// A line of numbers.
struct Line {
    std::size_t number = 0, columns = 0;
    std::array<double, 8> values{};
};

/// Calls take(line) for each line that is not empty.
template <class Take>
void for_each_line(std::string_view text, Take take) {
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (++number > max_wamit_lines)
            throw std::invalid_argument("the file has more than " + number_text(max_wamit_lines) + " lines");
        Line line{.number = number};
        while (true) {
            constexpr std::string_view blanks = " \t\r";
            rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
            if (rest.empty()) break;
            const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
            rest.remove_prefix(word.size());
            if (line.columns == line.values.size()) reject(number, "more than 8 columns");
            const std::optional<double> value = parse_decimal(word);
            if (!value)
                reject(number, invalid_value_message("column " + number_text(line.columns + 1), word.substr(0, 40),
                                                     "a finite number"));
            line.values[line.columns++] = *value;
        }
        if (line.columns > 0) take(line);
    }
}

std::size_t mode_in(const Line& line, std::size_t column) {
    const double value = line.values[column];
    for (std::size_t mode = 0; mode < 6; ++mode)
        if (value == static_cast<double>(mode + 1)) return mode;
    reject(line.number, invalid_value_message("the mode", value, "a whole number from 1 to 6"));
}

/// Returns the frequency of a line, 0 and infinity among them.
double omega_in(const Line& line, const WamitScale& scale) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double value = line.values[0];
    if (scale.first_column == WamitScale::Column::period_s) {
        if (value < 0) return 0;
        if (value == 0) return infinite;
        const double omega = two_pi / value;
        if (!(omega >= 1e-6 && omega <= 1e4))
            reject(line.number, invalid_value_message("the period", value, "[6.3e-4, 6.3e6] s"));
        return omega;
    }
    if (value < 0) return infinite;
    if (value > 0 && !(value >= 1e-6 && value <= 1e4))
        reject(line.number, invalid_value_message("the frequency", value, "[1e-6, 1e4] rad/s"));
    return value;
}

std::string frequency_text(double omega, const WamitScale& scale) {
    if (scale.first_column == WamitScale::Column::period_s)
        return "the period " + rounded_text(two_pi / omega, 6) + " s";
    return "the frequency " + rounded_text(omega, 6) + " rad/s";
}

/// Returns L^power.
double length_to(const WamitScale& scale, int power) {
    double result = 1;
    for (int i = 0; i < power; ++i) result *= scale.length_m;
    return result;
}

/// The velocity at the body's origin from that of the centre of mass: v + w x origin.
HullMatrix velocity_at_origin(const glm::dvec3& origin_m) {
    HullMatrix matrix{};
    for (std::size_t i = 0; i < 6; ++i) matrix[i][i] = 1;
    add_block(matrix, 0, 3, -1, cross_matrix(origin_m));
    return matrix;
}

/// Returns T^t matrix T, symmetric to the last bit.
HullMatrix about_centre(const HullMatrix& matrix, const HullMatrix& t) {
    HullMatrix half{}, result{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            for (std::size_t k = 0; k < 6; ++k) half[i][j] += matrix[i][k] * t[k][j];
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            for (std::size_t k = 0; k < 6; ++k) result[i][j] += t[k][i] * half[k][j];
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j) result[i][j] = result[j][i] = 0.5 * (result[i][j] + result[j][i]);
    return result;
}

/// The entries of a frequency as they stand in the file.
struct Entries {
    HullMatrix added{}, damping{};
    std::array<std::array<std::size_t, 6>, 6> line{};  ///< 0: left out
};

/// Averages i,j and j,i, or takes the one that is there.
void complete(Entries& entries) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (HullMatrix* matrix : {&entries.added, &entries.damping}) {
                double &a = (*matrix)[i][j], &b = (*matrix)[j][i];
                const bool has_a = entries.line[i][j] > 0, has_b = entries.line[j][i] > 0;
                a = b = has_a && has_b ? 0.5 * (a + b) : has_a ? a : b;
            }
}

double turns(double angle_deg) { return angle_deg / 360; }

}  // namespace

RadiationTable read_wamit_1(std::string_view text, const WamitScale& scale) {
    const DefaultFloatEnvironment environment;
    check(scale);
    std::map<double, Entries> rows;
    for_each_line(text, [&](const Line& line) {
        if (line.columns < 4) reject(line.number, "expected the columns PER I J A(I,J) B(I,J)");
        const double omega = omega_in(line, scale);
        const bool is_limit = omega == 0 || std::isinf(omega);
        if (line.columns != (is_limit ? 4U : 5U) && !(is_limit && line.columns == 5))
            reject(line.number, invalid_value_message("the number of columns", line.columns,
                                                      is_limit ? "4, PER I J A(I,J)" : "5, PER I J A(I,J) B(I,J)"));
        const std::size_t i = mode_in(line, 1), j = mode_in(line, 2);
        const std::size_t row = row_of_mode[i], column = row_of_mode[j];
        Entries& entries = rows[omega];
        if (rows.size() > max_wamit_frequencies + 2)
            reject(line.number, "more than " + number_text(max_wamit_frequencies) + " frequencies");
        const std::string pair = "(" + number_text(i + 1) + "," + number_text(j + 1) + ")";
        if (entries.line[row][column] > 0)
            reject(line.number, pair + " is given twice, first in line " + number_text(entries.line[row][column]));
        entries.line[row][column] = line.number;
        const int rotations = (i >= 3 ? 1 : 0) + (j >= 3 ? 1 : 0);
        const double mass = sign_of_mode[i] * sign_of_mode[j] * scale.density_kgpm3 * length_to(scale, 3 + rotations);
        entries.added[row][column] = mass * line.values[3];
        if (!is_limit) entries.damping[row][column] = mass * omega * line.values[4];
        if (!(std::fabs(entries.added[row][column]) <= 1e15 && std::fabs(entries.damping[row][column]) <= 1e15))
            reject(line.number, "A" + pair + " or B" + pair + " is beyond 1e15 in SI units, expected another scale");
    });
    // Damping that rounding or panels make negative is 0; more is an error.
    std::array<double, 6> largest{};
    for (const auto& [omega, entries] : rows)
        for (std::size_t i = 0; i < 6; ++i) largest[i] = std::max(largest[i], entries.damping[i][i]);
    const HullMatrix at_origin = velocity_at_origin(scale.origin_m);
    RadiationTable table;
    bool has_infinite = false;
    for (auto& [omega, entries] : rows) {
        const bool is_limit = omega == 0 || std::isinf(omega);
        for (std::size_t mode = 0; mode < 6; ++mode) {
            const std::size_t i = row_of_mode[mode];
            const std::string number = number_text(mode + 1);
            if (entries.line[i][i] == 0 && !(omega == 0))
                throw std::invalid_argument(
                    (std::isinf(omega) ? "infinite frequency" : frequency_text(omega, scale)) + " has no line of (" +
                    number + "," + number + "), " + mode_names[mode]);
            double& damping = entries.damping[i][i];
            if (damping < -0.01 * largest[i] || (damping < 0 && largest[i] == 0))
                reject(entries.line[i][i], "B(" + number + "," + number + ") is negative, expected damping");
            damping = std::max(damping, 0.0);
        }
        complete(entries);
        if (std::isinf(omega)) {
            has_infinite = true;
            table.infinite_added_mass = about_centre(entries.added, at_origin);
        }
        if (is_limit) continue;
        table.omega_radps.push_back(omega);
        table.added_mass.push_back(about_centre(entries.added, at_origin));
        HullMatrix& damping = table.damping.emplace_back(about_centre(entries.damping, at_origin));
        for (std::size_t i = 0; i < 6; ++i) damping[i][i] = std::max(damping[i][i], 0.0);
    }
    if (table.omega_radps.size() < 4)
        throw std::invalid_argument(invalid_value_message("the number of finite frequencies", table.omega_radps.size(),
                                                          "4 or more"));
    if (!has_infinite) table.infinite_added_mass = table.added_mass.back();
    return environment.result(std::move(table));
}

ForceTable read_wamit_3(std::string_view text, const WamitScale& scale) {
    const DefaultFloatEnvironment environment;
    check(scale);
    struct Cell {
        ForceTable::Forces forces{};
        std::array<std::size_t, 6> line{};
    };
    // Headings in thousandths of a degree, in WAMIT's direction, towards port.
    std::map<double, std::map<int, Cell>> rows;
    for_each_line(text, [&](const Line& line) {
        if (line.columns != 7)
            reject(line.number, invalid_value_message("the number of columns", line.columns,
                                                      "7, PER BETA I MOD PHASE RE IM"));
        const double omega = omega_in(line, scale);
        if (omega == 0 || std::isinf(omega)) return;  // statics, and no force
        if (!(std::fabs(line.values[1]) <= 720))
            reject(line.number, invalid_value_message("BETA", line.values[1], "[-720, 720] degrees"));
        int heading = static_cast<int>(std::floor(line.values[1] * 1000 + 0.5)) % 360'000;
        if (heading < 0) heading += 360'000;
        const std::size_t mode = mode_in(line, 2), row = row_of_mode[mode];
        const double size = line.values[3], re = line.values[5], im = line.values[6];
        const auto [sine, cosine] = det::sine_cosine_of_turns(turns(line.values[4]));
        const double accepted = 0.01 * std::fabs(size) + 1e-5;
        if (!(std::fabs(line.values[4]) <= 1e4) || std::fabs(size * cosine - re) > accepted ||
            std::fabs(size * sine - im) > accepted)
            reject(line.number, "MOD and PHASE (degrees) do not agree with RE and IM");
        Cell& cell = rows[omega][heading];
        if (rows.size() > max_wamit_frequencies)
            reject(line.number, "more than " + number_text(max_wamit_frequencies) + " frequencies");
        if (rows[omega].size() > max_wamit_headings)
            reject(line.number, "more than " + number_text(max_wamit_headings) + " headings");
        if (cell.line[row] > 0 && line.values[1] == 360) return;  // given at 0 degrees, too
        if (cell.line[row] > 0)
            reject(line.number, "mode " + number_text(mode + 1) + " is given twice, first in line " +
                                    number_text(cell.line[row]));
        cell.line[row] = line.number;
        const double force = sign_of_mode[mode] * scale.density_kgpm3 * scale.gravity_mps2 *
                             length_to(scale, mode >= 3 ? 3 : 2);
        if (!(std::fabs(force * size) <= 1e15))
            reject(line.number, "MOD is beyond 1e15 in SI units, expected another scale");
        cell.forces[row] = {force * re, force * im};
    });
    if (rows.size() < 2)
        throw std::invalid_argument(invalid_value_message("the number of frequencies", rows.size(), "2 or more"));
    // Of a symmetric hull.
    std::vector<int> headings;
    for (const auto& [heading, cell] : rows.begin()->second) headings.push_back(heading);
    const bool is_half = headings.front() == 0 && headings.back() == 180'000;
    ForceTable table;
    for (auto& [omega, cells] : rows) {
        if (!std::equal(cells.begin(), cells.end(), headings.begin(), headings.end(),
                        [](const auto& a, int heading) { return a.first == heading; }))
            throw std::invalid_argument(frequency_text(omega, scale) + " has other headings than " +
                                        frequency_text(rows.begin()->first, scale));
        for (const auto& [heading, cell] : cells)
            for (std::size_t mode = 0; mode < 6; ++mode)
                if (cell.line[row_of_mode[mode]] == 0)
                    throw std::invalid_argument(frequency_text(omega, scale) + " has no line of mode " +
                                                number_text(mode + 1) + ", " + mode_names[mode] + ", at " +
                                                number_text(heading / 1000.0) + " degrees");
        if (is_half)
            for (const auto& [heading, cell] : std::map<int, Cell>(cells)) {
                if (heading == 0 || heading == 180'000) continue;
                Cell mirrored = cell;
                for (const std::size_t row : {2, 3, 4}) mirrored.forces[row] = -mirrored.forces[row];
                cells.emplace(360'000 - heading, mirrored);
            }
        table.omega_radps.push_back(omega);
        // From WAMIT's direction, towards port, to ours: 360 degrees less, in increasing order.
        std::vector<std::pair<int, const Cell*>> ordered;
        for (const auto& [heading, cell] : cells) ordered.emplace_back((360'000 - heading) % 360'000, &cell);
        std::sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        const HullMatrix at_origin = velocity_at_origin(scale.origin_m);
        const double wave_number = omega * omega / scale.gravity_mps2;
        for (const auto& [heading, cell] : ordered) {
            if (table.omega_radps.size() == 1) table.heading_rad.push_back(two_pi * turns(heading / 1000.0));
            // The crest passes the origin later or earlier than the centre of mass.
            const auto [z, x] = det::sine_cosine_of_turns(turns(heading / 1000.0));
            const double late = wave_number * (x * scale.origin_m.x + z * scale.origin_m.z);
            const auto [sine, cosine] = det::sine_cosine_of_turns(-late / two_pi);
            ForceTable::Forces& forces = table.forces.emplace_back();
            for (std::size_t i = 0; i < 6; ++i) {
                double re = 0, im = 0;
                for (std::size_t k = 0; k < 6; ++k) {
                    re += at_origin[k][i] * cell->forces[k].real();
                    im += at_origin[k][i] * cell->forces[k].imag();
                }
                forces[i] = {re * cosine - im * sine, re * sine + im * cosine};
            }
        }
    }
    return environment.result(std::move(table));
}

}  // namespace pelagic
