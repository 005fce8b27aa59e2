// Comparison of Pelagic with its peers in one process: equal sea and outputs, which are textures
// only (OceanOptions::planes = false). The contestants take turns, so that other load on the
// machine affects them equally.
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
//
//   warm   a contestant's frames follow one another, and find what the caches kept
//   cold   frames of Pelagic and of the peer alternate, so each finds the caches as the other left
//          them, like the frame of an application that works between two frames
//
// The result of a library is the better of two arrangements. Rows with several threads compare
// Pelagic on its default executor with the peers on one thread, and with Pelagic called directly on
// one thread.
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
#include <utility>
#include <vector>

#include "pelagic/bench/counted_frames.hpp"
#include "pelagic/bench/peers/fftw_frame.hpp"
#include "pelagic/bench/peers/kiss_frame.hpp"
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

/// Mean times of two contestants by turn.
struct ColdTurns {
    std::vector<double> ours_ms, peer_ms;
};

/// Runs frames of two contestants alternately, and times each frame.
ColdTurns alternate(const Contestant& ours, const Contestant& peer, double seconds, std::size_t min_turns) {
    const auto timed = [](const Contestant& contestant, double time_s) {
        const Clock::time_point start = Clock::now();
        contestant.frame(time_s);
        return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    };
    const int batch = std::min(ours.batch, peer.batch);
    double time_s = 0;
    ColdTurns turns;
    const Clock::time_point start = Clock::now();
    while (turns.ours_ms.size() < min_turns ||
           std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
        double ours_ms = 0, peer_ms = 0;
        for (int i = -2; i < batch; ++i) {  // two frames of each warm up
            time_s += 1.0 / 72;
            const double once_ours = timed(ours, time_s), once_peer = timed(peer, time_s);
            if (i < 0) continue;
            ours_ms += once_ours;
            peer_ms += once_peer;
        }
        turns.ours_ms.push_back(ours_ms / batch);
        turns.peer_ms.push_back(peer_ms / batch);
    }
    return turns;
}

/// Ratio of medians, and quartiles of the ratios turn by turn.
struct Ratio {
    double median, low, high;
};
Ratio ratio_of(const std::vector<double>& ours_ms, const std::vector<double>& peer_ms) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < ours_ms.size(); ++i) ratios.push_back(ours_ms[i] / peer_ms[i]);
    return {median(ours_ms) / median(peer_ms), quantile(ratios, 0.25), quantile(ratios, 0.75)};
}

/// Pelagic beside the better arrangement of an FFT library.
struct BesideLibrary {
    std::string arrangement;
    double warm_ms, cold_ms;
    double ours_cold_ms;  ///< after the library's frames
    Ratio warm, cold;     ///< ours / the library's
};

struct Row {
    int n;
    Isa isa;
    int threads;
    double ours_ms, planes_ms, paper_ms;  ///< warm; textures only, and with planes
    double speedup;                       ///< over ours on one thread, in the same turns
    BesideLibrary fftw, kiss;
    std::map<std::string, double> instructions;  ///< per texel, by contestant; empty if not counted
};

/// Returns the instructions of a contestant ("ours", "fftw_packed" ...), if they were counted.
std::optional<double> instructions_of(const Row& row, const std::string& contestant) {
    const auto found = row.instructions.find(contestant);
    return found == row.instructions.end() ? std::nullopt : std::optional(found->second);
}
std::string contestant_of(const std::string& library, const BesideLibrary& beside) {
    return library + (beside.arrangement == packed_name ? "_packed" : "_separate");
}

/// The contestants and the results of one size.
class Comparison {
   public:
    Comparison(int n, Isa isa, const Options& options)
        : sea_{.resolution = n, .patch_size_m = 250, .lean = 0, .roughness = 0.1},
          isa_(isa),
          seconds_(options.quick ? 2 : 6),
          fftw_packed_(sea_, isa, peers::FieldArrangement::packed),
          fftw_separate_(sea_, isa, peers::FieldArrangement::separate),
          kiss_packed_(sea_, isa, peers::FieldArrangement::packed),
          kiss_separate_(sea_, isa, peers::FieldArrangement::separate),
          paper_(sea_),
          instructions_(bench::counted_frames(n, isa)) {}

