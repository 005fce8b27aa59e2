// Exports with an events file: the dynamic waves beside the cascades are compared with the grid's
// own ticks, linear theory and queries. The exported bytes depend on the events and the frame times
// only.
#include <gtest/gtest.h>
#include <math.h>
#include <signal.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/tests/dynamic_wave_pool.hpp"
#include "pelagic/tests/read_image.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/events/event_player.hpp"

namespace pelagic {
namespace {

using Json = nlohmann::ordered_json;

// A drop, a hull that moves through the grid, a relaxation between ticks, and an event after the
// last frame.
constexpr const char* several =
    "time,x,z,radius,height,velocity,heading,duration,length,mode\n"
    "0.5,0,0,1,0.4,,,,,\n"
    "0.7,-10,5,1,-0.5,6,-30,1.5,4,\n"
    "-0.258,8,-8,1.5,0.2,1,90,0.8,,relaxation\n"
    "9,0,0,1,1,,,,,\n";

// A grid of 128 texels on 64 m around (-1, -1.5), the centre of the events' positions.
constexpr int grid_texels = 128;
constexpr double grid_texel_m = 0.5;

// Frames with a gap: before the first event, on ticks and between them.
const Arguments sea_flags = {"--cascades",
                             "2",
                             "--resolution",
                             "32",
                             "--start",
                             "-0.5",
                             "--fps",
                             "7",
                             "--frames",
                             "0-9,14-17",
                             "--events-resolution",
                             "128",
                             "--wind-speed",
                             "8",
                             "--no-sync",
                             "--maps",
                             "displacement,compression"};

class ExportEvents : public testing::Test {
   protected:
    ExportEvents() { write_file(events(), several); }

    std::filesystem::path events() const { return folder_ / "events.csv"; }
    std::filesystem::path place(const std::string& name) const { return folder_ / name; }
    Arguments to(const std::string& name, const Arguments& more = {}) const {
        return joined(joined({"export", "--out", place(name).string(), "--events", events().string()}, sea_flags),
                      more);
    }
    Files made(const Arguments& arguments, const std::string& name) const {
        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return files_in(place(name));
    }
    ReadImage map(const std::string& name, const std::string& file) const { return read_image(place(name) / file); }

