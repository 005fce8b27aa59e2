// `pelagic bench`: frame times on this machine.

#include <CLI/App.hpp>
#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/tools/benchmark/bench_table.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/benchmark/machine.hpp"
#include "pelagic/tools/benchmark/memory_levels.hpp"
#include "pelagic/tools/benchmark/option_cost.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/record/sea_json.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* seconds_range = "[0.1, 3600]";

std::vector<int> sizes_from(const std::string& text) {
    std::vector<int> sizes;
    for (const std::string& size : split_at_commas(text)) {
        const auto n = parse_integer(size);
        if (!n || *n < 16 || *n > 2048 || !std::has_single_bit(static_cast<unsigned>(*n)))
            throw bad_value("--sizes", text, "powers of two from 16 to 2048 with commas, such as 64,256");
        sizes.push_back(static_cast<int>(*n));
    }
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

/// Returns an object with the keys of bench/results, and additional keys.
Json frame_timing_as_json(const FrameTiming& frame, const FrameTiming& on_one_thread) {
    Json json = {{"cascades", frame.cascades},
                 {"n", frame.resolution},
                 {"isa", name_of(frame.isa)},
                 {"threads", frame.threads},
                 {"textures_only", !frame.planes},
                 {"ours_ms", frame.ms.median},
                 {"ours_ms_quartiles", {frame.ms.low, frame.ms.high}},
                 {"speedup", on_one_thread.ms.median / frame.ms.median},
                 {"gb_per_s", frame.gb_per_s},
                 {"memory_bytes", frame.memory_bytes},
                 {"upload_bytes", frame.upload_bytes}};
    if (frame.threads > 1) return json;
    if (frame.instructions) json["instructions_per_texel"] = *frame.instructions;
    json["jobs"] = Json::array();
    for (const JobTiming& job : frame.jobs) {
        Json row = {{"job", job.job},
                    {"ms", job.ms.median},
                    {"ms_quartiles", {job.ms.low, job.ms.high}},
                    {"gb_per_s", job.gb_per_s}};
        if (job.instructions) row["instructions_per_texel"] = *job.instructions;
        json["jobs"].push_back(row);
    }
    return json;
}

Json timings_as_json(const Timings& timings) {
    Json rows = Json::array();
    const FrameTiming* on_one_thread = nullptr;
    for (const FrameTiming& frame : timings.frames) {
        if (frame.threads == 1) on_one_thread = &frame;
        rows.push_back(frame_timing_as_json(frame, *on_one_thread));
    }
    Json json = {{"version", PELAGIC_VERSION}, {"cpu", cpu_name()}, {"compiler", compiler_name()}};
    if (!timings.no_counter.empty()) json["no_instruction_counter"] = timings.no_counter;
    json["rows"] = rows;
    return json;
}

/// Returns the timings, with the memory levels and the bytes that each row's frame moves there.
Json timings_as_json(const Timings& timings, const std::vector<MemoryLevel>& levels,
                     const std::vector<CountedBytes>& counts) {
    Json json = timings_as_json(timings);
    json["memory_levels"] = Json::array();
    for (const MemoryLevel& level : levels)
        json["memory_levels"].push_back(
            {{"level", level.name}, {"bytes", level.bytes}, {"copy_gb_per_s", level.copy_gb_per_s}});
    for (std::size_t i = 0; i < timings.frames.size(); ++i) {
        json["rows"][i]["moved"] = Json::array();
        for (const MovedBytes& moved : moved_bytes(timings.frames[i], levels, counts))
            json["rows"][i]["moved"].push_back(
                {{"level", moved.level->name}, {"bytes", moved.bytes}, {"ms", moved.ms}, {"share", moved.share}});
    }
    return json;
}

Json costs_as_json(const CostPlan& plan, const std::vector<OptionCost>& costs) {
    Json rows = Json::array();
    for (const OptionCost& cost : costs)
        rows.push_back({{"option", cost.name},
                        {"warm_ms", cost.warm_ms.median},
                        {"warm_ms_quartiles", {cost.warm_ms.low, cost.warm_ms.high}},
                        {"rhythm_ms", cost.rhythm_ms.median},
                        {"rhythm_ms_quartiles", {cost.rhythm_ms.low, cost.rhythm_ms.high}},
                        {"warm_ratio", cost.warm_ms.median / costs.front().warm_ms.median},
                        {"rhythm_ratio", cost.rhythm_ms.median / costs.front().rhythm_ms.median},
                        {"memory_bytes", cost.memory_bytes}});
    return {{"version", PELAGIC_VERSION}, {"cpu", cpu_name()},         {"compiler", compiler_name()},
            {"isa", name_of(plan.isa)},   {"period_ms", headset_period_ms}, {"rows", rows}};
}

class BenchCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Measures frame times and prints tables or writes JSON. Throws InputError and FileError.
    void run() override;

   private:
    TimingPlan resolve() const;
    CostPlan resolve_cost() const;
    /// Measures the cost of options. Throws InputError and FileError.
    void run_cost();

    std::optional<std::string> sizes_, seconds_, json_, bytes_;
    bool headset_ = false, textures_only_ = false, cost_ = false;
    ComputeFlags compute_;
};

