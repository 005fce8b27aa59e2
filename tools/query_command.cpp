#include "pelagic/tools/query_command.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/query/points_file.hpp"
#include "pelagic/tools/query/query_rows.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double latest_time_s = 1e9;  // as `export --start`
constexpr std::size_t most_times = 1'000'000;

/// Points in memory at once: some megabytes, and enough for each of many threads.
constexpr std::size_t block_points = std::size_t{1} << 15;

constexpr const char* a_series = "FIRST:LAST:STEP in seconds, FIRST <= LAST in [-1e9, 1e9], at most 1000000 times";

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
    if (steps >= static_cast<double>(most_times)) throw bad_value("--times", text, a_series);
    std::vector<double> times;
    for (double i = 0; i <= steps; ++i) times.push_back(std::min(*first + i * *step, *last));
    return times;
}

}  // namespace

void QueryFlags::add_to(CLI::App& app) {
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
        "with --foam a column foam before the last one.\n"
        "Columns of the file stand before the answers, as they are. A file may have any length, in blocks of 32768\n"
        "points: a bad line ends the work when its block is reached, and --times goes block by block.");
}

std::vector<double> QueryFlags::times() const {
    if (times_ && time_)
        throw InputError("--times is " + *times_ + " and --time is " + *time_ + ", needs one of the two");
    if (times_) return series(*times_);
    return {time_ ? number_in("--time", *time_, -latest_time_s, latest_time_s, "seconds in [-1e9, 1e9]") : 0};
}

std::optional<ShoreOptions> QueryFlags::shore([[maybe_unused]] const ResolvedSea& sea) const {
#if defined(PELAGIC_HAS_IMAGES)
    if (floor_.has_floor() && !floor_.has_shore())
        throw InputError("--floor is given, needs --shore beside it: no other water feels its floor");
    return floor_.resolve(sea).shore();
#else
    return {};
#endif
}

void QueryFlags::run() const {
    const ResolvedSea sea = sea_.resolve();
    const ComputeOptions compute = compute_.resolve();
    const std::vector<double> times_s = times();
    const std::optional<ShoreOptions> shore = this->shore(sea);
    const std::optional<EventOptions> events = events_.resolve();
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
    Answers answers(foam_);
    RowWriter rows(executor, answers, json_, times_.has_value());
    std::optional<Frame> frame;
    for (rows.begin(reader); has_points; has_points = reader.read_block(block, block_points)) {
        answers.resize(block.size());
        for (const double time_s : times_s) {
            if (!frame || times_s.size() > 1) {
                frame = ocean.frame_at(time_s);
                if (player) frame = with_water(*frame, player->at(time_s));
            }
            jobs.sample(SurfaceQuery(*frame), {block.x, block.z}, answers.samples());
            rows.write(block, time_s);
        }
    }
    rows.end();
}

}  // namespace pelagic::tools
