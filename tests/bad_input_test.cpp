// Invalid input gives exit code 2 and one line that names the option, the value and the accepted
// values; no file is written.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

struct BadInput {
    std::vector<std::string>
        /// OUT is replaced by the path of a folder that does not exist, CONFIG by a file that holds
        /// `config`
        arguments;
    std::vector<std::string> expected;  ///< the error message contains each of these strings
    std::string config = {};
};

std::vector<BadInput> bad_inputs() {
    std::vector<BadInput> all = {
        // Subcommands and unexpected arguments.
        {{}, {"no command", "bench", "export", "info", "quadtree"}},
        {{"exprot"}, {"exprot", "export"}},
        {{"--frobnicate"}, {"--frobnicate", "export"}},
        {{"export", "--out", "OUT", "stray"}, {"stray", "unexpected"}},
        {{"export", "--out", "OUT", "--wnid-speed", "3"}, {"--wnid-speed", "--wind-speed"}},
        {{"export", "--out", "OUT", "--resolutoin=64"}, {"--resolutoin", "--resolution"}},
        {{"info", "--out", "OUT"}, {"--out", "unknown"}},
        {{"export", "--out", "OUT", "--seed", "1", "--seed", "2"}, {"--seed", "2 times", "once"}},
        {{"export", "--out", "OUT", "--seed"}, {"--seed", "requires a value"}},
        {{"export", "--out", "OUT", "--system", "height=-1"}, {"--system \"height=-1\": height -1", "(0, 30]"}},
        {{"export", "--out", "OUT", "--config", "CONFIG"}, {"CONFIG:2: height -1", "(0, 30]"}, "[[system]]\nheight = -1\n"},
        // Output paths.
        {{"export"}, {"--out", "missing", "folder"}},
        {{"export", "--out", ""}, {"--out", "folder"}},
        {{"export", "--out", "CONFIG"}, {"--out", "CONFIG", "is a file"}},
        {{"export", "--out", "CONFIG/below"}, {"--out", "CONFIG", "is a file"}},
        {{"export", "--out", "OUT/wave.%04x.exr"}, {"--out", "wave.%04x.exr", "a folder", "wave.####.exr"}},
        {{"export", "--out", "OUT/##.wave.##.exr"}, {"--out", "##.wave.##.exr", "a folder", "wave.####.exr"}},
        {{"export", "--out", "OUT/wave.####.jpg"}, {"--out", "wave.####.jpg", ".exr, .tif, .ktx2 or .dds"}},
        {{"export", "--out", "OUT/wave.####.exr", "--format", "tif"},
         {"--format", "wave.####.exr", "the same format"}},
        {{"export", "--out", "OUT.png"}, {"--out", "a folder", "wave.####.exr"}},
        {{"export", "--out", "OUT", "--frames", "20-10"}, {"--frames", "20-10", "10-20,40"}},
        {{"export", "--out", "OUT", "--frames", "1-5", "--start-number", "3"},
         {"--frames", "1-5", "--start-number, 3"}},
        {{"export", "--out", "OUT", "--frames", "2", "--start-number", "999999"},
         {"--frames", "at most 1", "--start-number"}},
        {{"export", "--out", "OUT", "--frames", "loop", "--loop-period", "1.01"},
         {"--frames", "loop", "24.24", "--loop-period 1 "}},
        {{"export", "--out", "OUT", "--start-number", "-1"}, {"--start-number", "-1", "0 to 999999"}},
        // Output files.
        {{"export", "--out", "OUT", "--compression", "lzw"},
         {"--compression", "is lzw", "zip, zips, piz, dwaa or none"}},
        {{"export", "--out", "OUT", "--format", "tif", "--compression", "piz"},
         {"--compression", "is piz", "zip, lzw or none"}},
        {{"export", "--out", "OUT", "--maps", "foam", "--compression", "piz"},
         {"--compression", "is piz", "EXR", "PNG"}},
        {{"export", "--out", "OUT", "--maps", "foam", "--tiled"}, {"--tiled", "EXR"}},
        {{"export", "--out", "OUT", "--pack", "bits"}, {"--pack", "is bits", "files, layers or parts"}},
        {{"export", "--out", "OUT", "--pack", "parts", "--mips"}, {"--pack", "is parts", "--tiled"}},
        {{"export", "--out", "OUT", "--pack", "layers", "--format", "tif"}, {"--pack", "is layers", "--format exr"}},
        // Options of `pelagic quadtree`.
        {{"bench", "--sizes", "64,100"}, {"--sizes", "is 64,100", "powers of two from 16 to 2048"}},
        {{"bench", "--sizes", "4096"}, {"--sizes", "is 4096", "powers of two from 16 to 2048"}},
        {{"bench", "--sizes", "64,"}, {"--sizes", "is 64,", "powers of two from 16 to 2048"}},
        {{"bench", "--sizes", "-64"}, {"--sizes", "is -64", "powers of two from 16 to 2048"}},
        {{"bench", "--headset", "--sizes", "64"}, {"--sizes", "--headset", "leave out"}},
        {{"bench", "--textures-only", "--bytes", "bytes.json"}, {"--textures-only", "--bytes", "cannot be combined"}},
        {{"bench", "--cost", "--headset"}, {"--headset", "--cost", "cannot be combined"}},
        {{"bench", "--cost", "--sizes", "64"}, {"--sizes", "--cost", "cannot be combined"}},
        {{"bench", "--cost", "--threads", "2"}, {"--threads", "--cost", "cannot be combined"}},
        {{"bench", "--seconds", "0"}, {"--seconds", " 0 is out of range", "[0.1, 3600]"}},
        {{"bench", "--seconds", "long"}, {"--seconds", " long is out of range", "[0.1, 3600]"}},
        {{"bench", "--isa", "mmx"}, {"--isa", "is mmx", "on this CPU"}},
        {{"bench", "--threads", "-1"}, {"--threads", "is -1", "0 to 1024"}},
        {{"bench", "--json", ""}, {"--json", "empty", "a file"}},
        {{"quadtree", "--size", "255"}, {"--size", " 255 is out of range", "[256, 8192]"}},
        {{"quadtree", "--size", "9000"}, {"--size", " 9000 is out of range", "[256, 8192]"}},
        {{"quadtree", "--size", "nan"}, {"--size", " nan is out of range", "[256, 8192]"}},
        {{"quadtree", "--quality", "best"}, {"--quality", "is best", "low, medium, high, ultra"}},
        {{"quadtree", "--camera", "1,2"}, {"--camera", "is 1,2", "X,Y,Z"}},
        {{"quadtree", "--camera", "1,nan,2"}, {"--camera", "is 1,nan,2", "X,Y,Z"}},
        {{"quadtree", "--target", "1,2,1e9"}, {"--target", " 1,2,1e9", "[-1e7, 1e7]"}},
        {{"quadtree", "--camera", "1,2,3", "--target", "1,2,3"},
         {"--target", "1,2,3", "another place than --camera"}},
        {{"quadtree", "--fov", "0"}, {"--fov", " 0 is out of range", "[1, 160]"}},
        {{"quadtree", "--fov", "180"}, {"--fov", " 180 is out of range", "[1, 160]"}},
        {{"quadtree", "--stereo", "0"}, {"--stereo", " 0 is out of range", "(0, 1]"}},
        {{"quadtree", "--stereo", "-0.06"}, {"--stereo", " -0.06 is out of range", "(0, 1]"}},
        {{"quadtree", "--time", "noon"}, {"--time", " noon is out of range", "[-1e9, 1e9]"}},
        {{"quadtree", "--obj", ""}, {"--obj", "empty", "a file"}},
        {{"quadtree", "--wind-speed", "-3"}, {"--wind-speed", " -3 is out of range"}},
        // Options of `pelagic export`.
        {{"export", "--out", "OUT", "--frames", "0"}, {"--frames", "is 0", "1 to 1000000"}},
        {{"export", "--out", "OUT", "--frames", "-4"}, {"--frames", "is -4", "1 to 1000000"}},
        {{"export", "--out", "OUT", "--frames", "2.5"}, {"--frames", "is 2.5", "whole number"}},
        {{"export", "--out", "OUT", "--frames", "many"}, {"--frames", "is many", "whole number"}},
        {{"export", "--out", "OUT", "--frames", "99999999999999999999"}, {"--frames", "1 to 1000000"}},
        {{"export", "--out", "OUT", "--loop-frames", "0"}, {"--loop-frames", "is 0", "1 to 1000000"}},
        {{"export", "--out", "OUT", "--loop-frames", "8", "--fps", "24"}, {"--loop-frames is 8", "--fps is 24"}},
        {{"export", "--out", "OUT", "--loop-frames", "8", "--frames", "8"}, {"--loop-frames is 8", "--frames is 8"}},
        {{"export", "--out", "OUT", "--fps", "0"}, {"--fps", " 0 is out of range", "(0, 1000]"}},
        {{"export", "--out", "OUT", "--fps", "-24"}, {"--fps", " -24 is out of range", "(0, 1000]"}},
        {{"export", "--out", "OUT", "--fps", "nan"}, {"--fps", " nan is out of range", "(0, 1000]"}},
        {{"export", "--out", "OUT", "--start", "inf"}, {"--start", " inf", "[-1e9, 1e9]"}},
        {{"export", "--out", "OUT", "--start", "noon"}, {"--start", " noon", "[-1e9, 1e9]"}},
        {{"export", "--out", "OUT", "--maps", "colour"}, {"--maps", "is colour", "displacement", "gradient"}},
        {{"export", "--out", "OUT", "--maps", ""}, {"--maps", "displacement", "gradient"}},
        {{"export", "--out", "OUT", "--maps", "gradient,gradient"}, {"--maps", "gradient,gradient"}},
        {{"export", "--out", "OUT", "--maps", "foam,foam"},
         {"--maps is foam,foam, expected displacement, gradient, normal, foam, velocity, jacobian, slope, "
          "compression or some of "
          "them with commas, each once"}},
        {{"export", "--out", "OUT", "--format", "bmp"}, {"--format", "is bmp", "exr, tif, ktx2 or dds"}},
        {{"export", "--out", "OUT", "--threads", "-1"}, {"--threads", "is -1", "0 to 1024"}},
        {{"export", "--out", "OUT", "--threads", "2000"}, {"--threads", "is 2000", "0 to 1024"}},
        {{"export", "--out", "OUT", "--threads", "two"}, {"--threads", "is two", "0 to 1024"}},
        {{"export", "--out", "OUT", "--isa", "mmx"}, {"--isa", "is mmx", "on this CPU"}},
#if defined(__x86_64__)
        {{"export", "--out", "OUT", "--isa", "neon"}, {"--isa", "is neon", "sse4.2", "on this CPU"}},
#endif
        {{"export", "--out", "OUT", "--trace", ""}, {"--trace", "empty", "file"}},
        {{"export", "--out", "OUT", "--trace", "/tmp"}, {"--trace", "/tmp", "is a folder"}},
        {{"export", "--out", "OUT", "--trace", "new/"}, {"--trace", "new/", "is a folder"}},
        {{"export", "--out", "OUT", "--trace", "/dev/null"}, {"--trace", "/dev/null", "is a device"}},
        {{"export", "--out", "OUT", "--trace", "OUT/sea.json"}, {"--trace", "OUT/sea.json", "uses that one itself"}},
        {{"export", "--out", "OUT/", "--trace", "OUT/./gradient_0000.png"}, {"--trace", "uses that one itself"}},
        // File names.
        {{"export", "--out", "OUT", "--spectrum", "jonsawp"}, {"--spectrum", "is jonsawp", "nearest is jonswap"}},
        {{"export", "--out", "OUT", "--spectrum", ""}, {"--spectrum", "phillips-paper"}},
        {{"export", "--out", "OUT", "--preset", "strom"}, {"--preset", "is strom", "nearest is storm"}},
        {{"info", "--preset", "hurricane"},
         {"--preset is hurricane, expected pond, calm, lake, analytic-calm, analytic-moderate, swell, moderate, "
          "rough, "
          "analytic-intense, storm or beaufort-0 to beaufort-12\n"}},
        {{"info", "--preset", "beufort-12"}, {"beaufort-0 to beaufort-12 (the nearest is beaufort-12)\n"}},
        {{"info", "--waves", "pon"},
         {"--waves is pon, expected spectrum, analytic, pond or regular (the nearest is pond)\n"}},
        // Options that have no effect, and values of 0 that are out of range.
        {{"export", "--out", "OUT", "--wave-height", "3", "--spectrum", "phillips"},
         {"--wave-height is 3, expected 0 where the spectrum is phillips"}},
        {{"info", "--peak-period", "8", "--fetch", "1e5"},
         {"--fetch is 1e5; it requires no --wave-height and no --peak-period"}},
        {{"info", "--config", "CONFIG"},
         {"fetch is 5000; it requires no --wave-height and no --peak-period"},
         "fetch = 5000\nwave_height = 2\n"},
        {{"info", "--peak-period", "0"}, {"--peak-period 0 is out of range [1, 40] s"}},
        {{"info", "--wave-height", "-1"}, {"--wave-height -1 is out of range (0, 30]"}},
        {{"info", "--waves", "analytic", "--peak-period", "8"},
         {"--peak-period is 8, expected 0 where waves is analytic"}},
        {{"info", "--spectrum", "none"}, {"spectrum is none, expected a swell or a system with it"}},
        {{"query", "--waves", "pond", "--wave-strength", "1"},
         {"--wave-strength is 1; it requires --waves analytic\n"}},
        {{"info", "--waves", "analytic", "--wave-drag", "0"}, {"--wave-drag is 0; it requires --waves pond"}},
        {{"info", "--preset", "pond", "--choppiness", "0.5"},
         {"--choppiness is 0.5; it requires --waves spectrum, analytic or regular"}},
        {{"info", "--waves", "analytic", "--seed", "2"}, {"--seed is 2; it requires --waves spectrum"}},
        {{"info", "--spectrum", "pierson-moskowitz", "--fetch", "1e5"},
         {"--fetch is 1e5; it requires --spectrum jonswap"}},
        {{"info", "--spreading", "hasselmann", "--wind-alignment", "1"}, {"it requires --spreading paper"}},
        {{"info", "--swell-period", "14"}, {"--swell-period is 14; it requires --swell-height"}},
        {{"info", "--config", "CONFIG"},
         {"CONFIG:2: longest_wave is 50; it requires --waves analytic or pond"},
         "seed = 3\nlongest_wave = 50\n"},
        {{"export", "--out", "OUT", "--weather", "CONFIG"},
         {"CONFIG:4: wave_count is 8; it requires --waves analytic or pond"},
         "[[change]]\nfrom = 5\nover = 5\nwave_count = 8\n"},
        {{"info", "--patch-size", "0"}, {"--patch-size 0 is out of range [0.001, 1e6]"}},
        {{"info", "--config", "CONFIG"}, {"CONFIG:1: cascades is 0, expected 1, 2, 3 or 4\n"}, "cascades = 0\n"},
        {{"info", "--roughness", "-1"}, {"--roughness -1 is out of range [0, 1] or wind"}},
        {{"info", "--waves", "pond", "--wave-height", "0"}, {"--wave-height 0 is out of range (0, 30]"}},
        {{"info", "--preset", "analytic-intense", "--wave-height", "30"},
         {"steepness is ", "ask for less --wave-height or --wave-strength"}},
        {{"info", "--cascades", "7"}, {"--cascades is 7, expected 1, 2, 3 or 4\n"}},
        {{"info", "--waves", "pond", "--wave-count", "65"}, {"--wave-count is 65, expected 1 to 64\n"}},
        {{"export", "--out", "OUT", "--waves", "analytic", "--wave-height", "9"},
         {"steepness is 1.0", "at most 0.4"}},
        {{"export", "--out", "OUT", "--preset", "pond", "--cascades", "4"},
         {"cascades is 4, expected 1 where waves is pond\n"}},
        {{"info", "--spectrum", "sine"}, {"expected phillips-paper, phillips, pierson-moskowitz, jonswap or none"}},
        {{"quadtree", "--quality", "hihg"}, {"low, medium, high, ultra", "nearest is high"}},
        {{"help", "exprot"}, {"exprot", "info, export, merge, verify"}},
        {{"info", "--frobnicate"}, {"unknown option --frobnicate; pelagic info --help lists all"}},
        // Config files.
        {{"export", "--out", "OUT", "--config", "/nowhere/sea.toml"},
         {"--config", "/nowhere/sea.toml", "can't be read"}},
        {{"export", "--out", "OUT", "--config", "/tmp"}, {"--config", "/tmp", "folder"}},
        {{"info", "--config", "/proc/self/mem"}, {"--config", "/proc/self/mem", "can't be read"}},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:2", "wind_sped", "expected preset, waves, spectrum,", "nearest is wind_speed"},
         "seed = 1\nwind_sped = 3\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"}, {"CONFIG:1"}, "wind_speed = = 3\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"}, {"CONFIG:2", "seed"}, "seed = 1\nseed = 2\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:1", "wind_speed", "-3", "(0, 60]"},
         "wind_speed = -3\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:1", "wind_speed", "nan", "(0, 60]"},
         "wind_speed = nan\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:1", "wind_speed", "boolean"},
         "wind_speed = true\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:1", "resolution", "64.5", "power of two"},
         "resolution = 64.5\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"}, {"CONFIG:1", "sea", "known"}, "[sea]\nseed = 1\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"}, {"CONFIG:1", "seed", "array"}, "seed = [1, 2]\n"},
        {{"export", "--out", "OUT", "--config", "CONFIG"},
         {"CONFIG:1", "preset", "strom", "storm"},
         "preset = \"strom\"\n"},
        {{"info", "--config", "CONFIG"}, {"CONFIG:1", "spectrum", "sine", "jonswap"}, "spectrum = \"sine\"\n"},
        {{"info", "--spectrum", "phillips-paper", "--swell-height", "2"},
         {"--swell-height is 2, expected 0 where the spectrum is phillips-paper"}},
        // A file of --config that is called sea.json.
        {{"info", "--config", "CONFIG"}, {"CONFIG:3", "malformed JSON", "sea.json"}, "{\n\"sea\": {\n"},
        {{"info", "--config", "CONFIG"}, {"CONFIG", "malformed JSON"}, "{\"sea\": {\"seed\": 1e999}}"},
        {{"info", "--config", "CONFIG"}, {"CONFIG holds no sea", "sea.json"}, "{\"frames\": []}"},
        {{"info", "--config", "CONFIG"}, {"CONFIG holds no sea"}, "{\"sea\": [1]}"},
        {{"info", "--config", "CONFIG"},
         {"CONFIG", "wind_sped_mps", "wind_speed"},
         "{\"sea\": {\"wind_sped_mps\": 3}}"},
        {{"info", "--config", "CONFIG"},
         {"CONFIG", "wind_speed", "-3", "(0, 60]"},
         "{\"sea\": {\"wind_speed_mps\": -3}}"},
        {{"info", "--config", "CONFIG"}, {"CONFIG", "seed", "array"}, "{\"sea\": {\"seed\": [1]}}"},
        {{"info", "--config", "CONFIG"}, {"CONFIG", "seed", "without quotes"}, "{\"sea\": {\"seed\": \"1\"}}"},
        {{"export", "--out", "OUT", "--cascades", "3", "--patch-size", "100"}, {"cascades is 3, expected 1", "side"}},
        {{"export", "--out", "OUT", "--cascades", "2", "--resolution", "16"},
         {"cascades is 2, expected 1", "resolution"}},
        {{"export", "--out", "OUT", "--cascades", "2", "--spectrum", "phillips-paper"},
         {"cascades is 2, expected 1", "paper"}},
        // An invalid value in the file is an error even where a flag overrides it.
        {{"export", "--out", "OUT", "--wind-speed", "5", "--config", "CONFIG"},
         {"CONFIG:1", "-3"},
         "wind_speed = -3\n"},
    };
    // Each number of the sea: too small, too large, infinite, NaN and not a number.
    struct Range {
        std::string flag, accepted;
        std::vector<std::string> values;
    };
    for (const auto& [flag, accepted, values] :
         std::vector<Range>{{"--resolution",
                             "a power of two from 16 to 2048",
                             {"1", "8", "100", "4096", "-64", "64.0", "1e2", "0x40", "", "64 "}},
                            {"--cascades", "1, 2, 3 or 4", {"5", "-1", "1.5", "many"}},
                            {"--patch-size", "[0.001, 1e6]", {"0.0009", "-250", "2e6", "nan", "inf", "250m"}},
                            {"--wind-speed", "(0, 60]", {"0", "-3", "61", "nan", "inf", "-inf", "abc", "12,5"}},
                            {"--wind-direction", "[-360, 360]", {"361", "-400", "nan", "north"}},
                            {"--fetch", "(0, 2e6]", {"0", "-1", "3e6", "inf"}},
                            {"--depth", "[0.01, 11000]", {"0", "1e-300", "0.009", "-10", "12000", "deep"}},
                            {"--choppiness", "[0, 1]", {"-0.1", "1.01", "nan"}},
                            {"--lean", "[0, 0.6] or wind", {"-0.1", "0.61", "nan"}},
                            {"--roughness", "[0, 1] or wind", {"-0.1", "1.01", "from-W"}},
                            {"--short-wave-cutoff", "[0, 1]", {"-0.1", "2"}},
                            {"--wind-alignment", "[0, 1]", {"-1", "1.5"}},
                            {"--swell-height", "[0, 30]", {"-1", "31"}},
                            {"--swell-period", "[1, 40]", {"0", "41"}},
                            {"--swell-direction", "[-360, 360]", {"361", "west"}},
                            {"--swell-spread", "degrees in [1, 80]", {"0", "81", "from-W"}},
                            {"--spreading", "paper, cosine-2s, hasselmann or donelan-banner", {"cosine", "1"}},
                            {"--loop-period", "[0.1, 86400]", {"0", "-200", "1e5", "nan"}},
                            {"--seed", "a whole number from 0 to 4294967295", {"-1", "4294967296", "1.5", "luck"}}})
        for (const std::string& value : values) {
            // One parser reads all flags. Under a sanitizer each flag is tried with one of its
            // values, and each kind of value with some flag.
            if (is_sanitized && &value != &values[flag.size() % values.size()]) continue;
            all.push_back({{"export", "--out", "OUT", flag, value}, {flag + " ", value, accepted}});
        }
    return all;
}