    Row row(int threads) {
        // One thread is a direct call, pinned to one core.
        std::optional<bench::PinnedToOneCore> pinned;
        if (threads == 1) pinned.emplace();
        const auto ocean_of = [&](std::shared_ptr<Executor> executor, bool planes) {
            return Ocean(sea_, {.executor = std::move(executor), .isa = isa_, .planes = planes});
        };
        Ocean alone = ocean_of(make_serial_executor(), false);
        Ocean together = ocean_of(make_default_executor(threads), false);
        Ocean with_planes = ocean_of(threads == 1 ? make_serial_executor() : make_default_executor(threads), true);
        const auto contestant = [](auto& frames) { return Contestant{[&frames](double t) { frames.frame_at(t); }}; };
        Contestant ours_alone = contestant(alone), ours_together = contestant(together),
                   planes = contestant(with_planes), fftw_packed = contestant(fftw_packed_),
                   fftw_separate = contestant(fftw_separate_), kiss_packed = contestant(kiss_packed_),
                   kiss_separate = contestant(kiss_separate_), paper = contestant(paper_);
        std::vector<Contestant*> contestants = {&ours_alone, &fftw_packed, &fftw_separate};
        if (threads > 1) contestants.push_back(&ours_together);
        contestants.insert(contestants.end(), {&planes, &kiss_packed, &kiss_separate, &paper});
        take_turns(contestants, seconds_, min_turns);
        const Contestant& ours = threads > 1 ? ours_together : ours_alone;
        return {sea_.resolution,
                isa_,
                threads,
                median(ours.turns_ms),
                median(planes.turns_ms),
                median(paper.turns_ms),
                median(ours_alone.turns_ms) / median(ours.turns_ms),
                beside(ours, fftw_packed, fftw_separate),
                beside(ours, kiss_packed, kiss_separate),
                instructions_};
    }

   private:
    static constexpr std::size_t min_turns = 15;

    BesideLibrary beside(const Contestant& ours, const Contestant& packed, const Contestant& separate) const {
        const bool packed_wins = median(packed.turns_ms) <= median(separate.turns_ms);
        const Contestant& better = packed_wins ? packed : separate;
        const ColdTurns cold = alternate(ours, better, seconds_ / 3, min_turns);
        return {packed_wins ? packed_name : "three real",
                median(better.turns_ms),
                median(cold.peer_ms),
                median(cold.ours_ms),
                ratio_of(ours.turns_ms, better.turns_ms),
                ratio_of(cold.ours_ms, cold.peer_ms)};
    }

   private:
    SeaState sea_;
    Isa isa_;
    double seconds_;
    peers::FftwFrame fftw_packed_, fftw_separate_;
    peers::KissFrame kiss_packed_, kiss_separate_;
    peers::PaperFrame paper_;
    std::map<std::string, double> instructions_;
};

void print_heading() {
    std::printf("%5s %-7s %7s | %-17s | %-17s | %-35s | %-17s | %-13s | %10s %7s | %-27s | %s\n", "", "", "",
                "ours ms", "FFTW ms", "ours/FFTW", "KISS FFT ms", "ours/KISS", "", "", "instructions a texel", "");
    std::printf(
        "%5s %-7s %7s | %8s %8s | %8s %8s | %5s %-11s %5s %-11s | %8s %8s | %6s %6s | %10s %7s | %8s %8s %9s | %s\n",
        "N", "isa", "threads", "warm", "cold", "warm", "cold", "warm", "(quartiles)", "cold", "(quartiles)", "warm",
        "cold", "warm", "cold", "paper/ours", "speedup", "ours", "FFTW", "ours/FFTW", "FFTW's fields");
}

std::string text_of(const char* format, std::optional<double> figure) {
    char text[32] = "-";
    if (figure) std::snprintf(text, sizeof text, format, *figure);
    return text;
}

