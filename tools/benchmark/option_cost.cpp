#include "pelagic/tools/benchmark/option_cost.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "pelagic/examples/boat/boat_mesh.hpp"
#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tools/benchmark/machine.hpp"

namespace pelagic::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double period_s = headset_period_ms / 1000;
/// Frames without timing before each turn: other rows have used the caches.
constexpr int frames_before_a_turn = 2, max_frames_a_turn = 72;
/// Foam has a tick each 14.4 frames.
constexpr int min_frames_a_turn = 15;
constexpr int warm_turns_a_round = 3;
constexpr std::size_t height_count = 1000;

/// What a row times.
enum class CostWork { frame, step, heights, boat };

struct CostRow {
    const char* name;
    CostWork work;
    OceanOptions options;
};

const DynamicWavesOptions grid_of_256 = {.resolution = 256};

std::vector<CostRow> all_cost_rows() {
    return {{"bare", CostWork::frame, {}},
            {"queries", CostWork::frame, {.queries = true}},
            {"velocities drawn", CostWork::frame, {.velocities = Velocities::drawn}},
            {"velocities water", CostWork::frame, {.velocities = Velocities::water}},
            {"depth", CostWork::frame, {.depth = true}},
            {"foam", CostWork::frame, {.foam = true}},
            {"dynamic waves 256", CostWork::frame, {.dynamic_waves = grid_of_256}},
            {"hull", CostWork::step, {.queries = true, .depth = true}},
            {"1,000 heights", CostWork::heights, {.queries = true}},
            {"boat",
             CostWork::boat,
             {.queries = true,
              .velocities = Velocities::water,
              .depth = true,
              .foam = true,
              .dynamic_waves = grid_of_256}}};
}

/// Positions within 200 m, on a spiral.
struct SpiralPositions {
    std::vector<double> x, z;
    SpiralPositions() {
        for (std::size_t i = 0; i < height_count; ++i) {
            const double turn = 2.4 * static_cast<double>(i);
            const double away_m = 200 * std::sqrt(static_cast<double>(i) / height_count);
            x.push_back(away_m * std::cos(turn));
            z.push_back(away_m * std::sin(turn));
        }
    }
};

/// The ocean of a row, and a dinghy if it times one.
class CostedOcean {
   public:
    CostedOcean(const SeaState& sea, Isa isa, CostRow row) : name_(row.name), work_(row.work) {
        row.options.executor = make_serial_executor();
        row.options.isa = isa;
        ocean_ = std::make_unique<Ocean>(sea, row.options);
        if (work_ == CostWork::step || work_ == CostWork::boat) {
            bodies_.emplace(row.options.executor, work_ == CostWork::boat ? &ocean_->dynamic_waves() : nullptr);
            const Hull dinghy(examples::boat_mesh(4, 1.7, 0.8), {.mass_kg = 350, .skeg_m2 = 0.16, .skeg_x_m = -1.6});
            bodies_->add(dinghy, dinghy.at_rest(0, 0));
        }
        height_.resize(height_count);
        frame_ = &ocean_->frame_at(0);
    }

    const std::string& name() const { return name_; }

    /// Returns the mean processor time of some frames in milliseconds.
    double warm_turn(int frames) {
        for (int i = 0; i < frames_before_a_turn; ++i) advance();
        double ms = 0;
        for (int i = 0; i < frames; ++i) ms += advance();
        return ms / frames;
    }

    /// As above, for a frame each headset_period_ms.
    double rhythm_turn(int frames) {
        const Clock::time_point begun = Clock::now();
        double ms = 0;
        for (int i = -frames_before_a_turn; i < frames; ++i) {
            const double frame_ms = advance();
            if (i >= 0) ms += frame_ms;
            const double until_s = period_s * (i + 1 + frames_before_a_turn);
            sleep_until(begun +
                        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(until_s)));
        }
        return ms / frames;
    }

    OptionCost result(std::vector<double> warm_ms, std::vector<double> rhythm_ms) const {
        return {name_, quartiles_of(std::move(warm_ms)), quartiles_of(std::move(rhythm_ms)), ocean_->memory_bytes()};
    }

   private:
    /// Computes the next frame and what belongs to it. Returns the processor time of what the row times.
    double advance() {
        const double begun_s = thread_seconds();
        if (work_ == CostWork::boat) bodies_->press(*frame_, period_s);
        frame_ = &ocean_->frame_at(time_s_ += period_s);
        const double with_frame_s = thread_seconds();
        if (bodies_) bodies_->step(*frame_, period_s);
        if (work_ == CostWork::heights || work_ == CostWork::boat)
            SurfaceQuery(*frame_).sample({positions_.x, positions_.z}, {.height_m = height_});
        const bool counts_frame = work_ == CostWork::frame || work_ == CostWork::boat;
        return 1000 * (thread_seconds() - (counts_frame ? begun_s : with_frame_s));
    }

    std::string name_;
    CostWork work_;
    std::unique_ptr<Ocean> ocean_;
    std::optional<FloatingBodies> bodies_;
    const Frame* frame_ = nullptr;
    double time_s_ = 0;
    SpiralPositions positions_;
    std::vector<float> height_;
};

}  // namespace

std::vector<std::string> cost_rows() {
    std::vector<std::string> names;
    for (const CostRow& row : all_cost_rows()) names.emplace_back(row.name);
    return names;
}

std::vector<OptionCost> measure_option_costs(const CostPlan& plan,
                                             const std::function<void(const std::string&, double)>& progress) {
    const Clock::time_point begun = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
    std::deque<CostedOcean> oceans;  // which cannot be moved
    for (CostRow& row : all_cost_rows()) oceans.emplace_back(plan.sea, plan.isa, std::move(row));
    const double frames = plan.seconds / period_s / static_cast<double>(oceans.size());
    const int frames_a_turn = static_cast<int>(std::clamp<double>(frames, min_frames_a_turn, max_frames_a_turn));
    std::vector<std::vector<double>> warm_ms(oceans.size()), rhythm_ms(oceans.size());
    do {
        for (std::size_t i = 0; i < oceans.size(); ++i) {
            rhythm_ms[i].push_back(oceans[i].rhythm_turn(frames_a_turn));
            progress(oceans[i].name(), std::min(1.0, seconds() / plan.seconds));
        }
        for (int turn = 0; turn < warm_turns_a_round; ++turn)
            for (std::size_t i = 0; i < oceans.size(); ++i) warm_ms[i].push_back(oceans[i].warm_turn(frames_a_turn));
    } while (seconds() < plan.seconds);
    std::vector<OptionCost> costs;
    for (std::size_t i = 0; i < oceans.size(); ++i)
        costs.push_back(oceans[i].result(std::move(warm_ms[i]), std::move(rhythm_ms[i])));
    return costs;
}

}  // namespace pelagic::tools