TEST(BadInput, ErrorNamesOptionValueAndRangeAndNoFileIsWritten) {
    const std::vector<BadInput> all = bad_inputs();
    EXPECT_GE(all.size(), 40u);
    for (const BadInput& bad : all) {
        const TemporaryFolder folder;
        const std::string config = (folder / "sea.toml").string();
        write_file(config, bad.config);
        const auto filled_in = [&](std::string text) {
            for (const auto& [name, value] :
                 {std::pair<std::string, std::string>{"OUT", (folder / "out").string()}, {"CONFIG", config}})
                if (const auto at = text.find(name); at != std::string::npos) text.replace(at, name.size(), value);
            return text;
        };
        std::vector<std::string> arguments;
        std::string command = "pelagic";
        for (const std::string& argument : bad.arguments)
            command += " " + arguments.emplace_back(filled_in(argument));

        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << command;
        EXPECT_EQ(outcome.out, "") << command;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command << "\n" << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("pelagic: ")) << outcome.err;
        for (const std::string& word : bad.expected)
            EXPECT_NE(outcome.err.find(filled_in(word)), std::string::npos) << command << "\n"
                                                                            << outcome.err << "lacks " << word;
        EXPECT_EQ(files_in(folder.path()).size(), 1u) << command << " wrote something";
    }
}

