// `pelagic query` as a shell runs it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <sstream>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr const char* query_header = "x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,converged";

std::vector<double> numbers_in(const std::string& line) {
    std::vector<double> numbers;
    const char* at = line.data();
    const char* const end = at + line.size();
    while (at < end) {
        at = std::from_chars(at, end, numbers.emplace_back()).ptr;
        if (at < end && *at++ != ',') return {};
    }
    return numbers;
}

Outcome query(const std::string& points, std::vector<std::string> more = {}) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", points);
    more.insert(more.begin(), {"query", "--points", (folder / "points.csv").string()});
    return run_pelagic(more);
}

TEST(QueryCommand, PrintsExactWaterBelowTheSurface) {
    const std::vector<std::string> sea = {"--resolution", "32", "--cascades", "2", "--depth", "50", "--seed", "3"};
    std::vector<std::string> more = {"--interpolation", "exact", "--times",   "0:5:5",
                                     "--sea-level",     "1.5",   "--current", "1,2"};
    more.insert(more.end(), sea.begin(), sea.end());
    const Outcome outcome = query("buoy,z,y,x\na,1,-3,0\nb,-4,-48.5,1e3\nc,0,30,2\n", more);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "note: interpolation is exact\n");
    const std::vector<std::string> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 7u);
    EXPECT_EQ(lines[0], "time,buoy,z,y,x,pressure_pa,velocity_x_mps,velocity_y_mps,velocity_z_mps,acceleration_x_mps2,"
                        "acceleration_y_mps2,acceleration_z_mps2,depth_below_surface_m");
    const ExactWater water = ExactWater({.cascades = 2, .resolution = 32, .depth_m = 50, .seed = 3},
                                        {.water_frame = {1.5, 1, 2}}).at(5);
    const std::vector<double> x = {0, 1e3, 2}, y = {-3, -48.5, 30}, z = {1, -4, 0};
    std::vector<std::vector<float>> of(8, std::vector<float>(3));
    water.sample({x, y, z}, {of[7], of[0], of[1], of[2], of[3], of[4], of[5], of[6]});
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string prefix = "5," + std::vector<std::string>{"a,1,-3,0", "b,-4,-48.5,1e3", "c,0,30,2"}[i] + ",";
        ASSERT_EQ(lines[4 + i].substr(0, prefix.size()), prefix);
        const std::vector<double> numbers = numbers_in(lines[4 + i].substr(prefix.size()));
        ASSERT_EQ(numbers.size(), of.size());
        for (std::size_t value = 0; value < of.size(); ++value)
            EXPECT_EQ(static_cast<float>(numbers[value]), of[value][i]) << value;
    }

    more.push_back("--json");
    const nlohmann::json rows = nlohmann::json::parse(query("x,y,z\n2,-1.25,0\n", more).out);
    EXPECT_EQ(rows[1]["y"], -1.25);
    EXPECT_EQ(rows[1]["interpolation"], "exact");
    EXPECT_TRUE(rows[1]["depth_below_surface_m"].is_number() && !rows[1].contains("converged"));
}

TEST(QueryCommand, PrintsTheExactSurface) {
    const Outcome outcome =
        query("0,0\n12.25,-3.5\n", {"--interpolation", "exact", "--resolution", "32", "--time", "7"});
    const std::vector<std::string> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], query_header);
    const std::vector<double> x = {0, 12.25}, z = {0, -3.5};
    std::vector<float> height(2), rise(2);
    ExactWater({.resolution = 32}).at(7).sample_surface({x, z}, {.height_m = height, .velocity_y_mps = rise});
    for (std::size_t i = 0; i < 2; ++i) {
        const std::vector<double> numbers = numbers_in(lines[1 + i]);
        EXPECT_EQ(static_cast<float>(numbers[2]), height[i]);
        EXPECT_EQ(static_cast<float>(numbers[7]), rise[i]);
        EXPECT_EQ((std::vector<double>{numbers[9], numbers[10], numbers[11]}), (std::vector<double>{1, 0, 1}));
    }
}