void BenchCommand::add_options(CLI::App& app) {
    app.option_defaults()->group(help_group::input);
    app.add_option("--sizes", sizes_,
                   "resolutions of seas with one cascade (default: 64,128,256,512,1024 and the default sea)")
        ->type_name("N,N");
    app.add_option("--seconds", seconds_, std::string("measuring time; ") + seconds_range + " (default: 30)")
        ->type_name("SECONDS");
    app.add_flag("--headset", headset_, "measure seas for a headset on 1, 2 and 3 threads; excludes --sizes");
    app.add_flag("--cost", cost_,
                 "measure processor time and memory of the default sea by option, on one thread; excludes the other "
                 "options of what is measured");
    app.add_option("--bytes", bytes_,
                   "measure the copy speed of each cache, beside the bytes that a frame moves there by the counts of "
                   "this file; excludes --headset")
        ->type_name("FILE.json");
    app.add_flag("--textures-only", textures_only_,
                 "measure frames with textures and without displacement as floats; excludes --bytes");
    app.add_option("--json", json_, "write the statistics as JSON; -: print them instead of the tables")
        ->type_name("FILE.json")
        ->group(help_group::output);
    compute_.add_to(app);
}

TimingPlan BenchCommand::resolve() const {
    const ComputeOptions compute = compute_.resolve();
    const int max_threads = make_default_executor(compute.threads)->thread_limit();
    TimingPlan plan;
    if (seconds_) plan.seconds = number_in("--seconds", *seconds_, 0.1, 3600, seconds_range);
    plan.planes = !textures_only_;
    if (textures_only_ && bytes_) throw InputError("--textures-only cannot be combined with --bytes");
    plan.isas = compute_.names_isa() ? std::vector{*compute.isa} : isas_here();
    if (headset_) {
        if (bytes_) throw InputError("--bytes cannot be combined with --headset");
        if (sizes_) throw InputError("--sizes is given, but --headset has seas of its own: leave out one of them");
        plan.seas = headset_seas();
        plan.isas = {plan.isas.back()};
        plan.threads.resize(static_cast<std::size_t>(std::min(max_threads, max_headset_threads)));
        std::iota(plan.threads.begin(), plan.threads.end(), 1);
        return plan;
    }
    if (!sizes_) plan.seas.emplace_back();
    for (const int n : sizes_ ? sizes_from(*sizes_) : std::vector{64, 128, 256, 512, 1024})
        plan.seas.push_back({.resolution = n, .patch_size_m = 250});
    if (bytes_)
        plan.isas = {plan.isas.back()};
    else
        plan.threads = thread_counts(max_threads);
    return plan;
}

CostPlan BenchCommand::resolve_cost() const {
    if (headset_) throw InputError("--headset cannot be combined with --cost");
    if (sizes_) throw InputError("--sizes cannot be combined with --cost");
    if (bytes_) throw InputError("--bytes cannot be combined with --cost");
    if (textures_only_) throw InputError("--textures-only cannot be combined with --cost");
    const ComputeOptions compute = compute_.resolve();
    if (compute.threads > 1) throw InputError("--threads cannot be combined with --cost, which measures one thread");
    CostPlan plan{.isa = compute_.names_isa() ? *compute.isa : isas_here().back()};
    if (seconds_) plan.seconds = number_in("--seconds", *seconds_, 0.1, 3600, seconds_range);
    return plan;
}

void BenchCommand::run_cost() {
    const CostPlan plan = resolve_cost();
    const bool prints_json = json_ == "-";
    const std::optional<OutputFile> file = prints_json ? std::nullopt : file_for("--json", json_);
    std::vector<OptionCost> costs;
    {
        Progress progress;
        costs = measure_option_costs(
            plan, [&](const std::string& row, double fraction) { progress.show(row, fraction); });
    }
    if (prints_json || file) {
        const std::string text = costs_as_json(plan, costs).dump(2) + "\n";
        if (file) file->write(text);
        if (prints_json) {
            std::printf("%s", text.c_str());
            return;
        }
    }
    print_option_costs("the default sea, 4x128", plan.isa, costs);
}

void BenchCommand::run() {
    if (cost_) return run_cost();
    const TimingPlan plan = resolve();
    const bool prints_json = json_ == "-";
    const std::optional<OutputFile> file = prints_json ? std::nullopt : file_for("--json", json_);
    const std::vector<CountedBytes> counts =
        bytes_ ? read_counted_bytes("--bytes", *bytes_) : std::vector<CountedBytes>();
    std::vector<MemoryLevel> levels;
    Timings timings;
    {
        Progress progress;
        if (bytes_) {
            levels = measure_memory_levels();
            if (levels.empty())
                throw InputError("--bytes needs the sizes of caches, which this system does not report");
        }
        timings = time_frames(
            plan, [&](const std::string& sea, double fraction) { progress.show("sea " + sea, fraction); });
    }
    if (prints_json || file) {
        const std::string text =
            (bytes_ ? timings_as_json(timings, levels, counts) : timings_as_json(timings)).dump(2) + "\n";
        if (file) file->write(text);
        if (prints_json) {
            std::printf("%s", text.c_str());
            return;
        }
    }
    if (bytes_) return print_moved_bytes(timings, levels, counts);
    headset_ ? print_headset_timings(timings) : print_timings(timings);
}

}  // namespace

std::unique_ptr<Command> make_bench_command() { return std::make_unique<BenchCommand>(); }

}  // namespace pelagic::tools
