#include "pelagic/jobs/job_graph.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pelagic/jobs/stack_room.hpp"

namespace pelagic {

StageId JobGraph::add(Stage stage) {
    const StageId id = stages_.size();
    if (stage.batch == 0) throw std::invalid_argument("stage " + stage.name + " has a batch of 0, needs at least 1");
    if (!stage.body) throw std::invalid_argument("stage " + stage.name + " has no body");
    for (const StageId earlier : stage.waits_for)
        if (earlier >= id)
            throw std::invalid_argument("stage " + stage.name + " waits for stage number " + std::to_string(earlier) +
                                        ", needs one of the " + std::to_string(id) + " added before it");
    stages_.push_back(std::move(stage));
    return id;
}

std::size_t block_count(const Stage& stage) {
    // Not (count + batch - 1) / batch: the sum wraps for a batch that means "all in one block".
    return stage.count / stage.batch + (stage.count % stage.batch != 0);
}

void run_block(const Stage& stage, std::size_t block) {
    const std::size_t begin = block * stage.batch;
    const std::size_t end = begin + std::min(stage.batch, stage.count - begin);
    if (stack_holds(stage.stack_bytes)) return stage.body(begin, end);
    run_on_a_stack_of(stage.stack_bytes, [&] { stage.body(begin, end); });
}

}  // namespace pelagic
