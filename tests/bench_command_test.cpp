// `pelagic bench` measures and prints what its options select. Times are not compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/simd/isa.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/benchmark/option_cost.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

const std::vector<std::string> jobs_of_one_cascade = {"evolve+rows", "columns+finalize", "gradients+mipmaps",
                                                      "mipmaps tail"};

Outcome bench(std::vector<std::string> more) {
    more.insert(more.begin(), {"bench", "--seconds", "0.2"});
    return run_pelagic(more);
}

std::vector<std::string> split_at(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    for (std::size_t from = 0, at = 0; at != std::string::npos; from = at + separator.size()) {
        at = text.find(separator, from);
        parts.push_back(text.substr(from, at - from));
    }
    return parts;
}

void expect_in_order(const json& quartiles, const json& median) {
    EXPECT_GT(quartiles.at(0).get<double>(), 0);
    EXPECT_LE(quartiles.at(0), median);
    EXPECT_LE(median, quartiles.at(1));
}

/// Returns the largest number of threads that `--threads 3` measures: no more than CPUs.
int measured_threads() { return std::min(3, default_thread_count()); }

TEST(BenchCommand, TimesEachJobOfEachSizeOnEachInstructionSetAndNumberOfThreads) {
    const Outcome run = bench({"--sizes", "128,32", "--threads", "3", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), default_thread_count() < 3) << run.err;
    const json all = json::parse(run.out);
    EXPECT_FALSE(all.at("cpu").get<std::string>().empty());
    std::vector<std::string> rows, wanted;
    for (const json& row : all.at("rows")) {
        rows.push_back(row.at("n").dump() + row.at("isa").get<std::string>() + row.at("threads").dump());
        EXPECT_EQ(row.at("cascades"), 1);
        expect_in_order(row.at("ours_ms_quartiles"), row.at("ours_ms"));
        EXPECT_GT(row.at("speedup").get<double>(), 0);
        EXPECT_GT(row.at("gb_per_s").get<double>(), 0);
        EXPECT_EQ(row.contains("jobs"), row.at("threads") == 1);
        std::vector<std::string> jobs;
        for (const json& job : row.value("jobs", json::array())) {
            jobs.push_back(job.at("job"));
            expect_in_order(job.at("ms_quartiles"), job.at("ms"));
            EXPECT_GT(job.at("gb_per_s").get<double>(), 0);
        }
        EXPECT_TRUE(jobs == jobs_of_one_cascade || row.at("threads") != 1);
    }
    for (const char* n : {"32", "128"}) {
        for (const Isa isa : isas_here()) wanted.push_back(n + std::string(name_of(isa)) + "1");
        for (int threads = 2; threads <= measured_threads(); ++threads)
            wanted.push_back(n + std::string(name_of(isas_here().back())) + std::to_string(threads));
    }
    EXPECT_EQ(rows, wanted);
}

