// Export options are written to a record and restored, from the record's values and from its
// command line, without loss.
#include "pelagic/tools/record/export_from_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/record/record_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

using Words = std::vector<std::string>;

// Options that do not affect the content of files.
const std::set<std::string> unrecorded = {"out",     "help",    "help-pixels", "resume",  "overwrite",
                                          "no-sync", "no-lock", "preview",     "threads", "isa",
                                          "trace",   "shard",   "config",      "weather"};

/// A placeholder for the path of the events file beside the record.
const std::string events_placeholder = "the events";

// For each option that affects files, arguments that set it to a value other than the default.
const std::map<std::string, Words> other_values = {
    {"start", {"--start", "-3.25"}},
    {"system", {"--system", "height=1.2 period=12", "--system", "wind_speed=5"}},
    {"regular", {"--regular", "height=1.5 period=7"}},
    {"regular-height", {"--waves", "regular", "--regular-height", "1.5"}},
    {"regular-period", {"--waves", "regular", "--regular-period", "7"}},
    {"order", {"--waves", "regular", "--order", "2"}},
    {"wind-alignment", {"--wind-alignment", "0.75", "--spreading", "paper"}},
    {"frames", {"--frames", "10-20,40", "--start-number", "4"}},
    {"start-number", {"--start-number", "7", "--frames", "3"}},
    {"fps", {"--fps", "29.97"}},
    {"loop-frames", {"--loop-frames", "48", "--start-number", "5"}},
    {"maps", {"--maps", "gradient,compression"}},
    {"format", {"--format", "tif"}},
    {"bit-depth", {"--maps", "normal", "--bit-depth", "8"}},
    {"foam-size", {"--maps", "foam", "--foam-size", "50"}},
    {"foam-pixels", {"--maps", "foam", "--foam-pixels", "64"}},
    {"normal-y", {"--maps", "normal", "--normal-y", "down"}},
    {"axes", {"--axes", "z-up"}},
    {"unit", {"--unit", "cm"}},
    {"rows", {"--rows", "bottom"}},
    {"compression", {"--compression", "piz"}},
    {"pack", {"--pack", "layers"}},
    {"tiled", {"--tiled"}},
    {"mips", {"--mips"}},
    {"half", {"--half"}},
    {"flipbook", {"--flipbook", "2x1", "--frames", "2"}},
    {"mesh", {"--maps", "none", "--mesh", "obj,gltf"}},
    {"mesh-size", {"--mesh", "ply", "--mesh-size", "12.5"}},
    {"mesh-steps", {"--mesh", "ply", "--mesh-steps", "8"}},
    {"preset", {"--preset", "storm"}},
    {"waves", {"--waves", "analytic"}},
    {"spectrum", {"--spectrum", "pierson-moskowitz"}},
    {"spreading", {"--spreading", "hasselmann"}},
    {"cascades", {"--cascades", "3"}},
    {"resolution", {"--resolution", "64"}},
    {"patch-size", {"--patch-size", "300"}},
    {"wind-speed", {"--wind-speed", "20kn"}},
    {"wind-direction", {"--wind-direction", "from-NW"}},
    {"lean", {"--lean", "0.2"}},
    {"roughness", {"--roughness", "0.25"}},
    {"swell-height", {"--swell-height", "1.5"}},
    {"swell-period", {"--swell-height", "1", "--swell-period", "13"}},
    {"swell-direction", {"--swell-height", "1", "--swell-direction", "77"}},
    {"swell-spread", {"--swell-height", "1", "--swell-spread", "9"}},
    {"seed", {"--seed", "99"}},
    {"wave-count", {"--waves", "analytic", "--wave-count", "9"}},
    {"longest-wave", {"--waves", "analytic", "--longest-wave", "80"}},
    {"shortest-wave", {"--waves", "analytic", "--shortest-wave", "3"}},
    {"wave-strength", {"--waves", "analytic", "--wave-strength", "0.5"}},
    {"wave-height", {"--waves", "analytic", "--wave-height", "2"}},
    {"peak-period", {"--wave-height", "2", "--peak-period", "7"}},
    {"wave-drag", {"--waves", "pond", "--wave-drag", "0.2"}},
    {"events", {"--events", events_placeholder}},
    {"events-side", {"--events", events_placeholder, "--events-side", "80"}},
    {"events-resolution", {"--events", events_placeholder, "--events-resolution", "128"}},
    {"events-at", {"--events", events_placeholder, "--events-at", "-3.5,2"}},
    {"sea-level", {"--sea-level", "-1.8"}},
    {"current", {"--current", "-0.5,1.25"}},
    {"events-step", {"--events", events_placeholder, "--events-step", "verlet"}},
};

