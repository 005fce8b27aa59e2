// Job graphs: named stages, each a parallel loop, and the dependencies between stages.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace pelagic {

/// Processes the items [begin, end) of a stage. Several threads call it at once with disjoint
/// ranges. It should not throw; if it does, the run continues to its end, and complete() throws the
/// first exception.
using JobBody = std::function<void(std::size_t begin, std::size_t end)>;
using StageId = std::size_t;

struct Stage {
    std::string name;                     ///< name in traces, benchmarks and documentation
    std::size_t count = 0;                ///< number of items; a stage without items is allowed
    std::size_t batch = 1;                ///< items per job; at least 1
    std::vector<StageId> waits_for = {};  ///< stages that must be done before this stage starts
    JobBody body;                         ///< called once per block of up to `batch` items
    std::size_t stack_bytes = 0;          ///< stack use of one call of the body; 0: negligible
};

/// Stages in topological order: a stage waits for earlier stages only, so that the graph has no
/// cycles. Block b holds the items [b batch, min((b+1) batch, count)), independent of the number of
/// threads.
class JobGraph {
   public:
    /// Appends a stage and returns its identifier.
    /// \throws std::invalid_argument  if the batch is 0, the body is empty, or `waits_for` holds a
    ///                                stage that has not been added
    StageId add(Stage stage);
    /// Returns the stages in the order of add().
    std::span<const Stage> stages() const { return stages_; }

   private:
    std::vector<Stage> stages_;
};

/// Returns the number of blocks of a stage: ceil(count / batch).
std::size_t block_count(const Stage& stage);

/// Calls the stage's body for block number `block`. If the remaining stack of the calling thread is
/// too small, the body runs on a temporary thread.
/// \throws std::system_error  if that thread cannot be created
/// \throws                    the exception of the body
void run_block(const Stage& stage, std::size_t block);

}  // namespace pelagic
