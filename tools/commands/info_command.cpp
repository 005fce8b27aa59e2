// `pelagic info`: prints sea-state statistics, or measures an export.

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"
#include "pelagic/tools/record/sea_json.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/path_text.hpp"
#if defined(PELAGIC_HAS_IMAGES)
#include "pelagic/tools/measure/measure_report.hpp"
#endif

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

/// An ocean without waves. It has 99 % of the memory of an ocean with waves: the size of statistics
/// by frequency depends on the waves. Its frames must not be computed.
class IdleOcean {
   public:
    /// \param planned  the executor whose name and number of threads the ocean reports
    /// \throws  as Ocean's constructor
    IdleOcean(const Forecast& forecast, std::shared_ptr<Executor> planned, std::optional<Isa> isa) {
        const auto release = [](void*, void*, std::size_t, std::size_t) {};
        ocean_.emplace(forecast, OceanOptions{.executor = std::make_shared<IdleExecutor>(std::move(planned)),
                                              .isa = isa,
                                              .memory = {this, allocate, release}});
    }

    const Ocean& ocean() const { return *ocean_; }

   private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    static void* allocate(void* user, std::size_t bytes, std::size_t /*alignment*/) {
        const std::size_t lines = (bytes + sizeof(Line) - 1) / sizeof(Line);
        std::vector<std::vector<Line>>& blocks = static_cast<IdleOcean*>(user)->blocks_;
        const auto found =
            std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.size() >= lines; });
        return found != blocks.end() ? found->data() : blocks.emplace_back(lines).data();
    }

    /// Memory of all buffers, which overlap: their contents have no effect. Pages of separate
    /// buffers would take most of the time of construction.
    std::vector<std::vector<Line>> blocks_;
    std::optional<Ocean> ocean_;
};

/// Starts computing a report on another thread if --threads allows one, beside the construction of
/// the ocean, which takes about as long.
/// \param report_of  report_on or expected_report_on
std::future<SeaReport> begin_report(SeaReport (*report_of)(const SeaState&), const SeaState& sea,
                                    const ComputeOptions& compute) {
    const auto report = [report_of, sea] { return report_of(sea); };
    try {
        if (compute.threads != 1) return std::async(std::launch::async, report);
    } catch (const std::system_error&) {  // the system cannot start a thread
    }
    return std::async(std::launch::deferred, report);
}

Json computing_as_json(const Ocean& ocean) {
    Json stages = Json::array();
    for (const Stage& stage : ocean.graph().stages())
        stages.push_back({{"name", stage.name}, {"count", stage.count}, {"batch", stage.batch}});
    Json isas = Json::array();
    for (const Isa isa : isas_here()) isas.push_back(name_of(isa));
    return {{"isa", name_of(ocean.isa())},          {"isas_here", isas},
            {"executor", ocean.executor().name()},  {"threads", ocean.executor().thread_limit()},
            {"memory_bytes", ocean.memory_bytes()}, {"stages", stages}};
}

/// Returns the options and waves of a sea, before the results of computing it.
Json head_as_json(const ResolvedSea& resolved, const SeaReport& report, std::optional<double> measured_height_m) {
    Json json = {{"version", PELAGIC_VERSION}, {"sea", sea_as_json(resolved)}};
    if (!resolved.preset.empty()) json["preset"] = resolved.preset;
    if (!resolved.changes.empty()) json["weather"] = weather_as_json(resolved);
    json["waves"] = waves_as_json(resolved.sea, report, measured_height_m);
    json["repeats_after_m"] = repeats_after_m(resolved);
    return json;
}

/// Returns all statistics, with those of the seed's waves and of the first frame.
Json measured_info(const ResolvedSea& resolved, const ComputeOptions& compute) {
    std::future<SeaReport> begun = begin_report(report_on, resolved.sea, compute);
    Ocean ocean(forecast_of(resolved), {.executor = make_default_executor(compute.threads), .isa = compute.isa});
    const Frame& frame = ocean.frame_at(0);
    const SeaReport report = begun.get();
    Json json = head_as_json(resolved, report, measured_significant_wave_height_m(frame));
    json["foam"] = foam_as_json(frame);
    json["first_frame"] = {{"hash", hex_text(hash_of(frame))},
                           {"height_min_m", frame.bounds.height_min_m},
                           {"height_max_m", frame.bounds.height_max_m},
                           {"horizontal_x_max_m", frame.bounds.horizontal_x_max_m},
                           {"horizontal_z_max_m", frame.bounds.horizontal_z_max_m}};
    json["warnings"] = warnings_of(resolved, report);
    json["computing"] = computing_as_json(ocean);
    return json;
}

