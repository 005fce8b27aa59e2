// `pelagic info --measure` on exports of known seas, on files with hand-written waves, and on
// folders of foreign files.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/measure/fourier.hpp"
#include "pelagic/tools/measure/wave_measurement.hpp"

namespace pelagic {
namespace {

using nlohmann::json;
using std::numbers::pi;

void export_to_measure(const std::filesystem::path& folder, std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"export", "--out", folder.string(), "--no-sync", "--overwrite"});
    if (std::find(flags.begin(), flags.end(), "--maps") == flags.end())
        flags.insert(flags.end(), {"--maps", "displacement"});
    const Outcome outcome = run_pelagic(flags);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

json measured(const std::filesystem::path& folder) {
    const Outcome outcome = run_pelagic({"info", "--json", "--measure", folder.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
}

double figure(const json& found, const char* name, const char* of = "found") {
    return found["waves"][name][of].get<double>();
}

/// Integrates a spectrum over its sample positions; each band extends halfway to its neighbours.
double integral(const json& spectrum, const char* at, const char* density) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < spectrum.size(); ++i)
        sum += spectrum[i][density].get<double>() *
               (spectrum[i + 1][at].get<double>() - spectrum[i - 1][at].get<double>()) / 2;
    return sum;
}

TEST(Fourier, MatchesTheDefinitionForAnyLength) {
    for (const std::size_t n : {1u, 2u, 3u, 7u, 16u, 45u, 64u, 100u}) {
        std::vector<std::complex<double>> values(n);
        for (std::size_t p = 0; p < n; ++p)
            values[p] = {std::sin(1.7 * static_cast<double>(p * p)), std::cos(0.3 * static_cast<double>(p))};
        auto transformed = values;
        tools::fourier(transformed);
        for (std::size_t q = 0; q < n; ++q) {
            std::complex<double> sum = 0;
            for (std::size_t p = 0; p < n; ++p)
                sum += values[p] * std::polar(1.0, -2 * pi * static_cast<double>(p * q % n) / static_cast<double>(n));
            EXPECT_LT(std::abs(transformed[q] - sum), 1e-12 * static_cast<double>(n)) << n << ", " << q;
        }
    }
}

// Frame rates are twice the highest frequency and more: 8 frames a second, where the grid's
// shortest waves have a period of 2.5 s.
TEST(Measure, LoopHasTheSeedsSpectrum) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--preset", "moderate", "--patch-size", "200", "--resolution", "64",
                                       "--loop-period", "60", "--loop-frames", "120", "--wind-direction", "70"});
    const json found = measured(folder / "out");
    EXPECT_TRUE(found["frames"]["one_loop"].get<bool>());
    const double height = figure(found, "significant_wave_height_m");
    // Over a whole loop opposite waves are orthogonal, so the result does not depend on chance.
    EXPECT_NEAR(height / figure(found, "significant_wave_height_m", "realised"), 1, 1e-4);
    // One seed of a patch of three peak waves scatters by about a tenth.
    EXPECT_NEAR(height / figure(found, "significant_wave_height_m", "expected"), 1, 0.3);
    EXPECT_NEAR(figure(found, "peak_period_s") / figure(found, "peak_period_s", "realised"), 1, 0.05);
    EXPECT_NEAR(figure(found, "peak_wavelength_m") / figure(found, "peak_wavelength_m", "expected"), 1, 0.3);
    // Eight pairs of frames, which mix some opposite waves, give the direction within some degrees.
    EXPECT_NEAR(figure(found, "mean_direction_deg"), figure(found, "mean_direction_deg", "realised"), 3);
    EXPECT_NEAR(figure(found, "directional_spread_deg"), figure(found, "directional_spread_deg", "realised"), 3);
    // Parseval: both spectra hold the variance, except for the first and last band and the corners
    // beyond the last ring.
    const double variance = height * height / 16;
    EXPECT_NEAR(integral(found["by_frequency"], "frequency_hz", "found_m2_per_hz") / variance, 1, 0.05);
    EXPECT_NEAR(integral(found["by_wave_number"], "wave_number_rad_per_m", "found_m3") / variance, 1, 0.1);
    // The model's spectrum over the frequencies of the grid holds it too.
    const double expected = figure(found, "significant_wave_height_m", "expected");
    EXPECT_NEAR(integral(found["by_frequency"], "frequency_hz", "expected_m2_per_hz") / (expected * expected / 16), 1,
                0.1);
}

