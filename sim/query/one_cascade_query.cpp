// There are two methods for reference points. Nearly everywhere a position has one reference point
// (fold_map.hpp), and a SIMD kernel finds it iteratively. Where the surface may intersect itself,
// and where the iteration did not converge, scalar code searches all cells that can be displaced to
// the position, in double precision. Linear cells are solved in closed form, cubic cells by
// Newton's method. The fold map is that of the linear surface, so intersections in a fold that only
// the cubic surface has may be missed. They are close together.
#include "pelagic/sim/query/one_cascade_query.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/query/cascade_cell.hpp"

namespace pelagic {
namespace {

// Bounds of the search's target, texels. Floats resolve positions some texels away to 1e-6. Above
// the upper bound, a false reference point might be accepted outside the fold map's margin.
constexpr double min_cascade_target = 4e-6, max_cascade_target = 1.0 / 64;
static_assert(max_cascade_target < FoldMap::margin);

// Upper bound of Newton's steps in a cubic cell, and the residual at which they stop, as a fraction
// of the search's target.
constexpr int max_cubic_steps = 16;
constexpr double same_cubic = 1.0 / 64;

// Tolerance at cell edges, texels, so that rounding does not exclude a point on an edge from both
// cells.
constexpr double edge_tolerance = 1e-7;

struct Vector {
    double x, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.z - b.z}; }
    friend Vector operator*(double f, Vector a) { return {f * a.x, f * a.z}; }
};
double cross(Vector a, Vector b) { return a.x * b.z - a.z * b.x; }
double dot(Vector a, Vector b) { return a.x * b.x + a.z * b.z; }

/// Calls take(u, v) for each solution of a + b u + c v + d u v = 0 in the unit square. The cross
/// product with c + d u, the derivative along v, gives a quadratic equation for u.
template <class Take>
void solve_cell(Vector a, Vector b, Vector c, Vector d, Take take) {
    const double square = cross(b, d), linear = cross(a, d) + cross(b, c), constant = cross(a, c);
    const double discriminant = linear * linear - 4 * square * constant;
    if (!(discriminant >= 0)) return;
    const double root = std::sqrt(discriminant);
    const double larger = -0.5 * (linear < 0 ? linear - root : linear + root);
    const auto take_if_inside = [&](double u) {
        const Vector along = c + u * d;
        const double v = -dot(a + u * b, along) / dot(along, along);
        // False for 0 / 0.
        const auto is_inside = [](double t) { return t >= -edge_tolerance && t <= 1 + edge_tolerance; };
        if (is_inside(u) && is_inside(v)) take(std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0));
    };
    take_if_inside(constant / larger);
    if (root > 0) take_if_inside(larger / square);
}

}  // namespace

struct OneCascadeQuery::Intersection {
    bool found = false;
    int cell_x = 0, cell_z = 0;
    float u = 0, v = 0;
    double height = 0;
    float error = 0;  ///< texels
};

OneCascadeQuery::OneCascadeQuery(const Frame& frame, const Kernels& kernels, const SurfaceQueryOptions& options)
    : kernels_(kernels),
      cascade_(frame.cascades.front()),
      foam_(frame),
      interpolation_(options.interpolation),
      texel_m_(cascade_.texel_m()),
      target_(static_cast<float>(
          std::clamp(options.tolerance_m * query_aim / texel_m_, min_cascade_target, max_cascade_target))) {}

void OneCascadeQuery::locate_points(PointChunk& chunk) const {
    kernels_.split_positions({.x = chunk.x,
                              .z = chunk.z,
                              .texel_m = texel_m_,
                              .along = 0,
                              .across = 0,
                              .resolution = cascade_.resolution(),
                              .count = chunk.padded,
                              .out = chunk.world[0].positions()});
}