/// Returns the statistics that need neither realised waves nor a frame. Those of measured_info()
/// that do are null.
Json expected_info(const ResolvedSea& resolved, const ComputeOptions& compute) {
    std::future<SeaReport> begun = begin_report(expected_report_on, resolved.sea, compute);
    const IdleOcean idle(forecast_of(resolved), make_default_executor(compute.threads), compute.isa);
    const Ocean& ocean = idle.ocean();
    const SeaReport report = begun.get();
    Json json = head_as_json(resolved, report, std::nullopt);
    json["foam"] = nullptr;
    json["first_frame"] = nullptr;
    json["warnings"] = warnings_of(resolved, report);
    json["computing"] = computing_as_json(ocean);
    // the memory of an ocean without waves is valid to two digits
    json["computing"]["memory_bytes"] =
        static_cast<std::uint64_t>(std::stod(rounded_text(static_cast<double>(ocean.memory_bytes()), 2)));
    return json;
}

/// Smallest absolute value that is printed; smaller ones are rounding errors of 0.
constexpr double min_shown = 1e-9;

/// Formats a value for the table. --json prints all digits.
/// \param digits  significant digits: 4 for computed values, 6 for options
std::string printed_value(const Json& value, int digits) {
    if (value.is_null()) return "not measured";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.dump();
    const double number = value.get<double>();
    if (!std::isfinite(number)) return "none";  // for example the period of a sea without waves
    return std::fabs(number) < min_shown ? "0" : rounded_text(number, digits);
}

/// Rounds directions to 0.01 degrees.
Json shown(const std::string& key, const Json& value) {
    if (!key.ends_with("_deg") || !value.is_number_float()) return value;
    return std::floor(value.get<double>() * 100 + 0.5) / 100;
}

void print_section(const char* title, const Json& values, int digits = 4) {
    std::printf("%s\n", title);
    for (const auto& [key, value] : values.items()) {
        if (value.is_object() && !value.empty()) {
            std::string parts;
            for (const auto& [name, part] : value.items())
                parts += (parts.empty() ? "" : ", ") +
                         (part.is_null() ? "not " + name : name + " " + printed_value(shown(key, part), digits));
            std::printf("  %-26s  %s\n", key.c_str(), parts.c_str());
        } else {
            std::printf("  %-26s  %s\n", key.c_str(), printed_value(shown(key, value), digits).c_str());
        }
    }
}

/// Returns the options that have an effect in a wave system.
Json system_for_people(Json system) {
    const bool is_by_height = system.at("height_m") > 0 || system.at("peak_period_s") > 0;
    for (const char* of_wind : {"wind_speed_mps", "fetch_m"})
        if (is_by_height) system.erase(of_wind);
    for (const char* key : {"height_m", "peak_period_s", "spread_deg"})
        if (system.at(key) == 0) system.erase(key);
    if (system.contains("spread_deg")) system.erase("spreading");
    return system;
}

/// Returns the options that have an effect in this sea, without values that select an automatic
/// value.
Json sea_for_people(const Json& sea) {
    const SeaState state{.waves = *value_named<WaveModel>(sea.at("waves").get<std::string>()),
                         .spectrum = *value_named<SpectrumModel>(sea.at("spectrum").get<std::string>()),
                         .spreading = *value_named<SpreadingModel>(sea.at("spreading").get<std::string>()),
                         .peak_period_s = sea.at("peak_period_s"),
                         .swell_height_m = sea.at("swell_height_m"),
                         .wave_height_m = sea.at("wave_height_m")};
    const auto counts = [&](const std::string& key) {
        if (!requirement_of(key, state).empty()) return false;
        if (key == "swell_height_m" || key == "patch_size_m" || key == "wave_count" || key == "wave_height_m" ||
            key == "peak_period_s" || key.ends_with("est_wave_m"))
            return sea.at(key) > 0;
        return key != "depth_m" || state.waves == WaveModel::spectrum || state.waves == WaveModel::regular;
    };
    Json rows = Json::object();
    for (const auto& [key, value] : sea.items())
        if (key == "systems")
            for (std::size_t i = 0; i < value.size(); ++i)
                rows["system " + number_text(i + 1)] = system_for_people(value[i]);
        else if (counts(key))
            rows[key] = (key == "roughness" || key == "lean") && value < 0 ? Json("from the wind") : value;
    return rows;
}