// A mixed sea whose former estimate of the peak was 9.56 s, where there is no peak; its wind sea
// peaks at 7.0 s and its swell at 14 s.
TEST(Measure, PeaksOfWindSeaAndSwellAreSeparate) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out",
                      {"--wind-speed",   "14", "--wind-direction",  "-130", "--spreading",    "hasselmann",
                       "--swell-height", "2",  "--swell-direction", "-60",  "--swell-period", "14",
                       "--seed",         "62", "--patch-size",      "1200", "--resolution",   "64",
                       "--loop-frames",  "400"});
    const json found = measured(folder / "out");
    // Harmonics of the loop are 7 % apart at the swell's peak, and bands of the realised spectrum are
    // 5 % wide.
    for (const char* part : {"wind_sea_peak_period_s", "swell_peak_period_s", "peak_period_s"})
        EXPECT_NEAR(figure(found, part) / figure(found, part, "realised"), 1, 0.12) << part;
    EXPECT_NEAR(figure(found, "wind_sea_peak_period_s"), 7, 0.7);
    EXPECT_NEAR(figure(found, "swell_peak_period_s"), 14, 1.6) << "few waves of the patch make it";
    // The measurement uses 256 points of the patch; the seed's statistics use all points.
    EXPECT_NEAR(figure(found, "tm01_s") / figure(found, "tm01_s", "realised"), 1, 0.02);
    EXPECT_NEAR(figure(found, "tm02_s") / figure(found, "tm02_s", "realised"), 1, 0.02);
    // Rice: crossings of a Gaussian sea are sqrt(m0 / m2) apart. Half a second between frames
    // misses few of them.
    EXPECT_NEAR(figure(found, "zero_crossing_period_s") / figure(found, "tm02_s", "realised"), 1, 0.03);
}

TEST(Measure, HalvesAndTiffAndFramesWithoutALoopAgree) {
    const TemporaryFolder folder;
    const std::vector<std::string> sea = {"--preset", "moderate", "--patch-size", "200",   "--resolution",
                                          "32",       "--frames", "150",          "--fps", "2"};
    std::vector<double> heights;
    for (const auto& more :
         std::vector<std::vector<std::string>>{{}, {"--half"}, {"--format", "tif"}, {"--format", "tif", "--half"}}) {
        export_to_measure(folder / "out", joined(sea, more));
        const json found = measured(folder / "out");
        EXPECT_FALSE(found["frames"]["one_loop"].get<bool>());
        heights.push_back(figure(found, "significant_wave_height_m"));
        EXPECT_NEAR(figure(found, "peak_period_s") / figure(found, "peak_period_s", "realised"), 1, 0.15);
        const double variance = heights[0] * heights[0] / 16;
        // Welch's windows span 75 s, about ten waves, and the lowest frequency is not among theirs.
        EXPECT_NEAR(integral(found["by_frequency"], "frequency_hz", "found_m2_per_hz") / variance, 1, 0.15);
    }
    EXPECT_EQ(heights[0], heights[2]);
    EXPECT_EQ(heights[1], heights[3]);
    EXPECT_NEAR(heights[1] / heights[0], 1, 1e-3);  // halves have 11 bits
    const json record = json::parse(read_file(folder / "out" / "sea.json"));
    EXPECT_NEAR(heights[0] / record["waves"]["significant_wave_height_m"]["measured"].get<double>(), 1, 0.01)
        << "the mean of heights beside the root of the mean of squares";
}

