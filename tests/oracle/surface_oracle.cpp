#include "pelagic/tests/oracle/surface_oracle.hpp"

#include <algorithm>
#include <cmath>

namespace pelagic::oracle {
namespace {

// In units of a cell: smaller squares are searched with Newton's method.
constexpr double smallest_square_cells = 1.0 / 16;

}  // namespace

Surface::Surface(const Frame& frame, double patch_size_m)
    : n_(frame.cascades[0].resolution()), texel_m_(patch_size_m / n_), planes_(displacement_of(frame)) {
    const Plane* const planes[3] = {&planes_.dx, &planes_.height, &planes_.dz};
    const auto at = [this](const Plane& plane, int i, int j) {
        return plane[static_cast<std::size_t>((j + n_) % n_ * n_ + (i + n_) % n_)];
    };
    for (int j = 0; j < n_; ++j) {
        for (int i = 0; i < n_; ++i) {
            for (int p = 0; p < 3; ++p) {
                slopes_[p].push_back((at(*planes[p], i + 1, j) - at(*planes[p], i - 1, j)) / (2 * texel_m_));
                slopes_[p + 3].push_back((at(*planes[p], i, j + 1) - at(*planes[p], i, j - 1)) / (2 * texel_m_));
            }
        }
    }

    // Assigns each cell to every square of the world that overlaps its displaced bounding box:
    // counts first, then fills.
    const std::size_t squares = static_cast<std::size_t>(n_) * n_;
    std::vector<std::size_t> counts(squares);
    for (const bool fill : {false, true}) {
        for (int j = 0; j < n_; ++j) {
            for (int i = 0; i < n_; ++i) {
                double low_x = 1e300, high_x = -1e300, low_z = 1e300, high_z = -1e300;
                for (int corner = 0; corner < 4; ++corner) {
                    const Corner c = drawn({i, j}, corner % 2, corner / 2);
                    low_x = std::min(low_x, c.x), high_x = std::max(high_x, c.x);
                    low_z = std::min(low_z, c.z), high_z = std::max(high_z, c.z);
                }
                for (double z = std::floor(low_z - 1e-6); z <= high_z + 1e-6; ++z) {
                    for (double x = std::floor(low_x - 1e-6); x <= high_x + 1e-6; ++x) {
                        const int patch_x = static_cast<int>(std::floor(x / n_)) * n_;
                        const int patch_z = static_cast<int>(std::floor(z / n_)) * n_;
                        const std::size_t square = static_cast<std::size_t>((static_cast<int>(z) - patch_z) * n_ +
                                                                            static_cast<int>(x) - patch_x);
                        if (fill) candidates_[first_[square] + counts[square]] = {i - patch_x, j - patch_z};
                        ++counts[square];
                    }
                }
            }
        }
        if (fill) break;
        first_.push_back(0);
        for (const std::size_t count : counts) first_.push_back(first_.back() + count);
        candidates_.resize(first_.back());
        std::fill(counts.begin(), counts.end(), 0);
    }
}

double Surface::value_at(const Plane& plane, const ReferencePoint& rest) const {
    const auto at = [&](int i, int j) {
        return plane[static_cast<std::size_t>(((j % n_ + n_) % n_) * n_ + (i % n_ + n_) % n_)];
    };
    const auto [i, j, u, v] = rest;
    return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) + v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

SurfaceFacts Surface::facts_at(const ReferencePoint& rest) const {
    const double dx_x = value_at(slopes_[0], rest), h_x = value_at(slopes_[1], rest),
                 dz_x = value_at(slopes_[2], rest);
    const double dx_z = value_at(slopes_[3], rest), h_z = value_at(slopes_[4], rest),
                 dz_z = value_at(slopes_[5], rest);
    // Tangents (1 + dx_x, h_x, dz_x) and (dx_z, h_z, 1 + dz_z); the cross product of the second and
    // the first points up.
    const double x = h_z * dz_x - (1 + dz_z) * h_x;
    const double y = (1 + dz_z) * (1 + dx_x) - dx_z * dz_x;
    const double z = dx_z * h_x - h_z * (1 + dx_x);
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length, y};
}

