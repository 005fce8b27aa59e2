// Two ways to a rest point. Nearly everywhere it is the only one (fold_map.hpp), and a kernel steps towards it, W points
// at a time. Where the surface may lie over itself, and where the steps did not arrive, all cells that could be drawn
// at the point are looked at, in double and in closed form; that is plain code, compiled once.
#include "pelagic/sim/surface_query.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/surface/fold_map.hpp"
#include "pelagic/sim/surface/surface_texels.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// Points that go through the kernels at once. Their arrays, 8 KB on the stack, stay in the first cache.
constexpr std::size_t chunk_points = 128;

constexpr double aim = 1.0 / 64;  // of the tolerance

// Texels. Float tells places some texels away to 1e-6; beyond the most, a false rest point might be taken for a true
// one outside of the fold map's margin.
constexpr double least_target = 4e-6, most_target = 1.0 / 64;
static_assert(most_target < FoldMap::margin);

constexpr double most_texels = 0x1p50;

// A point on the edge between cells must not fall between them by rounding. In texels.
constexpr double edge = 1e-7;

std::int64_t floor_of(double x) {
    const auto cut = static_cast<std::int64_t>(x);
    return cut - (static_cast<double>(cut) > x);
}

struct Vector {
    double x, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.z - b.z}; }
    friend Vector operator*(double f, Vector a) { return {f * a.x, f * a.z}; }
};
double cross(Vector a, Vector b) { return a.x * b.z - a.z * b.x; }
double dot(Vector a, Vector b) { return a.x * b.x + a.z * b.z; }

/// Calls take(u, v) with each place in the unit square where a + b u + c v + d u v = 0. The cross product with c + d u,
/// along which v moves, leaves a quadratic equation for u.
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
        const auto is_inside = [](double t) { return t >= -edge && t <= 1 + edge; };  // false for 0 / 0
        if (is_inside(u) && is_inside(v)) take(std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0));
    };
    take_if_inside(constant / larger);
    if (root > 0) take_if_inside(larger / square);
}

}  // namespace

struct SurfaceQuery::Chunk {
    using Floats = float[chunk_points];
    using Cells = std::int32_t[chunk_points];

    alignas(64) Cells world_x, world_z, rest_x, rest_z;
    alignas(64) Floats world_u, world_v, rest_u, rest_v, error;
    alignas(64) Floats height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z;
    bool is_somewhere[chunk_points];

    std::size_t first = 0, count = 0;  ///< of the batch
    std::size_t padded = 0;            ///< count, up to whole registers

    CellPlaces rest() { return {rest_x, rest_z, rest_u, rest_v}; }
};

struct SurfaceQuery::Sheet {
    bool found = false;
    int cell_x = 0, cell_z = 0;
    float u = 0, v = 0;
    double height = 0;
    float error = 0;  ///< texels
};

SurfaceQuery::SurfaceQuery(const Frame& frame, double tolerance_m)
    : kernels_(&kernels_for(frame.isa)), frame_(frame), tile_(&frame.tiles.front()) {
    assert(tolerance_m > 0);
    if (frame.tiles.front().folds.empty())
        throw std::invalid_argument("the frame can't be queried, needs an ocean with OceanOptions::queries");
    const DefaultFloatEnvironment environment;
    texel_m_ = frame.tiles.front().texel_m();
    tolerance_m_ = static_cast<float>(tolerance_m);
    target_ = static_cast<float>(std::clamp(tolerance_m * aim / texel_m_, least_target, most_target));
}