// Two systems of one direction, 1.5 and 1 m high, without a wind sea.
TEST(Measure, PeaksOfSystemsAreSeparate) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--spectrum", "none", "--system", "height=1.5 period=15 spread=20", "--system",
                                       "height=1 period=7 spread=20", "--patch-size", "1500", "--resolution", "64",
                                       "--loop-frames", "400"});
    const json found = measured(folder / "out");
    // As for the swell above, harmonics of the loop are 8 % apart at 15 s.
    for (const char* part : {"system_1_peak_period_s", "system_2_peak_period_s", "peak_period_s"})
        EXPECT_NEAR(figure(found, part) / figure(found, part, "realised"), 1, 0.12) << part;
    EXPECT_NEAR(figure(found, "system_1_peak_period_s"), 15, 1.6);
    EXPECT_NEAR(figure(found, "system_2_peak_period_s"), 7, 0.7);
    EXPECT_EQ(figure(found, "peak_period_s"), figure(found, "system_1_peak_period_s"));
}

/// Returns an export whose images are replaced by those of one wave with wave numbers (m, n) that
/// travels in their direction.
struct OneWave {
    static constexpr int side = 32, frames = 64, m = -3, n = 4;
    static constexpr double amplitude_m = 0.5, depth_m = 12, loop_period_s = 40;

    void write_to(const std::filesystem::path& folder) {
        export_to_measure(folder, {"--resolution", "32", "--patch-size", "100", "--depth", "12", "--loop-period",
                                   "40", "--loop-frames", "64"});
        const double k = 2 * pi / 100 * 5;
        harmonic = std::round(std::sqrt(9.80665 * k * std::tanh(k * depth_m)) * loop_period_s / (2 * pi));
        for (int frame = 0; frame < frames; ++frame) {
            std::vector<float> pixels(3 * side * side);
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i)
                    pixels[static_cast<std::size_t>(3 * (j * side + i) + 1)] = static_cast<float>(
                        amplitude_m *
                        std::cos(2 * pi * (static_cast<double>(m * i + n * j) / side - harmonic * frame / frames)));
            char name[40];
            std::snprintf(name, sizeof name, "displacement_%04d.exr", frame);
            const auto output = OIIO::ImageOutput::create("x.exr");
            ASSERT_TRUE(
                output->open((folder / name).string(), OIIO::ImageSpec(side, side, 3, OIIO::TypeDesc::FLOAT)));
            ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
            output->close();
        }
    }
    double harmonic = 0;
};

TEST(Measure, OneWaveHasItsFrequencyLengthAndDirection) {
    const TemporaryFolder folder;
    OneWave wave;
    wave.write_to(folder / "out");
    const json found = measured(folder / "out");
    EXPECT_NEAR(figure(found, "significant_wave_height_m"), 4 * wave.amplitude_m / std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(figure(found, "peak_period_s"), wave.loop_period_s / wave.harmonic, 1e-6);
    EXPECT_NEAR(figure(found, "peak_wavelength_m"), 100 / 5.0, 1e-4);
    EXPECT_NEAR(figure(found, "mean_direction_deg"), std::atan2(4.0, -3.0) * 180 / pi, 1e-4);
    // the square root of a float's rounding error
    EXPECT_NEAR(figure(found, "directional_spread_deg"), 0, 0.1);
    // All energy is in one band and one ring.
    double max = 0, all = 0;
    for (const json& ring : found["by_wave_number"]) {
        max = std::max(max, ring["found_m3"].get<double>());
        all += ring["found_m3"].get<double>();
    }
    EXPECT_NEAR(max / all, 1, 1e-9);
}

// The cascades are rotated against each other, and each holds a band of the waves.
TEST(Measure, SeveralCascadesHaveTheSeedsSpectrum) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--cascades", "3", "--resolution", "32", "--loop-period", "60",
                                       "--loop-frames", "60", "--wind-direction", "200"});
    const json found = measured(folder / "out");
    EXPECT_EQ(found["cascades"].size(), 3u);
    EXPECT_EQ(found["cascades_there"], 3);
    // At one frame a second short waves alias to each other's frequencies, and a few of them to
    // twice their own.
    EXPECT_NEAR(figure(found, "significant_wave_height_m") / figure(found, "significant_wave_height_m", "realised"), 1,
                0.02);
    const double apart = figure(found, "mean_direction_deg") - figure(found, "mean_direction_deg", "realised");
    EXPECT_LT(std::fabs(std::remainder(apart, 360)), 5);
    EXPECT_NEAR(figure(found, "directional_spread_deg"), figure(found, "directional_spread_deg", "realised"), 5);

    // If the images of a cascade are missing the others are measured, and a note is printed.
    json record = json::parse(read_file(folder / "out" / "sea.json"));
    for (json& frame : record["frames"]) frame["files"].erase(2);
    write_file(folder / "out" / "sea.json", record.dump());
    const Outcome outcome = run_pelagic({"info", "--measure", (folder / "out").string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("images of 2 of the sea's 3 cascades"), std::string::npos) << outcome.out;
}