void OneCascadeQuery::find_reference_points(PointChunk& chunk) const {
    PointChunk::World& world = chunk.world[0];
    const bool is_cubic = interpolation_ == Interpolation::cubic;
    const InvertSurfaceJob job{.surface = texels_of(cascade_),
                               .texels_per_m = static_cast<float>(1 / texel_m_),
                               .target = target_,
                               .count = chunk.padded,
                               .world = world.positions(),
                               .rest = chunk.rest.positions(),
                               .error = chunk.error};
    kernels_.invert_surface.linear(job);
    if (is_cubic) kernels_.invert_surface.cubic(job);

    const std::uint8_t* folds = cascade_.folds.data();
    const int resolution = cascade_.resolution();
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const auto square = static_cast<unsigned>(world.cell_z[i] * resolution + world.cell_x[i]);
        const bool may_be_overturned = (folds[square / 8] >> square % 8 & 1) != 0;
        if (chunk.error[i] <= target_ && !may_be_overturned) continue;
        const Intersection intersection =
            is_cubic ? highest_cubic_intersection(world.cell_x[i], world.u[i], world.cell_z[i], world.v[i])
                     : highest_intersection(world.cell_x[i], world.u[i], world.cell_z[i], world.v[i]);
        if (!intersection.found) continue;  // keep the iteration's result and error
        chunk.rest.cell_x[i] = intersection.cell_x;
        chunk.rest.cell_z[i] = intersection.cell_z;
        chunk.rest.u[i] = intersection.u;
        chunk.rest.v[i] = intersection.v;
        chunk.error[i] = intersection.error;
    }
    for (std::size_t i = 0; i < chunk.count; ++i) chunk.error[i] *= static_cast<float>(texel_m_);
}

void OneCascadeQuery::read(const SampleSurfaceJob::Outputs& outputs, PointChunk& chunk) const {
    const auto& kernel = kernels_.sample_surface;
    (interpolation_ == Interpolation::cubic ? kernel.cubic : kernel.linear)(
        {.surface = texels_of(cascade_),
         .two_texels_m = static_cast<float>(2 * texel_m_),
         .jacobian_factor = static_cast<float>(1 / (4 * texel_m_ * texel_m_)),
         .count = chunk.padded,
         .rest = chunk.rest.positions(),
         .out = outputs});
}

ReferenceCell OneCascadeQuery::reference_cell(std::size_t, const PointChunk& chunk, std::size_t point) const {
    const PointChunk::World& rest = chunk.rest;
    return {rest.cell_x[point], rest.cell_z[point], rest.u[point], rest.v[point]};
}

void OneCascadeQuery::read_foam(const PointChunk& chunk, std::span<float> foam) const {
    const PointChunk::World& rest = chunk.rest;
    for (std::size_t i = 0; i < foam.size(); ++i)
        foam[i] = foam_.at((rest.cell_x[i] + static_cast<double>(rest.u[i])) * texel_m_,
                           (rest.cell_z[i] + static_cast<double>(rest.v[i])) * texel_m_);
}

// Searches the cells within the largest displacement of the position: no others can be displaced to
// it.
OneCascadeQuery::Intersection OneCascadeQuery::highest_intersection(int cell_x, double u, int cell_z,
                                                                    double v) const {
    const SurfaceTexels surface = texels_of(cascade_);
    const double texels_per_m = 1 / texel_m_;
    const double reach_x = cascade_.bounds.horizontal_x_max_m * texels_per_m + edge_tolerance;
    const double reach_z = cascade_.bounds.horizontal_z_max_m * texels_per_m + edge_tolerance;
    const auto first_x = static_cast<int>(floor_of(u - reach_x)), last_x = static_cast<int>(floor_of(u + reach_x));
    const auto first_z = static_cast<int>(floor_of(v - reach_z)), last_z = static_cast<int>(floor_of(v + reach_z));

    /// Returns a texel's displaced position relative to the query position, in texels.
    const auto corner = [&](int i, int j) {
        const std::ptrdiff_t offset = texel_offset(surface, cell_x + i, cell_z + j);
        return Vector{i - u + surface.dx[offset] * texels_per_m, j - v + surface.dz[offset] * texels_per_m};
    };
    const auto height_at = [&](int i, int j, double along_x, double along_z) {
        const auto texel = [&](int a, int b) {
            return static_cast<double>(surface.height[texel_offset(surface, cell_x + i + a, cell_z + j + b)]);
        };
        const double low = texel(0, 0) + along_x * (texel(1, 0) - texel(0, 0));
        const double high = texel(0, 1) + along_x * (texel(1, 1) - texel(0, 1));
        return low + along_z * (high - low);
    };

    Intersection highest;
    for (int j = first_z; j <= last_z; ++j) {
        Vector v00 = corner(first_x, j), v01 = corner(first_x, j + 1);
        for (int i = first_x; i <= last_x; ++i) {
            const Vector v10 = corner(i + 1, j), v11 = corner(i + 1, j + 1);
            const auto straddles = [](double a, double b, double c, double d) {
                return std::min(std::min(a, b), std::min(c, d)) <= edge_tolerance &&
                       std::max(std::max(a, b), std::max(c, d)) >= -edge_tolerance;
            };
            if (straddles(v00.x, v10.x, v01.x, v11.x) && straddles(v00.z, v10.z, v01.z, v11.z)) {
                const Vector b = v10 - v00, c = v01 - v00, d = (v11 - v01) - b;
                solve_cell(v00, b, c, d, [&](double along_x, double along_z) {
                    const double height = height_at(i, j, along_x, along_z);
                    if (highest.found && height <= highest.height) return;
                    highest = {true, i, j, static_cast<float>(along_x), static_cast<float>(along_z), height};
                });
            }
            v00 = v10;
            v01 = v11;
        }
    }
    if (highest.found) {
        const int i = highest.cell_x, j = highest.cell_z;
        const Vector v00 = corner(i, j), b = corner(i + 1, j) - v00, c = corner(i, j + 1) - v00;
        const double along_x = highest.u, along_z = highest.v;
        const Vector off =
            v00 + along_x * b + along_z * c + along_x * along_z * ((corner(i + 1, j + 1) - corner(i, j + 1)) - b);
        highest.error = static_cast<float>(std::sqrt(dot(off, off)));
        highest.cell_x += cell_x;
        highest.cell_z += cell_z;
    }
    return highest;
}