void SurfaceQuery::sample(const SurfacePoints& points, const SurfaceSamples& samples) const {
    const std::size_t count = points.x.size();
    [[maybe_unused]] const auto fits = [count](const auto& span) { return span.empty() || span.size() == count; };
    assert(points.z.size() == count && fits(samples.height_m) && fits(samples.normal_x) && fits(samples.normal_y) &&
           fits(samples.normal_z) && fits(samples.jacobian) && fits(samples.velocity_x_mps) &&
           fits(samples.velocity_y_mps) && fits(samples.velocity_z_mps) && fits(samples.error_m) &&
           fits(samples.converged));
    const bool wants_velocity =
        !samples.velocity_x_mps.empty() || !samples.velocity_y_mps.empty() || !samples.velocity_z_mps.empty();
    if (wants_velocity && !has_velocities())
        throw std::invalid_argument("the frame has no velocities, needs an ocean with OceanOptions::velocities");

    const DefaultFloatEnvironment environment;
    Chunk chunk;
    for (std::size_t first = 0; first < count; first += chunk_points) {
        chunk.first = first;
        chunk.count = std::min(chunk_points, count - first);
        chunk.padded = (chunk.count + kernels_->lanes - 1) / kernels_->lanes * kernels_->lanes;
        place_points(points, chunk);
        find_rest_points(chunk);
        read_surface(samples, chunk);
        hand_out(samples, chunk);
    }
}

/// Each point becomes a cell of the patch and a place in it.
void SurfaceQuery::place_points(const SurfacePoints& points, Chunk& chunk) const {
    const std::int64_t last = tile_->resolution() - 1;
    for (std::size_t i = 0; i < chunk.padded; ++i) {
        double x = i < chunk.count ? points.x[chunk.first + i] / texel_m_ : 0;
        double z = i < chunk.count ? points.z[chunk.first + i] / texel_m_ : 0;
        chunk.is_somewhere[i] = x >= -most_texels && x <= most_texels && z >= -most_texels && z <= most_texels;
        if (!chunk.is_somewhere[i]) x = z = 0;
        const std::int64_t cell_x = floor_of(x), cell_z = floor_of(z);
        chunk.world_x[i] = static_cast<std::int32_t>(cell_x & last);
        chunk.world_z[i] = static_cast<std::int32_t>(cell_z & last);
        chunk.world_u[i] = static_cast<float>(x - static_cast<double>(cell_x));
        chunk.world_v[i] = static_cast<float>(z - static_cast<double>(cell_z));
    }
}

void SurfaceQuery::find_rest_points(Chunk& chunk) const {
    kernels_->invert_surface({.surface = texels_of(*tile_),
                              .texels_per_m = static_cast<float>(1 / texel_m_),
                              .target = target_,
                              .count = chunk.padded,
                              .world = {chunk.world_x, chunk.world_z, chunk.world_u, chunk.world_v},
                              .rest = chunk.rest(),
                              .error = chunk.error});

    for (std::size_t i = 0; i < chunk.count; ++i) {
        if (chunk.error[i] <= target_ && !may_be_folded(chunk.world_x[i], chunk.world_z[i])) continue;
        const Sheet sheet = highest_sheet(chunk.world_x[i], chunk.world_u[i], chunk.world_z[i], chunk.world_v[i]);
        if (!sheet.found) continue;  // the error says how good the steps' end is
        chunk.rest_x[i] = sheet.cell_x;
        chunk.rest_z[i] = sheet.cell_z;
        chunk.rest_u[i] = sheet.u;
        chunk.rest_v[i] = sheet.v;
        chunk.error[i] = sheet.error;
    }
}

/// Reads the frame at the rest points, and no more of it than is wanted.
void SurfaceQuery::read_surface(const SurfaceSamples& samples, Chunk& chunk) const {
    const bool wants_normal = !samples.normal_x.empty() || !samples.normal_y.empty() || !samples.normal_z.empty() ||
                              !samples.jacobian.empty();
    const bool wants_velocity =
        !samples.velocity_x_mps.empty() || !samples.velocity_y_mps.empty() || !samples.velocity_z_mps.empty();
    SampleSurfaceJob job{.surface = texels_of(*tile_),
                         .two_texels_m = static_cast<float>(2 * texel_m_),
                         .jacobian_factor = static_cast<float>(1 / (4 * texel_m_ * texel_m_)),
                         .count = chunk.padded,
                         .rest = chunk.rest(),
                         .out = {}};
    if (wants_normal || !samples.height_m.empty()) job.out.height = chunk.height;
    if (wants_normal) {
        job.out.normal_x = chunk.normal_x;
        job.out.normal_y = chunk.normal_y;
        job.out.normal_z = chunk.normal_z;
        job.out.jacobian = chunk.jacobian;
    }
    if (wants_velocity) {
        job.out.velocity_x = chunk.velocity_x;
        job.out.velocity_y = chunk.velocity_y;
        job.out.velocity_z = chunk.velocity_z;
    }
    kernels_->sample_surface(job);
}

