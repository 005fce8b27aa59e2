// Sharded exports: for any partition, order and interruption the bytes equal those of one run.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sweep.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/descriptor.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/record/record_file.hpp"

namespace pelagic {
namespace {

using Json = nlohmann::ordered_json;

// Foam at short fetch in a gale, with a large whitecap cover and a warm-up before a shard's first
// frame; frames with a gap. Foam of a depth of 8 bits is a PNG, which takes much more time than an
// EXR of floats.
const Arguments shard_flags = {"--cascades",     "1",
                               "--resolution",   "32",
                               "--wind-speed",   "20",
                               "--fetch",        "100",
                               "--maps",         "displacement,foam",
                               "--fps",          "12",
                               "--start-number", "2",
                               "--frames",       "2-8,20-23",
                               "--no-sync"};
const Arguments with_png_foam = {"--bit-depth", "8"};
constexpr int shard_frames = 11;

Arguments whole_export(const std::filesystem::path& folder, const Arguments& more = {}) {
    Arguments all = joined(joined({"export", "--out", folder.string()}, shard_flags), more);
    if (std::find(more.begin(), more.end(), "--bit-depth") == more.end())
        all.insert(all.end(), {"--bit-depth", "float"});
    return all;
}

Arguments shard_to(const std::filesystem::path& folder, int index, int count, const Arguments& more = {}) {
    return whole_export(folder, joined({"--shard", std::to_string(index) + "/" + std::to_string(count)}, more));
}

void expect_done(const Outcome& outcome) { EXPECT_EQ(outcome.exit_code, 0) << outcome.err; }

void make_shards(const std::filesystem::path& folder, int count, const Arguments& more = {}) {
    for (int index = 1; index <= count; ++index) expect_done(run_pelagic(shard_to(folder, index, count, more)));
}

Outcome merge(const std::filesystem::path& folder) { return run_pelagic({"merge", folder.string()}); }

const Files& one_run() {
    static const Files files = [] {
        const TemporaryFolder folder;
        expect_done(run_pelagic(whole_export(folder.path())));
        return files_in(folder.path());
    }();
    return files;
}

/// Returns the names that only one of the two has, or whose bytes differ; empty if they are equal.
std::string differences(const Files& left, const Files& right) {
    std::string names;
    for (const auto& [name, bytes] : left)
        if (!right.contains(name) || right.at(name) != bytes) names += " " + name;
    for (const auto& [name, bytes] : right)
        if (!left.contains(name)) names += " " + name;
    return names;
}

void expect_message(const Outcome& outcome, int exit_code, const std::string& expected) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err << "lacks " << expected;
}

/// Exports a shard with `kills` processes that are killed after a random time, then with one that
/// completes.
void make_with_kills(const std::filesystem::path& folder, int index, int count, int kills, std::mt19937& random) {
    const TemporaryFolder logs;
    for (int i = 0; i < kills; ++i) {
        const pid_t process = start_pelagic(shard_to(folder, index, count, {"--resume"}), logs / "out", logs / "err");
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 80));
        ::kill(process, SIGKILL);
        wait_for(process);
    }
    expect_done(run_pelagic(shard_to(folder, index, count, {"--resume"})));
}

TEST(ShardPartitions, KilledAndConcurrentShardsEqualOneRun) {
    for (unsigned seed = 0; seed < of_sweep(2u, 20u); ++seed) {
        std::mt19937 random(seed);
        const int count = 1 + static_cast<int>(random() % (shard_frames + 4));
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(count) + " shards");
        std::vector<int> order(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i + 1;
        std::shuffle(order.begin(), order.end(), random);
        const TemporaryFolder folder;
        const std::size_t half = order.size() / 2;
        const auto make = [&](std::size_t begin, std::size_t end, std::mt19937::result_type own_seed) {
            std::mt19937 own(own_seed);
            for (std::size_t i = begin; i < end; ++i)
                make_with_kills(folder.path(), order[i], count, own() % 4 == 0 ? 2 : 0, own);
        };
        std::thread other(make, 0, half, random());
        make(half, order.size(), random());
        other.join();
        expect_done(merge(folder.path()));
        EXPECT_EQ(differences(files_in(folder.path()), one_run()), "");
    }
}

