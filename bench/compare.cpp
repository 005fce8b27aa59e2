// Comparison of Pelagic with its peers in one process: equal sea and outputs. The contestants take
// turns, so that other load on the machine affects them equally.
//
//   pelagic-compare [--quick] [--json FILE] [--sizes 64,256] [--isa avx2]
//
// Without --json, a complete run is written to bench/results/<cpu>.json; a partial run (--quick,
// --sizes, --isa) is only printed.
//
// valgrind counts instructions per texel (i/t) of one frame in a separate process, if valgrind and
// Python are installed.
//
// A turn is some frames of each contestant. Results are medians and quartiles over the turns.
// FFTW's result is the better of two arrangements. Rows with several threads compare Pelagic on its
// default executor with the peers on one thread, and with Pelagic called directly on one thread.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/bench/counted_frames.hpp"
#include "pelagic/bench/peers/fftw_frame.hpp"
#include "pelagic/bench/peers/paper_frame.hpp"
#include "pelagic/bench/pinned_to_one_core.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/benchmark/machine.hpp"

namespace pelagic {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
    std::vector<int> sizes;
    std::vector<Isa> isas;
    bool quick = false;
    std::string json_file;
};

constexpr const char* packed_name = "complex + real";

/// A contestant. `frame` computes the frame of a time; a turn has `batch` frames.
struct Contestant {
    std::function<void(double)> frame;
    int batch = 1;
    std::vector<double> turns_ms = {};
};

double quantile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// Runs two warm-up frames, because other contestants have used the caches and Pelagic alternates
/// between two slots; then times the batch.
double turn_ms(const Contestant& contestant, double& time_s) {
    for (int i = 0; i < 2; ++i) contestant.frame(time_s += 1.0 / 72);
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < contestant.batch; ++i) contestant.frame(time_s += 1.0 / 72);
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count() / contestant.batch;
}

void take_turns(std::vector<Contestant*> contestants, double seconds, std::size_t min_turns) {
    double time_s = 0;
    for (Contestant* contestant : contestants) {
        // A turn lasts about a millisecond or more.
        contestant->batch = 1;
        const double once = turn_ms(*contestant, time_s);
        contestant->batch = std::max(1, static_cast<int>(1.0 / once));
        contestant->turns_ms.clear();
    }
    const Clock::time_point start = Clock::now();
    for (std::size_t turn = 0;
         turn < min_turns || std::chrono::duration<double>(Clock::now() - start).count() < seconds; ++turn)
        for (Contestant* contestant : contestants) contestant->turns_ms.push_back(turn_ms(*contestant, time_s));
}

struct Row {
    int n;
    Isa isa;
    int threads;
    double ours_ms, fftw_ms, paper_ms;
    double speedup;                ///< over ours on one thread, in the same turns
    double ratio_low, ratio_high;  ///< quartiles of ours / FFTW turn by turn
    std::string arrangement;
    std::map<std::string, double> instructions;  ///< per texel, by contestant; empty if not counted
};

/// Returns the instructions of a contestant ("ours", "packed" and so on), if they were counted.
std::optional<double> instructions_of(const Row& row, const std::string& contestant) {
    const auto found = row.instructions.find(contestant);
    return found == row.instructions.end() ? std::nullopt : std::optional(found->second);
}
std::string fftw_contestant(const Row& row) { return row.arrangement == packed_name ? "packed" : "separate"; }

/// The contestants and the results of one size.
class Comparison {
   public:
    Comparison(int n, Isa isa, const Options& options)
        : sea_{.resolution = n, .patch_size_m = 250, .roughness = 0.1},
          isa_(isa),
          seconds_(options.quick ? 2 : 6),
          packed_(sea_, isa, peers::FftwArrangement::packed),
          separate_(sea_, isa, peers::FftwArrangement::separate),
          paper_(sea_),
          instructions_(bench::counted_frames(n, isa)) {}