ExportOptions options_of(Words words) {
    CLI::App app;
    ExportFlags flags;
    flags.add_to(app);
    app.parse(Words(words.rbegin(), words.rend()));
    return flags.resolve();
}

/// Replaces the placeholder by an events file in `folder`, and writes that file.
Words with_events_of(const std::filesystem::path& folder, Words words) {
    for (std::string& word : words)
        if (word == events_placeholder) {
            word = (folder / "sea_events.csv").string();
            std::ofstream(word) << "time,x,z,radius,height\n0.5,1,2,1,0.4\n";
        }
    return words;
}

/// Returns a number of the sea halfway between its default and its least or greatest value, for options
/// whose default has an effect; nothing for others.
std::optional<Words> another_value_of_sea(const std::string& name) {
    if (other_values.contains(name)) return {};
    for (const SeaStateField& field : sea_state_fields()) {
        std::string flag(field.name.substr(0, field.name.find_last_of('_')));
        for (std::string text : {flag, std::string(field.name)}) {
            std::replace(text.begin(), text.end(), '_', '-');
            if (text != name || field.also) continue;
            const double usual = field.value_in({}), limit = usual < field.max ? field.max : field.min;
            return Words{"--" + name, number_text(0.5 * (usual + limit))};
        }
    }
    return {};
}

/// Splits a line without quotes into words.
Words split(const std::string& line) {
    std::istringstream stream(line);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

void expect_round_trip(Words words) {
    const TemporaryFolder folder;
    words = with_events_of(folder.path(), std::move(words));
    words.insert(words.end(), {"--out", folder.path().string()});
    const ExportOptions options = options_of(words);
    const Json record = options_as_json(options);
    EXPECT_EQ(options_as_json(options_of_record(ReadJson(record), folder / "sea.json")), record);

    write_record(OutputFolder(folder.path(), Sync::no), "sea.json", record, [](const auto&) {});
    Words line = split(command_line_of(options, folder / "sea.json"));
    ASSERT_EQ(line.at(1), "export");
    line.erase(line.begin(), line.begin() + 2);
    const ExportOptions again = options_of(line);
    EXPECT_EQ(options_as_json(again), record) << command_line_of(options, folder / "sea.json");
    EXPECT_EQ(again.folder, options.folder);
}

TEST(ExportFromRecord, KeepsEachOptionOfExport) {
    const TemporaryFolder folder;
    const Json usual = options_as_json(options_of({"--out", folder.path().string()}));
    CLI::App app;
    ExportFlags flags;
    flags.add_to(app);
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_lnames().at(0);
        SCOPED_TRACE("--" + name);
        if (unrecorded.contains(name)) continue;
        const std::optional<Words> of_sea = another_value_of_sea(name);
        if (!other_values.contains(name) && !of_sea) {
            ADD_FAILURE() << "is it in options_as_json() and in export_from_record.cpp? Then give this test a value";
            continue;
        }
        const Words another = of_sea ? *of_sea : other_values.at(name);
        Words words = with_events_of(folder.path(), another);
        words.insert(words.end(), {"--out", folder.path().string()});
        EXPECT_NE(options_as_json(options_of(words)), usual) << "the record does not hold it";
        expect_round_trip(another);
    }
}

TEST(ExportFromRecord, KeepsCombinedOptions) {
    expect_round_trip({"--frames", "7-7"});
    expect_round_trip({"--frames", "loop", "--loop-period", "20", "--fps", "24"});
    expect_round_trip({"--start", "1e9", "--frames", "2"});
}