    TemporaryFolder folder_;
};

void expect_same(const Files& files, const Files& wanted) {
    EXPECT_EQ(files.size(), wanted.size());
    for (const auto& [name, bytes] : wanted) {
        ASSERT_TRUE(files.contains(name)) << name;
        EXPECT_EQ(files.at(name) == bytes, true) << name;
    }
}

TEST_F(ExportEvents, ShardedAndResumedExportsEqualOneRun) {
    const Files one = made(to("one"), "one");
    EXPECT_TRUE(one.contains("dynamic-waves_0017.exr"));
    EXPECT_EQ(one.at("sea_events.csv"), several);

    for (const char* shard : {"3/3", "1/3", "2/3"})
        made(to("shards", {"--shard", shard, "--threads", "1"}), "shards");
    ASSERT_EQ(run_pelagic({"merge", place("shards").string()}).exit_code, 0);
    expect_same(files_in(place("shards")), one);
    const Outcome verified = run_pelagic({"verify", place("shards").string(), "--sample", "all"});
    EXPECT_EQ(verified.exit_code, 0) << verified.err << verified.out;

    // Killed as soon as some frames are journaled. On a fast machine the export may be complete by
    // then, which is valid too.
    const pid_t process = start_pelagic(to("killed"), place("out"), place("err"));
    for (int i = 0; i < 2000; ++i) {
        const std::string journal = read_file(place("killed") / ".pelagic-export.jsonl");
        if (std::count(journal.begin(), journal.end(), '\n') > 4 ||
            std::filesystem::exists(place("killed") / "sea.json"))
            break;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    kill(process, SIGKILL);
    wait_for(process);
    expect_same(made(to("killed", {"--resume"}), "killed"), one);

    // A single frame in the middle, exported again, has equal dynamic waves.
    std::filesystem::remove(place("killed") / "dynamic-waves_0008.exr");
    expect_same(made(to("killed", {"--resume"}), "killed"), one);
}

TEST_F(ExportEvents, DoNotChangeTheCascadesOrTheirHashes) {
    const Files pushed = made(to("pushed"), "pushed");
    // The folder of the first export, whose dynamic waves the second export removes.
    made(to("calm"), "calm");
    Arguments calm = sea_flags;
    const auto of_events = std::find(calm.begin(), calm.end(), "--events-resolution");
    calm.erase(of_events, of_events + 2);
    const Files still = made(joined({"export", "--out", place("calm").string(), "--overwrite"}, calm), "calm");
    const std::size_t frames = 14;
    // two maps of two cascades, sea.json, its record and the folder's lock
    EXPECT_EQ(still.size(), frames * 4 + 3);
    EXPECT_EQ(pushed.size(), frames * 5 + 4);  // also the grid's maps and the events file
    for (const auto& [name, bytes] : still) {
        if (name != "sea.json" && name != "sea_files.json") {
            EXPECT_EQ(pushed.at(name) == bytes, true) << name;
        }
    }
    const Json of_pushed = Json::parse(pushed.at("sea.json"))["frames"];
    const Json of_still = Json::parse(still.at("sea.json"))["frames"];
    for (std::size_t i = 0; i < frames; ++i) {
        for (const char* key : {"hash", "height_max_m"}) EXPECT_EQ(of_pushed[i][key], of_still[i][key]);
        EXPECT_FALSE(of_still[i].contains("dynamic_waves_hash"));
        // Two frames are before the first event; later frames move.
        if (i == 1) {
            EXPECT_EQ(of_pushed[i]["dynamic_waves_hash"], of_pushed[0]["dynamic_waves_hash"]);
        } else if (i > 1) {
            EXPECT_NE(of_pushed[i]["dynamic_waves_hash"], of_pushed[i - 1]["dynamic_waves_hash"]);
        }
    }
}

/// The events above, applied to the grid tick by tick: 60 ticks per second. An event takes effect
/// in the first tick that is not before its time.
class ManualTicks {
   public:
    ManualTicks() : pool_({.resolution = grid_texels}) {
        pool_.grid.set_center(-1, -1.5);
        DynamicWaveSources& sources = pool_.grid.sources();
        const auto set = [&](std::uint32_t number, const Disturbance& source) {
            pool_.grid.set_source(number, source);
        };
        relaxation_ = sources.new_number();
        // -0.258 s is 0.48 ticks after tick -16; tick -15 is 8 ms later, when the source is 8 mm
        // further south.
        set(relaxation_, {.mode = Disturbance::Mode::relaxation,
                          .x_m = 8,
                          .z_m = -8 + 0.008,
                          .radius_m = 1.5,
                          .height_m = 0.2,
                          .velocity_z_mps = 1});
    }

    /// The grid that a frame shows. \param fraction fraction in [0, 1] of the time between the
    /// previous tick and `tick`
    std::vector<float> after_tick(int tick, double fraction) {
        for (; tick_ < tick; ++tick_) before_tick(tick_ + 1), pool_.tick();
        const std::size_t texels = grid_texels * grid_texels;
        AlignedBuffer<float> height(texels), rise(texels), edge(grid_texels);
        std::vector<std::uint8_t> foam(texels);
        for (std::size_t item = 0; item < grid_texels / DynamicWaveGrid::rows_per_item; ++item)
            pool_.grid.interpolate(static_cast<float>(fraction), item,
                                   {height.data(), rise.data(), foam.data(), edge.data(), edge.data()});
        std::vector<float> pixels;
        const auto in_torus = [](std::int64_t i) {
            return static_cast<std::size_t>(((i % grid_texels) + grid_texels) % grid_texels);
        };
        for (std::int64_t z = pool_.grid.first_z(); z < pool_.grid.first_z() + grid_texels; ++z)
            for (std::int64_t x = pool_.grid.first_x(); x < pool_.grid.first_x() + grid_texels; ++x) {
                const std::size_t texel = in_torus(z) * grid_texels + in_torus(x);
                pixels.insert(pixels.end(),
                              {height.data()[texel], rise.data()[texel], static_cast<float>(foam[texel]) / 255});
            }
        return pixels;
    }

   private:
    void before_tick(int tick) {
        constexpr double degree = std::numbers::pi / 180;
        DynamicWaveSources& sources = pool_.grid.sources();
        if (tick == 30) sources.add_impulse({.mode = Disturbance::Mode::impulse, .radius_m = 1, .height_m = 0.4});
        if (tick == 33) sources.remove(relaxation_);  // the first tick after -0.258 s + 0.8 s
        if (tick == 42) {
            hull_ = sources.new_number();
            pool_.grid.set_source(hull_, {.shape = Disturbance::Shape::hull,
                                          .x_m = -10,
                                          .z_m = 5,
                                          .radius_m = 1,
                                          .length_m = 4,
                                          .heading_rad = -30 * degree,
                                          .height_m = -0.5,
                                          .velocity_x_mps = 6 * std::cos(30 * degree),
                                          .velocity_z_mps = -6 * std::sin(30 * degree)});
        }
        if (tick == 132) sources.remove(hull_);
    }

    DynamicWavePool pool_;
    int tick_ = -16;
    std::uint32_t relaxation_ = 0, hull_ = 0;
};

TEST_F(ExportEvents, EqualTheTicksOfTheirTimes) {
    write_file(events(), several);
    made(to("ticks"), "ticks");
    const Json layout = Json::parse(read_file(place("ticks") / "sea.json"))["dynamic_waves"];
    EXPECT_EQ(layout["x_m_of_column"], (Json{{"scale", grid_texel_m}, {"offset", -1 - 32.0}}));
    EXPECT_EQ(layout["z_m_of_row"], (Json{{"scale", grid_texel_m}, {"offset", -1.5 - 32.0}}));
    ManualTicks manual;
    double highest = 0;
    for (const int frame : {2, 7, 9, 14, 17}) {
        // The time of a tick may be rounded down, so a tick begins 2^-16 of its length earlier.
        const double ticks = (-0.5 + frame / 7.0) * 60 + 0x1p-16;
        const std::vector<float> wanted =
            manual.after_tick(static_cast<int>(std::floor(ticks)), ticks - std::floor(ticks));
        const ReadImage read =
            map("ticks", (frame < 10 ? "dynamic-waves_000" : "dynamic-waves_00") + std::to_string(frame) + ".exr");
        ASSERT_EQ(read.type, "float");
        ASSERT_EQ(read.pixels.size(), wanted.size());
        double worst = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            worst = std::max(worst, std::fabs(read.pixels[i] - static_cast<double>(wanted[i])));
        for (std::size_t i = 0; i < wanted.size(); i += 3) highest = std::max(highest, read.pixels[i]);
        // Sines of headings by libm differ in the last bit, and floats of half a metre by 3e-8;
        // vertical velocities are up to 10 m/s.
        EXPECT_LT(worst, 2e-6) << "frame " << frame;
    }
    EXPECT_GT(highest, 0.1);
}

// 800 drops of 100 m at one position and time: 80 km high, with vertical velocities of as many
// cm/s.
TEST_F(ExportEvents, HeightsBeyondTheLargestHalfAreClampedWithOneNote) {
    std::string rows = "time,x,z,radius,height\n";
    for (int row = 0; row < 800; ++row) rows += "0.5,0,0,2,100\n0.5,12,0,2,-100\n";
    write_file(events(), rows);
    const auto outcome_of = [&](const std::string& name, const Arguments& more) {
        return run_pelagic(
            joined({"export", "--out", place(name).string(), "--events", events().string(), "--maps", "none",
                    "--resolution", "16", "--cascades", "1", "--fps", "2", "--frames", "2-4", "--no-sync"},
                   more));
    };
    for (const Arguments& more : {Arguments{"--half"}, Arguments{}}) {
        const std::string name = more.empty() ? "floats" : "halves";
        const Outcome outcome = outcome_of(name, more);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const ReadImage image = map(name, "dynamic-waves_0002.exr");
        const auto [lowest, highest] = std::minmax_element(image.pixels.begin(), image.pixels.end());
        if (more.empty()) {
            EXPECT_EQ(outcome.err.find("note: values beyond"), std::string::npos) << outcome.err;
            EXPECT_GT(*highest, 65520);
            continue;
        }
        // after the notes about the sea
        const std::size_t begin = std::min(outcome.err.find("note: values beyond"), outcome.err.size());
        EXPECT_EQ(outcome.err.substr(begin),
                  "note: values beyond 65504, the largest 16-bit float, are stored as 65504; 32-bit floats hold "
                  "them, without --half and --format ktx2\n");
        EXPECT_EQ(image.type, "half");
        EXPECT_EQ(*highest, 65504);
        EXPECT_EQ(*lowest, -65504);
    }
    // The KTX2 export holds no infinite half.
    const Outcome outcome = outcome_of("textures", {"--format", "ktx2", "--compression", "none"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("note: values beyond 65504"), std::string::npos) << outcome.err;
    const std::string file = read_file(place("textures") / "dynamic-waves_0002.ktx2");
    const auto number_at = [&](std::size_t at, std::size_t bytes) {
        std::uint64_t number = 0;
        for (std::size_t i = bytes; i-- > 0;) number = number << 8 | static_cast<unsigned char>(file.at(at + i));
        return number;
    };
    const std::uint64_t begin = number_at(80, 8), bytes = number_at(88, 8);
    ASSERT_EQ(bytes % 2, 0U);
    std::uint64_t largest = 0;
    for (std::uint64_t at = begin; at < begin + bytes; at += 2)
        largest = std::max(largest, number_at(at, 2) & 0x7FFF);
    EXPECT_EQ(largest, 0x7BFFU);
}

std::vector<std::vector<double>> rows_in(const std::string& text) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

TEST_F(ExportEvents, QueriesMatchTheMap) {
    const Arguments flat_cascades = {"--choppiness", "0"};
    made(to("map", flat_cascades), "map");
    const ReadImage image = map("map", "dynamic-waves_0009.exr");  // 0.785714 s
    std::string points = "x,z\n";
    std::vector<std::pair<int, int>> texels;
    for (int row = 20; row < 108; row += 8)
        for (int column = 20; column < 108; column += 3) texels.emplace_back(column, row);
    for (const auto& [column, row] : texels)
        points +=
            std::to_string(-33 + column * grid_texel_m) + "," + std::to_string(-33.5 + row * grid_texel_m) + "\n";
    write_file(place("points.csv"), points);
    Arguments query = {"query",
                       "--points",
                       place("points.csv").string(),
                       "--cascades",
                       "2",
                       "--resolution",
                       "32",
                       "--wind-speed",
                       "8",
                       "--choppiness",
                       "0"};
    const Outcome calm = run_pelagic(joined(query, {"--time", "0.7857142857142857"}));
    const Outcome pushed = run_pelagic(
        joined(query, {"--time", "0.7857142857142857", "--events", events().string(), "--events-resolution", "128"}));
    ASSERT_EQ(pushed.exit_code, 0) << pushed.err;
    const auto without = rows_in(calm.out), both = rows_in(pushed.out);
    ASSERT_EQ(without.size(), texels.size());
    ASSERT_EQ(both.size(), texels.size());
    double highest = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto& [column, row] = texels[i];
        const double height = image.at(column, row, 0);
        highest = std::max(highest, std::fabs(height));
        // Rounding of sums of floats of about a metre and a metre per second.
        EXPECT_NEAR(both[i][2] - without[i][2], height, 5e-7);
        EXPECT_NEAR(both[i][7] - without[i][7], image.at(column, row, 1), 2e-6);
        const auto slope = [&](const std::vector<double>& of, std::size_t axis) { return -of[3 + axis] / of[4]; };
        const double along_x = (image.at(column + 1, row, 0) - image.at(column - 1, row, 0)) / (2 * grid_texel_m);
        const double along_z = (image.at(column, row + 1, 0) - image.at(column, row - 1, 0)) / (2 * grid_texel_m);
        EXPECT_NEAR(slope(both[i], 0) - slope(without[i], 0), along_x, 2e-6);
        EXPECT_NEAR(slope(both[i], 2) - slope(without[i], 2), along_z, 2e-6);
    }
    EXPECT_GT(highest, 0.05);
}

TEST_F(ExportEvents, DoNotDependOnEarlierTimes) {
    using namespace tools;
    EventOptions options{.file = std::make_shared<const EventFile>(parse_events("events.csv", several)), .water = {}};
    options.water.resolution = 64;
    const auto copied = [](const DynamicWavesView& water) {
        return std::pair(std::vector<float>(water.height_m.begin(), water.height_m.end()),
                         std::vector<float>(water.vertical_velocity_mps.begin(), water.vertical_velocity_mps.end()));
    };
    const auto alone = [&](double time_s) {
        return copied(EventPlayer(options, make_serial_executor(), {}).at(time_s));
    };
    EventPlayer player(options, make_serial_executor(), {});
    for (const double time_s : {1.5, 0.31, -7.0, 0.9, 0.93, 0.9, 2.25})
        EXPECT_EQ(copied(player.at(time_s)) == alone(time_s), true) << time_s;
}

TEST_F(ExportEvents, ExportsWithAnotherFileAreNotResumedOrMerged) {
    made(to("one"), "one");
    made(to("shards", {"--shard", "1/2"}), "shards");
    write_file(events(), std::string(several) + "9,1,0,1,1,,,,,\n");
    expect_one_line(run_pelagic(to("one", {"--resume"})), 2, "--events was ");
    EXPECT_EQ(read_file(place("one") / "sea_events.csv"), several);
    made(to("shards", {"--shard", "2/2"}), "shards");
    EXPECT_NE(run_pelagic({"merge", place("shards").string()}).exit_code, 0);
    // An edited copy differs from the record.
    write_file(place("one") / "sea_events.csv", std::string(several) + "\n");
    expect_one_line(run_pelagic({"verify", place("one").string()}), 2, "--events is ");
}

TEST_F(ExportEvents, InvalidRowsAreRejectedWithLineAndColumn) {
    const std::string start = "time,x,z,radius,height";
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"", " is empty, expected a CSV file whose first line names"},
        {start + "\n", "holds no events, expected rows"},
        {"0,0,0,1,1\n", ":1: a column's name is 0, expected time, x, z"},
        {"time,x,z,radius\n", "a column height"},
        {"time,x,z,x,radius,height\n", ":1: a column's name is x, expected each column once"},
        {start + ",speed\n", ":1: a column's name is speed, expected time"},
        {start + "\n\n0,0,0,1\n", ":3: the number of columns is 4, expected 5"},
        {start + "\n0,0,0,0,1\n", ":2: radius is 0, expected metres in [0.001, 1000]"},
        {start + "\n0,nan,0,1,1\n", ":2: x is nan, expected metres in"},
        {start + "\n0,+-1,0,1,1\n", ":2: x is +-1, expected metres in"},
        {start + "\n2e9,0,0,1,1\n", ":2: time is 2e9, expected seconds in"},
        {start + "\n0,0,0,1,1e3\n", ":2: height is 1e3, expected metres in [-100, 100]"},
        {start + ",velocity\n0,0,0,1,1,3\n", ":2: velocity is 3, expected 0, or a duration"},
        {start + ",mode\n0,0,0,1,1,push\n", ":2: mode is push, expected impulse, pressure, relaxation or foam"},
        {start + ",mode,duration\n0,0,0,1,1,impulse,1\n",
         ":2: mode is impulse, expected pressure or relaxation with a duration"},
        {start + "\n-90000,0,0,1,1\n", "expected 86400 s between them at most"}};
    for (const auto& [text, expected] : bad) {
        write_file(events(), text);
        const Outcome outcome = run_pelagic(to("bad"));
        expect_one_line(outcome, 2, expected);
        EXPECT_FALSE(std::filesystem::exists(place("bad"))) << text;
    }
    write_file(events(), several);
    expect_one_line(run_pelagic(to("bad", {"--events-side", "0"})), 2,
                    "--events-side is 0, expected metres in [1, 10000]");
    expect_one_line(run_pelagic(to("bad", {"--events-at", "3"})), 2, "--events-at is 3, expected X,Z");
    expect_one_line(run_pelagic({"query", "--points", "-", "--events-at", "3,4"}), 2, "it requires --events");
    std::string many = start + "\n";
    for (int i = 0; i < 4097; ++i) many += "1,0,0,1,0.1\n";
    write_file(events(), many);
    expect_one_line(run_pelagic(to("bad")), 2, "more than 4096 disturbances at 1 s");
    EXPECT_FALSE(std::filesystem::exists(place("bad")));
}

}  // namespace
}  // namespace pelagic
