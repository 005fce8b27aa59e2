// What frames remember of ticks before them, and yet stay functions of sea and time: a history forgets exactly, so whoever
// begins so many ticks earlier, with nothing, has the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"

namespace pelagic {

class History {
   public:
    virtual ~History() = default;

    /// After so many ticks nothing is left of what was before.
    virtual int warm_up_ticks() const = 0;

    /// Adds the stages of one tick. \param surfaces_done  those that leave the tick's displacement, by cascade
    /// Returns the stages after which the tick is remembered, by cascade.
    virtual std::vector<StageId> add_tick_stages(JobGraph& graph, std::span<const StageId> surfaces_done) = 0;

    /// Nothing is remembered.
    virtual void forget() = 0;
    /// What the next run of the stages adds is one tick later. \pre none is in flight
    virtual void advance() = 0;

    /// What is remembered, as bytes that restore() takes on any machine. \pre `bytes` has saved_bytes()
    virtual std::size_t saved_bytes() const = 0;
    virtual void save(std::span<std::uint8_t> bytes) const = 0;
    virtual void restore(std::span<const std::uint8_t> bytes) = 0;

    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
