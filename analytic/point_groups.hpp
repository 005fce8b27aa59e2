// Points of an application cut into what kernels take: whole groups, and a room for every answer.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"

namespace pelagic {

inline constexpr double furthest_analytic_point_m = 1e9;

/// The application's arrays, empty where he wants none.
template <std::size_t Kinds>
struct AnswerArrays {
    std::array<std::span<float>, Kinds> of;

    template <class... Spans>
    AnswerArrays(Spans... spans) : of{spans...} {}

    bool wants_any(std::size_t first, std::size_t last) const {
        return std::any_of(of.begin() + first, of.begin() + last,
                           [](std::span<float> array) { return !array.empty(); });
    }
};

template <std::size_t Kinds>
struct PointGroup {
    std::size_t first;
    std::size_t count;  ///< past the application's points there are copies of his last
    const double *x, *z;
    std::array<float*, Kinds> answers;  ///< never null
};

/// Calls sample(group) for groups of at most `most` points, and hands out what they answer. Answers that nobody wants
/// go to an array on the stack, so that kernels needn't ask.
/// \param multiple  of what the kernel takes, a part of analytic_group: a single point shall not cost sixteen
template <std::size_t Kinds, class Sample>
void for_each_group(std::span<const double> x, std::span<const double> z, const AnswerArrays<Kinds>& arrays,
                    std::size_t multiple, Sample sample) {
    constexpr std::size_t max = 8 * analytic_group;
    assert(x.size() == z.size());
    float room[Kinds][max];
    for (std::size_t first = 0; first < x.size();) {
        const std::size_t left = x.size() - first;
        const std::size_t whole = std::min(left / analytic_group * analytic_group, max);
        const bool is_tail = whole == 0;
        double tail_x[analytic_group], tail_z[analytic_group];
        for (std::size_t i = 0; is_tail && i < analytic_group; ++i) {
            tail_x[i] = x[first + std::min(i, left - 1)];
            tail_z[i] = z[first + std::min(i, left - 1)];
        }
        PointGroup<Kinds> group{first,
                                is_tail ? (left + multiple - 1) / multiple * multiple : whole,
                                is_tail ? tail_x : x.data() + first,
                                is_tail ? tail_z : z.data() + first,
                                {}};
        assert(std::all_of(group.x, group.x + group.count,
                           [](double at) { return std::fabs(at) <= furthest_analytic_point_m; }));
        assert(std::all_of(group.z, group.z + group.count,
                           [](double at) { return std::fabs(at) <= furthest_analytic_point_m; }));
        for (std::size_t kind = 0; kind < Kinds; ++kind) {
            assert(arrays.of[kind].empty() || arrays.of[kind].size() == x.size());
            group.answers[kind] = is_tail || arrays.of[kind].empty() ? room[kind] : arrays.of[kind].data() + first;
        }
        sample(static_cast<const PointGroup<Kinds>&>(group));
        if (is_tail)
            for (std::size_t kind = 0; kind < Kinds; ++kind)
                if (!arrays.of[kind].empty()) std::copy_n(room[kind], left, arrays.of[kind].data() + first);
        first += is_tail ? left : whole;
    }
}

}  // namespace pelagic
