// Division of an application's points into groups for the kernels, with an array for each output.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

inline constexpr double furthest_analytic_point_m = 1e9;

/// Checks a time. \throws std::invalid_argument  if it is not finite
inline void need_finite_time(double time_s) {
    if (!std::isfinite(time_s))
        throw std::invalid_argument(invalid_value_message("time_s", time_s, "a finite number"));
}

/// Output arrays of the application; an empty one is not written.
template <std::size_t Kinds>
struct OutputArrays {
    std::array<std::span<float>, Kinds> of;

    /// \throws std::invalid_argument  if kernels cannot take the points or arrays
    void check(std::span<const double> x, std::span<const double> z) const {
        if (z.size() != x.size()) throw std::invalid_argument("x and z of the points differ in length");
        for (const std::span<float> array : of)
            if (!array.empty() && array.size() != x.size())
                throw std::invalid_argument("an array differs in length from the points, expected as many or none");
        for (const std::span<const double> along : {x, z})
            for (const double at : along)
                if (!(std::fabs(at) <= furthest_analytic_point_m))
                    throw std::invalid_argument(invalid_value_message("a coordinate", at, "[-1e9, 1e9]"));
    }

    template <class... Spans>
    OutputArrays(Spans... spans) : of{spans...} {}

    /// Returns whether an array in [first, last) is not empty.
    bool has_any(std::size_t first, std::size_t last) const {
        return std::any_of(of.begin() + first, of.begin() + last,
                           [](std::span<float> array) { return !array.empty(); });
    }
};

template <std::size_t Kinds>
struct PointGroup {
    std::size_t first;
    std::size_t count;  ///< including copies of the last point, as padding
    const double *x, *z;
    std::array<float*, Kinds> outputs;  ///< never null
};

/// Calls sample(group) for groups of at most 8 * analytic_group points. Outputs without an array
/// are written to scratch memory on the stack, so that kernels need no branches. The last group's
/// outputs are copied.
/// \param multiple  the kernel's point count is a multiple of it; a divisor of analytic_group
template <std::size_t Kinds, class Sample>
void for_each_group(std::span<const double> x, std::span<const double> z, const OutputArrays<Kinds>& arrays,
                    std::size_t multiple, Sample sample) {
    constexpr std::size_t max = 8 * analytic_group;
    arrays.check(x, z);
    float scratch[Kinds][max];
    for (std::size_t first = 0; first < x.size();) {
        const std::size_t remaining = x.size() - first;
        const std::size_t whole = std::min(remaining / analytic_group * analytic_group, max);
        const bool is_tail = whole == 0;
        double tail_x[analytic_group], tail_z[analytic_group];
        for (std::size_t i = 0; is_tail && i < analytic_group; ++i) {
            tail_x[i] = x[first + std::min(i, remaining - 1)];
            tail_z[i] = z[first + std::min(i, remaining - 1)];
        }
        PointGroup<Kinds> group{first,
                                is_tail ? (remaining + multiple - 1) / multiple * multiple : whole,
                                is_tail ? tail_x : x.data() + first,
                                is_tail ? tail_z : z.data() + first,
                                {}};
        for (std::size_t kind = 0; kind < Kinds; ++kind)
            group.outputs[kind] = is_tail || arrays.of[kind].empty() ? scratch[kind] : arrays.of[kind].data() + first;
        sample(static_cast<const PointGroup<Kinds>&>(group));
        if (is_tail)
            for (std::size_t kind = 0; kind < Kinds; ++kind)
                if (!arrays.of[kind].empty()) std::copy_n(scratch[kind], remaining, arrays.of[kind].data() + first);
        first += is_tail ? remaining : whole;
    }
}

}  // namespace pelagic