void SurfaceQuery::hand_out(const SurfaceSamples& samples, const Chunk& chunk) const {
    const auto copy = [&](std::span<float> to, const float* from) {
        if (!to.empty()) std::memcpy(to.data() + chunk.first, from, chunk.count * sizeof(float));
    };
    copy(samples.height_m, chunk.height);
    copy(samples.normal_x, chunk.normal_x);
    copy(samples.normal_y, chunk.normal_y);
    copy(samples.normal_z, chunk.normal_z);
    copy(samples.jacobian, chunk.jacobian);
    copy(samples.velocity_x_mps, chunk.velocity_x);
    copy(samples.velocity_y_mps, chunk.velocity_y);
    copy(samples.velocity_z_mps, chunk.velocity_z);
    if (samples.error_m.empty() && samples.converged.empty()) return;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const float error_m = chunk.is_somewhere[i] ? chunk.error[i] * static_cast<float>(texel_m_)
                                                    : std::numeric_limits<float>::infinity();
        if (!samples.error_m.empty()) samples.error_m[chunk.first + i] = error_m;
        if (!samples.converged.empty()) samples.converged[chunk.first + i] = error_m <= tolerance_m_;
    }
}

bool SurfaceQuery::may_be_folded(int cell_x, int cell_z) const {
    const auto square = static_cast<std::size_t>(cell_z * tile_->resolution() + cell_x);
    return tile_->folds[square / 8] >> square % 8 & 1;
}

// A cell (i, j) can be drawn at the point only if it rests within the largest displacement of it.
SurfaceQuery::Sheet SurfaceQuery::highest_sheet(int cell_x, double u, int cell_z, double v) const {
    const SurfaceTexels surface = texels_of(*tile_);
    const double texels_per_m = 1 / texel_m_;
    const double reach_x = tile_->bounds.sideways_x_max_m * texels_per_m + edge;
    const double reach_z = tile_->bounds.sideways_z_max_m * texels_per_m + edge;
    const auto first_x = static_cast<int>(floor_of(u - reach_x)), last_x = static_cast<int>(floor_of(u + reach_x));
    const auto first_z = static_cast<int>(floor_of(v - reach_z)), last_z = static_cast<int>(floor_of(v + reach_z));

    /// A texel as drawn, from the point that is asked about, in texels.
    const auto corner = [&](int i, int j) {
        const std::ptrdiff_t place = place_of(surface, cell_x + i, cell_z + j);
        return Vector{i - u + surface.dx[place] * texels_per_m, j - v + surface.dz[place] * texels_per_m};
    };
    const auto height_at = [&](int i, int j, double along_x, double along_z) {
        const auto texel = [&](int a, int b) {
            return static_cast<double>(surface.height[place_of(surface, cell_x + i + a, cell_z + j + b)]);
        };
        const double low = texel(0, 0) + along_x * (texel(1, 0) - texel(0, 0));
        const double high = texel(0, 1) + along_x * (texel(1, 1) - texel(0, 1));
        return low + along_z * (high - low);
    };

    Sheet highest;
    for (int j = first_z; j <= last_z; ++j) {
        Vector v00 = corner(first_x, j), v01 = corner(first_x, j + 1);
        for (int i = first_x; i <= last_x; ++i) {
            const Vector v10 = corner(i + 1, j), v11 = corner(i + 1, j + 1);
            const auto straddles = [](double a, double b, double c, double d) {
                return std::min(std::min(a, b), std::min(c, d)) <= edge &&
                       std::max(std::max(a, b), std::max(c, d)) >= -edge;
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

}  // namespace pelagic
