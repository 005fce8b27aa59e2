#include "pelagic/tools/commands/idle_ocean.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace pelagic::tools {
namespace {

/// Executor that runs no job.
class IdleExecutor final : public Executor {
   public:
    /// \param planned  the executor whose name and number of threads are reported
    explicit IdleExecutor(std::shared_ptr<Executor> planned) : planned_(std::move(planned)) {}

    std::unique_ptr<GraphRun> prepare(const JobGraph&) override { return std::make_unique<IdleRun>(); }
    int thread_limit() const override { return planned_->thread_limit(); }
    std::string_view name() const override { return planned_->name(); }

   private:
    struct IdleRun final : GraphRun {
        void schedule() override {}
        void complete() override {}
        bool is_done() const override { return true; }
    };
    std::shared_ptr<Executor> planned_;
};

}  // namespace

IdleOcean::IdleOcean(const Forecast& forecast, std::shared_ptr<Executor> planned, std::optional<Isa> isa) {
    const auto release = [](void*, void*, std::size_t, std::size_t) {};
    ocean_.emplace(forecast, OceanOptions{.executor = std::make_shared<IdleExecutor>(std::move(planned)),
                                          .isa = isa,
                                          .memory = {this, allocate, release}});
}

void* IdleOcean::allocate(void* user, std::size_t bytes, std::size_t /*alignment*/) {
    const std::size_t lines = (bytes + sizeof(Line) - 1) / sizeof(Line);
    std::vector<std::vector<Line>>& blocks = static_cast<IdleOcean*>(user)->blocks_;
    const auto found =
        std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.size() >= lines; });
    return found != blocks.end() ? found->data() : blocks.emplace_back(lines).data();
}

}  // namespace pelagic::tools
