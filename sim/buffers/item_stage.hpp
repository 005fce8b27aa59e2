// Stages of a frame whose items are independent of one another.
#pragma once

#include <cstddef>
#include <string>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {

/// What a job's own functions take of the stack, beside the arrays that kernels.hpp states.
inline constexpr std::size_t stack_margin = 64 * 1024;

/// Calls item(i) for each item of a block, in the default floating-point environment.
template <class Item>
JobBody for_each_item(Item item) {
    return [item](std::size_t begin, std::size_t end) {
        const DefaultFloatEnvironment environment;
        for (std::size_t i = begin; i < end; ++i) item(i);
    };
}

/// The name of a stage of one cascade: "evolve+rows" of the coarsest, "evolve+rows c1" of the next.
inline std::string stage_name(const char* stage, std::size_t cascade) {
    return cascade == 0 ? stage : std::string(stage) + " c" + std::to_string(cascade);
}

}  // namespace pelagic