TEST(ShardedExport, DividesFramesEvenlyIntoContiguousRuns) {
    for (const auto& [total, count] : {std::pair(11, 3), {2, 5}, {1'000'000, 7}, {999'999, 1'000'000}}) {
        std::size_t next = 0, min = SIZE_MAX, max = 0;
        for (int index = 1; index <= count; ++index) {
            const tools::Shard shard{index, count};
            const auto n = static_cast<std::size_t>(total);
            ASSERT_EQ(shard.begin(n), next);
            next = shard.end(n);
            min = std::min(min, next - shard.begin(n));
            max = std::max(max, next - shard.begin(n));
        }
        EXPECT_EQ(next, static_cast<std::size_t>(total));
        EXPECT_LE(max - min, 1u);
    }
}

TEST(ShardedExport, RejectsInvalidShards) {
    const TemporaryFolder folder;
    for (const std::string wrong : {"0/2", "3/2", "1/0", "2", "1/1000001", "a/b", "1/2/3", "-1/2", ""})
        expect_message(run_pelagic(whole_export(folder.path(), {"--shard", wrong})), 2, "--shard is " + wrong);
    EXPECT_TRUE(files_in(folder.path()).empty());
    EXPECT_FALSE(tools::shard_of_record("sea.01-of-2.json"));
    EXPECT_FALSE(tools::shard_of_record("sea.json"));
    EXPECT_EQ(tools::shard_of_record("sea.2-of-10.json"), (tools::Shard{2, 10}));
}

TEST(ShardedExport, RejectsFilesThatHoldAllFrames) {
    const TemporaryFolder folder;
    expect_message(run_pelagic(shard_to(folder.path(), 1, 2, {"--mesh", "mdd"})), 2,
                   "--shard is 1/2, expected files of single frames only");
}

TEST(ShardedExport, JoinsAFinishedExportOnlyWithEqualOptions) {
    const TemporaryFolder folder;
    expect_done(run_pelagic(whole_export(folder.path())));
    expect_message(run_pelagic(shard_to(folder.path(), 1, 3, {"--depth", "7"})), 2, "--depth is 4000.0, not 7.0");
    EXPECT_TRUE(std::filesystem::remove(folder / ".sea.1-of-3.lock")) << "all that it left";
    EXPECT_EQ(differences(files_in(folder.path()), one_run()), "");
    const Outcome kept = run_pelagic(shard_to(folder.path(), 2, 3, {"--resume"}));
    EXPECT_NE(kept.out.find("4 frames (4 of them kept)"), std::string::npos) << kept.out << kept.err;
    expect_done(merge(folder.path()));  // one record of three exists, but all frames do
    EXPECT_EQ(differences(files_in(folder.path()), one_run()), "");
}

TEST(ShardedExport, IsLockedAgainstConcurrentExports) {
    const TemporaryFolder folder;
    make_shards(folder.path(), 2);
    const Files before = files_in(folder.path());
    const auto hold = [&](const std::string& name, int how) {
        tools::Descriptor file(::open((folder / name).c_str(), O_RDWR));
        EXPECT_EQ(::flock(file.get(), how), 0);
        return file;
    };
    {
        const tools::Descriptor at_work = hold(".sea.2-of-2.lock", LOCK_EX), in_folder = hold(".sea.lock", LOCK_SH);
        expect_message(run_pelagic(shard_to(folder.path(), 2, 2)), 2, "where no other process exports shard 2/2");
        expect_message(run_pelagic(whole_export(folder.path())), 2, "another export is at work there");
        expect_message(merge(folder.path()), 2, "another export is at work there");
        expect_done(run_pelagic(shard_to(folder.path(), 1, 2, {"--resume"})));
    }
    {
        const tools::Descriptor in_folder = hold(".sea.lock", LOCK_EX);
        expect_message(run_pelagic(shard_to(folder.path(), 2, 2)), 2, "another export is at work there");
    }
    EXPECT_EQ(differences(files_in(folder.path()), before), "");
}

TEST(MergedShards, CanBeCompletedByTheCommandsThatMergePrints) {
    const TemporaryFolder parent;
    const auto folder = parent / "it's a $sea; \"really\"";
    make_shards(folder, 4);
    std::filesystem::remove(folder / "sea.1-of-4.json");
    std::filesystem::remove(folder / "foam_0004.exr");
    write_file(folder / "displacement_0023.exr", "torn");
    const Files before = files_in(folder);
    const Outcome refused = merge(folder);
    expect_message(refused, 1, "sea.1-of-4.json is missing");
    expect_message(refused, 1, "foam_0004.exr is missing");
    expect_message(refused, 1, "displacement_0023.exr has other bytes than were written");
    expect_message(refused, 1, "3 of 4 shards have to be made again, 1-2,4");
    EXPECT_EQ(differences(files_in(folder), before), "");
    EXPECT_EQ(std::count(refused.out.begin(), refused.out.end(), '\n'), 3);
    write_file(parent / "lines", refused.out);
    const std::string binary = std::filesystem::path(tested_binary).parent_path().string();
    ASSERT_EQ(std::system(
                  ("PATH='" + binary + "':\"$PATH\" sh -e '" + (parent / "lines").string() + "' >/dev/null").c_str()),
              0);
    expect_done(merge(folder));
    EXPECT_EQ(differences(files_in(folder), one_run()), "");
    const Outcome again = merge(folder);
    EXPECT_NE(again.err.find("nothing to merge"), std::string::npos) << again.err;
    EXPECT_EQ(again.out, "");
    EXPECT_EQ(differences(files_in(folder), one_run()), "");
}

/// Runs `pelagic COMMAND FOLDER | sh` in `place`. \return the exit code
int piped_into_shell(const std::filesystem::path& place, const std::string& command, const std::string& folder) {
    write_file(place / "folder", folder);
    const std::string path = std::filesystem::path(tested_binary).parent_path().string();
    return std::system(("cd '" + place.string() + "' && PATH='" + path + "':\"$PATH\" && pelagic " + command +
                        " \"$(cat folder)\" 2>err | sh >out 2>>err")
                           .c_str());
}

TEST(PipesIntoAShell, RunOnlyTheCommandsThatCompleteTheExport) {
    for (const std::string name :
         {"a;touch PWNED;", "$(touch PWNED)", "`touch PWNED`", "a'\ntouch PWNED\n'b", "-a\ntouch PWNED", "plain"}) {
        SCOPED_TRACE(name);
        const TemporaryFolder place;
        const auto folder = place.path() / name;
        const auto expect_piped = [&](const std::string& command) {
            EXPECT_EQ(piped_into_shell(place.path(), command, "./" + name), 0) << read_file(place / "err");
            EXPECT_FALSE(std::filesystem::exists(place / "PWNED")) << command;
        };
        // So short a loop prints a note, which must not be a line for the shell.
        const bool has_png = name == "plain";
        const std::string foam = has_png ? "foam_0003.png" : "foam_0003.exr";
        make_shards(folder, 2, joined({"--loop-period", "4"}, has_png ? with_png_foam : Arguments{}));
        const Files shards = files_in(folder);
        std::filesystem::remove(folder / "sea.2-of-2.json");
        ASSERT_TRUE(std::filesystem::remove(folder / foam));
        expect_piped("merge");  // exports both shards again
        EXPECT_EQ(differences(files_in(folder), shards), "");
        for (const char* command : {"merge", "merge", "verify"}) expect_piped(command);
        EXPECT_NE(read_file(place / "err").find("11 frames as written"), std::string::npos);
        const Files whole = files_in(folder);
        write_file(folder / foam, "torn");
        expect_piped("verify");
        EXPECT_EQ(differences(files_in(folder), whole), "");
    }
}

TEST(MergedShards, DoNotChangeOtherFiles) {
    const TemporaryFolder folder, fresh;
    make_shards(folder.path(), 2, with_png_foam);
    expect_done(run_pelagic(whole_export(fresh.path(), with_png_foam)));
    const std::vector<std::string> own = {".displacement_0003.exr.part", ".sea.1-of-2.json.part", ".sea.json.part",
                                          ".sea_files.json.part"};
    const std::vector<std::string> others = {".part",     ".notes.txt.part",           "displacement_0003.exr.part",
                                             "mine.part", ".displacement_0003.part",   ".film.mov.part",
                                             "sea.txt",   ".displacement_03.exr.part", "sea.1-of-2.json.bak"};
    for (const auto& names : {own, others})
        for (const std::string& name : names) write_file(folder / name, name);
    expect_done(merge(folder.path()));
    Files left = files_in(folder.path());
    for (const std::string& name : others) {
        EXPECT_EQ(left[name], name);
        left.erase(name);
    }
    EXPECT_EQ(differences(left, files_in(fresh.path())), "") << "its own are gone";
}

TEST(MergedShards, MissingShardsAreRejected) {
    const TemporaryFolder folder;
    expect_message(merge(folder.path()), 2, "none is there");
    expect_message(merge(folder / "nowhere"), 2, "No such file");
    write_file(folder / "sea.1-of-1.json", "{ torn");
    expect_message(merge(folder.path()), 1, "the options of the export are unknown");
}

/// An edit of one of two records, which merge must report without a change.
struct Edit {
    std::string name, expected;
    int exit_code;
    std::function<void(const std::filesystem::path& folder)> make;
};

void edit(const std::filesystem::path& file, const std::function<void(Json&)>& change) {
    Json record = Json::parse(read_file(file));
    change(record);
    write_file(file, record.dump(2) + "\n");
}

class EditedShard : public testing::TestWithParam<Edit> {};

TEST_P(EditedShard, IsNamedInOneLine) {
    static const Files shards = [] {
        const TemporaryFolder folder;
        make_shards(folder.path(), 2);
        return files_in(folder.path());
    }();
    const TemporaryFolder folder;
    for (const auto& [name, bytes] : shards) write_file(folder / name, bytes);
    GetParam().make(folder.path());
    const auto names = [&] {
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) all.push_back(entry.path());
        std::sort(all.begin(), all.end());
        return all;
    };
    const auto before = names();
    expect_message(run_pelagic({"merge", folder.path().string()}, [] { ::alarm(60); }), GetParam().exit_code,
                   GetParam().expected);
    EXPECT_EQ(names(), before);
}

std::filesystem::path second(const std::filesystem::path& folder) { return folder / "sea.2-of-2.json"; }

INSTANTIATE_TEST_SUITE_P(
    Records, EditedShard,
    testing::Values(
        Edit{"Empty", "sea.2-of-2.json is damaged", 1, [](const auto& folder) { write_file(second(folder), ""); }},
        Edit{"Torn", "sea.2-of-2.json is damaged", 1,
             [](const auto& folder) {
                 const std::string text = read_file(second(folder));
                 write_file(second(folder), text.substr(0, text.size() - 100));
             }},
        Edit{"NoRecord", "sea.2-of-2.json is damaged", 1,
             [](const auto& folder) { write_file(second(folder), "[1, 2]"); }},
        Edit{"TooDeep", "sea.2-of-2.json is damaged", 1,
             [](const auto& folder) { write_file(second(folder), std::string(100'000, '[')); }},
        Edit{"KeysBehindFrames", "sea.2-of-2.json is damaged", 1,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["more"] = 1; }); }},
        Edit{"Short", "sea.2-of-2.json ends before frame 23, of 6 frames", 1,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["frames"].erase(5); }); }},
        Edit{"Overlapping", "sea.2-of-2.json does not say of frame 7 what an export writes", 1,
             [](const auto& folder) {
                 const Json first = Json::parse(read_file(folder / "sea.1-of-2.json"));
                 edit(second(folder),
                      [&](Json& record) { record["frames"].insert(record["frames"].begin(), first["frames"][4]); });
             }},
        Edit{"FrameTwice", "sea.2-of-2.json has more than its 6 frames", 1,
             [](const auto& folder) {
                 edit(second(folder), [](Json& record) { record["frames"].push_back(record["frames"][5]); });
             }},
        Edit{"EditedFrame", "sea.2-of-2.json does not say of frame 8", 1,
             [](const auto& folder) {
                 edit(second(folder), [](Json& record) { record["frames"][1]["height_max_m"] = 3; });
             }},
        Edit{"OtherSea", "sea.2-of-2.json is of another export than sea.1-of-2.json: --wind-speed is 9.0, not 20.0",
             2,
             [](const auto& folder) {
                 edit(second(folder), [](Json& record) { record["sea"]["wind_speed_mps"] = 9.; });
             }},
        Edit{"OtherMaps", "--mips is true, not false", 2,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["export"]["mips"] = true; }); }},
        Edit{"Newer", "sea.2-of-2.json was written by pelagic 99.0.0", 2,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["version"] = "99.0.0"; }); }},
        Edit{"AnOptionOfAnotherVersion", "sea.2-of-2.json: export:", 2,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["export"]["whales"] = 3; }); }},
        Edit{"OtherShard", "sea.2-of-2.json is of another shard than its name says", 2,
             [](const auto& folder) { edit(second(folder), [](Json& record) { record["shard"]["index"] = 1; }); }},
        Edit{"OtherNumberOfShards", "there are sea.1-of-2.json and sea.3-of-4.json", 2,
             [](const auto& folder) { std::filesystem::copy_file(second(folder), folder / "sea.3-of-4.json"); }},
        Edit{"OtherExport", "sea_files.json is of another export than sea.1-of-2.json: --depth is 7", 2,
             [](const auto& folder) {
                 std::filesystem::copy_file(second(folder), folder / "sea_files.json");
                 edit(folder / "sea_files.json", [](Json& record) { record["sea"]["depth_m"] = 7.; });
             }},
        Edit{"Link", "sea.2-of-2.json: it is a symbolic link", 1,
             [](const auto& folder) {
                 std::filesystem::rename(second(folder), folder / "mine");
                 std::filesystem::create_symlink("mine", second(folder));
             }},
        Edit{"Fifo", "sea.2-of-2.json: it is a FIFO", 1,
             [](const auto& folder) {
                 std::filesystem::remove(second(folder));
                 ASSERT_EQ(::mkfifo(second(folder).c_str(), 0666), 0);
             }}),
    [](const auto& of) { return of.param.name; });

