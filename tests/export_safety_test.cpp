// Exports into prepared folders: only the export's own regular files are read, followed, replaced
// or removed.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

const std::string journal_name = ".pelagic-export.jsonl", record_name = "sea_files.json";

Arguments export_of_3_frames(const std::filesystem::path& folder, const Arguments& more = {},
                             const std::string& maps = two_exr_maps) {
    return joined({"export", "--out", folder.string(), "--resolution", "16", "--frames", "3", "--maps", maps}, more);
}

/// Ends the program after a minute if it hangs, for example while it opens a FIFO.
void at_most_a_minute() { ::alarm(60); }

Outcome run_within_a_minute(const Arguments& arguments) { return run_pelagic(arguments, at_most_a_minute); }

/// Notes about the sea precede an error.
void expect_error_line(const Outcome& outcome, int exit_code, const std::string& expected) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    const std::string error = outcome.err.substr(std::min(outcome.err.find("pelagic: "), outcome.err.size()));
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err << "lacks " << expected;
}

/// An object that may exist in place of a file; the test uses each kind that the system permits.
struct Obstacle {
    std::string name;
    mode_t type;
    std::function<bool(const std::filesystem::path&)> make;
};

std::vector<Obstacle> obstacles(const std::filesystem::path& victim) {
    return {{"a symbolic link", S_IFLNK,
             [victim](const auto& path) { return ::symlink(victim.c_str(), path.c_str()) == 0; }},
            {"a folder", S_IFDIR, [](const auto& path) { return ::mkdir(path.c_str(), 0777) == 0; }},
            {"a FIFO", S_IFIFO, [](const auto& path) { return ::mkfifo(path.c_str(), 0666) == 0; }},
            // A copy of /dev/null, as root only.
            {"a device", S_IFCHR,
             [](const auto& path) { return ::mknod(path.c_str(), S_IFCHR | 0666, makedev(1, 3)) == 0; }}};
}

mode_t type_of(const std::filesystem::path& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 ? status.st_mode & S_IFMT : 0;
}

/// Runs a command that would write each name in `folder`, once per obstacle in its place. Outside
/// of full sweeps each name is tried with the symbolic link and one other obstacle in turn.
void expect_obstacles_rejected(const std::vector<std::string>& names,
                               const std::function<Arguments(const std::filesystem::path&)>& command) {
    for (std::size_t turn = 0; turn < names.size(); ++turn) {
        const std::string& name = names[turn];
        const TemporaryFolder elsewhere;
        write_file(elsewhere / "victim", "mine");
        const std::vector<Obstacle> all = obstacles(elsewhere / "victim");
        for (std::size_t which = 0; which < all.size(); ++which) {
            const bool is_its_turn = which == 0 ? !is_sanitized || turn % 4 == 0 : which == 1 + turn % 3;
            if (!of_sweep(is_its_turn, true)) continue;
            const Obstacle& obstacle = all[which];
            const TemporaryFolder folder;
            if (!obstacle.make(folder / name)) continue;
            SCOPED_TRACE(name + " is " + obstacle.name);
            expect_error_line(run_within_a_minute(command(folder.path())), 1,
                              (folder / name).string() + ": it is " + obstacle.name);
            EXPECT_EQ(type_of(folder / name), obstacle.type) << "still what it was";
            EXPECT_EQ(read_file(elsewhere / "victim"), "mine");
        }
        EXPECT_EQ(files_in(elsewhere.path()).size(), 1u) << "nothing was made beside it";
    }
}

TEST(PreparedFolder, OnlyRegularFilesAreReplaced) {
    expect_obstacles_rejected({"sea.json", ".sea.json.part", record_name, "." + record_name + ".part", journal_name,
                               "." + journal_name + ".part", "displacement_0000.exr", ".displacement_0000.exr.part",
                               "compression_0002.exr", ".compression_0002.exr.part", ".sea.lock"},
                              [](const auto& folder) { return export_of_3_frames(folder); });
    expect_obstacles_rejected({"gradient_0002.png", ".gradient_0002.png.part"},
                              [](const auto& folder) { return export_of_3_frames(folder, {}, maps_with_png); });
}

TEST(PreparedFolder, OnlyRegularFilesAreRead) {
    expect_obstacles_rejected({record_name, journal_name},
                              [](const auto& folder) { return export_of_3_frames(folder, {"--resume"}); });
}