/// Returns a wave (m, n) of a cascade's grid at a time, by the dispersion relation in deep water,
/// rounded to the loop.
std::vector<float> wave_of(const CascadePlan& cascade, int m, int n, double amplitude_m, double time_s,
                           double loop_period_s) {
    const double k = cascade.spacing() * std::hypot(m, n);
    const double periods = std::round(std::sqrt(9.80665 * k) * loop_period_s / (2 * pi));
    std::vector<float> heights;
    for (int j = 0; j < cascade.resolution; ++j)
        for (int i = 0; i < cascade.resolution; ++i)
            heights.push_back(
                static_cast<float>(amplitude_m * std::cos(2 * pi *
                                                          (static_cast<double>(m * i + n * j) / cascade.resolution -
                                                           periods * time_s / loop_period_s))));
    return heights;
}

// Two cascades, the finer one rotated by 40 degrees: energies add, and directions are in world
// axes.
TEST(Measure, WavesOfSeveralCascadesAddInWorldAxes) {
    const double turn = 40 * pi / 180, loop_s = 30;
    const CascadePlan coarse{.grid = {.side_m = 200}, .resolution = 16, .max_k = 0.2};
    const CascadePlan fine{.grid = {.side_m = 30, .cosine = std::cos(turn), .sine = std::sin(turn)},
                           .resolution = 16,
                           .number = 1,
                           .min_k = 0.2};
    const int frames = 90;
    std::vector<tools::WaveMeasurement> cascades;
    for (const CascadePlan& cascade : {coarse, fine})
        cascades.emplace_back(tools::HeightSeries{.cascade = cascade,
                                                  .depth_m = 4000,
                                                  .loop_period_s = loop_s,
                                                  .likely_peak_period_s = 6,
                                                  .frames = frames,
                                                  .step_s = loop_s / frames,
                                                  .is_one_loop = true});
    for (int frame = 0; frame < frames; ++frame) {
        const double time_s = loop_s / frames * frame;
        cascades[0].add_frame(wave_of(coarse, 4, 0, 0.4, time_s, loop_s));  // along +x
        // 90 + 40 degrees from the first wave
        cascades[1].add_frame(wave_of(fine, 0, 3, 0.3, time_s, loop_s));
    }
    const tools::MeasuredWaves found = measured_waves(cascades);
    EXPECT_NEAR(found.significant_wave_height_m, 4 * std::sqrt((0.16 + 0.09) / 2), 1e-6);
    ASSERT_TRUE(found.directions);
    const double x = 0.16 - 0.09 * std::sin(turn), z = 0.09 * std::cos(turn);
    EXPECT_NEAR(found.directions->mean_rad, std::atan2(z, x), 1e-5);
    EXPECT_NEAR(found.directions->spread_rad, std::sqrt(2 * (1 - std::hypot(x, z) / 0.25)), 1e-5);
    // Each wave is in its ring, and both are in their frequency bands.
    double rings = 0, bands = 0;
    for (const auto& ring : found.by_wave_number)
        for (const auto& [cascade, number, amplitude] : {std::tuple(coarse, 4, 0.4), std::tuple(fine, 3, 0.3)})
            if (std::fabs(ring.at - number * cascade.spacing()) < 1e-9)
                rings += ring.density * cascade.spacing() * 2 / (amplitude * amplitude);
    EXPECT_NEAR(rings, 2, 1e-6);
    for (const auto& band : found.by_frequency) bands += band.density > 0.01 ? 1 : 0;
    EXPECT_EQ(bands, 2);
}

