// A frame's work as data: named stages, each a parallel loop, and which stage waits for which.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pelagic {

/// Does the items [begin, end) of a stage. Called from several threads at once on disjoint ranges. Should not throw; if it
/// does, the run goes on to its end, and complete() throws the first exception.
using JobBody = std::function<void(std::size_t begin, std::size_t end)>;
using StageId = std::size_t;

struct Stage {
    std::string name;                     ///< the same word in code, trace, benchmark and docs
    std::size_t count = 0;                ///< items in the loop; 0 is allowed and does nothing
    std::size_t batch = 1;                ///< items a job; at least 1
    std::vector<StageId> waits_for = {};  ///< stages that must be done before this one starts
    JobBody body;                         ///< called once per block of `batch` items, the last block may be short
    std::size_t stack_bytes = 0;          ///< what one call of the body takes of the stack; 0: next to nothing
};

/// Stages in an order in which each one comes after all that it waits for, so the graph can't have a cycle.
/// Block edges depend on count and batch only, never on the thread count: block b is [b batch, min((b+1) batch, count)).
class JobGraph {
   public:
    /// Throws std::invalid_argument if the batch is 0, the body is empty, or `waits_for` names a stage not added yet.
    StageId add(Stage stage);
    std::span<const Stage> stages() const { return stages_; }

   private:
    std::vector<Stage> stages_;
};

/// Blocks in a stage: ceil(count / batch).
std::size_t block_count(const Stage& stage);

/// Calls the stage's body on its block number `block`: here, or on a thread of its own if too little is left of this
/// thread's stack. Throws what the body throws, and std::system_error if there is no such thread to be had.
void run_block(const Stage& stage, std::size_t block);

}  // namespace pelagic