TEST(PreparedFolder, ImagesMustBeRegularFilesToBeKept) {
    const TemporaryFolder elsewhere;
    for (const Obstacle& obstacle : obstacles(elsewhere / "image")) {
        const TemporaryFolder folder;
        ASSERT_EQ(run_within_a_minute(export_of_3_frames(folder.path())).exit_code, 0);
        std::filesystem::rename(folder / "compression_0001.exr", elsewhere / "image");
        if (!obstacle.make(folder / "compression_0001.exr")) continue;
        expect_error_line(run_within_a_minute(export_of_3_frames(folder.path(), {"--resume"})), 1,
                          "it is " + obstacle.name);
        EXPECT_EQ(type_of(folder / "compression_0001.exr"), obstacle.type);
    }
}

TEST(PreparedFolder, QuadtreeFilesReplaceOnlyRegularFiles) {
    for (const std::string option : {"--svg", "--obj", "--json"})
        expect_obstacles_rejected({"plan", ".plan.part"}, [&](const auto& folder) {
            return Arguments{"quadtree", "--resolution", "16", option, (folder / "plan").string()};
        });
}

TEST(PreparedFolder, TracesReplaceOnlyRegularFiles) {
    expect_obstacles_rejected({".trace.json.part"}, [](const auto& folder) {
        return export_of_3_frames(folder / "sea", {"--trace", (folder / "trace.json").string()});
    });
}

// The temporary file of a killed run is a regular file, possibly with a second hard link.
TEST(PreparedFolder, AStaleTemporaryFileIsReplacedWithoutItsHardLink) {
    const TemporaryFolder folder, fresh;
    ASSERT_EQ(run_within_a_minute(export_of_3_frames(fresh.path())).exit_code, 0);
    write_file(folder / "victim", "mine");
    std::filesystem::create_hard_link(folder / "victim", folder / ".sea.json.part");
    write_file(folder / ".compression_0001.exr.part", "torn");
    ASSERT_EQ(run_within_a_minute(export_of_3_frames(folder.path())).exit_code, 0);
    auto files = files_in(folder.path());
    EXPECT_EQ(files["victim"], "mine");
    files.erase("victim");
    EXPECT_TRUE(files == files_in(fresh.path()));
}

TEST(FinishedExport, IsReplacedOnlyWithOverwrite) {
    const TemporaryFolder folder, fresh;
    ASSERT_EQ(run_within_a_minute(export_of_3_frames(folder.path())).exit_code, 0);
    const auto to = [](const TemporaryFolder& place) {
        return Arguments{
            "export", "--out",  place.path().string(), "--resolution", "16", "--frames", "2", "--wind-speed",
            "9",      "--maps", two_exr_maps};
    };
    ASSERT_EQ(run_within_a_minute(to(fresh)).exit_code, 0);
    const Arguments second = to(folder);
    const auto with = [&](const std::string& more) {
        Arguments all = second;
        all.push_back(more);
        return all;
    };
    const auto before = files_in(folder.path());
    const auto expect_rejected_and_kept = [&](const Arguments& arguments, const std::string& expected) {
        const auto now = files_in(folder.path());
        const Outcome outcome = run_within_a_minute(arguments);
        expect_error_line(outcome, 2, expected);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(files_in(folder.path()) == now);
    };
    const std::string finished = folder.path().string() +
                                 " already holds a finished export of 3 frames: --resume keeps what is "
                                 "whole of it, --overwrite replaces it";
    expect_rejected_and_kept(second, finished);
    expect_rejected_and_kept(export_of_3_frames(folder.path()), finished);
    expect_rejected_and_kept(with("--resume"), "--wind-speed was 12.0 and is 9.0");
    Arguments both = with("--overwrite");
    both.push_back("--resume");
    expect_rejected_and_kept(both, "--overwrite is given with --resume");
    expect_rejected_and_kept(export_of_3_frames(folder.path(), {"--overwrite", "--shard", "1/2"}),
                             "--overwrite is given with --shard 1/2");
    EXPECT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--resume"})).exit_code, 0);
    EXPECT_TRUE(files_in(folder.path()) == before);

    // If the record is missing, sea.json is checked instead; if both are missing, there is nothing
    // to check.
    std::filesystem::remove(folder / record_name);
    expect_rejected_and_kept(second, finished);
    expect_rejected_and_kept(export_of_3_frames(folder.path(), {"--resume"}),
                             "which has a sea.json but no sea_files.json");
    write_file(folder / record_name, before.at(record_name));
    std::filesystem::remove(folder / "sea.json");
    expect_rejected_and_kept(second, finished);
    write_file(folder / "sea.json", before.at("sea.json"));
    EXPECT_EQ(run_within_a_minute(with("--overwrite")).exit_code, 0);
    EXPECT_TRUE(files_in(folder.path()) == files_in(fresh.path()));
}

