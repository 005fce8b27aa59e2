#include "pelagic/jobs/job_graph.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "pelagic/jobs/stack_room.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

StageId JobGraph::add(Stage stage) {
    const StageId id = stages_.size();
    const auto reject = [&](const std::string& what) {
        throw std::invalid_argument(one_line("stage " + stage.name + what));
    };
    if (stage.batch == 0) reject(" has a batch of 0, expected at least 1");
    if (!stage.body) reject(" has no body");
    for (const StageId earlier : stage.waits_for)
        if (earlier >= id)
            reject(" waits for stage number " + number_text(earlier) + ", expected one of the " + number_text(id) +
                   " added before it");
    stages_.push_back(std::move(stage));
    return id;
}

std::size_t block_count(const Stage& stage) {
    // (count + batch - 1) / batch would overflow for the largest batch, which means one block.
    return stage.count / stage.batch + (stage.count % stage.batch != 0);
}

void run_block(const Stage& stage, std::size_t block) {
    const std::size_t begin = block * stage.batch;
    const std::size_t end = begin + std::min(stage.batch, stage.count - begin);
    if (stack_holds(stage.stack_bytes)) return stage.body(begin, end);
    run_on_a_stack_of(stage.stack_bytes, [&] { stage.body(begin, end); });
}

}  // namespace pelagic