TEST(BenchCommand, PrintsTablesWithinAHundredColumnsAndWritesTheFile) {
    const TemporaryFolder folder;
    const Outcome run = bench({"--sizes", "256", "--threads", "1", "--json", (folder / "here.json").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(files_in(folder.path()).size(), 1u);
    EXPECT_EQ(json::parse(read_file(folder / "here.json")).at("rows").size(), isas_here().size());
    for (const Isa isa : isas_here()) EXPECT_NE(run.out.find(name_of(isa)), std::string::npos);
    for (const std::string& job : jobs_of_one_cascade) EXPECT_NE(run.out.find(job), std::string::npos) << job;
    EXPECT_EQ(run.out.find("several threads"), std::string::npos);
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);  // the name of the processor has any length
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
}

// A frame of 256 with its spectrum has 4 MB. Beyond a first-level cache, each job moves its inputs
// and outputs at least once.
TEST(BenchCommand, PrintsCopySpeedsAndTheBytesOfFramesAtEachLevel) {
    const std::string counts = in_sources("bench/bytes.json");
    const Outcome run = bench({"--bytes", counts, "--sizes", "64,256", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json all = json::parse(run.out), levels = all.at("memory_levels");
    ASSERT_GE(levels.size(), 2u);
    std::size_t smaller = 0;
    for (const json& level : levels) {
        EXPECT_GT(level.at("copy_gb_per_s").get<double>(), 0);
        if (level.at("level") == "memory") continue;
        EXPECT_GT(level.at("bytes").get<std::size_t>(), smaller);
        smaller = level.at("bytes");
    }
    double once = 0;
    for (const std::string& job : jobs_of_one_cascade) once += tools::work_of(job, {1, 256, 8}).bytes;
    ASSERT_EQ(all.at("rows").size(), 2u) << "one instruction set, one thread";
    for (const json& row : all.at("rows")) {
        const json& moved = row.at("moved");
        ASSERT_EQ(moved.size() + 1, levels.size());
        for (std::size_t i = 0; i < moved.size(); ++i) {
            EXPECT_EQ(moved[i].at("level"), levels[i + 1].at("level"));
            const double bytes = moved[i].at("bytes"), ms = moved[i].at("ms");
            EXPECT_NEAR(ms, bytes / (levels[i + 1].at("copy_gb_per_s").get<double>() * 1e6), 1e-9);
            EXPECT_NEAR(moved[i].at("share").get<double>(), ms / row.at("ours_ms").get<double>(), 1e-9);
            EXPECT_TRUE(i == 0 || bytes <= moved[i - 1].at("bytes")) << "a larger cache holds more";
        }
        if (row.at("n") == 256) {
            EXPECT_GT(moved[0].at("bytes").get<double>(), once * 256 * 256);
        }
    }

    const Outcome table = bench({"--bytes", counts, "--sizes", "32,64"});
    EXPECT_NE(table.out.find("copy, GB/s"), std::string::npos);
    EXPECT_NE(table.out.find("not counted for this sea"), std::string::npos) << "N = 32 has no count";
    std::istringstream lines(table.out);
    std::string line;
    std::getline(lines, line);  // the name of the processor has any length
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
    EXPECT_EQ(bench({"--bytes", counts, "--headset"}).exit_code, 2);
    const std::string other = in_sources("bench/budgets.json");
    EXPECT_NE(bench({"--bytes", other}).err.find("expected a file of counts as bench/bytes.json"), std::string::npos);
}

TEST(BenchCommand, JobsOfSeveralCascadesAreSummed) {
    std::vector<double> done;
    const tools::Timings timings =
        tools::time_frames({.seas = {{}}, .isas = {isas_here().back()}, .threads = {1}, .seconds = 0.1},
                           [&](const std::string& sea, double part) {
                               EXPECT_EQ(sea, "4x128");
                               done.push_back(part);
                           });
    ASSERT_EQ(timings.frames.size(), 1u);
    const tools::FrameTiming& frame = timings.frames[0];
    EXPECT_EQ(frame.sea(), "4x128");
    std::vector<std::string> jobs;
    double sum_ms = 0;
    for (const tools::JobTiming& job : frame.jobs) {
        jobs.push_back(job.job);
        sum_ms += job.ms.median;
        EXPECT_TRUE(timings.no_counter.empty() || !job.instructions);
        EXPECT_GT(job.instructions.value_or(1), 0);
    }
    EXPECT_EQ(jobs, (std::vector<std::string>{"evolve+rows", "columns+finalize", "slopes+mipmaps", "slopes tail"}));
    EXPECT_GT(sum_ms, 0);
    EXPECT_GE(done.size(), 5u);  // progress is reported between the turns
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_GT(done.front(), 0);
    EXPECT_LE(done.back(), 1);
}

// For N = 256, one job computes columns and maps of frames without planes.
TEST(BenchCommand, TimesFramesOfTexturesOnly) {
    const auto row_of = [](std::vector<std::string> more) {
        more.insert(more.end(), {"--sizes", "256", "--threads", "1", "--isa",
                                 std::string(name_of(isas_here().front())), "--json", "-"});
        const Outcome run = bench(more);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return json::parse(run.out).at("rows").at(0);
    };
    const json with = row_of({}), without = row_of({"--textures-only"});
    EXPECT_FALSE(with.at("textures_only"));
    EXPECT_TRUE(without.at("textures_only"));
    EXPECT_LT(without.at("memory_bytes"), with.at("memory_bytes"));
    EXPECT_EQ(without.at("upload_bytes"), with.at("upload_bytes"));
    std::vector<std::string> jobs;
    for (const json& job : without.at("jobs")) {
        jobs.push_back(job.at("job"));
        EXPECT_GT(job.at("gb_per_s").get<double>(), 0);
    }
    EXPECT_EQ(jobs, (std::vector<std::string>{"evolve+rows", "edge columns", "columns+textures", "mipmaps tail"}));
}

// With the instruction set that every x86-64 processor has: its registers are as wide as a
// headset's, so memory sizes are equal.
json headset_rows() {
    const std::string isa(name_of(isas_here().front()));
    const Outcome run = bench({"--headset", "--threads", "3", "--isa", isa, "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out).at("rows");
}

std::string sea_label(const json& row) { return row.at("cascades").dump() + "x" + row.at("n").dump(); }

json memory_by_info(const json& row) {
    std::vector<std::string> ask = {"info", "--json", "--isa", row.at("isa"), "--resolution", row.at("n").dump()};
    const bool is_one_cascade = row.at("cascades") == 1;
    ask.push_back(is_one_cascade ? "--patch-size" : "--cascades");
    ask.push_back(is_one_cascade ? "250" : row.at("cascades").dump());
    return json::parse(run_pelagic(ask).out).at("computing").at("memory_bytes");
}

TEST(HeadsetBench, HasEachSeaOnOneTwoAndThreeThreadsWithItsMemoryAndTextures) {
    std::vector<std::string> rows, wanted;
    for (const json& row : headset_rows()) {
        rows.push_back(sea_label(row) + " " + row.at("threads").dump());
        expect_in_order(row.at("ours_ms_quartiles"), row.at("ours_ms"));
        if (row.at("threads") == 1) {
            EXPECT_EQ(row.at("memory_bytes"), memory_by_info(row)) << rows.back();
        }
        // Half floats. A single cascade has one mip chain of 32-bit words, several cascades have
        // two each.
        const std::size_t cascades = row.at("cascades"), n = row.at("n"), chains = cascades == 1 ? 1 : 2;
        EXPECT_EQ(row.at("upload_bytes"), cascades * (8 * n * n + chains * 4 * (4 * n * n - 1) / 3)) << rows.back();
    }
    for (const char* sea : {"1x128", "1x256", "3x64", "3x128", "4x128"})
        for (int threads = 1; threads <= measured_threads(); ++threads)
            wanted.push_back(sea + (" " + std::to_string(threads)));
    EXPECT_EQ(rows, wanted);
}

TEST(HeadsetBench, PrintsItsRowsWithinAHundredColumns) {
    const Outcome run = bench({"--headset", "--threads", "2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);  // the name of the processor has any length
    std::vector<std::string> rows;
    while (std::getline(lines, line)) {
        EXPECT_LE(line.size(), 100u) << line;
        std::istringstream words(line);
        std::string sea, threads;
        if (words >> sea >> threads && sea.find('x') == 1) rows.push_back(sea + " " + threads);
    }
    std::vector<std::string> wanted = {"1x128 1", "1x128 2", "1x256 1", "1x256 2", "3x64 1",
                                       "3x64 2",  "3x128 1", "3x128 2", "4x128 1", "4x128 2"};
    if (measured_threads() == 1) std::erase_if(wanted, [](const std::string& row) { return row.back() == '2'; });
    EXPECT_EQ(rows, wanted);
}

TEST(CostBench, HasARowForEachOptionWithItsMemory) {
    const Outcome run = bench({"--cost", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json all = json::parse(run.out);
    EXPECT_EQ(all.at("isa"), std::string(name_of(isas_here().back())));
    std::vector<std::string> rows;
    std::map<std::string, std::size_t> bytes;
    for (const json& row : all.at("rows")) {
        rows.push_back(row.at("option"));
        bytes[rows.back()] = row.at("memory_bytes");
        for (const std::string pace : {"warm", "rhythm"}) {
            expect_in_order(row.at(pace + "_ms_quartiles"), row.at(pace + "_ms"));
            EXPECT_GT(row.at(pace + "_ratio").get<double>(), 0) << rows.back();
        }
    }
    EXPECT_EQ(rows, tools::cost_rows());
    const json bare = all.at("rows").at(0), boat = all.at("rows").back();
    EXPECT_EQ(bare.at("warm_ratio"), 1);
    EXPECT_GT(boat.at("warm_ratio").get<double>(), 1) << "four options of which each adds to a frame";
    const json info = json::parse(run_pelagic({"info", "--json"}).out);
    EXPECT_EQ(bytes["bare"], info.at("computing").at("memory_bytes"));
    for (const char* option :
         {"queries", "velocities drawn", "velocities water", "depth", "foam", "dynamic waves 256"})
        EXPECT_GT(bytes[option], bytes["bare"]) << option;
    EXPECT_GT(bytes["boat"], bytes["depth"]);
}

TEST(CostBench, PrintsItsRowsWithinAHundredColumns) {
    const TemporaryFolder folder;
    const Outcome run = bench({"--cost", "--json", (folder / "cost.json").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(json::parse(read_file(folder / "cost.json")).at("rows").size(), tools::cost_rows().size());
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);  // the name of the processor has any length
    std::vector<std::string> rows;
    while (std::getline(lines, line)) {
        EXPECT_LE(line.size(), 100u) << line;
        if (const auto bar = line.find('|'); bar != std::string::npos)
            rows.push_back(line.substr(0, line.find_last_not_of(' ', bar - 1) + 1));
    }
    rows.erase(rows.begin(), rows.begin() + 2);  // headings
    EXPECT_EQ(rows, tools::cost_rows());
}

std::string megabytes(const json& bytes, const char* format) {
    char text[40];
    std::snprintf(text, sizeof text, format, bytes.get<double>() / 1e6);
    return text;
}

// The page's milliseconds come from a model (bench/instructions/headset_model.py); memory and
// upload sizes come from this program. Sizes do not depend on threads.
TEST(HeadsetPage, HasTheRowsOfTheBenchCommand) {
    std::vector<std::string> rows, wanted;
    std::istringstream page(read_file(in_sources("docs/integrations/vr.md")));
    for (std::string line; std::getline(page, line);) {
        const std::vector<std::string> cells = split_at(line, " | ");
        if (cells.size() == 7 && cells[0].find('x') == 3)
            rows.push_back(cells[0].substr(2) + " " + cells[1] + " " + cells[5] + " " + cells[6]);
    }
    for (const json& row : headset_rows()) {
        const int threads = row.at("threads");
        for (int on_page = threads; on_page <= (threads == measured_threads() ? 3 : threads); ++on_page)
            wanted.push_back(sea_label(row) + " " + std::to_string(on_page) + " " +
                             megabytes(row.at("memory_bytes"), "%.1f") + " " +
                             megabytes(row.at("upload_bytes"), "%.2f |"));
    }
    EXPECT_EQ(rows, wanted);
}

TEST(BenchCommand, AnUnwritablePathIsAnErrorBeforeTheWorkBegins) {
    const TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"bench", "--seconds", "3600", "--json", (folder / "no/such/folder.json").string()});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("can't write"), std::string::npos);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(ThreadCounts, DoubleUpToTheMaximum) {
    EXPECT_EQ(tools::thread_counts(1), (std::vector{1}));
    EXPECT_EQ(tools::thread_counts(6), (std::vector{1, 2, 4, 6}));
    EXPECT_EQ(tools::thread_counts(8), (std::vector{1, 2, 4, 8}));
}

TEST(StageWork, JobNamesDropTheCascade) {
    EXPECT_EQ(tools::job_of("evolve+rows c1"), "evolve+rows");
    EXPECT_EQ(tools::job_of("velocity columns"), "velocity columns");
    EXPECT_EQ(tools::job_of("c1"), "c1");
}

}  // namespace
}  // namespace pelagic