TEST(ExportFromRecord, KeepsNamePatternsAndForecasts) {
    const TemporaryFolder folder;
    const ExportOptions named = options_of({"--out", (folder / "wave.####.tif").string()});
    const Json record = options_as_json(named);
    EXPECT_EQ(options_as_json(options_of_record(ReadJson(record), folder / "sea.json")), record);
    EXPECT_NE(command_line_of(named, folder / "sea.json").find("--out '" + (folder / "wave.####.tif").string() + "'"),
              std::string::npos);

    write_file(folder / "weather.toml",
               "wind_speed = 9\nresolution = 32\n[[change]]\nfrom = 2\nover = 3\nwind_speed = 12\n[[change]]\nfrom = "
               "9\nover = 1\nswell_height = 1\n"
               "swell_from = 4e4\n");
    expect_round_trip({"--weather", (folder / "weather.toml").string(), "--frames", "20"});
}

TEST(ExportFromRecord, RejectsRecordsThatNoExportWrites) {
    const TemporaryFolder folder;
    const Json usual = options_as_json(options_of({"--out", folder.path().string()}));
    const auto message_of = [&](const std::string& pointer, const ReadJson& value) -> std::string {
        ReadJson edited = usual;
        edited[ReadJson::json_pointer(pointer)] = value;
        try {
            options_of_record(edited, folder / "sea.json");
        } catch (const InputError& error) {
            return error.what();
        } catch (const DamagedRecord&) {
            return "damaged";
        }
        return "accepted";
    };
    const auto expect_message = [&](const std::string& line, const std::string& message) {
        EXPECT_NE(line.find(message), std::string::npos) << line;
    };
    expect_message(message_of("/version", "99.0"), "was written by pelagic 99.0, expected");
    expect_message(message_of("/export/maps", "whales"), "--maps is whales");
    expect_message(message_of("/export/frames", -1), "--frames is -1");
    expect_message(message_of("/export/help", true), "sea.json: ");
    expect_message(message_of("/export/trace", "/tmp/somewhere"), "--trace is /tmp/somewhere, not not set");
    expect_message(message_of("/export/out", "elsewhere"), "sea.json: ");
    expect_message(message_of("/export/names", "../../../etc/wave.####.exr"), "sea.json: ");
    expect_message(message_of("/sea/wind_speed_mps", 1e6), "wind_speed");
    EXPECT_EQ(message_of("/export", 3), "damaged");
    EXPECT_EQ(message_of("/export/mips", ReadJson{{"a", {{"b", 1}}}}), "damaged");
}

// A record that is written frame by frame equals the JSON of the whole record, with one line per
// frame.
TEST(RecordFile, EqualsTheWholeRecord) {
    const TemporaryFolder folder;
    const OutputFolder place(folder.path(), Sync::no);
    const Json head = {{"version", "1"}, {"sea", {{"a", 1.5}, {"b", Json::array()}}}};
    for (const int count : {0, 1, 3}) {
        Json whole = head;
        whole["frames"] = Json::array();
        std::vector<FrameRecord> frames;
        for (int i = 0; i < count; ++i) {
            frames.push_back({.frame = i,
                              .time_s = i / 24.,
                              .hash = "h",
                              .foam_hash = "",
                              .dynamic_waves_hash = "",
                              .files = {{"a", "b"}, {"c", "d"}}});
            whole["frames"].push_back(frame_as_json(frames.back()));
        }
        write_record(place, "record", head, [&](const auto& take) {
            for (const FrameRecord& frame : frames) take(frame);
        });
        const std::string text = read_file(folder / "record");
        EXPECT_EQ(Json::parse(text), whole);
        std::string expected = head.dump(2);
        expected.resize(expected.size() - 2);  // the last brace and the line break before it
        expected += ",\n  \"frames\": [";
        for (int i = 0; i < count; ++i)
            expected += (i == 0 ? "\n    " : ",\n    ") + whole["frames"][static_cast<std::size_t>(i)].dump();
        EXPECT_EQ(text, expected + (count > 0 ? "\n  ]\n}\n" : "]\n}\n"));
        Json read = head;
        read["frames"] = Json::array();
        EXPECT_TRUE(read_record(place, "record",
                                {.head = [&](const ReadJson& read_head) { return read_head == ReadJson(head); },
                                 .frame =
                                     [&](const ReadJson& entry) {
                                         read["frames"].push_back(Json(entry));
                                         return true;
                                     }}));
        EXPECT_EQ(ReadJson(read), ReadJson(whole));
    }
}

}  // namespace
}  // namespace pelagic::tools