TEST(QueryCommand, RejectsInvalidPointsOfWaterOnOneLine) {
    const auto expect_error = [](const std::string& points, std::vector<std::string> more, const std::string& text) {
        more.insert(more.end(), {"--resolution", "16"});
        const Outcome outcome = query(points, more);
        EXPECT_EQ(outcome.exit_code, 2) << text;
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.ends_with(text + "\n")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    };
    const std::vector<std::string> exact = {"--interpolation", "exact"};
    expect_error("x,y,z\n0,0,0\n", {"--foam"}, "--foam cannot be combined with points that have a column y");
    expect_error("x,y,z\n0,0,0\n3,-60,4\n", {"--interpolation", "exact", "--depth", "50", "--sea-level", "2"},
                 ":3: the line is 3,-60,4, expected y of at least -48, the sea floor");
    expect_error("x,y,z\n0,deep,0\n", exact,
                 ":2: the line is 0,deep,0, expected x,y,z: three numbers of metres in [-1e15, 1e15]");
    expect_error("x,y,z,y\n0,0,0,0\n", exact, ":1: the line is x,y,z,y, expected at most one column y");
    expect_error("x,y,z\n0,0,0\n", {"--interpolation", "exact", "--foam"},
                 "--foam cannot be combined with --interpolation exact");
    expect_error("0,0\n", {"--interpolation", "exact", "--waves", "pond"},
                 "--waves pond cannot be combined with --interpolation exact");
    expect_error("x,y,z\n0,0,0\n", {"--interpolation", "exact", "--record", "20"}, "has a column y");
    expect_error("x,y,z,pressure_pa\n0,0,0,0\n", {"--interpolation", "exact", "--quiet"},
                 "the points' column pressure_pa has the name of another column or of a result, expected its own");
}

