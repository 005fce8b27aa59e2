#include "pelagic/sim/query/stack_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pelagic/sim/buffers/contraction_map.hpp"
#include "pelagic/sim/query/cascade_cell.hpp"

namespace pelagic {
namespace {

// Factor on a box's size in its proof, so that the search finds a reference point just outside of
// it once.
constexpr double surroundings = 1.5;

// Boxes with less slack are divided, because Newton's steps would be large.
constexpr double min_linear_slack = 0.02, min_cubic_slack = 0.3;

// Box size in finest texels below which the search uses Newton's method without a proof, because no
// proof exists at overturned intersections. Reference points that are closer together count as one.
constexpr double same_intersection = 1.0 / 128;
constexpr double small_surroundings = 2;

// Residual at which Newton's method stops, metres; below the rounding of the displacements, which
// are floats.
constexpr double exact_m = 1e-10;
constexpr int max_steps = 16;

// Upper bound of the residual of a solution, as a fraction of the search's target.
constexpr double same = 1.0 / 4;

// Factor on the remaining cascades' bounds, and metres added to them, so that rounding never
// discards a box early that all cascades together would keep.
constexpr double above_rounding = 1.001, min_remaining_m = 1e-9;

constexpr double square_root_of_2 = 1.41421356237309515;

double length_of(double x, double z) { return std::sqrt(x * x + z * z); }

struct CellPosition {
    int i, j;
    double u, v;
};

CellPosition position_in(const SearchCascade& cascade, const StackPoint& point, std::size_t number, Offset offset) {
    const double u = point.u[number] + (cascade.along * offset.x + cascade.across * offset.z);
    const double v = point.v[number] + (cascade.along * offset.z - cascade.across * offset.x);
    const double column = std::floor(u), row = std::floor(v);
    return {point.cell_x[number] + static_cast<int>(column), point.cell_z[number] + static_cast<int>(row), u - column,
            v - row};
}

/// Returns the horizontal displacement of one cascade, metres.
Offset displacement_at(const SearchCascade& cascade, const StackPoint& point, std::size_t number, Offset offset) {
    const CellPosition at = position_in(cascade, point, number, offset);
    const CascadeCell cell(cascade.texels, at.i, at.j, cascade.interpolation);
    const auto [x, z] =
        cell.values_at(CascadeCell::Planar<2>{cascade.texels.dx, cascade.texels.dz}, at.u, at.v);
    return {x, z};
}

/// Returns an upper bound of the contraction of up to 2 x 2 cells (kernels/cell_strip.kernel.hpp).
double contraction_of_cells(const SearchCascade& cascade, int first_i, int last_i, int first_j, int last_j) {
    const SurfaceTexels& texels = cascade.texels;
    const int columns = last_i - first_i + 2, rows = last_j - first_j + 2;
    Offset moved[3][3];
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::ptrdiff_t offset = texel_offset(texels, first_i + i, first_j + j);
            moved[j][i] = {static_cast<double>(texels.dx[offset]), static_cast<double>(texels.dz[offset])};
        }
    // `along` and `across` are the grid's cosine and sine over the length of a texel.
    double x_squared = 0, z_squared = 0, x_along = 1e300, z_across = 1e300;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const Offset here = moved[j][i];
            if (i + 1 < columns) {
                const double x = moved[j][i + 1].x - here.x, z = moved[j][i + 1].z - here.z;
                x_squared = std::max(x_squared, x * x + z * z);
                x_along = std::min(x_along, cascade.along * x + cascade.across * z);
            }
            if (j + 1 < rows) {
                const double x = moved[j + 1][i].x - here.x, z = moved[j + 1][i].z - here.z;
                z_squared = std::max(z_squared, x * x + z * z);
                z_across = std::min(z_across, cascade.along * z - cascade.across * x);
            }
        }
    const double norm_squared = (x_squared + z_squared) * cascade.texels_per_m * cascade.texels_per_m;
    const double trace = x_along + z_across;
    const double apart = std::sqrt(std::max(2 * norm_squared - trace * trace, norm_squared));
    return std::max(0.0, std::min((apart - trace) / 2, apart));
}