TEST(BadInput, AConfigFileOfMoreThan64MiBIsRejected) {
    const TemporaryFolder folder;
    write_file(folder / "sea.toml", "");
    // a sparse file, which takes no disk space
    std::filesystem::resize_file(folder / "sea.toml", (std::uintmax_t{64} << 20) + 1);
    const Outcome outcome = run_pelagic({"info", "--config", (folder / "sea.toml").string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("which has more than 64 MiB, expected a TOML file"), std::string::npos) << outcome.err;
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

// toml++ recurses for each component of a key and for each nested value: 100,000 levels would
// overflow the stack.
TEST(BadInput, ATomlFileOfManyLevelsIsRejected) {
    const std::string dots = repeated("a.", 100'000) + "a";
    const std::vector<std::pair<std::string, std::string>> files = {
        {dots + " = 1\n", ":1: a line of more than 4096 bytes"},
        {"[" + dots + "]\n", ":1: a line of more than 4096 bytes"},
        {"seed = 1\n[[" + dots + "]]\n", ":2: a line of more than 4096 bytes"},
        {"seed = 1\n\n" + repeated("a.", 1000) + "a = 1\n", ":3: a line with more than 16 dots"},
        {"a = \"\"\"\n# \"\"\"\n\"#\"." + repeated("a.", 20) + "a = 1\n", ":3: a line with more than 16 dots"},
        {"a = " + repeated("[\n", 100'000), ""},
        {"a = " + repeated("[{a.a.a.a.a.a.a.a = \n", 30'000), ""},
        {repeated("# the sea of the film\n", 100'000), ":1: TOML of more than 1 MiB"}};
    for (const auto& [text, expected] : files)
        for (const char* option : {"--config", "--weather"}) {
            const TemporaryFolder folder;
            write_file(folder / "sea.toml", text);
            const Outcome outcome = run_pelagic({"info", option, (folder / "sea.toml").string()});
            EXPECT_EQ(outcome.exit_code, 2) << option << text.substr(0, 40);
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
            EXPECT_NE(outcome.err.find("sea.toml" + expected), std::string::npos)
                << outcome.err << "lacks " << expected;
        }
    const TemporaryFolder folder;
    write_file(folder / "sea.toml", "# " + repeated(".", 80) + "\nseed = 7 # " + repeated(".", 80) + "\n");
    EXPECT_EQ(run_pelagic({"info", "--config", (folder / "sea.toml").string()}).exit_code, 0)
        << "comments may have dots";
}

// The search for the nearest preset name took 22 s of CPU time for this name; a sanitizer takes ten
// times as long per byte.
TEST(BadInput, APresetNameOf60MillionBytesIsRejected) {
    const TemporaryFolder folder;
    const std::string name(is_sanitized ? 6'000'000 : 60'000'000, 'x');
    write_file(folder / "sea.json", R"({"sea": {"preset": ")" + name + R"("}})");
    const Outcome outcome = run_pelagic({"info", "--config", (folder / "sea.json").string()}, [] {
        const rlimit ten_seconds{10, 10};
        ::setrlimit(RLIMIT_CPU, &ten_seconds);
    });
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_LT(outcome.err.size(), 300u);
    EXPECT_NE(outcome.err.find("sea: preset is xxx"), std::string::npos) << outcome.err;
}

TEST(BadInput, HelpAndVersionAreNoErrors) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"--help"}, {"--version"}, {"export", "--help"}, {"info", "--help"}}) {
        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_NE(outcome.out.find("pelagic"), std::string::npos);
    }
    const std::string help = run_pelagic({"export", "--help"}).out;
    EXPECT_EQ(run_pelagic({"help", "export"}).out, help);
    EXPECT_EQ(run_pelagic({"help"}).out, run_pelagic({"--help"}).out);
    for (const char* part :
         {"--wind-speed", "m/s", "(0, 60]", "(default: 12)", "power of two", "storm", "--help-pixels"})
        EXPECT_NE(help.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace pelagic