void print(const Row& row) {
    const std::optional<double> ours = instructions_of(row, "ours"),
                                fftw = instructions_of(row, contestant_of("fftw", row.fftw));
    const auto text = [](const Ratio& ratio) {
        return text_of("%5.3f", ratio.median) + text_of(" (%.2f", ratio.low) + text_of("-%.2f)", ratio.high);
    };
    std::printf(
        "%5d %-7s %7d | %8.4f %8.4f | %8.4f %8.4f | %s %s | %8.4f %8.4f | %6.3f %6.3f | %10.1f %7.2f | %8s %8s %9s | "
        "%s\n",
        row.n, std::string(name_of(row.isa)).c_str(), row.threads, row.ours_ms, row.fftw.ours_cold_ms,
        row.fftw.warm_ms, row.fftw.cold_ms, text(row.fftw.warm).c_str(), text(row.fftw.cold).c_str(),
        row.kiss.warm_ms, row.kiss.cold_ms, row.kiss.warm.median, row.kiss.cold.median, row.paper_ms / row.ours_ms,
        row.speedup, text_of("%.1f", ours).c_str(), text_of("%.1f", fftw).c_str(),
        text_of("%.3f", ours && fftw ? std::optional(*ours / *fftw) : std::nullopt).c_str(),
        row.fftw.arrangement.c_str());
    std::fflush(stdout);
}

nlohmann::ordered_json json_of(const Row& row) {
    nlohmann::ordered_json json = {{"n", row.n},
                                   {"isa", name_of(row.isa)},
                                   {"threads", row.threads},
                                   {"ours_ms", row.ours_ms},
                                   {"ours_planes_ms", row.planes_ms},
                                   {"paper_ms", row.paper_ms},
                                   {"speedup", row.speedup}};
    for (const auto& [name, beside] : {std::pair("fftw", &row.fftw), std::pair("kiss", &row.kiss)}) {
        const std::string library = name, ratio = "ours_over_" + library;
        json[library + "_ms"] = beside->warm_ms;
        json[ratio] = beside->warm.median;
        json[ratio + "_quartiles"] = {beside->warm.low, beside->warm.high};
        json[library + "_cold_ms"] = beside->cold_ms;
        json["ours_after_" + library + "_ms"] = beside->ours_cold_ms;
        json[ratio + "_cold"] = beside->cold.median;
        json[ratio + "_cold_quartiles"] = {beside->cold.low, beside->cold.high};
        json[library + "_arrangement"] = beside->arrangement;
    }
    if (row.instructions.empty()) return json;
    json["ours_instructions_per_texel"] = instructions_of(row, "ours").value();
    json["fftw_instructions_per_texel"] = instructions_of(row, contestant_of("fftw", row.fftw)).value();
    json["kiss_instructions_per_texel"] = instructions_of(row, contestant_of("kiss", row.kiss)).value();
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
    app.add_flag("--quick", options.quick, "N = 64, 128 and 256, the strongest instruction set, little time");
    app.add_option("--json", options.json_file, "write the table as JSON [a whole run: bench/results/<cpu>.json]");
    app.add_option("--sizes", options.sizes, "N, separated by commas [64,128,256,512,1024]")
        ->delimiter(',')
        ->check(CLI::IsMember({32, 64, 128, 256, 512, 1024, 2048}));
    app.add_option("--isa", isa_name,
                   "sse4.2, avx2, avx512 or neon [the two strongest that run here; --quick: the strongest]");
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
    const int cores = default_thread_count();
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
        {"cpu", tools::cpu_name()}, {"compiler", tools::compiler_name()}, {"textures_only", true}, {"rows", rows}};
    json_file << all.dump(2) << "\n";
    if (!json_file.flush()) throw std::runtime_error("can't write " + part_file);
    std::filesystem::rename(part_file, options.json_file);
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    CLI::App app("Pelagic beside FFTW, KISS FFT and the paper, in one run");
    try {
        pelagic::run(pelagic::options_from(argc, argv, app));
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << "pelagic-compare: " << error.what() << "\n";
        return 1;
    }
}