TEST(FinishedExport, ShardsAreReplacedOnlyWithOverwrite) {
    const TemporaryFolder folder, fresh;
    ASSERT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--shard", "2/2"})).exit_code, 0);
    const auto before = files_in(folder.path());
    expect_error_line(run_within_a_minute(export_of_3_frames(folder.path())), 2,
                      "already holds 1 shard of an export: pelagic merge");
    EXPECT_TRUE(files_in(folder.path()) == before);
    EXPECT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--shard", "1/2"})).exit_code, 0)
        << "shards go on beside one another";
    EXPECT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--overwrite"})).exit_code, 0);
    EXPECT_EQ(run_within_a_minute(export_of_3_frames(fresh.path())).exit_code, 0);
    EXPECT_TRUE(files_in(folder.path()) == files_in(fresh.path()));
}

// sea.json is written for human readers, with one line per frame; the record holds the files'
// hashes.
TEST(FinishedExport, OnlyTheRecordHoldsFileHashes) {
    const TemporaryFolder folder;
    constexpr std::size_t frames = 15;
    const Outcome outcome =
        run_within_a_minute({"export", "--out", folder.path().string(), "--resolution", "32", "--frames",
                             std::to_string(frames), "--no-sync", "--maps", "displacement,gradient,compression",
                             "--mips", "--mesh", "obj,mdd", "--mesh-steps", "4"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string text = read_file(folder / "sea.json");
    EXPECT_EQ(text.find("xxh3"), std::string::npos);
    const auto lines_of = [](const json& whole) {
        const std::string pretty = whole.dump(2);
        return std::count(pretty.begin(), pretty.end(), '\n') + 1;
    };
    const json sea = json::parse(text), files = json::parse(read_file(folder / record_name));
    json without_frames = sea;
    without_frames["frames"] = json::array();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), lines_of(without_frames) + std::ptrdiff_t{frames} + 1);
    ASSERT_EQ(sea.at("frames").size(), frames);
    ASSERT_EQ(files.at("frames").size(), frames);
    std::set<std::string> named = {"sea.json", record_name, ".sea.lock", sea.at("sequence_files")[0].at("name")};
    for (std::size_t i = 0; i < frames; ++i) {
        const json &frame = sea["frames"][i], &entry = files["frames"][i];
        for (const char* key : {"frame", "time_s", "hash", "foam_hash", "significant_wave_height_m"})
            EXPECT_EQ(frame.at(key), entry.at(key)) << key;
        ASSERT_EQ(frame.at("files").size(), entry.at("files").size());
        for (std::size_t f = 0; f < frame["files"].size(); ++f) {
            EXPECT_EQ(frame["files"][f], (json{{"name", entry["files"][f].at("name")}}));
            EXPECT_EQ(entry["files"][f].at("xxh3").get<std::string>().size(), 16u);
            named.insert(frame["files"][f]["name"]);
        }
    }
    std::set<std::string> there;
    for (const auto& [name, bytes] : files_in(folder.path())) there.insert(name);
    EXPECT_EQ(named, there);
    // If a byte of any file changes, verify names that file.
    ASSERT_EQ(run_within_a_minute({"verify", folder.path().string(), "--sample", "0"}).exit_code, 0);
    for (const std::string name : {"displacement_0007.exr", "displacement_c3_0011.exr", "gradient_c2_0014_mip3.png",
                                   "compression_c1_0000_mip1.exr", "mesh_0013.obj", "mesh.mdd"}) {
        const std::string bytes = read_file(folder / name);
        ASSERT_FALSE(bytes.empty()) << name;
        std::string changed = bytes;
        changed.back() = static_cast<char>(changed.back() ^ 1);
        write_file(folder / name, changed);
        const Outcome verified = run_within_a_minute({"verify", folder.path().string(), "--sample", "0"});
        EXPECT_EQ(verified.exit_code, 1);
        EXPECT_NE(verified.err.find(name + " has other bytes than were written"), std::string::npos) << verified.err;
        write_file(folder / name, bytes);
    }
}