TEST(VerifiedExport, IsCompleteOrTheErrorIsNamed) {
    const TemporaryFolder folder;
    for (const auto& [name, bytes] : one_run()) write_file(folder / name, bytes);
    const Arguments verify = {"verify", folder.path().string(), "--sample", "all"};
    const Outcome whole = run_pelagic(verify);
    expect_done(whole);
    EXPECT_NE(whole.err.find("11 frames as written, 11 of them recomputed"), std::string::npos) << whole.err;
    EXPECT_EQ(whole.out, "");

    write_file(folder / "foam_0007.exr", "torn");
    const Outcome torn = run_pelagic(verify);
    expect_message(torn, 1, "foam_0007.exr has other bytes than were written");
    EXPECT_TRUE(torn.out.ends_with(" --resume\n")) << torn.out;
    write_file(folder / "foam_0007.exr", one_run().at("foam_0007.exr"));

    edit(folder / "sea.json", [](Json& record) { record["waves"]["steepness"] = 1; });
    expect_message(run_pelagic(verify), 1, "sea.json is edited: steepness is 1, not 0.");

    write_file(folder / "sea.json", one_run().at("sea.json"));
    edit(folder / "sea.json", [](Json& record) { record["frames"][3]["hash"] = "0123456789abcdef"; });
    expect_message(run_pelagic(verify), 1,
                   "sea.json is edited: its entry 3 of frames is not what an export writes there");
    write_file(folder / "sea.json", one_run().at("sea.json"));
    edit(folder / "sea.json", [](Json& record) { record["frames"].erase(10); });
    const Outcome short_list = run_pelagic(verify);
    expect_message(short_list, 1, "sea.json is edited: it has 10 of 11 frames");
    std::filesystem::remove(folder / "sea.json");
    expect_message(run_pelagic(verify), 1, "sea.json is missing");
    EXPECT_TRUE(short_list.out.ends_with(" --resume\n")) << short_list.out;

    // A hash that another processor or compiler might compute: the entry itself is consistent.
    write_file(folder / "sea.json", one_run().at("sea.json"));
    edit(folder / "sea_files.json", [](Json& record) {
        Json& frame = record["frames"][3];
        frame["hash"] = "0123456789abcdef";
        frame.erase("record_xxh3");
        frame["record_xxh3"] = tools::digest_of(frame.dump());
    });
    const Outcome other = run_pelagic(verify);
    expect_message(other, 1, "frame 5 is computed otherwise here: hash is \"0123456789abcdef\", not");
    EXPECT_TRUE(other.out.ends_with(" --overwrite\n")) << "--resume would keep that frame: " << other.out;
    write_file(folder / "sea_files.json", one_run().at("sea_files.json"));
    expect_done(run_pelagic({"verify", folder.path().string(), "--sample", "0"}));
}