// In each cell, Newton's method starts at the centres of its four quarters. A solution in the cell
// is a reference point.
OneCascadeQuery::Intersection OneCascadeQuery::highest_cubic_intersection(int cell_x, double u, int cell_z,
                                                                          double v) const {
    const SurfaceTexels surface = texels_of(cascade_);
    const double texels_per_m = 1 / texel_m_;
    const double reach_x = cascade_.bounds.horizontal_x_max_m * max_cubic_value * texels_per_m + edge_tolerance;
    const double reach_z = cascade_.bounds.horizontal_z_max_m * max_cubic_value * texels_per_m + edge_tolerance;
    const auto first_x = static_cast<int>(floor_of(u - reach_x)), last_x = static_cast<int>(floor_of(u + reach_x));
    const auto first_z = static_cast<int>(floor_of(v - reach_z)), last_z = static_cast<int>(floor_of(v + reach_z));
    const double enough = target_ * same_cubic;

    Intersection highest;
    double error = 0;
    const auto search_cell = [&](int i, int j, const CascadeCell& cell, double along_x, double along_z) {
        /// Displaced position relative to the query position, in texels, and its derivatives.
        Vector off{}, along_u{}, along_v{};
        const auto evaluate = [&] {
            const CascadeCell::Value dx = cell.at(surface.dx, along_x, along_z),
                                     dz = cell.at(surface.dz, along_x, along_z);
            off = {i + along_x - u + dx.value * texels_per_m, j + along_z - v + dz.value * texels_per_m};
            along_u = {1 + dx.along_u * texels_per_m, dz.along_u * texels_per_m};
            along_v = {dx.along_v * texels_per_m, 1 + dz.along_v * texels_per_m};
        };
        evaluate();
        for (int step = 0; step < max_cubic_steps && !(dot(off, off) <= enough * enough); ++step) {
            const double determinant = cross(along_u, along_v);
            if (determinant == 0) return;
            along_x -= cross(off, along_v) / determinant;
            along_z -= cross(along_u, off) / determinant;
            const auto is_near = [](double t) { return t > -1 && t < 2; };  // false for NaN
            if (!is_near(along_x) || !is_near(along_z)) return;
            evaluate();
        }
        const auto is_inside = [](double t) { return t >= -edge_tolerance && t <= 1 + edge_tolerance; };
        if (!(dot(off, off) <= target_ * target_) || !is_inside(along_x) || !is_inside(along_z)) return;
        const double height = cell.at(surface.height, along_x, along_z).value;
        if (highest.found && height <= highest.height) return;
        highest = {true,
                   cell_x + i,
                   cell_z + j,
                   static_cast<float>(std::clamp(along_x, 0.0, 1.0)),
                   static_cast<float>(std::clamp(along_z, 0.0, 1.0)),
                   height};
        error = std::sqrt(dot(off, off));
    };
    for (int j = first_z; j <= last_z; ++j)
        for (int i = first_x; i <= last_x; ++i) {
            const CascadeCell cell(surface, cell_x + i, cell_z + j, Interpolation::cubic);
            const auto may_reach = [&](const float* plane, double from) {
                const auto [min, max] = cell.range(plane);
                return from + min * texels_per_m <= edge_tolerance &&
                       from + 1 + max * texels_per_m >= -edge_tolerance;
            };
            if (!may_reach(surface.dx, i - u) || !may_reach(surface.dz, j - v)) continue;
            for (const double along_x : {0.25, 0.75})
                for (const double along_z : {0.25, 0.75}) search_cell(i, j, cell, along_x, along_z);
        }
    highest.error = static_cast<float>(error);
    return highest;
}

}  // namespace pelagic