/// A finished export whose record, or a journal with equal entries, is edited before it is resumed.
class EditedRecord : public testing::TestWithParam<bool> {
   protected:
    void make(const std::string& maps = two_exr_maps) {
        maps_ = maps;
        ASSERT_EQ(run_within_a_minute(arguments()).exit_code, 0);
        whole_ = files_in(folder_ / "sea");
        sea_ = json::parse(whole_.at(record_name));
    }

    Arguments arguments(const Arguments& more = {}) const {
        return export_of_3_frames(folder_ / "sea", joined({"--mips"}, more), maps_);
    }

    /// Writes sea_ as the record or journal, resumes, and expects exactly the files of a complete
    /// export.
    void expect_completed(const std::string& what, const std::string& kept) {
        SCOPED_TRACE(what);
        std::filesystem::remove(folder_ / "sea" / journal_name);
        std::filesystem::remove(folder_ / "sea" / record_name);
        if (GetParam()) {
            const json options = {{"version", sea_["version"]}, {"sea", sea_["sea"]}, {"export", sea_["export"]}};
            std::string lines = json{{"options", options}, {"replaced_files", replaced_}}.dump() + "\n";
            for (const json& frame : sea_["frames"]) lines += frame.dump() + "\n";
            write_file(folder_ / "sea" / journal_name, lines);
        } else {
            write_file(folder_ / "sea" / record_name, sea_.dump());
        }
        const Outcome outcome = run_within_a_minute(arguments({"--resume"}));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("(" + kept + " of them kept)"), std::string::npos) << outcome.out;
        EXPECT_TRUE(files_in(folder_ / "sea") == whole_);
        sea_ = json::parse(whole_.at(record_name));
    }

    const TemporaryFolder folder_;
    std::string maps_;
    std::map<std::string, std::string> whole_;
    json sea_;
    std::vector<std::string> replaced_;
};

TEST_P(EditedRecord, EntriesAreKeptOnlyIfTheExportWouldWriteThem) {
    make();
    const auto frames = [&]() -> json& { return sea_["frames"]; };
    const auto remove_map = [&] { std::filesystem::remove(folder_ / "sea" / "compression_0001.exr"); };
    expect_completed("as it was", "3");

    remove_map();
    frames()[1]["files"] = json::array();
    expect_completed("no files", "2");

    remove_map();
    frames()[1]["files"].erase(1);
    expect_completed("a file less", "2");

    frames().erase(1);
    expect_completed("an entry less", "2");
    frames()[2] = frames()[1];
    expect_completed("a frame twice", "2");

    // Several errors at once, each in a frame of its own, which is therefore not kept.
    frames()[0]["frame"] = 77;
    frames()[1]["frame"] = -5;
    frames()[2]["frame"] = 4294967298;
    expect_completed("frames 77, -5 and 2^32 + 2", "0");
    frames()[0]["frame"] = 1e300;
    frames()[1]["frame"] = "1";
    expect_completed("frame 1e300, and a text as one", "1");
    std::swap(frames()[0]["files"], frames()[1]["files"]);
    expect_completed("swapped lists", "1");
    std::swap(frames()[0]["frame"], frames()[1]["frame"]);
    std::swap(frames()[2]["files"][0], frames()[2]["files"][1]);
    expect_completed("swapped numbers, and another order", "0");
    frames()[0]["time_s"] = 0.5;
    frames()[1]["significant_wave_height_m"] = 9.0;
    frames()[2]["hash"] = frames()[1]["hash"];
    expect_completed("another time, height and hash", "0");
    frames()[0]["files"][0]["xxh3"] = 7;
    frames()[2]["files"][0]["xxh3"] = frames()[2]["files"][1]["xxh3"];
    expect_completed("another hash of a file, and a number for one", "1");
    frames()[0] = nullptr;
    frames()[1] = 3;
    frames()[2] = "frame";
    expect_completed("nothing, a number and a text for frames", "0");
    frames()[0] = json::array();
    frames()[1] = json::object();
    expect_completed("an empty array and an empty object for frames", "1");
    frames() = json::array();
    expect_completed("no frames", "0");
}