Surface::Corner Surface::drawn(const Candidate& cell, double u, double v) const {
    const ReferencePoint rest{cell.i, cell.j, u, v};
    return {cell.i + u + value_at(planes_.dx, rest) / texel_m_, cell.j + v + value_at(planes_.dz, rest) / texel_m_};
}

std::vector<Intersection> Surface::intersections_at(double x_m, double z_m) const {
    double x = x_m / texel_m_, z = z_m / texel_m_;
    x -= std::floor(x / n_) * n_;
    z -= std::floor(z / n_) * n_;
    const std::size_t square = static_cast<std::size_t>(static_cast<int>(z) % n_ * n_ + static_cast<int>(x) % n_);
    std::vector<Intersection> intersections;
    for (std::size_t c = first_[square]; c < first_[square + 1]; ++c)
        search(candidates_[c], {x, z}, 0, 0, 1, intersections);
    std::sort(intersections.begin(), intersections.end(),
              [](const Intersection& a, const Intersection& b) { return a.height > b.height; });
    return intersections;
}

// Searches the square of a cell from (u, v) to (u + size, v + size). A bilinear patch has its
// extremes at its corners.
void Surface::search(const Candidate& cell, Corner point, double u, double v, double size,
                     std::vector<Intersection>& intersections) const {
    const Corner a = drawn(cell, u, v), b = drawn(cell, u + size, v), c = drawn(cell, u, v + size),
                 d = drawn(cell, u + size, v + size);
    const auto apart = [](double p, std::initializer_list<double> values) {
        return p < std::min(values) - 1e-9 || p > std::max(values) + 1e-9;
    };
    if (apart(point.x, {a.x, b.x, c.x, d.x}) || apart(point.z, {a.z, b.z, c.z, d.z})) return;
    if (size <= smallest_square_cells) return refine(cell, point, u + size / 2, v + size / 2, intersections);
    for (int quarter = 0; quarter < 4; ++quarter)
        search(cell, point, u + quarter % 2 * size / 2, v + quarter / 2 * size / 2, size / 2, intersections);
}

// Newton's method with a numeric derivative, exact for a bilinear patch.
void Surface::refine(const Candidate& cell, Corner point, double u, double v,
                     std::vector<Intersection>& intersections) const {
    for (int step = 0; step < 40; ++step) {
        const Corner here = drawn(cell, u, v);
        const double off_x = here.x - point.x, off_z = here.z - point.z;
        if (std::hypot(off_x, off_z) < 1e-11) break;
        const Corner left = drawn(cell, 0, v), right = drawn(cell, 1, v), low = drawn(cell, u, 0),
                     high = drawn(cell, u, 1);
        const double xu = right.x - left.x, zu = right.z - left.z, xv = high.x - low.x, zv = high.z - low.z;
        const double determinant = xu * zv - xv * zu;
        if (determinant == 0) return;
        u -= (zv * off_x - xv * off_z) / determinant;
        v -= (xu * off_z - zu * off_x) / determinant;
        if (!(std::fabs(u) < 10 && std::fabs(v) < 10)) return;
    }
    const Corner here = drawn(cell, u, v);
    if (std::hypot(here.x - point.x, here.z - point.z) > 1e-9) return;
    const auto is_inside = [](double t) { return t >= -1e-9 && t <= 1 + 1e-9; };
    if (!is_inside(u) || !is_inside(v)) return;
    const ReferencePoint rest{cell.i, cell.j, u, v};
    // already found from the neighbouring square or cell
    for (const Intersection& intersection : intersections)
        if (std::fabs(intersection.rest.i + intersection.rest.u - cell.i - u) < 1e-6 &&
            std::fabs(intersection.rest.j + intersection.rest.v - cell.j - v) < 1e-6)
            return;
    intersections.push_back({rest, value_at(planes_.height, rest)});
}

}  // namespace pelagic::oracle