    Row row(int threads) {
        // One thread is a direct call, pinned to one core.
        std::optional<bench::PinnedToOneCore> pinned;
        if (threads == 1) pinned.emplace();
        Ocean alone(sea_, {.executor = make_serial_executor(), .isa = isa_});
        Ocean together(sea_, {.executor = make_default_executor(threads), .isa = isa_});
        Contestant ours_alone{[&](double t) { alone.frame_at(t); }};
        Contestant ours_together{[&](double t) { together.frame_at(t); }};
        Contestant packed{[&](double t) { packed_.frame_at(t); }};
        Contestant separate{[&](double t) { separate_.frame_at(t); }};
        Contestant paper{[&](double t) { paper_.frame_at(t); }};
        std::vector<Contestant*> contestants = {&ours_alone, &packed, &separate};
        if (threads > 1) contestants.push_back(&ours_together);
        contestants.push_back(&paper);
        take_turns(contestants, seconds_, 15);
        const Contestant& ours = threads > 1 ? ours_together : ours_alone;

        const bool packed_wins = median(packed.turns_ms) <= median(separate.turns_ms);
        const Contestant& fftw = packed_wins ? packed : separate;
        std::vector<double> ratios;
        for (std::size_t i = 0; i < ours.turns_ms.size(); ++i) ratios.push_back(ours.turns_ms[i] / fftw.turns_ms[i]);
        return {sea_.resolution,
                isa_,
                threads,
                median(ours.turns_ms),
                median(fftw.turns_ms),
                median(paper.turns_ms),
                median(ours_alone.turns_ms) / median(ours.turns_ms),
                quantile(ratios, 0.25),
                quantile(ratios, 0.75),
                packed_wins ? packed_name : "three real",
                instructions_};
    }

   private:
    SeaState sea_;
    Isa isa_;
    double seconds_;
    peers::FftwFrame packed_, separate_;
    peers::PaperFrame paper_;
    std::map<std::string, double> instructions_;
};

void print_heading() {
    std::printf("%5s %-7s %7s | %9s %9s %9s | %9s  %-13s %10s %7s | %9s %9s %9s  %s\n", "N", "isa", "threads",
                "ours ms", "FFTW ms", "paper ms", "ours/FFTW", "(quartiles)", "paper/ours", "speedup", "ours i/t",
                "FFTW i/t", "ours/FFTW", "FFTW's fields");
}

std::string text_of(const char* format, std::optional<double> figure) {
    char text[32] = "-";
    if (figure) std::snprintf(text, sizeof text, format, *figure);
    return text;
}

void print(const Row& row) {
    const std::optional<double> ours = instructions_of(row, "ours"),
                                fftw = instructions_of(row, fftw_contestant(row));
    std::printf("%5d %-7s %7d | %9.4f %9.4f %9.3f | %9.3f  (%.3f-%.3f) %10.1f %7.2f | %9s %9s %9s  %s\n", row.n,
                std::string(name_of(row.isa)).c_str(), row.threads, row.ours_ms, row.fftw_ms, row.paper_ms,
                row.ours_ms / row.fftw_ms, row.ratio_low, row.ratio_high, row.paper_ms / row.ours_ms, row.speedup,
                text_of("%.1f", ours).c_str(), text_of("%.1f", fftw).c_str(),
                text_of("%.3f", ours && fftw ? std::optional(*ours / *fftw) : std::nullopt).c_str(),
                row.arrangement.c_str());
    std::fflush(stdout);
}