/// Returns the waves section of the table: steps of scales as "6, strong breeze", and a row for
/// each cascade's slopes.
Json waves_for_people(const Json& waves, bool has_spectrum) {
    Json rows = Json::object();
    for (const auto& [key, value] : waves.items()) {
        if (key == "loop_frequencies" && !has_spectrum) continue;
        if (key == "wind_sea" || key == "swell") {
            for (const auto& [figure, both] : value.items()) rows[key + ", " + figure] = both;
        } else if (key == "systems") {
            for (std::size_t i = 0; i < value.size(); ++i)
                for (const auto& [figure, both] : value[i].items())
                    rows["system " + number_text(i + 1) + ", " + figure] = both;
        } else if (value.is_object() && value.contains("number")) {
            rows[key] = value.at("number").dump() + ", " + value.at("name").get<std::string>();
        } else if (key == "slope_variance") {
            for (Json cascade : value.at("cascades")) {
                const std::string side = rounded_text(cascade.at("side_m").get<double>(), 4);
                cascade.erase("side_m");
                cascade.erase("resolution");
                rows[key + ", " + side + " m"] = cascade;
            }
            if (value.at("cascades").size() > 1) rows[key + ", all"] = value.at("all");
            rows["  of Cox and Munk"] = value.at("cox_and_munk");
        } else {
            rows[key] = value;
        }
    }
    return rows;
}

/// Returns the foam section of the table, with a row for each cascade's drift.
Json foam_for_people(Json foam) {
    const Json cascades = foam.at("cascades");
    foam.erase("cascades");
    for (const Json& cascade : cascades) {
        const std::string row = "drift of " + rounded_text(cascade.at("side_m").get<double>(), 4) + " m";
        if (cascade.at("makes_whitecaps").get<bool>())
            foam[row] = {{"columns_per_loop", cascade.at("columns_per_loop")},
                         {"rows_per_loop", cascade.at("rows_per_loop")},
                         {"drift_mps", cascade.at("drift_mps")}};
        else
            foam[row] = "makes no whitecaps";
    }
    return foam;
}

/// Prints a summary of five lines.
void print_sea_summary(const Json& json) {
    const Json &sea = json.at("sea"), &waves = json.at("waves"), &computing = json.at("computing");
    const auto number = [](const Json& value) { return printed_value(value, 3); };
    const auto row = [](const char* name, const std::string& text) { std::printf("%-10s%s\n", name, text.c_str()); };
    const auto step = [](const Json& of) { return of.at("number").dump() + ", " + of.at("name").get<std::string>(); };
    const std::string preset = json.value("preset", ""), model = sea.at("waves");
    const std::string waves_of = model == "spectrum" ? sea.at("spectrum").get<std::string>() : model;
    const Json& height = waves.at("significant_wave_height_m");
    const std::size_t cascades = waves.at("slope_variance").at("cascades").size();
    row("Sea", (preset.empty() ? "" : "preset " + preset + ", ") +
                   (waves_of == "none" ? "no wind sea" : waves_of) + ", wind " +
                   number(sea.at("wind_speed_mps")) + " m/s towards " + number(sea.at("wind_direction_deg")) +
                   " degrees (Beaufort " + step(waves.at("beaufort")) + ")");
    const Json& measured = height.at("measured");
    row("Waves", "Hs " + number(height.at("expected")) + " m expected" +
                     (measured.is_null() ? "" : ", " + number(measured) + " m in this seed's first frame") +
                     " (sea state " + step(waves.at("sea_state")) + ")");
    row("Periods", "peak " +
                       peak_period_text(waves.at("peak_period_s").at("expected").get<double>(),
                                        sea.at("loop_period_s").get<double>(), 3) +
                       " (" +
                       number(waves.at("peak_wavelength_m")) + " m), Tm01 " +
                       number(waves.at("tm01_s").at("expected")) + " s, Tm02 and zero crossings " +
                       number(waves.at("tm02_s").at("expected")) + " s");
    const std::string loop = "after " + number_text(sea.at("loop_period_s").get<double>()) + " s and after " +
                             rounded_text(json.at("repeats_after_m").get<double>(), 6) + " m";
    row("Repeats", cascades == 1 ? loop
                                 : loop + ", the side of the coarsest of " + number_text(cascades) +
                                       " cascades: its long waves, not the finer ones");
    row("Computes", computing.at("isa").get<std::string>() + ", executor " +
                        computing.at("executor").get<std::string>() + " with " + computing.at("threads").dump() +
                        " threads, " + number(computing.at("memory_bytes").get<double>() / 1e6) + " MB");
}

