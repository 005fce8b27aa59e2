// `pelagic query`: how high the water is at given points, which way it faces, how it moves and how white it is.

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/floor_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"
#include "pelagic/tools/query/points_file.hpp"
#include "pelagic/tools/query/query_rows.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double latest_time_s = 1e9;  // as `export --start`
constexpr double longest_loop_s = 86400;
constexpr std::size_t max_times = 1'000'000;

/// Points in memory at once: some megabytes, and enough for each of many threads.
constexpr std::size_t block_points = std::size_t{1} << 15;

constexpr const char* a_series = "FIRST:LAST:STEP in seconds, FIRST <= LAST in [-1e9, 1e9], at most 1000000 times";

constexpr NamedValues<Interpolation, 2> interpolations = {
    {{Interpolation::linear, "linear"}, {Interpolation::cubic, "cubic"}}};

/// Throws InputError if the times span more than the sea's loop, which nobody asked for, and names one that fits.
void require_no_repetition(const std::string& text, const std::vector<double>& times_s, const ResolvedSea& sea) {
    const double loop_s = sea.sea.loop_period_s, span_s = times_s.back() - times_s.front();
    if (sea.has_loop_period || span_s <= loop_s) return;
    const double step_s = span_s / static_cast<double>(times_s.size() - 1), fits_s = std::ceil(span_s + step_s);
    throw InputError("--times " + text + " spans " + number_text(span_s) + " s, but the sea repeats after " +
                     number_text(loop_s) + " s: " +
                     (fits_s <= longest_loop_s
                          ? "--loop-period " + number_text(fits_s) + " makes it long enough, and "
                          : "no loop is longer than 86400 s; ") +
                     "--loop-period " + number_text(loop_s) + " permits repetition");
}

/// Prints once that points are farther apart than the sea is long before it repeats.
class SpanNote {
   public:
    explicit SpanNote(double repeat_m) : repeat_m_(repeat_m) {}

    void look_at(const PointBlock& block) {
        if (is_printed_) return;
        x_.extend(block.x);
        z_.extend(block.z);
        const double span_m = std::max(x_.length(), z_.length());
        if (!(span_m > repeat_m_)) return;
        std::fprintf(stderr, "note: the points span %s m, but the longest waves repeat after %s m\n",
                     number_text(span_m).c_str(), number_text(repeat_m_).c_str());
        is_printed_ = true;
    }

   private:
    struct Extent {
        double min = std::numeric_limits<double>::infinity(), max = -min;

        void extend(const std::vector<double>& to) {
            const auto [low, high] = std::minmax_element(to.begin(), to.end());
            min = std::min(min, *low);
            max = std::max(max, *high);
        }
        double length() const { return max - min; }
    };
    double repeat_m_;
    Extent x_, z_;
    bool is_printed_ = false;
};

std::vector<double> series(const std::string& text) {
    const auto first_colon = text.find(':'), last_colon = text.rfind(':');
    if (first_colon == last_colon) throw bad_value("--times", text, a_series);
    const auto first = parse_number(std::string_view(text).substr(0, first_colon));
    const auto last = parse_number(std::string_view(text).substr(first_colon + 1, last_colon - first_colon - 1));
    const auto step = parse_number(std::string_view(text).substr(last_colon + 1));
    if (!first || !last || !step || *step <= 0 || *first > *last || std::fabs(*first) > latest_time_s ||
        std::fabs(*last) > latest_time_s)
        throw bad_value("--times", text, a_series);
    // 0:1:0.1 has 11 times, though ten tenths are not quite one.
    const double steps = std::floor((*last - *first) / *step + 1e-6);
    if (steps >= static_cast<double>(max_times)) throw bad_value("--times", text, a_series);
    std::vector<double> times;
    for (double i = 0; i <= steps; ++i) times.push_back(std::min(*first + i * *step, *last));
    return times;
}

class QueryCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Reads points block by block and prints a row for each of them, so that memory does not grow with the file. Throws
    /// InputError, for what is wrong with the options or the first block before anything is printed, and FileError.
    void run() override;

   private:
    std::vector<double> times(const ResolvedSea& sea) const;

    std::optional<ShoreOptions> shore(const ResolvedSea& sea) const;

    EventFlags events_;
    SeaOptions sea_;
    ComputeFlags compute_;
    FloorFlags floor_;
    std::optional<std::string> points_, time_, times_, interpolation_;
    bool json_ = false, foam_ = false;
};

