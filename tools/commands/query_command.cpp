// `pelagic query`: height, normal, velocity and foam of the water at given points, or the motion of
// a hull.

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/water_jobs.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/events/event_options.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/hulls/hull_notes.hpp"
#include "pelagic/tools/hulls/hull_options.hpp"
#include "pelagic/tools/hulls/hull_player.hpp"
#include "pelagic/tools/measure/buoy_record.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/floor_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"
#include "pelagic/tools/options/water_frame_options.hpp"
#include "pelagic/tools/query/points_file.hpp"
#include "pelagic/tools/query/query_rows.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

/// How values at points are computed: from a frame (Interpolation), or by the sum over its waves.
enum class QueryMethod { linear, cubic, exact };

}  // namespace
}  // namespace pelagic::tools

template <>
struct pelagic::EnumNames<pelagic::tools::QueryMethod> {
    static constexpr std::array<std::string_view, 3> all = {"linear", "cubic", "exact"};
};

namespace pelagic::tools {
namespace {

constexpr double latest_time_s = 1e9;  // the range of `export --start`
constexpr double longest_loop_s = 86400;
constexpr std::size_t max_times = 1'000'000;

/// Points in memory at once: a few megabytes, and enough work for many threads.
constexpr std::size_t block_points = std::size_t{1} << 15;
/// Points of the exact sum between two reports of progress, some milliseconds.
constexpr std::size_t exact_batch_points = 256;
/// Text of a hull's rows that is written at once.
constexpr std::size_t output_bytes = std::size_t{1} << 16;

constexpr const char* a_series = "FIRST:LAST:STEP in seconds, FIRST <= LAST in [-1e9, 1e9], at most 1000000 times";

/// Throws InputError if the times span more than the sea's loop and --loop-period is not given. The
/// message suggests a loop period.
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

/// Prints a note, once, if the points span more than the distance after which the sea repeats.
class SpanNote {
   public:
    explicit SpanNote(double repeat_m) : repeat_m_(repeat_m) {}