void print_sea_table(const Json& json) {
    print_sea_summary(json);
    const bool has_spectrum = json.at("sea").at("waves") == "spectrum";
    print_section("\nSea", sea_for_people(json.at("sea")), 6);
    print_section("Waves", waves_for_people(json.at("waves"), has_spectrum));
    const Json &foam = json.at("foam"), &first_frame = json.at("first_frame");
    if (!foam.is_null() && foam.at("whitecap_cover") > 0) print_section("Foam accumulation", foam_for_people(foam));
    if (!first_frame.is_null()) print_section("Frame at 0 s", first_frame);
    Json computing = json.at("computing");
    std::string stages;
    for (const Json& stage : computing.at("stages")) {
        const auto name = stage.at("name").get<std::string>();
        // stages of finer cascades repeat those of the coarsest
        if (job_of(name) != name) continue;
        stages += (stages.empty() ? "" : " -> ") + name;
    }
    computing["stages"] = stages;
    print_section("Computing", computing);
    const double fetch_m = json.at("sea").at("fetch_m"),
                 counts_m = json.at("waves").value("effective_fetch_m", fetch_m);
    if (counts_m < fetch_m)
        std::printf(
            "note: this wind's sea is fully developed after %s m of fetch (g F / U^2 = 17000): more adds nothing\n",
            rounded_text(counts_m, 3).c_str());
    for (const Json& warning : json.at("warnings")) std::printf("note: %s\n", warning.get<std::string>().c_str());
    if (first_frame.is_null())
        std::printf(
            "note: memory is rounded, and foam and the frame at 0 s were not measured; --measured prints them\n");
}

class InfoCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Prints the resolved options, heights and periods, stages, memory and computing resources, as
    /// a table or with --json as JSON. The table lacks measured values without --measured. With
    /// --measure it prints the measured waves of an export instead. Throws InputError and
    /// FileError.
    void run() override;

   private:
    void measure() const;

    std::optional<std::string> measure_, svg_;
    SeaOptions sea_;
    ComputeFlags compute_;
    bool json_ = false, measured_ = false;
};

void InfoCommand::add_options(CLI::App& app) {
    app.option_defaults()->group(help_group::output);
    app.add_flag("--json", json_, "print JSON, with measured values");
    app.add_flag("--measured", measured_, "also measure the waves of this seed, foam and the frame at 0 s");
    app.add_option("--measure", measure_, "print waves measured in an export, beside those expected")
        ->type_name("DIR");
    app.add_option("--svg", svg_, "with --measure: plot both spectra, measured and expected")->type_name("FILE.svg");
    sea_.add_to(app, SeaOptions::PresetName::positional_too);
    sea_.add_weather_to(app);
    compute_.add_to(app);
    app.footer(SeaOptions::description_of_presets());
}

void InfoCommand::run() {
    if (measure_) return measure();
    if (svg_) throw InputError("--svg is " + *svg_ + "; it requires --measure DIR");
    const ResolvedSea sea = sea_.resolve();
    const ComputeOptions compute = compute_.resolve();
    const Json json = json_ || measured_ ? measured_info(sea, compute) : expected_info(sea, compute);
    if (json_)
        std::printf("%s\n", json.dump(2).c_str());
    else
        print_sea_table(json);
}

void InfoCommand::measure() const {
    if (measured_) throw InputError("--measured cannot be combined with --measure, which measures an export");
    if (sea_.is_given())
        throw InputError("--measure is " + *measure_ +
                         "; no sea option is accepted beside it, the export's sea.json has the sea");
    if (svg_ && svg_->empty()) throw InputError("--svg is empty, expected a file to write to");
    std::optional<OutputFile> svg;
    if (svg_) svg.emplace(path_of(*svg_));  // opened before measuring
#if defined(PELAGIC_HAS_IMAGES)
    const Json json = measure_export(path_of(*measure_));
    if (svg) svg->write(measurement_as_svg(json));
    if (json_)
        std::printf("%s\n", json.dump(2).c_str());
    else
        print_measurement(json);
#else
    throw InputError("--measure is not in this build: configure with -DPELAGIC_IMAGES=ON");
#endif
}

}  // namespace

std::unique_ptr<Command> make_info_command() { return std::make_unique<InfoCommand>(); }

}  // namespace pelagic::tools