// With a column y the values are those of WaterQuery.
TEST(QueryCommand, SamplesTheWaterBelowAFrame) {
    const Outcome outcome = query("x,y,z\n3,-4,5\n-60,-12,7\n", {"--resolution", "64", "--time", "12.5"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    Ocean ocean({.resolution = 64}, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const std::vector<double> x = {3, -60}, y = {-4, -12}, z = {5, 7};
    std::vector<float> pressure(2), rise(2);
    WaterQuery(ocean.frame_at(12.5), {.surface = {.interpolation = Interpolation::cubic}})
        .sample({x, y, z}, {.pressure_pa = pressure, .velocity_y_mps = rise});
    std::istringstream lines(outcome.out);
    std::string line;
    std::getline(lines, line);
    for (std::size_t i = 0; i < 2; ++i) {
        std::getline(lines, line);
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        double skipped, p, vx, vy;
        numbers >> skipped >> skipped >> skipped >> p >> vx >> vy;
        EXPECT_NEAR(p, static_cast<double>(pressure[i]), 0.01);  // floats of 1e5 Pa
        EXPECT_NEAR(vy, static_cast<double>(rise[i]), 1e-6);
    }
}

// The default interpolation is cubic, and the output states which is used.
TEST(QueryCommand, PrintsTheLibrarysResultsExactly) {
    for (const auto& [flags, interpolation] :
         {std::pair<std::vector<std::string>, Interpolation>{{}, Interpolation::cubic},
          {{"--interpolation", "cubic"}, Interpolation::cubic},
          {{"--interpolation", "linear"}, Interpolation::linear}}) {
        std::vector<std::string> more = {"--time",       "12.5", "--resolution", "64", "--patch-size", "250",
                                         "--choppiness", "1",    "--wind-speed", "9",  "--seed",       "3"};
        more.insert(more.end(), flags.begin(), flags.end());
        const Outcome outcome = query("x,z\n0,0\n12.25,-3.5\n\n  1e2 ,\t-0.1\r\n", more);
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.err, "note: interpolation is " + std::string(name_of(interpolation)) + "\n");
        const std::vector<std::string> lines = lines_of(outcome.out);
        ASSERT_EQ(lines.size(), 4u);
        EXPECT_EQ(lines[0], query_header);

        Ocean ocean({.resolution = 64, .patch_size_m = 250, .wind_speed_mps = 9, .choppiness = 1, .seed = 3},
                    {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
        const std::vector<double> x = {0, 12.25, 1e2}, z = {0, -3.5, -0.1};
        std::vector<std::vector<float>> values(9, std::vector<float>(3));
        std::vector<std::uint8_t> converged(3);
        SurfaceQuery(ocean.frame_at(12.5), {.interpolation = interpolation})
            .sample({x, z}, {.height_m = values[0],
                             .normal_x = values[1],
                             .normal_y = values[2],
                             .normal_z = values[3],
                             .jacobian = values[7],
                             .velocity_x_mps = values[4],
                             .velocity_y_mps = values[5],
                             .velocity_z_mps = values[6],
                             .error_m = values[8],
                             .converged = converged});
        for (std::size_t i = 0; i < 3; ++i) {
            const std::vector<double> numbers = numbers_in(lines[i + 1]);
            ASSERT_EQ(numbers.size(), 12u) << lines[i + 1];
            EXPECT_EQ(numbers[0], x[i]);
            EXPECT_EQ(numbers[1], z[i]);
            for (std::size_t value = 0; value < values.size(); ++value)
                EXPECT_EQ(static_cast<float>(numbers[2 + value]), values[value][i]) << lines[i + 1];
            EXPECT_EQ(numbers[11], 1);
        }
    }
}

// The default sea repeats after 3600 s: the row of 3600 s equals that of 0 s.
TEST(QueryCommand, RejectsTimesBeyondTheLoopUnlessItIsGiven) {
    const Outcome outcome = query("1,2\n", {"--times", "0:7200:3600"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(
        outcome.err,
        "pelagic: --times 0:7200:3600 spans 7200 s, but the sea repeats after 3600 s: --loop-period 10800 makes it long "
        "enough, and --loop-period 3600 permits repetition\n");
    const auto heights = [](const Outcome& run) {
        std::vector<double> found;
        for (const std::string& line : lines_of(run.out))
            if (const std::vector<double> numbers = numbers_in(line); numbers.size() == 13)
                found.push_back(numbers[3]);
        return found;
    };
    const Outcome repeated = query("1,2\n", {"--times", "0:7200:3600", "--loop-period", "3600"});
    EXPECT_EQ(repeated.exit_code, 0) << repeated.err;
    const std::vector<double> same = heights(repeated);
    ASSERT_EQ(same.size(), 3u);
    EXPECT_TRUE(same[0] == same[1] && same[1] == same[2]);
    const std::vector<double> others = heights(query("1,2\n", {"--times", "0:7200:3600", "--loop-period", "10800"}));
    ASSERT_EQ(others.size(), 3u);
    EXPECT_TRUE(others[0] != others[1] && others[1] != others[2] && others[2] != others[0]);
    // A file may also give the loop; times that span exactly one loop close it.
    const TemporaryFolder folder;
    write_file(folder / "sea.toml", "loop_period = 10\n");
    EXPECT_EQ(query("1,2\n", {"--times", "0:30:10", "--config", (folder / "sea.toml").string()}).exit_code, 0);
    EXPECT_EQ(query("1,2\n", {"--times", "-1800:1800:1800"}).exit_code, 0);
    const Outcome days = query("1,2\n", {"--times", "0:90000:60"});
    EXPECT_EQ(days.exit_code, 2);
    EXPECT_NE(days.err.find("no loop is longer than 86400 s; --loop-period 3600 permits"), std::string::npos)
        << days.err;
}

TEST(QueryCommand, ReportsPointsThatSpanMoreThanAPeriod) {
    const auto notes = [](const std::string& points) { return query(points, {"--patch-size", "250"}).err; };
    const std::string note = "note: the points span 250.5 m, but the longest waves repeat after 250 m\n";
    EXPECT_NE(notes("100,2\n3,4\n100,252.5\n").find(note), std::string::npos);
    EXPECT_EQ(notes("100,2\n3,4\n100,252\n").find("span"), std::string::npos);
    // In double the side, six times 1.2 m, is 7.199999999999999.
    EXPECT_NE(
        query("0,0\n20,0\n", {"--preset", "pond"}).err.find("span 20 m, but the longest waves repeat after 7.2 m\n"),
        std::string::npos);
}

TEST(QueryCommand, ReadsPointsWithoutAHeaderAndWithAByteOrderMark) {
    EXPECT_EQ(lines_of(query("1,2\n3,4").out).size(), 3u);
    EXPECT_EQ(lines_of(query("\xEF\xBB\xBFx,z\r\n1,2\r\n").out).size(), 2u);
}

TEST(QueryCommand, RejectsAFileWithoutPoints) {
    for (const char* points : {"", "\n\n", "x,z\n\n", "name,z,x"}) {
        const Outcome outcome = query(points);
        EXPECT_EQ(outcome.exit_code, 2) << points;
        EXPECT_EQ(outcome.out, "") << points;
        EXPECT_NE(outcome.err.find("points.csv holds no points, expected lines x,z"), std::string::npos)
            << outcome.err;
    }
}

TEST(QueryCommand, KeepsTheColumnsOfTheFileAndFindsXAndZByName) {
    const std::vector<std::string> lines = lines_of(query("z, name ,x\n2,\"Buoy, \"\"A\"\"\",1\n4,,+3\n").out);
    const std::vector<std::string> plain = lines_of(query("1,2\n3,4\n").out);
    ASSERT_EQ(lines.size(), 3u);
    ASSERT_EQ(plain.size(), 3u);
    EXPECT_EQ(lines[0], "z,name,x" + plain[0].substr(3));
    EXPECT_EQ(lines[1], "2,\"Buoy, \"\"A\"\"\",1" + plain[1].substr(3));
    EXPECT_EQ(lines[2], "4,,+3" + plain[2].substr(3));
    for (const auto& [points, says] : std::vector<std::pair<std::string, std::string>>{
             {"x,z,y\n1,2\n", "points.csv:2: the line is 1,2, expected 3 columns"},
             {"1,2,3\n", "or a first line that names columns"},
             {"x,z,x\n1,2,3\n", "expected one column x and one column z"},
             {"x,z,height\n1,2,3\n", "the points' column height has the name"},
             {"x,z,a\n1,2,\"b\n", "expected an end of its quotes"}}) {
        const Outcome outcome = query(points);
        EXPECT_EQ(outcome.exit_code, 2) << points;
        EXPECT_EQ(outcome.out, "") << points;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err << "lacks " << says;
    }
}

// The water of (7, 2) at 100 s comes from (7 - 2 * 100, 2 + 1 * 100).
TEST(QueryCommand, SeaLevelAndCurrentMoveTheWater) {
    const std::vector<std::string> sea = {"--time", "100", "--resolution", "64", "--patch-size", "250"};
    std::vector<std::string> options = sea;
    options.insert(options.end(), {"--sea-level", "3", "--current", "2,-1"});
    const std::vector<std::string> moved = lines_of(query("7,2\n", options).out),
                                   still = lines_of(query("-193,102\n", sea).out);
    ASSERT_EQ(moved.size(), 2u);
    ASSERT_EQ(still.size(), 2u);
    const std::vector<double> a = numbers_in(moved[1]), b = numbers_in(still[1]);
    ASSERT_EQ(a.size(), 12u);
    ASSERT_EQ(b.size(), 12u);
    const std::vector<double> added = {200, -100, 3, 0, 0, 0, 2, 0, -1, 0, 0, 0};
    // Floats of a few metres have rounding errors of 5e-7.
    for (std::size_t i = 0; i < added.size(); ++i) EXPECT_NEAR(a[i], b[i] + added[i], 1e-6) << i;
    for (const auto& [wrong, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"--sea-level", "1001"}, "--sea-level is 1001, expected metres in [-1000, 1000]"},
             {{"--current", "1"}, "--current is 1, expected X,Z in m/s, each in [-10, 10]"},
             {{"--current", "1,-11"}, "--current is 1,-11, expected X,Z in m/s, each in [-10, 10]"}}) {
        const Outcome outcome = query("7,2\n", wrong);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
    }
}

TEST(QueryCommand, ReadsStandardInput) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "1,2\n3,4\n");
    const Outcome outcome = run_pelagic(
        {"query", "--points", "-"}, [&] { ::dup2(::open((folder / "points.csv").c_str(), O_RDONLY), STDIN_FILENO); });
    EXPECT_EQ(outcome.err, "note: interpolation is cubic\n");
    EXPECT_EQ(lines_of(outcome.out).size(), 3u);
    EXPECT_EQ(outcome.out, query("1,2\n3,4\n").out);
}

// Another JSON reader finds the same numbers.
TEST(QueryCommand, PrintsJsonWithTheSameNumbers) {
    const std::string points = "x,z,name\n1,2,\"a \"\"\xc3\xb6\"\" \t\xff\"\n3e0,4,b\n";
    const Outcome outcome = query(points, {"--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json rows = nlohmann::json::parse(outcome.out);
    const std::vector<std::string> lines = lines_of(query("1,2\n3,4\n").out);
    const char* const names[] = {"x", "z", "height", "nx", "ny", "nz", "vx", "vy", "vz", "jacobian", "error_m"};
    ASSERT_EQ(rows.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::vector<double> numbers = numbers_in(lines[i + 1]);
        for (std::size_t value = 0; value < std::size(names); ++value)
            EXPECT_EQ(rows[i].at(names[value]).get<double>(), numbers[value]) << names[value];
        EXPECT_EQ(rows[i].at("converged"), true);
        EXPECT_EQ(rows[i].at("interpolation"), "cubic");
        EXPECT_EQ(rows[i].size(), 14u);
    }
    EXPECT_EQ(rows[0].at("name"), "a \"\xc3\xb6\" \t\xEF\xBF\xBD");
    EXPECT_EQ(rows[1].at("name"), "b");
}

TEST(QueryCommand, PrintsASeriesOfTimes) {
    const std::vector<std::string> lines = lines_of(query("1,2\n3,4\n", {"--times", "-0.5:0.5:0.1"}).out);
    ASSERT_EQ(lines.size(), 1 + 11 * 2u);
    EXPECT_EQ(lines[0], "time," + std::string(query_header));
    EXPECT_TRUE(lines[1].starts_with("-0.5,1,2,"));
    EXPECT_TRUE(lines[22].starts_with("0.5,3,4,"));
    for (const auto& [row, time] : {std::pair{3, "-0.4"}, {21, "0.5"}}) {
        const std::vector<std::string> at_once = lines_of(query("1,2\n3,4\n", {"--time", time}).out);
        EXPECT_EQ(lines[row], time + std::string(",") + at_once[1]);
    }
    for (const char* bad : {"0:1", "0:1:0", "1:0:0.1", "0:1:x", "0:2e9:1", "0:1:1e-7", "::", "0:1:nan"}) {
        const Outcome outcome = query("1,2\n", {"--times", bad});
        EXPECT_EQ(outcome.exit_code, 2) << bad;
        EXPECT_NE(outcome.err.find("--times is " + std::string(bad) + ", expected FIRST:LAST:STEP"),
                  std::string::npos)
            << outcome.err;
    }
    EXPECT_EQ(query("1,2\n", {"--times", "0:1:1", "--time", "0"}).exit_code, 2);
}

TEST(QueryCommand, ReadsAFileOfAnyLengthInConstantMemory) {
    const TemporaryFolder folder;
    constexpr int points = is_sanitized ? 60'000 : 300'000;
    std::string text = "x,z,note\n";
    for (int i = 0; i < points; ++i) text += std::to_string(i % 977) + ".25," + std::to_string(i % 1013) + ",buoy\n";
    const auto peak_kb = [&](const std::string& of) {
        write_file(folder / "points.csv", of);
        rusage used{};
        const pid_t process = start_pelagic({"query", "--points", (folder / "points.csv").string(), "--threads", "1"},
                                            folder / "out", folder / "err");
        int status = 0;
        ::wait4(process, &status, 0, &used);
        EXPECT_EQ(status, 0) << read_file(folder / "err");
        return used.ru_maxrss;
    };
    const long few = peak_kb(text.substr(0, text.rfind('\n', text.size() / 5) + 1));
    const long many = peak_kb(text);
    EXPECT_EQ(lines_of(read_file(folder / "out")).size(), 1u + points);
    if (is_sanitized) return;
    // Five times the points: 240,000 more, which would take at least 52 bytes each, 12 MB, if all
    // were held in memory.
    EXPECT_LT(many - few, 6000) << few << " kB and " << many << " kB";
}

TEST(QueryCommand, RejectsAnEndlessLine) {
    const Outcome outcome = query("1,2\n" + std::string(3 << 20, '7'));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("points.csv:2: the line has more than 65536 characters"), std::string::npos)
        << outcome.err;
}

TEST(QueryCommand, OutputDependsNeitherOnThreadsNorOnTheInstructionSet) {
    std::string points;
    const int count = is_sanitized ? 600 : 3000;
    for (int i = 0; i < count; ++i) points += std::to_string(i * 0.37) + "," + std::to_string(500 - i * 1.1) + "\n";
    const std::string expected = query(points, {"--threads", "1"}).out;
    EXPECT_EQ(lines_of(expected).size(), 1u + static_cast<unsigned>(count));
    EXPECT_EQ(query(points, {"--threads", "3"}).out, expected);
    for (const Isa isa : isas_here()) EXPECT_EQ(query(points, {"--isa", std::string(name_of(isa))}).out, expected);
}

TEST(QueryCommand, MoreThreadsThanCpusAreNotedOnce) {
    const int cpus = default_thread_count();
    if (cpus == 1024) GTEST_SKIP() << "no larger count is accepted";
    const Outcome as_many = query("1,2\n", {"--threads", std::to_string(cpus)});
    const Outcome more = query("1,2\n", {"--threads", std::to_string(cpus + 1)});
    EXPECT_EQ(as_many.err.find("--threads"), std::string::npos) << as_many.err;
    EXPECT_EQ(more.err, "note: --threads " + std::to_string(cpus + 1) +
                            " is more than the CPUs that this process may use, " + std::to_string(cpus) +
                            ": uses as many\n" + as_many.err);
    EXPECT_EQ(more.out, as_many.out);
}

TEST(QueryCommand, NamesFileLineAndTextOfInvalidInput) {
    for (const auto& [points, says] : std::vector<std::pair<std::string, std::string>>{
             {"x,z\n1,2\nharbour\n", "points.csv:3: the line is harbour, expected x,z"},
             {"1\n", ":1: the line is 1, expected x,z"},
             {"1,2,3\n", ":1: the line is 1,2,3, expected x,z"},
             {"1;2\n", ":1: the line is 1;2, expected"},
             {",\n", ":1: the line is ,, expected"},
             {"1,nan\n", ":1: the line is 1,nan, expected"},
             {"1,+-1\n", ":1: the line is 1,+-1, expected"},
             {"inf,1\n", ":1: the line is inf,1, expected"},
             {"1e16,1\n", "[-1e15, 1e15]"},
             {"1,2\nx,z\n", ":2: the line is x,z, expected"},
             {"\n\n0x10,1\n", ":3: the line is 0x10,1, expected"},
             {"1,2\x1b[2J\n", "the line is 1,2\\x1b[2J, expected"}}) {
        const Outcome outcome = query(points);
        EXPECT_EQ(outcome.exit_code, 2) << points;
        EXPECT_EQ(outcome.out, "") << points;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err << "lacks " << says;
    }
}

TEST(QueryCommand, AFootprintLeavesOutShortWaves) {
    const std::vector<std::string> sea = {"--resolution", "64",  "--cascades",   "1",
                                          "--patch-size", "200", "--choppiness", "0"};
    const auto first_height = [&](std::vector<std::string> more) {
        more.insert(more.end(), sea.begin(), sea.end());
        const Outcome outcome = query("3,4\n", more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return static_cast<float>(numbers_in(lines_of(outcome.out)[1])[2]);
    };
    SeaState state{.patch_size_m = 200};
    state.resolution = 64, state.cascades = 1, state.choppiness = 0;
    Ocean ocean(state, {.queries = true, .depth = true});
    const double x = 3, z = 4;
    float height = 0;
    SurfaceQuery(ocean.frame_at(0), {.interpolation = Interpolation::cubic})
        .sample({{&x, 1}, {&z, 1}, 30}, {.height_m = {&height, 1}});
    EXPECT_EQ(first_height({"--footprint", "30"}), height);
    ExactWater(state).sample_surface({{&x, 1}, {&z, 1}, 30}, {.height_m = {&height, 1}});
    EXPECT_EQ(first_height({"--footprint", "30", "--interpolation", "exact"}), height);
    EXPECT_NE(first_height({}), first_height({"--footprint", "30"}));
}

TEST(QueryCommand, NamesTheMissingOrInvalidOption) {
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "1,2\n");
    const std::string points = (folder / "points.csv").string();
    for (const auto& [arguments, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"query"}, "--points is missing: expected a CSV file of lines x,z"},
             {{"query", "--points", ""}, "--points is missing"},
             {{"query", "--points", (folder / "none.csv").string()},
              "none.csv, which can't be read, expected a CSV file"},
             {{"query", "--points", folder.path().string()}, ", a folder, expected a CSV file"},
             {{"query", "--points", "/proc/self/mem"}, "/proc/self/mem, which can't be read, expected a CSV file"},
             {{"query", "--points", points, "--time", "noon"}, "--time is noon, expected seconds in [-1e9, 1e9]"},
             {{"query", "--points", points, "--time", "2e9"}, "--time is 2e9, expected seconds in [-1e9, 1e9]"},
             {{"query", "--points", points, "--interpolation", "quintic"},
              "--interpolation is quintic, expected linear, cubic or exact"},
             {{"query", "--points", points, "--footprint", "-1"}, "--footprint -1 is out of range [0, 10000] m"},
             {{"query", "--points", points, "--footprint", "5", "--waves", "pond"},
              "--waves pond cannot be combined with --footprint"},
             {{"query", "--points", points, "--footprint", "5", "--velocities", "drawn"},
              "--velocities drawn cannot be combined with --footprint"},
             {{"query", "--points", points, "--choppiness", "2"}, "--choppiness 2 is out of range [0, 1]"},
             {{"query", "--points", points, "--tmie", "2"}, "unknown option --tmie, the nearest known one is --time"},
             {{"ask"},
              "unknown command ask, expected info, export, merge, verify, query, render, view, quadtree or bench"},
             {{}, "no command, expected info, export, merge, verify, query, render, view, quadtree or bench"}}) {
        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << says;
        EXPECT_EQ(outcome.out, "") << says;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err << "lacks " << says;
    }
}

TEST(QueryCommand, HelpListsTheOutputColumns) {
    const Outcome outcome = run_pelagic({"query", "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* part : {"--points", "--time", query_header})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
    EXPECT_NE(run_pelagic({"--help"}).out.find("query"), std::string::npos);
}

// The record is a series of the library's heights; statistics of a regular wave would be exact, those
// of a random sea are within their sampling errors of `info`.
TEST(QueryCommand, RecordsOnePointAsABuoy) {
    const Outcome outcome =
        run_pelagic({"query", "--record", "600", "--rate", "2", "--wind-speed", "9", "--time", "50"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "note: interpolation is cubic\n");
    const std::vector<std::string> lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 1u + 1200 + 7);
    EXPECT_EQ(lines[0], "time," + std::string(query_header));
    EXPECT_EQ(lines[1].substr(0, 7), "50,0,0,");
    EXPECT_EQ(lines[1200].substr(0, 10), "649.5,0,0,");
    double sum = 0, squares = 0;
    for (std::size_t i = 1; i <= 1200; ++i) {
        const double height = numbers_in(lines[i]).at(3);
        sum += height / 1200, squares += height * height / 1200;
    }
    std::map<std::string, double> footer;
    for (std::size_t i = 1201; i < lines.size(); ++i) {
        const std::size_t comma = lines[i].find(',');
        ASSERT_EQ(lines[i].substr(0, 2), "# ");
        footer[lines[i].substr(2, comma - 2)] = std::stod(lines[i].substr(comma + 1));
    }
    EXPECT_NEAR(footer.at("Hm0_m"), 4 * std::sqrt(squares - sum * sum), 1e-3);
    const SeaReport report = report_on({.wind_speed_mps = 9, .loop_period_s = 3600});
    EXPECT_NEAR(footer.at("Hm0_m") / report.realised_significant_wave_height_m, 1, 0.25);
    EXPECT_NEAR(footer.at("Tp_s") / report.expected.peak_period_s, 1, 0.2);
    EXPECT_NEAR(footer.at("Tz_s") / report.expected_periods.tm02_s, 1, 0.2);
    EXPECT_NEAR(footer.at("direction_deg"), 0, 20);
    EXPECT_NEAR(footer.at("spread_deg") * std::numbers::pi / 180, report.expected_directions.spread_rad, 0.25);
    EXPECT_NEAR(footer.at("skewness"), 0, 0.5);
    EXPECT_NEAR(footer.at("highest_wave_m") / footer.at("Hm0_m"), 1.6, 0.5);
}

TEST(QueryCommand, RejectsInvalidRecords) {
    const TemporaryFolder folder;
    write_file(folder / "two.csv", "0,0\n1,1\n");
    const std::string two = (folder / "two.csv").string();
    const std::string a_duration = "seconds in [10, 86400], with 16 to 1000000 samples";
    for (const auto& [flags, message] : {
             std::pair<std::vector<std::string>, std::string>{{"--rate", "4"},
                                                              "--rate needs --record: only a record has a rate"},
             {{"--record", "5"}, "--record is 5, expected " + a_duration},
             {{"--record", "10", "--rate", "1"}, "--record is 10, expected " + a_duration},
             {{"--record", "60", "--rate", "0"}, "--rate is 0, expected samples per second in [0.001, 100]"},
             {{"--record", "60", "--json"}, "--json cannot be combined with --record"},
             {{"--record", "60", "--times", "0:1:1"}, "--times cannot be combined with --record"},
             {{"--record", "60", "--points", two}, "--record needs one point, and " + two + " has more"}}) {
        std::vector<std::string> words = {"query"};
        words.insert(words.end(), flags.begin(), flags.end());
        const Outcome outcome = run_pelagic(words);
        EXPECT_EQ(outcome.exit_code, 2) << message;
        EXPECT_EQ(outcome.err, "pelagic: " + message + "\n");
        EXPECT_EQ(outcome.out, "");
    }
}

}  // namespace
}  // namespace pelagic