void QueryCommand::add_options(CLI::App& app) {
    app.add_option(
           "--points", points_,
           "where to look: lines x,z in metres, or columns x and z and others by a first line that names them; "
           "- is standard input")
        ->type_name("FILE.csv");
    app.add_option("--time", time_, "in seconds; [-1e9, 1e9], default 0")->type_name("NUMBER");
    app.add_option(
           "--times", times_,
           "a series instead: every point at FIRST, then at FIRST + STEP and so on, the time in a first column")
        ->type_name("FIRST:LAST:STEP");
    app.add_option("--interpolation", interpolation_,
                   "between texels: cubic, the default, keeps the heights and slopes of short waves; linear is the "
                   "surface that is drawn, of which N = 128 keeps 93 % of Hm0")
        ->type_name("linear|cubic");
    app.add_flag("--json", json_, "an array of objects, one a line, instead of CSV");
    app.add_flag("--foam", foam_,
                 "a column foam too: how much of the water is white, 0 to 1, with what is left of 2.9 seconds "
                 "before; a jump in time costs 29 ticks, each less than a frame");
#if defined(PELAGIC_HAS_IMAGES)
    floor_.add_to(app);
#endif
    events_.add_to(app);
    sea_.add_to(app);
    sea_.add_weather_to(app);
    compute_.add_to(app);
    app.footer(
        "Prints x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,converged: metres, metres a second, the normal as a\n"
        "unit vector, how far the sampled point is from the one asked for, and whether that is within a millimetre;\n"
        "with --foam a column foam before the last one, with --shore a column depth: of still water in metres, 0 or\n"
        "less where the ground is dry. Over a shore vx and vz include the motion of long waves by linear theory.\n"
        "The displacement of these waves is vertical, so error_m and jacobian do not include them.\n"
        "Standard error names the interpolation; with --json each object does, as interpolation.\n"
        "Columns of the file stand before the answers, as they are. A file may have any length, in blocks of 32768\n"
        "points: a bad line ends the work when its block is reached, and --times goes block by block.");
}

std::vector<double> QueryCommand::times(const ResolvedSea& sea) const {
    if (times_ && time_)
        throw InputError("--times is " + *times_ + " and --time is " + *time_ + ", needs one of the two");
    if (times_) {
        const std::vector<double> times_s = series(*times_);
        require_no_repetition(*times_, times_s, sea);
        return times_s;
    }
    return {time_ ? number_in("--time", *time_, -latest_time_s, latest_time_s, "seconds in [-1e9, 1e9]") : 0};
}

std::optional<ShoreOptions> QueryCommand::shore([[maybe_unused]] const ResolvedSea& sea) const {
#if defined(PELAGIC_HAS_IMAGES)
    if (floor_.has_floor() && !floor_.has_shore())
        throw InputError("--floor is given, needs --shore beside it: no other water feels its floor");
    return floor_.resolve(sea).shore();
#else
    return {};
#endif
}

void QueryCommand::run() {
    const ResolvedSea sea = sea_.resolve();
    const ComputeOptions compute = compute_.resolve();
    const std::vector<double> times_s = times(sea);
    const Interpolation interpolation =
        interpolation_ ? one_of(interpolations, "--interpolation", *interpolation_) : Interpolation::cubic;
    const std::optional<ShoreOptions> shore = this->shore(sea);
    const std::optional<EventOptions> events = events_.resolve(sea.sea.depth_m);
    if (events) require_reachable(*events, times_s.back());
    if (!points_ || points_->empty())
        throw InputError("--points is missing, needs a CSV file of lines x,z, or - for standard input");
    InputFile file("--points", *points_, "a CSV file of lines x,z", true);
    PointReader reader(file.name(), [&](std::span<char> bytes) { return file.read(bytes); });
    PointBlock block;
    bool has_points = reader.read_block(block, block_points);

    const auto executor = make_default_executor(compute.threads);
    Ocean ocean(forecast_of(sea), {.executor = executor,
                                   .isa = compute.isa,
                                   .queries = true,
                                   .velocities = true,
                                   .foam = foam_,
                                   .shore = shore});
    std::optional<EventPlayer> player;
    if (events) player.emplace(*events, executor, compute.isa);
    SurfaceQueryJobs jobs(executor);
    Answers answers(foam_, shore.has_value());
    RowWriter rows(executor, answers, interpolation, json_, times_.has_value());
    SpanNote span_note(repeat_length_m(sea.sea));
    std::optional<Frame> frame;
    if (!json_) std::fprintf(stderr, "note: interpolation is %s\n", std::string(name_of(interpolation)).c_str());
    for (rows.begin(reader); has_points; has_points = reader.read_block(block, block_points)) {
        answers.resize(block.size());
        span_note.look_at(block);
        for (const double time_s : times_s) {
            if (!frame || times_s.size() > 1) {
                frame = ocean.frame_at(time_s);
                if (player) frame = with_water(*frame, player->at(time_s));
            }
            jobs.sample(SurfaceQuery(*frame, {.interpolation = interpolation}), {block.x, block.z},
                        answers.samples());
            for (std::size_t i = 0; i < answers.depths().size(); ++i)
                answers.depths()[i] =
                    static_cast<float>(pelagic::sample(frame->shore, block.x[i], block.z[i]).depth_m);
            rows.write(block, time_s);
        }
    }
    rows.end();
}

}  // namespace

std::unique_ptr<Command> make_query_command() { return std::make_unique<QueryCommand>(); }

}  // namespace pelagic::tools