TEST(VerifiedExport, NeedsAFinishedExport) {
    const TemporaryFolder folder;
    expect_message(run_pelagic({"verify", folder.path().string()}), 2,
                   "sea_files.json is missing: expected a finished export");
    expect_done(run_pelagic(shard_to(folder.path(), 1, 2)));
    expect_message(run_pelagic({"verify", folder.path().string()}), 2, "pelagic merge makes one of the shards");
    expect_message(run_pelagic({"verify", folder.path().string(), "--sample", "some"}), 2, "--sample is some");
}

tools::ExportOptions shard_options_of(const Arguments& words) {
    CLI::App app;
    tools::ExportFlags flags;
    flags.add_to(app);
    app.parse(Arguments(words.rbegin(), words.rend()));
    return flags.resolve();
}

// Four frames in so many shards that almost all are empty: the cost of merging the records.
TEST(ManyShards, AreMerged) {
    const TemporaryFolder folder;
    const int count = of_sweep(500, 10'000);
    const Arguments few = {
        "--out",     folder.path().string(), "--resolution", "16", "--wind-speed", "9", "--frames", "4", "--maps",
        two_exr_maps};
    tools::ExportOptions options = shard_options_of(few);
    const tools::OutputFolder place(folder.path(), tools::Sync::no);
    std::vector<int> with_frames;
    for (int index = 1; index <= count; ++index) {
        options.shard = tools::Shard{index, count};
        if (options.frames_here().empty())
            tools::write_record(place, tools::record_name(options.shard), tools::shard_head(options),
                                [](const auto&) {});
        else
            with_frames.push_back(index);
    }
    ASSERT_EQ(with_frames.size(), 4u);
    for (const int index : with_frames) {
        expect_done(
            run_pelagic(joined({"export", "--shard", std::to_string(index) + "/" + std::to_string(count)}, few)));
    }
    expect_done(merge(folder.path()));
    EXPECT_EQ(files_in(folder.path()).size(), 4u * 2 + 3) << "images, sea.json, the record and the lock";
}

}  // namespace
}  // namespace pelagic