nlohmann::ordered_json json_of(const Row& row) {
    nlohmann::ordered_json json = {{"n", row.n},
                                   {"isa", name_of(row.isa)},
                                   {"threads", row.threads},
                                   {"ours_ms", row.ours_ms},
                                   {"fftw_ms", row.fftw_ms},
                                   {"paper_ms", row.paper_ms},
                                   {"ours_over_fftw", row.ours_ms / row.fftw_ms},
                                   {"ours_over_fftw_quartiles", {row.ratio_low, row.ratio_high}},
                                   {"speedup", row.speedup},
                                   {"fftw_arrangement", row.arrangement}};
    if (row.instructions.empty()) return json;
    json["ours_instructions_per_texel"] = instructions_of(row, "ours").value();
    json["fftw_instructions_per_texel"] = instructions_of(row, fftw_contestant(row)).value();
    json["paper_instructions_per_texel"] = instructions_of(row, "paper").value();
    return json;
}

/// "AMD EPYC 9B14" -> "amd-epyc-9b14"
std::string file_name_of(const std::string& cpu) {
    std::string name;
    for (const char c : cpu) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    if (name.ends_with('-')) name.pop_back();
    return name;
}

Options options_from(int argc, char** argv, CLI::App& app) {
    Options options;
    std::string isa_name;
    app.add_flag("--quick", options.quick, "N = 64, 128 and 256 only, short turns: under a minute");
    app.add_option("--json", options.json_file, "write the table as JSON [a whole run: bench/results/<cpu>.json]");
    app.add_option("--sizes", options.sizes, "N, separated by commas [64,128,256,512,1024]")
        ->delimiter(',')
        ->check(CLI::IsMember({32, 64, 128, 256, 512, 1024, 2048}));
    app.add_option("--isa", isa_name, "sse4.2, avx2, avx512 or neon [the two strongest that run here]");
    app.parse(argc, argv);
    const bool is_whole = !options.quick && options.sizes.empty() && isa_name.empty();
    if (is_whole && options.json_file.empty())
        options.json_file = std::string(PELAGIC_RESULTS_FOLDER) + "/" + file_name_of(tools::cpu_name()) + ".json";
    if (options.sizes.empty())
        options.sizes = options.quick ? std::vector{64, 128, 256} : std::vector{64, 128, 256, 512, 1024};
    if (isa_name.empty()) {
        const std::vector<Isa> here = isas_here();
        const std::size_t count = options.quick ? 1 : std::min<std::size_t>(2, here.size());
        options.isas.assign(here.rbegin(), here.rbegin() + static_cast<std::ptrdiff_t>(count));
    } else {
        const std::optional<Isa> isa = isa_named(isa_name);
        if (!isa || !runs_here(*isa))
            throw CLI::ValidationError("--isa",
                                       "is " + isa_name + ", expected an instruction set that this CPU runs");
        options.isas = {*isa};
    }
    return options;
}

void run(const Options& options) {
    // A temporary file, renamed when complete. It is opened before the measurement, to fail early.
    const std::string part_file = options.json_file + ".part";
    std::ofstream json_file;
    if (!options.json_file.empty()) {
        json_file.open(part_file);
        if (!json_file) throw std::runtime_error("can't write " + part_file);
    }
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::printf("%s, %s. FFTW plans are PATIENT: planning takes a while.\n", tools::cpu_name().c_str(),
                tools::compiler_name().c_str());
    print_heading();
    for (const int n : options.sizes) {
        for (const Isa isa : options.isas) {
            Comparison comparison(n, isa, options);
            for (int threads = 1; threads <= cores; threads *= 2) {
                const Row row = comparison.row(threads);
                print(row);
                rows.push_back(json_of(row));
            }
        }
    }
    if (options.json_file.empty()) return;
    const nlohmann::ordered_json all = {
        {"cpu", tools::cpu_name()}, {"compiler", tools::compiler_name()}, {"rows", rows}};
    json_file << all.dump(2) << "\n";
    if (!json_file.flush()) throw std::runtime_error("can't write " + part_file);
    std::filesystem::rename(part_file, options.json_file);
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    CLI::App app("Pelagic beside FFTW and the paper, in one run");
    try {
        pelagic::run(pelagic::options_from(argc, argv, app));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << "pelagic-compare: " << error.what() << "\n";
        return 1;
    }
}