TEST_P(EditedRecord, FilesThatNoExportCanHaveNamedAreNotRemoved) {
    make(maps_with_png);
    std::filesystem::create_directories(folder_ / "victim" / "empty");
    const std::map<std::string, std::string> mine = {{"precious", "1"},
                                                     {".precious.part", "2"},
                                                     {"displacement_0001.exr", "3"},
                                                     {".displacement_0001.exr.part", "4"}};
    for (const auto& [name, text] : mine) write_file(folder_ / "victim" / name, text);
    const Arguments own = {"displacement_notes.txt", "gradient_1.png",           "gradient_00001.png",
                           "gradient_0001_mip0.png", "gradient_0001_mip12.png",  "displacement_0001_mip1.exr",
                           "displacement_0001.png",  "displacement_1000000.exr", "gradient_0001.png.bak"};
    Arguments names = {"../victim/precious",
                       "../victim/empty",
                       "../victim/displacement_0001.exr",
                       "../victim",
                       "..",
                       ".",
                       "",
                       "/etc/passwd",
                       "displacement_0001.exr/../../victim/precious",
                       "victim",
                       std::string(100000, 'a')};
    names.insert(names.end(), own.begin(), own.end());
    for (const std::string& name : own) {
        write_file(folder_ / "sea" / name, "mine");
        whole_[name] = "mine";
    }
    for (const std::string& name : names) {
        sea_["frames"][0]["files"].push_back({{"name", name}, {"xxh3", "0000000000000000"}});
        replaced_.push_back(name);
    }
    expect_completed("names that are none", "2");
    auto left = files_in(folder_ / "victim");
    left.erase("empty");
    EXPECT_TRUE(left == mine);
    EXPECT_TRUE(std::filesystem::is_directory(folder_ / "victim" / "empty"));
}

// Images of an older export that the new one replaces are removed, if they are regular files.
TEST_P(EditedRecord, OlderImagesAreRemovedOnlyIfTheyAreFiles) {
    make();
    std::filesystem::create_directory(folder_ / "sea" / "gradient_0007.png");
    write_file(folder_ / "sea" / "gradient_0008_mip3.png", "old");
    write_file(folder_ / "sea" / "displacement_123456.tif", "old");
    for (const std::string name : {"gradient_0007.png", "gradient_0008_mip3.png", "displacement_123456.tif"}) {
        sea_["frames"][0]["files"].push_back({{"name", name}, {"xxh3", "0000000000000000"}});
        replaced_.push_back(name);
    }
    whole_["gradient_0007.png"] = "";
    expect_completed("older images", "2");
}

INSTANTIATE_TEST_SUITE_P(Records, EditedRecord, testing::Bool(),
                         [](const auto& of) { return of.param ? "Journal" : "Record"; });

TEST(DamagedRecord, IsRejectedInOneLineAndReplacedWithOverwrite) {
    for (const std::string& text :
         {std::string("{ torn"), std::string("[]"), std::string("7"), std::string("{}"), std::string(1000000, '['),
          std::string("{\"version\":1,\"sea\":{},\"export\":{}}"),
          std::string("{\"version\":1,\"sea\":{},\"export\":{},\"frames\":1e999}")}) {
        const TemporaryFolder folder;
        write_file(folder / record_name, text);
        expect_error_line(run_within_a_minute(export_of_3_frames(folder.path(), {"--resume"})), 2, "damaged");
        expect_error_line(run_within_a_minute(export_of_3_frames(folder.path())), 2,
                          "an export whose sea_files.json is damaged");
        EXPECT_EQ(read_file(folder / record_name), text);
        EXPECT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--overwrite"})).exit_code, 0);
        EXPECT_EQ(run_within_a_minute(export_of_3_frames(folder.path(), {"--resume"})).exit_code, 0);
    }
}

TEST(DamagedRecord, IsRejectedAtAnySize) {
    const TemporaryFolder folder;
    write_file(folder / record_name, "");
    // a sparse file, which takes no disk space
    std::filesystem::resize_file(folder / record_name, std::uintmax_t{1} << 40);
    expect_error_line(run_within_a_minute(export_of_3_frames(folder.path(), {"--resume"})), 2, "damaged");
}

}  // namespace
}  // namespace pelagic