// The same heights in files of every kind: floats are exact, halves have a relative precision of
// 2^-11, a millimetre at a height of 4 m.
TEST(Measure, LayersPartsAndTexturesMatchSingleFiles) {
    const TemporaryFolder folder;
    const std::vector<std::string> sea = {"--preset",      "rough", "--cascades",    "3", "--resolution", "64",
                                          "--loop-period", "20",    "--loop-frames", "16"};
    struct Kind {
        std::string name;
        std::vector<std::string> flags;
        bool has_halves = false;
    };
    json files;
    for (const auto& [name, flags, has_halves] : std::vector<Kind>{
             {"files", {}, false},
             {"layers", {"--pack", "layers", "--maps", "displacement,gradient,compression"}, false},
             {"parts", {"--pack", "parts", "--tiled", "--mips", "--maps", "displacement,velocity"}, false},
             {"turned", {"--pack", "layers", "--axes", "z-up", "--unit", "cm", "--rows", "bottom"}, false},
             {"ktx2", {"--format", "ktx2", "--mips"}, true},
             {"zstd", {"--format", "ktx2", "--compression", "zstd", "--axes", "z-up"}, true}}) {
        SCOPED_TRACE(name);
        export_to_measure(folder / name, joined(sea, flags));
        const json found = measured(folder / name);
        if (files.empty()) files = found;
        EXPECT_EQ(found["cascades"], files["cascades"]);
        for (const char* of :
             {"significant_wave_height_m", "peak_period_s", "peak_wavelength_m", "mean_direction_deg"})
            EXPECT_NEAR(figure(found, of) / figure(files, of), 1, has_halves ? 1e-3 : 1e-6) << of;
    }
    // A damaged texture gives one line.
    const std::filesystem::path texture = folder / "ktx2" / "displacement_c1_0003.ktx2";
    const std::string whole = read_file(texture);
    for (const auto& [bytes, reason] : std::vector<std::pair<std::string, std::string>>{
             {whole.substr(0, 90), "it ends before its texels"},
             {whole.substr(0, whole.size() - 10), "it ends before its texels"},
             {"KTX" + whole.substr(3), "it is no KTX2 file"},
             {read_file(folder / "ktx2" / "displacement_0000.ktx2").replace(20, 1, "\x20"), "it has 32 x 64 texels"},
             {std::string(whole).replace(12, 1, "\x25"), "its Vulkan format is 37"},
             {std::string(whole).replace(44, 1, "\x01"), "its supercompression scheme is 1"},
             {std::string(whole).replace(80, 8, std::string(8, '\xff')), "it ends before its texels"},
             {std::string(whole).replace(44, 1, "\x02"), "libzstd can't decompress"}}) {
        write_file(texture, bytes);
        const Outcome outcome = run_pelagic({"info", "--measure", (folder / "ktx2").string()});
        EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
        EXPECT_NE(outcome.err.find("displacement_c1_0003.ktx2: " + reason), std::string::npos) << outcome.err;
    }
}