/// Returns an upper bound of what a cascade adds to the distance of a box's centre and to the
/// distance below which the box is kept.
double remaining_of(const SearchCascade& cascade, double radius) {
    const double largest_m = static_cast<double>(cascade.contraction.largest_m);
    return largest_m + std::min(static_cast<double>(cascade.contraction.stretch) * radius, 2 * largest_m);
}

}  // namespace

SearchCascade::SearchCascade(const Cascade& cascade, Interpolation interpolated)
    : texels(texels_of(cascade)),
      along(cascade.grid.cosine / cascade.texel_m()),
      across(cascade.grid.sine / cascade.texel_m()),
      texels_per_m(1 / cascade.texel_m()),
      interpolation(interpolated),
      contraction(cascade.contraction) {
    if (interpolation == Interpolation::linear) return;
    contraction.largest_m *= static_cast<float>(max_cubic_value);
    // The square root of 2 combines the slopes along two axes.
    contraction.stretch *= static_cast<float>(max_cubic_slope * square_root_of_2);
}

/// Displaced position of an offset's reference point, relative to the query position, metres.
struct StackSearch::Drawn {
    double x, z;
    double x_x = 1, x_z = 0, z_x = 0, z_z = 1;  ///< derivatives along the world's axes

    double distance() const { return length_of(x, z); }
};

/// A square with sides along the world's axes.
struct StackSearch::Box {
    Offset centre;
    double half;

    bool contains(Offset o, double margin) const {
        return std::fabs(o.x - centre.x) <= half * margin && std::fabs(o.z - centre.z) <= half * margin;
    }
};

/// Intersections found so far.
struct StackSearch::Intersections {
    static constexpr std::size_t max_kept = 16;

    void add(const StackSearch& search, const StackPoint& point, Offset offset, double error) {
        if (count < max_kept) kept[count++] = offset;
        const double height = search.height_at(point, offset);
        if (!highest.found || height > highest.height_m) highest = {true, offset, height, error};
    }
    bool has_one_in(const Box& box, double margin) const {
        return std::any_of(kept.begin(), kept.begin() + count, [&](Offset o) { return box.contains(o, margin); });
    }

    std::array<Offset, max_kept> kept;
    std::size_t count = 0;
    StackIntersection highest;
};

StackSearch::Drawn StackSearch::drawn_at(const StackPoint& point, Offset offset) const {
    Drawn drawn{.x = offset.x, .z = offset.z};
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const SearchCascade& cascade = cascades_[t];
        const CellPosition at = position_in(cascade, point, t, offset);
        const CascadeCell cell(cascade.texels, at.i, at.j, cascade.interpolation);
        const auto [dx, dz] = cell.at(CascadeCell::Planar<2>{cascade.texels.dx, cascade.texels.dz}, at.u, at.v);
        const double weight = point.weight[t];
        drawn.x += weight * dx.value;
        drawn.z += weight * dz.value;
        drawn.x_x += weight * (cascade.along * dx.along_u - cascade.across * dx.along_v);
        drawn.x_z += weight * (cascade.across * dx.along_u + cascade.along * dx.along_v);
        drawn.z_x += weight * (cascade.along * dz.along_u - cascade.across * dz.along_v);
        drawn.z_z += weight * (cascade.across * dz.along_u + cascade.along * dz.along_v);
    }
    return drawn;
}

/// Returns the distance of drawn_at(), without derivatives.
double StackSearch::distance_at(const StackPoint& point, Offset offset) const {
    double x = offset.x, z = offset.z;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const Offset moved = displacement_at(cascades_[t], point, t, offset);
        x += point.weight[t] * moved.x;
        z += point.weight[t] * moved.z;
    }
    return length_of(x, z);
}

/// Returns whether a point of a box may be displaced to the query position. Sets the distance of
/// the box's centre if so. Coarse cascades are added first, and a box is discarded as soon as the
/// others cannot bring it back.
bool StackSearch::may_reach(const StackPoint& point, const Box& box, double& distance) const {
    const double radius = box.half * square_root_of_2;
    // Upper bounds of what the remaining cascades add to the distance and to its maximum.
    double remaining = 0;
    for (const SearchCascade& cascade : cascades_) remaining += remaining_of(cascade, radius);
    double x = box.centre.x, z = box.centre.z, max = radius + target_m_;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const SearchCascade& cascade = cascades_[t];
        const Offset moved = displacement_at(cascade, point, t, box.centre);
        const double weight = point.weight[t];
        x += weight * moved.x;
        z += weight * moved.z;
        max += std::min(static_cast<double>(cascade.contraction.stretch) * radius,
                        static_cast<double>(cascade.contraction.largest_m) + weight * length_of(moved.x, moved.z));
        remaining -= remaining_of(cascade, radius);
        distance = length_of(x, z);
        if (t + 1 < cascades_.size() && distance > max + above_rounding * remaining + min_remaining_m) return false;
    }
    return !(distance > max);
}

