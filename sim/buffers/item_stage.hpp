// Helpers for stages of a frame whose items are independent of one another.
#pragma once

#include <cstddef>
#include <string>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {

/// Stack bytes of a job's functions, in addition to the arrays that kernels.hpp documents.
inline constexpr std::size_t stack_margin = 64 * 1024;

/// Returns a job body that calls item(i) for each item of a block, in the default floating-point
/// environment.
template <class Item>
JobBody for_each_item(Item item) {
    return [item](std::size_t begin, std::size_t end) {
        const DefaultFloatEnvironment environment;
        for (std::size_t i = begin; i < end; ++i) item(i);
    };
}

/// Returns the name of a stage of a cascade: "evolve+rows" for the coarsest, "evolve+rows c1" for
/// the next.
inline std::string stage_name(const char* stage, std::size_t cascade) {
    return cascade == 0 ? stage : std::string(stage) + " c" + std::to_string(cascade);
}

}  // namespace pelagic