    void extend(const PointBlock& block) {
        if (is_printed_) return;
        x_.extend(block.x);
        z_.extend(block.z);
        const double span_m = std::max(x_.length(), z_.length());
        if (!(span_m > repeat_m_)) return;
        print_note("the points span " + rounded_text(span_m, 9) + " m, but the longest waves repeat after " +
                   rounded_text(repeat_m_, 9) + " m");
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

/// The text of the points: of a file, of standard input, or the origin without --points.
class PointBytes {
   public:
    explicit PointBytes(const std::optional<std::string>& points) {
        if (!points) return;
        file_.emplace("--points", path_of(*points), "a CSV file of lines x,z", true);
        std::error_code unknown_size;  // of a pipe
        const auto bytes = std::filesystem::file_size(any_length(path_of(*points)), unknown_size);
        if (!unknown_size) all_ = static_cast<double>(bytes);
    }

    std::string name() const { return file_ ? file_->name() : "the origin"; }
    std::size_t read(std::span<char> to) {
        std::size_t got = 0;
        if (file_)
            got = file_->read(to);
        else if (read_ == 0)
            got = std::string_view("0,0\n").copy(to.data(), to.size());
        read_ += got;
        return got;
    }
    /// Returns the fraction of the file that was read, 0 if its size is unknown.
    double fraction_read() const { return all_ > 0 ? std::min(1.0, static_cast<double>(read_) / all_) : 0; }

   private:
    std::optional<InputFile> file_;
    double all_ = 0;
    std::size_t read_ = 0;
};

/// A record of one point: --record and --rate.
struct RecordOptions {
    double duration_s = 0, rate_hz = 4;

    std::vector<double> times_s(double first_s) const {
        std::vector<double> times;
        const auto count = static_cast<std::size_t>(std::floor(duration_s * rate_hz + 1e-6));
        for (std::size_t i = 0; i < count; ++i) times.push_back(first_s + static_cast<double>(i) / rate_hz);
        return times;
    }
};

/// Makes the loop of the sea, with its transitions, long enough for a record.
ResolvedSea without_repetition(ResolvedSea sea, const RecordOptions& record) {
    if (sea.has_loop_period || record.duration_s <= sea.sea.loop_period_s) return sea;
    const double loop_s = std::ceil(record.duration_s);
    print_note("the loop period is " + number_text(loop_s) + " s");
    sea.sea.loop_period_s = loop_s;
    for (ResolvedChange& change : sea.changes) change.sea.sea.loop_period_s = loop_s;
    return sea;
}

/// Collects the samples of a record and prints its statistics.
class RecordFooter {
   public:
    RecordFooter(double rate_hz, double depth_m) : record_{.rate_hz = rate_hz, .depth_m = depth_m} {}

    /// \pre the samples are those of one point
    void add(SampleBuffers& samples) {
        const SurfaceSamples point = samples.samples();
        // A surface that overturns has no slope.
        const double up = std::max(static_cast<double>(point.normal_y[0]), 0.02);
        record_.height_m.push_back(static_cast<double>(point.height_m[0]));
        record_.slope_x.push_back(0 - static_cast<double>(point.normal_x[0]) / up);
        record_.slope_z.push_back(0 - static_cast<double>(point.normal_z[0]) / up);
    }
    void print() const {
        const RecordStatistics found = statistics_of(record_);
        std::string text;
        const auto line = [&](const char* name, std::optional<double> value) {
            text += std::string("# ") + name + "," + (value ? rounded_text(*value, 4) : "") + "\n";
        };
        line("Hm0_m", found.significant_wave_height_m);
        line("Tp_s", found.peak_period_s);
        line("Tz_s", found.zero_crossing_period_s);
        const auto degrees = [&](double WaveDirections::*radians) {
            return found.directions ? std::optional(in_degrees((*found.directions).*radians)) : std::nullopt;
        };
        line("direction_deg", degrees(&WaveDirections::mean_rad));
        line("spread_deg", degrees(&WaveDirections::spread_rad));
        line("skewness", found.skewness);
        line("highest_wave_m", found.highest_wave_m);
        write_output(text);
    }

   private:
    BuoyRecord record_;
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
    // 0:1:0.1 has 11 times, although ten tenths are slightly less than one.
    const double steps = std::floor((*last - *first) / *step + 1e-6);
    if (steps >= static_cast<double>(max_times)) throw bad_value("--times", text, a_series);
    std::vector<double> times;
    for (double i = 0; i <= steps; ++i) times.push_back(std::min(*first + i * *step, *last));
    return times;
}

/// Shows the computed time, or with one time the point, on a terminal, with an estimate, after two
/// seconds.
class QueryProgress {
   public:
    QueryProgress(double begins_s, double ends_s) : begins_s_(begins_s), ends_s_(ends_s) {}

    /// \param first_point  number of the block's first point, from 0
    /// \param from, to      fractions of all points before and after the block; 0 if unknown
    void begin_block(std::size_t first_point, double from, double to) {
        first_point_ = first_point;
        from_ = from;
        to_ = to;
    }
    void show(double time_s) {
        const double all_s = ends_s_ - begins_s_;
        show(time_s, first_point_, all_s > 0 ? std::clamp((time_s - begins_s_) / all_s, 0.0, 1.0) : 0);
    }
    /// \param point     number of the point, from 0
    /// \param fraction  of the block that is done, of all times
    void show(double time_s, std::size_t point, double fraction) {
        progress_.show(ends_s_ > begins_s_
                           ? "time " + rounded_text(time_s, 1) + " of " + rounded_text(ends_s_, 1) + " s"
                           : "point " + number_text(point + 1),
                       from_ + fraction * (to_ - from_));
    }
    void clear() { progress_.clear(); }

   private:
    double begins_s_, ends_s_, from_ = 0, to_ = 1;
    std::size_t first_point_ = 0;
    Progress progress_{"", 1, std::chrono::seconds(2)};
};

class QueryCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Reads points block by block and prints a row for each, so that memory does not grow with the
    /// file. Throws FileError, and InputError; errors in the options or in the first block are
    /// thrown before anything is printed.
    void run() override;

   private:
    /// Prints rows of the exact sum over waves.
    void run_exact(const ResolvedSea& sea, const std::vector<double>& times_s,
                   const std::optional<RecordOptions>& record) const;
    void require_points(const std::optional<RecordOptions>& record) const;
    /// Prints a row for each time.
    void run_hull(const ResolvedSea& sea, const std::vector<double>& times_s) const;
    std::vector<double> times(const ResolvedSea& sea) const;
    /// Returns the options of a record; none without --record.
    std::optional<RecordOptions> record() const;

    std::optional<ShoreOptions> shore(const ResolvedSea& sea) const;

    HullFlags hull_;
    EventFlags events_;
    SeaOptions sea_;
    ComputeFlags compute_;
    FloorFlags floor_;
    WaterFrameFlags water_frame_;
    /// Returns the footprint in metres, 0 without --footprint.
    double footprint_m(const SeaState& sea) const;

    std::optional<std::string> points_, time_, times_, record_, rate_, interpolation_, velocities_, footprint_;
    bool json_ = false, foam_ = false;
};

void QueryCommand::add_options(CLI::App& app) {
    app.option_defaults()->group(help_group::input);
    app.add_option("--points", points_, "lines x,z in metres, or a header with columns x and z; -: standard input")
        ->type_name("FILE.csv");
    app.add_option("--time", time_, "seconds; [-1e9, 1e9] (default: 0)")->type_name("SECONDS");
    app.add_option("--times", times_, "sample at several times, and add a column with the time")
        ->type_name("FIRST:LAST:STEP");
    app.add_option("--record", record_, "sample one point, (0, 0) without --points, and add statistics")
        ->type_name("SECONDS");
    app.add_option("--rate", rate_, "samples per second of --record; [0.001, 100] (default: 4)")->type_name("HZ");
    app.add_option("--interpolation", interpolation_,
                   "between texels; cubic keeps short waves, linear is the drawn surface; exact adds all waves "
                   "at points of the undisplaced water (default: cubic)")
        ->type_name(alternatives(names_of<QueryMethod>()));
    app.add_option("--velocities", velocities_,
                   "drawn: of the drawn surface; water: the water's own, without waves of less than four texels "
                   "(default: drawn)")
        ->type_name("drawn|water");
    app.add_option("--footprint", footprint_,
                   "leave out waves shorter than about this length; velocities are then the water's own; "
                   "[0, 10000] (default: 0)")
        ->type_name("METRES");

    app.option_defaults()->group(help_group::output);
    app.add_flag("--foam", foam_, "add a column with the foam coverage, 0 to 1");
    app.add_flag("--json", json_, "print an array of objects instead of CSV");
#if defined(PELAGIC_HAS_IMAGES)
    floor_.add_to(app);
#endif
    hull_.add_to(app);
    events_.add_to(app);
    sea_.add_to(app, SeaOptions::PresetName::positional_too);
    sea_.add_weather_to(app);
    water_frame_.add_to(app);
    compute_.add_to(app);
    app.footer(
        "Prints x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,converged. Units are metres and m/s; the\n"
        "normal is a unit vector. error_m is the distance between the sampled and the requested point;\n"
        "converged: whether it is at most a millimetre. --foam adds a column foam before the last one.\n"
        "--shore adds a column depth: still-water depth in metres, 0 or less on dry ground. Over a shore\n"
        "vx and vz include the motion of long waves by linear theory. The displacement of these waves is\n"
        "vertical, so error_m and jacobian do not include them. The interpolation is printed on standard\n"
        "error, or with --json as interpolation in each object. Other columns of the file are copied in\n"
        "front of the results. A file may have any length. It is read in blocks of 32768 points: an\n"
        "invalid line ends the command when its block is read, and --times applies to one block at a time.\n"
        "With a column y the command prints pressure_pa, velocity_x_mps, velocity_y_mps,\n"
        "velocity_z_mps, acceleration_x_mps2, acceleration_y_mps2, acceleration_z_mps2 and\n"
        "depth_below_surface_m of the water at that height, for sea water of 1025 kg/m^3.\n"
        "--record prints a row for each time, then lines # NAME,VALUE: Hm0_m, Tp_s, Tz_s (upward crossings\n"
        "of the mean), direction_deg and spread_deg (towards, from +x to +z), skewness, highest_wave_m.\n"
        "Without --loop-period the loop is at least as long as the record.\n"
        "--hull prints time,x,y,z,heave,heading,pitch,roll,vx,vy,vz,draught,displaced instead: position and\n"
        "velocity of the centre of mass, heave above its height in still water, degrees (pitch: bow up,\n"
        "roll: starboard down), and m^3 of water.");
}

std::vector<double> QueryCommand::times(const ResolvedSea& sea) const {
    if (times_ && time_)
        throw InputError("--times is " + *times_ + " and --time is " + *time_ + "; give one of the two");
    if (times_) {
        const std::vector<double> times_s = series(*times_);
        require_no_repetition(*times_, times_s, sea);
        return times_s;
    }
    return {time_ ? number_in("--time", *time_, -latest_time_s, latest_time_s, "seconds in [-1e9, 1e9]") : 0};
}

std::optional<RecordOptions> QueryCommand::record() const {
    if (!record_) {
        if (rate_) throw InputError("--rate needs --record: only a record has a rate");
        return {};
    }
    for (const auto& [flag, is_given] : {std::pair("--times", times_.has_value()), {"--json", json_}})
        if (is_given) throw InputError(std::string(flag) + " cannot be combined with --record");
    RecordOptions record;
    constexpr const char* a_duration = "seconds in [10, 86400], with 16 to 1000000 samples";
    record.duration_s = number_in("--record", *record_, 10, longest_loop_s, a_duration);
    if (rate_) record.rate_hz = number_in("--rate", *rate_, 1e-3, 100, "samples per second in [0.001, 100]");
    const double samples = record.duration_s * record.rate_hz;
    if (samples < 16 || samples > static_cast<double>(max_times)) throw bad_value("--record", *record_, a_duration);
    return record;
}

std::optional<ShoreOptions> QueryCommand::shore([[maybe_unused]] const ResolvedSea& sea) const {
#if defined(PELAGIC_HAS_IMAGES)
    if (floor_.has_floor() && !floor_.has_shore())
        throw InputError("--floor needs --shore: only a shore uses the floor");
    return floor_.resolve(sea).shore();
#else
    return {};
#endif
}

double QueryCommand::footprint_m(const SeaState& sea) const {
    if (!footprint_) return 0;
    const double metres = number_in("--footprint", *footprint_, 0, 1e4, "[0, 10000] m");
    for (const auto& [flags, is_given] : {std::pair("--waves pond", sea.waves == WaveModel::pond),
                                          {"--velocities drawn", velocities_ == name_of(Velocities::drawn)}})
        if (is_given) throw InputError(std::string(flags) + " cannot be combined with --footprint");
    return metres;
}

void QueryCommand::run_hull(const ResolvedSea& sea, const std::vector<double>& times_s) const {
    for (const auto& [flag, is_given] : {std::pair("--points", points_.has_value()),
                                         {"--record", record_.has_value()},
                                         {"--interpolation", interpolation_.has_value()},
                                         {"--velocities", velocities_.has_value()},
                                         {"--footprint", footprint_.has_value()},
                                         {"--foam", foam_}})
        if (is_given) throw InputError(std::string(flag) + " cannot be combined with --hull");
    const ComputeOptions compute = compute_.resolve();
    const WaterFrame water = water_frame_.resolve(floor_.has_shore());
    const std::optional<ShoreOptions> shore = this->shore(sea);
    const HullLaunch launch = *hull_.resolve();
    const EventOptions events = *events_.resolve(sea.sea.depth_m, launch.place());
    require_reachable(events, times_s.back());
    require_reachable(times_s.front(), times_s.back());

    const auto executor = make_default_executor(compute.threads);
    Ocean ocean(forecast_of(sea),
                {.executor = executor, .isa = compute.isa, .queries = true, .depth = true, .shore = shore});
    ocean.set_water_frame(water);
    const double first_s = times_s.front();
    EventPlayer waves(events, executor, compute.isa, water, HullPlayer::begins_s(first_s));
    QueryProgress progress(waves.begins_s(), times_s.back());
    waves.report_to([&](double time_s) { progress.show(time_s); });
    HullPlayer hull(launch, ocean, waves, first_s, executor);
    std::string rows = json_ ? "[\n" : hull_columns() + "\n";
    for (const double time_s : times_s) {
        rows += hull_row(time_s, hull.at(time_s), json_);
        rows += json_ && time_s != times_s.back() ? ",\n" : "\n";
        if (rows.size() < output_bytes && time_s != times_s.back()) continue;
        progress.clear();
        write_output(rows);
        rows.clear();
    }
    if (json_) write_output("]\n");
    // after an error there is only its line
    for (const std::string& note : notes_on(*launch.hull, sea.sea)) print_note(note);
}

void QueryCommand::require_points(const std::optional<RecordOptions>& record) const {
    if (!record && (!points_ || points_->empty()))
        throw InputError("--points is missing: expected a CSV file of lines x,z, or - for standard input");
}

void QueryCommand::run_exact(const ResolvedSea& sea, const std::vector<double>& times_s,
                             const std::optional<RecordOptions>& record) const {
    for (const auto& [flag, is_given] : {std::pair("--foam", foam_),
                                         {"--floor", floor_.has_floor()},
                                         {"--shore", floor_.has_shore()},
                                         {"--velocities", velocities_.has_value()},
                                         {"--events", events_.resolve(sea.sea.depth_m).has_value()},
                                         {"--weather", !sea.changes.empty()},
                                         {"--waves pond", sea.sea.waves == WaveModel::pond}})
        if (is_given) throw InputError(std::string(flag) + " cannot be combined with --interpolation exact");
    const ComputeOptions compute = compute_.resolve();
    const WaterFrame frame = water_frame_.resolve(false);
    const double footprint_m = this->footprint_m(sea.sea);
    require_points(record);
    const auto executor = make_default_executor(compute.threads);
    ExactWater water(sea.sea, {.water_frame = frame, .executor = executor, .isa = compute.isa});

    PointBytes bytes(points_);
    PointReader reader(bytes.name(), [&](std::span<char> to) { return bytes.read(to); });
    reader.set_min_y(frame.sea_level_m - water.depth_m(), "the sea floor");
    PointBlock block;
    bool has_points = reader.read_block(block, block_points);
    if (record && (block.size() > 1 || reader.has_y()))
        throw InputError("--record needs one point, and " + bytes.name() + " has " +
                         (block.size() > 1 ? "more" : "a column y"));
    WaterJobs jobs(executor);
    SampleBuffers surface(false, false);
    WaterBuffers below;
    ResultColumns& results = reader.has_y() ? static_cast<ResultColumns&>(below) : surface;
    RowWriter rows(executor, results, name_of(QueryMethod::exact), json_, times_.has_value() || record);
    std::optional<RecordFooter> footer;
    if (record) footer.emplace(record->rate_hz, water.depth_m());
    SpanNote span_note(repeat_length_m(sea.sea));
    if (!json_) print_note("interpolation is exact");
    QueryProgress progress(times_s.front(), times_s.back());
    std::size_t points = 0;
    double done = 0;  // fraction of the points
    for (rows.begin(reader); has_points; has_points = reader.read_block(block, block_points)) {
        const bool is_all = points == 0 && block.size() < block_points;
        const double until = is_all ? 1 : bytes.fraction_read();
        progress.begin_block(points, done, until);
        points += block.size();
        done = until;
        results.resize(block.size());
        span_note.extend(block);
        for (std::size_t moment = 0; moment < times_s.size(); ++moment) {
            const double time_s = times_s[moment];
            water.set_time(time_s);
            for (std::size_t first = 0; first < block.size(); first += exact_batch_points) {
                const double batches = static_cast<double>(first) / static_cast<double>(block.size());
                progress.show(time_s, points - block.size() + first,
                              (static_cast<double>(moment) + batches) / static_cast<double>(times_s.size()));
                const std::size_t count = std::min(exact_batch_points, block.size() - first);
                const auto batch = [&](std::span<const double> all) { return all.subspan(first, count); };
                if (reader.has_y())
                    jobs.sample(water, {batch(block.x), batch(block.y), batch(block.z), footprint_m},
                                below.samples(first, count));
                else
                    jobs.sample_surface(water, {batch(block.x), batch(block.z), footprint_m},
                                        surface.samples(first, count));
            }
            if (footer) footer->add(surface);
            progress.clear();
            rows.write(block, time_s);
        }
    }
    rows.end();
    if (footer) footer->print();
}

void QueryCommand::run() {
    const std::optional<RecordOptions> record = this->record();
    const ResolvedSea sea = record ? without_repetition(sea_.resolve(), *record) : sea_.resolve();
    print_weather_note(sea);
    std::vector<double> times_s = times(sea);
    if (record) times_s = record->times_s(times_s.front());
    if (hull_.has_hull()) return run_hull(sea, times_s);
    hull_.resolve();  // rejects its other options
    const QueryMethod method =
        interpolation_ ? one_of<QueryMethod>("--interpolation", *interpolation_) : QueryMethod::cubic;
    if (method == QueryMethod::exact) return run_exact(sea, times_s, record);
    const Velocities velocities =
        velocities_ ? one_of<Velocities>("--velocities", *velocities_) : Velocities::drawn;
    if (velocities == Velocities::none) throw InputError("--velocities none, expected drawn or water");
    const double footprint_m = this->footprint_m(sea.sea);
    const Interpolation interpolation = method == QueryMethod::cubic ? Interpolation::cubic : Interpolation::linear;
    const ComputeOptions compute = compute_.resolve();
    const WaterFrame water = water_frame_.resolve(floor_.has_shore());
    const std::optional<ShoreOptions> shore = this->shore(sea);
    const std::optional<EventOptions> events = events_.resolve(sea.sea.depth_m);
    if (events) require_reachable(*events, times_s.back());
    require_points(record);
    PointBytes bytes(points_);
    PointReader reader(bytes.name(), [&](std::span<char> to) { return bytes.read(to); });
    PointBlock block;
    reader.set_min_y(water.sea_level_m - sea.sea.depth_m, "the sea floor");
    bool has_points = reader.read_block(block, block_points);
    if (record && (block.size() > 1 || reader.has_y()))
        throw InputError("--record needs one point, and " + bytes.name() + " has " +
                         (block.size() > 1 ? "more" : "a column y"));
    if (reader.has_y() && (foam_ || velocities_))
        throw InputError(std::string(foam_ ? "--foam" : "--velocities") +
                         " cannot be combined with points that have a column y");

    const auto executor = make_default_executor(compute.threads);
    Ocean ocean(forecast_of(sea), {.executor = executor,
                                   .isa = compute.isa,
                                   .queries = true,
                                   .velocities = reader.has_y() || footprint_m > 0 ? Velocities::none : velocities,
                                   .depth = reader.has_y() || footprint_m > 0,
                                   .foam = foam_,
                                   .shore = shore});
    ocean.set_water_frame(water);
    std::optional<EventPlayer> player;
    if (events) player.emplace(*events, executor, compute.isa, water);
    SurfaceQueryJobs jobs(executor);
    WaterJobs water_jobs(executor);
    SampleBuffers samples(foam_, shore.has_value());
    WaterBuffers below;
    ResultColumns& results = reader.has_y() ? static_cast<ResultColumns&>(below) : samples;
    RowWriter rows(executor, results, name_of(interpolation), json_, times_.has_value() || record);
    std::optional<RecordFooter> footer;
    SpanNote span_note(repeat_length_m(sea.sea));
    std::optional<Frame> frame;
    if (!json_) print_note("interpolation is " + std::string(name_of(interpolation)));
    QueryProgress progress(player ? std::min(player->begins_s(), times_s.front()) : times_s.front(), times_s.back());
    if (player) player->report_to([&](double time_s) { progress.show(time_s); });
    std::size_t points = 0;
    double done = 0;  // fraction of the points
    for (rows.begin(reader); has_points; has_points = reader.read_block(block, block_points)) {
        const bool is_all = points == 0 && block.size() < block_points;
        const double until = is_all ? 1 : bytes.fraction_read();
        progress.begin_block(points, done, until);
        points += block.size();
        done = until;
        results.resize(block.size());
        span_note.extend(block);
        for (const double time_s : times_s) {
            progress.show(time_s);
            if (!frame || times_s.size() > 1) {
                frame = ocean.frame_at(time_s);
                if (player) frame = with_water(*frame, player->at(time_s));
            }
            const SurfaceQueryOptions surface{.interpolation = interpolation};
            if (reader.has_y())
                water_jobs.sample(WaterQuery(*frame, {.surface = surface}), {block.x, block.y, block.z, footprint_m},
                                  below.samples(0, block.size()));
            else
                jobs.sample(SurfaceQuery(*frame, surface), {block.x, block.z, footprint_m},
                            samples.samples(0, block.size()));
            if (record) {
                const double floor_m =
                    frame->shore ? pelagic::sample(frame->shore, block.x[0], block.z[0]).depth_m : sea.sea.depth_m;
                if (!footer) footer.emplace(record->rate_hz, std::max(floor_m, 0.01));
                footer->add(samples);
            }
            for (std::size_t i = 0; !reader.has_y() && i < samples.depths().size(); ++i)
                samples.depths()[i] =
                    static_cast<float>(pelagic::sample(frame->shore, block.x[i], block.z[i]).depth_m);
            progress.clear();
            rows.write(block, time_s);
        }
    }
    rows.end();
    if (footer) footer->print();
}

}  // namespace

std::unique_ptr<Command> make_query_command() { return std::make_unique<QueryCommand>(); }

}  // namespace pelagic::tools