double StackSearch::height_at(const StackPoint& point, Offset offset) const {
    double height = 0;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const SearchCascade& cascade = cascades_[t];
        const CellPosition at = position_in(cascade, point, t, offset);
        const CascadeCell cell(cascade.texels, at.i, at.j, cascade.interpolation);
        height += point.weight[t] * cell.values_at(CascadeCell::Planar<1>{cascade.texels.height}, at.u, at.v)[0];
    }
    return height;
}

/// Returns an upper bound of a cascade's contraction on a square along its own axes.
/// \param reach  half of the square's side, texels
double StackSearch::contraction_within(const StackPoint& point, std::size_t number, Offset centre,
                                       double reach) const {
    const SearchCascade& cascade = cascades_[number];
    const CellPosition at = position_in(cascade, point, number, centre);
    const int n = cascade.texels.resolution;
    const int first_i = at.i + static_cast<int>(std::floor(at.u - reach));
    const int last_i = at.i + static_cast<int>(std::floor(at.u + reach));
    const int first_j = at.j + static_cast<int>(std::floor(at.v - reach));
    const int last_j = at.j + static_cast<int>(std::floor(at.v + reach));
    if (last_i - first_i <= 1 && last_j - first_j <= 1)
        return contraction_of_cells(cascade, first_i, last_i, first_j, last_j);
    // Choose the finest level at which few blocks cover the square: a coarser one covers more cells
    // beside it.
    constexpr int max_columns = 8, max_rows = 3;
    constexpr int min_shift_z = std::countr_zero(FindContractionJob::block_rows);
    const std::uint8_t* blocks = cascade.contraction.blocks.data();
    int shift_x = 0, shift_z = min_shift_z, columns = n, rows = n >> min_shift_z;
    while (columns > 1 && ((last_i >> shift_x) - (first_i >> shift_x) >= max_columns ||
                           (last_j >> shift_z) - (first_j >> shift_z) >= max_rows)) {
        blocks += columns * rows;
        columns /= 2;
        if (++shift_x > shift_z) {
            rows /= 2;
            ++shift_z;
        }
    }
    std::uint8_t max = columns == 1 ? *blocks : 0;
    for (int j = first_j >> shift_z; columns > 1 && j <= last_j >> shift_z; ++j) {
        const std::uint8_t* const row = blocks + (j & (rows - 1)) * columns;
        for (int i = first_i >> shift_x; i <= last_i >> shift_x; ++i) max = std::max(max, row[i & (columns - 1)]);
    }
    return max == 255 ? 1e9 : static_cast<double>(max) / ContractionBound::one;
}

/// Returns the slack, 1 minus the contraction bounds of the first `cascades` cascades, within a
/// circle or on a square along the world's axes. \param reach_m  radius, or half of the square's
/// side
double StackSearch::slack_within(const StackPoint& point, Offset centre, double reach_m, std::size_t cascades,
                                 bool is_square) const {
    double slack = 1;
    for (std::size_t t = 0; t < cascades && slack > 0; ++t) {
        const SearchCascade& cascade = cascades_[t];
        const double around = cascade.interpolation == Interpolation::cubic ? 1 : 0;
        const double texels =
            reach_m * (is_square ? std::fabs(cascade.along) + std::fabs(cascade.across) : cascade.texels_per_m) +
            around;
        slack -= contraction_within(point, t, centre, texels);
    }
    return slack;
}