TEST(Measure, OneFrameGivesNeitherPeriodNorDirection) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--resolution", "32"});
    const json found = measured(folder / "out");
    EXPECT_TRUE(found["waves"]["peak_period_s"]["found"].is_null());
    EXPECT_TRUE(found["waves"]["mean_direction_deg"]["found"].is_null());
    EXPECT_TRUE(found["by_frequency"].empty());
    const json record = json::parse(read_file(folder / "out" / "sea.json"));
    EXPECT_NEAR(figure(found, "significant_wave_height_m"),
                record["frames"][0]["significant_wave_height_m"].get<double>(), 1e-9);
    EXPECT_GT(figure(found, "peak_wavelength_m"), 0);
}

TEST(Measure, WritesOnlyTheRequestedImage) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--resolution", "16", "--patch-size", "250", "--loop-frames", "32"});
    const auto before = files_in(folder / "out");
    const Outcome outcome =
        run_pelagic({"info", "--measure", (folder / "out").string(), "--svg", (folder / "plot.svg").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    for (const char* part :
         {"32 frames, ", "16 x 16 texels on 250 m", "one loop", "found", "expected", "peak_wavelength_m"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << outcome.out;
    EXPECT_EQ(files_in(folder / "out"), before);
    const std::string svg = read_file(folder / "plot.svg");
    EXPECT_TRUE(svg.starts_with("<svg"));
    for (const char* part :
         {"<title>Waves of 32 frames: Hs ", "Spectrum by frequency", "Spectrum by wave number", "expected",
          ">frequency, Hz<", ">variance density, m²/Hz<", ">wave number, rad/m<", ">variance density, m³<", "</svg>"})
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    // Both ends of each axis are labelled: numbers left of x = 0 at the frame's upper and lower
    // edge (0 and 420), and below it at its left and right edge (0 and 560).
    for (const char* end :
         {"x=\"-8\" y=\"5.0\"", "x=\"-8\" y=\"425.0\"", "x=\"0.0\" y=\"446\"", "x=\"560.0\" y=\"446\""}) {
        const std::size_t first = svg.find(end);
        ASSERT_NE(first, std::string::npos) << end;
        EXPECT_NE(svg.find(end, first + 1), std::string::npos) << "of both panels: " << end;
    }
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& reason) {
    const Outcome outcome = run_pelagic(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << "expected " << reason << "\nsays " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_LT(outcome.err.size(), 400u);
    EXPECT_EQ(outcome.out, "");
}

TEST(Measure, HostileFoldersGiveOneLine) {
    const TemporaryFolder folder;
    const std::filesystem::path out = folder / "out";
    export_to_measure(out, {"--resolution", "16", "--patch-size", "250", "--frames", "3"});
    const std::string sea_json = read_file(out / "sea.json"), image = read_file(out / "displacement_0001.exr");
    const std::vector<std::string> measure = {"info", "--measure", out.string()};
    const auto with_record = [&](const auto& change, const std::string& reason) {
        json record = json::parse(sea_json);
        change(record);
        write_file(out / "sea.json", record.dump());
        expect_refused(measure, 2, reason);
        write_file(out / "sea.json", sea_json);
    };
    expect_refused({"info", "--measure", ""}, 2, "--measure is empty");
    expect_refused({"info", "--measure", (out / "sea.json").string()}, 2,
                   "expected a folder that pelagic export has written");
    expect_refused({"info", "--measure", folder.path().string()}, 2,
                   "sea.json is missing: expected a finished export");
    expect_refused({"info", "--measure", out.string(), "--wind-speed", "3"}, 2, "no sea option is accepted");
    expect_refused({"info", "--measure", out.string(), "--svg", ""}, 2, "--svg is empty");
    expect_refused({"info", "--measure", out.string(), "--svg", (folder / "none" / "x.svg").string()}, 1,
                   "can't write");
    expect_refused({"info", "--svg", "x.svg"}, 2, "it requires --measure DIR");

    with_record([](json& record) { record["export"]["pack"] = "parts"; }, "frame 0 names no displacement image");
    with_record([](json& record) { record["export"]["format"] = "dds"; },
                "expected an export with --format exr, tif or ktx2");
    with_record([](json& record) { record.erase("frames"); }, "has no frames");
    with_record([](json& record) { record["frames"] = json::array(); }, "has no frames");
    with_record([](json& record) { record["frames"][1] = 7; }, "frame 1 has no time_s");
    with_record([](json& record) { record["frames"][1]["time_s"] = "soon"; }, "frame 1 has no time_s");
    with_record([](json& record) { record["frames"][1]["time_s"] = 0.08; }, "not equally far apart");
    with_record(
        [](json& record) {
            for (json& frame : record["frames"]) frame["time_s"] = 1;
        },
        "not equally far apart");
    for (const char* name :
         {"../displacement_0001.exr", "/etc/passwd", "displacement_0001.png", "gradient_0001.png", ""})
        with_record([&](json& record) { record["frames"][1]["files"][0]["name"] = name; },
                    "frame 1 names no displacement image");
    with_record([](json& record) { record["sea"]["wind_speed_mps"] = -3; }, "(0, 60]");
    with_record([](json& record) { record["sea"] = 3; }, "holds no sea");
    with_record([](json& record) { record["deep"] = json::parse("[[[[[[[[[[1]]]]]]]]]]"); }, "malformed JSON");
    for (const std::string text : {"", "{", "[]", "\"sea\"", "{\"a\": 1e999}"}) {
        write_file(out / "sea.json", text);
        expect_refused(measure, 2, "malformed JSON");
    }
    write_file(out / "sea.json", sea_json);

    const auto with_image = [&](const std::string& bytes, const std::string& reason) {
        write_file(out / "displacement_0001.exr", bytes);
        expect_refused(measure, 1, "displacement_0001.exr: " + reason);
    };
    with_image("", "");
    with_image("no image", "");
    with_image(image.substr(0, image.size() / 2), "");
    with_image(std::string(std::size_t{2} << 20, 'x'), "it is larger than 16 x 16 pixels can be");
    export_to_measure(folder / "other", {"--resolution", "32", "--patch-size", "250"});
    with_image(read_file(folder / "other" / "displacement_0000.exr"), "it has 32 x 32 pixels, expected 16 x 16");
    std::filesystem::remove(out / "displacement_0001.exr");
    expect_refused(measure, 1, "displacement_0001.exr: No such file");
    std::filesystem::create_symlink("displacement_0000.exr", out / "displacement_0001.exr");
    expect_refused(measure, 1, "it is a symbolic link");
    std::filesystem::remove(out / "displacement_0001.exr");
    ASSERT_EQ(::mkfifo((out / "displacement_0001.exr").c_str(), 0666), 0);
    expect_refused(measure, 1, "it is a FIFO");
    std::filesystem::remove(out / "displacement_0001.exr");
    std::filesystem::create_symlink("/dev/zero", out / "sea.json.new");
    std::filesystem::rename(out / "sea.json.new", out / "sea.json");
    expect_refused(measure, 1, "it is a symbolic link");
}

TEST(Measure, NonHeightImagesAreRejected) {
    const TemporaryFolder folder;
    export_to_measure(folder / "out", {"--resolution", "16", "--patch-size", "250"});
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        std::vector<float> pixels(3 * 16 * 16);
        pixels[100 * 3 + 1] = bad;
        const auto output = OIIO::ImageOutput::create("x.exr");
        ASSERT_TRUE(output->open((folder / "out" / "displacement_0000.exr").string(),
                                 OIIO::ImageSpec(16, 16, 3, OIIO::TypeDesc::FLOAT)));
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        output->close();
        expect_refused({"info", "--measure", (folder / "out").string()}, 1, "which is no height in metres");
    }
}

}  // namespace
}  // namespace pelagic
