// An ocean that computes nothing, for `pelagic info`, which prints its size, stages and threads.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic::tools {

/// An ocean without waves. It has 99 % of the memory of an ocean with waves: the size of statistics
/// by frequency depends on the waves. Its frames must not be computed.
class IdleOcean {
   public:
    /// \param planned  the executor whose name and number of threads the ocean reports
    /// \throws  as Ocean's constructor
    IdleOcean(const Forecast& forecast, std::shared_ptr<Executor> planned, std::optional<Isa> isa);

    const Ocean& ocean() const { return *ocean_; }

   private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    static void* allocate(void* user, std::size_t bytes, std::size_t alignment);

    /// Memory of all buffers, which overlap: their contents have no effect. Pages of separate
    /// buffers would take most of the time of construction.
    std::vector<std::vector<Line>> blocks_;
    std::optional<Ocean> ocean_;
};

}  // namespace pelagic::tools