/// Returns a box around a known reference point that contains all others, from the bounds r_i of
/// contraction_map.hpp. Its size is 0 if there are no others.
StackSearch::Box StackSearch::around_known(const StackPoint& point, Offset known) const {
    double reference_m = target_m_;
    for (const SearchCascade& cascade : cascades_) reference_m += 2 * cascade.contraction.largest_m;
    double reach_m = reference_m;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const double slack = slack_within(point, known, reach_m, t + 1, false);
        reference_m -= 2 * cascades_[t].contraction.largest_m;
        if (t + 1 == cascades_.size()) {
            if (slack >= ContractionMap::min_slack_of_all) return {known, 0};
        } else if (slack > 0) {
            reach_m = std::min(reach_m, reference_m / slack);
        }
    }
    return {known, reach_m};
}

bool StackSearch::is_only_one(const StackPoint& point, Offset known) const {
    double further_m = target_m_, slack = 1;
    for (const SearchCascade& cascade : cascades_)
        further_m += 2 * static_cast<double>(cascade.contraction.largest_m);
    double reach_m = further_m;
    for (std::size_t t = 0; t < cascades_.size(); ++t) {
        const SearchCascade& cascade = cascades_[t];
        slack -= contraction_within(point, t, known, reach_m * cascade.texels_per_m);
        if (!(slack > 0)) return false;
        further_m -= 2 * static_cast<double>(cascade.contraction.largest_m);
        reach_m = std::min(reach_m, further_m / slack);
    }
    return slack >= ContractionMap::min_slack_of_all;
}

/// Runs Newton's method; returns whether it converges.
bool StackSearch::step_towards(const StackPoint& point, Offset& offset) const {
    Offset best = offset;
    double best_distance = 1e300;
    for (int step = 0; step < max_steps; ++step) {
        const Drawn here = drawn_at(point, offset);
        const double distance = here.distance();
        if (distance < best_distance) best = offset, best_distance = distance;
        if (distance <= exact_m) break;
        const double determinant = here.x_x * here.z_z - here.x_z * here.z_x;
        if (!(determinant > 1e-6 || determinant < -1e-6)) break;
        offset.x -= (here.z_z * here.x - here.x_z * here.z) / determinant;
        offset.z -= (here.x_x * here.z - here.z_x * here.x) / determinant;
        if (!(std::fabs(offset.x) < 1e6 && std::fabs(offset.z) < 1e6)) break;
    }
    offset = best;
    return best_distance <= target_m_ * same;
}

void StackSearch::search_box(const StackPoint& point, const Box& box, Intersections& intersections) const {
    const double small = same_intersection / cascades_.back().texels_per_m;
    const double enough =
        cascades_.front().interpolation == Interpolation::cubic ? min_cubic_slack : min_linear_slack;
    // Each level of the search adds at most three boxes to the stack.
    std::array<Box, 128> waiting;
    std::size_t count = 0;
    waiting[count++] = box;
    while (count > 0) {
        const Box here = waiting[--count];
        double distance = 0;
        if (!may_reach(point, here, distance)) continue;
        const bool is_small = here.half <= small;
        if (is_small ||
            slack_within(point, here.centre, here.half * surroundings, cascades_.size(), true) >= enough) {
            const double near = is_small ? small_surroundings : surroundings;
            if (intersections.has_one_in(here, near)) continue;
            Offset found = here.centre;
            if (step_towards(point, found)) {
                intersections.add(*this, point, found, distance_at(point, found));
                if (here.contains(found, near)) continue;
            }
        }
        if (here.half <= target_m_ || count + 4 > waiting.size()) {
            // At the edge of a fold, where Newton's method does not converge, the centre is the
            // solution.
            if (distance <= target_m_) intersections.add(*this, point, here.centre, distance);
            continue;
        }
        const double half = here.half / 2;
        for (const double x : {-half, half})
            for (const double z : {-half, half}) waiting[count++] = {{here.centre.x + x, here.centre.z + z}, half};
    }
}

StackIntersection StackSearch::highest_intersection(const StackPoint& point, const Offset* known) const {
    Intersections intersections;
    Box box{{}, 0};
    if (known) {
        Offset exact = *known;
        if (step_towards(point, exact)) {
            intersections.add(*this, point, exact, distance_at(point, exact));
            box = around_known(point, exact);
        }
    }
    if (intersections.count == 0)
        for (const SearchCascade& cascade : cascades_) box.half += cascade.contraction.largest_m;
    if (box.half > 0) search_box(point, box, intersections);
    return intersections.highest;
}

}  // namespace pelagic
