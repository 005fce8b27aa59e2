// `pelagic bench`: that it measures what it was asked for and says so; how long anything takes is nobody's promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/simd/isa.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"
#include "pelagic/tools/benchmark/stored_figures.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

const std::vector<std::string> jobs_of_one_tile = {"evolve+rows", "columns+finalize", "gradients+mipmaps",
                                                   "mipmaps tail"};

Outcome bench(std::vector<std::string> more) {
    more.insert(more.begin(), {"bench", "--seconds", "0.2"});
    return run_pelagic(more);
}

void expect_in_order(const json& quartiles, const json& median) {
    EXPECT_GT(quartiles.at(0).get<double>(), 0);
    EXPECT_LE(quartiles.at(0), median);
    EXPECT_LE(median, quartiles.at(1));
}

TEST(BenchCommand, TimesEachJobOfEachSizeOnEachInstructionSetAndNumberOfThreads) {
    const Outcome run = bench({"--sizes", "128,32", "--threads", "3", "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const json all = json::parse(run.out);
    EXPECT_FALSE(all.at("cpu").get<std::string>().empty());
    std::vector<std::string> rows, wanted;
    for (const json& row : all.at("rows")) {
        rows.push_back(row.at("n").dump() + row.at("isa").get<std::string>() + row.at("threads").dump());
        EXPECT_EQ(row.at("tiles"), 1);
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
        EXPECT_TRUE(jobs == jobs_of_one_tile || row.at("threads") != 1);
    }
    for (const char* n : {"32", "128"}) {
        for (const Isa isa : isas_here()) wanted.push_back(n + std::string(name_of(isa)) + "1");
        for (const char* threads : {"2", "3"})
            wanted.push_back(n + std::string(name_of(isas_here().back())) + threads);
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
    for (const std::string& job : jobs_of_one_tile) EXPECT_NE(run.out.find(job), std::string::npos) << job;
    for (const tools::MachineFrames& stored : tools::stored_frames())
        EXPECT_NE(run.out.find(stored.machine.substr(0, 39)), std::string::npos) << stored.machine;
    EXPECT_EQ(run.out.find("more threads"), std::string::npos);
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);  // the processor's name may be any
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
}

TEST(BenchCommand, ASeaOfSeveralTilesHasEachJobOnce) {
    std::vector<double> done;
    const tools::Timings timings = tools::time_frames(
        {.sizes = {}, .default_sea = true, .isas = {isas_here().back()}, .most_threads = 1, .seconds = 0.1},
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
    EXPECT_GE(done.size(), 5u);  // turn by turn
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_GT(done.front(), 0);
    EXPECT_LE(done.back(), 1);
}

TEST(BenchCommand, AFailedWriteIsOneLineBeforeTheWorkBegins) {
    const TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"bench", "--seconds", "3600", "--json", (folder / "no/such/folder.json").string()});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("can't write"), std::string::npos);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(ThreadCounts, DoubleUpToTheMost) {
    EXPECT_EQ(tools::thread_counts(1), (std::vector{1}));
    EXPECT_EQ(tools::thread_counts(6), (std::vector{1, 2, 4, 6}));
    EXPECT_EQ(tools::thread_counts(8), (std::vector{1, 2, 4, 8}));
}

TEST(StageWork, IsThatOfTheJobWhateverTheTile) {
    EXPECT_EQ(tools::job_of("evolve+rows c1"), "evolve+rows");
    EXPECT_EQ(tools::job_of("velocity columns"), "velocity columns");
    EXPECT_EQ(tools::job_of("c1"), "c1");
}

// What the project keeps is in the program, and read.
TEST(StoredFigures, AreThere) {
    EXPECT_FALSE(tools::stored_frames().empty());
    for (const tools::MachineFrames& frames : tools::stored_frames()) {
        EXPECT_TRUE(isa_named(frames.isa)) << frames.machine;
        EXPECT_FALSE(frames.ms.empty()) << frames.machine;
        for (const auto& [resolution, ms] : frames.ms) EXPECT_GT(ms, 0) << frames.machine << resolution;
    }
    for (const char* job : {"evolve+rows", "columns+finalize", "gradients+mipmaps", "mipmaps tail", "frame"})
        for (const Isa isa : {Isa::sse4_2, Isa::avx2})
            EXPECT_GT(tools::stored_instructions("1x256", job, isa).value_or(0), 0) << job << name_of(isa);
    EXPECT_FALSE(tools::stored_instructions("1x256", "no such job", Isa::avx2));
    EXPECT_FALSE(tools::stored_instructions_compiler().empty());
}

}  // namespace
}  // namespace pelagic
