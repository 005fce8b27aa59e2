// Foam on the command line: maps on disk, read by libpng and OpenImageIO; query
// columns; the output of info.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/foam_report.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

// A gale at short fetch, with a large whitecap cover. The last two of four cascades hold waves
// shorter than a metre, which break without whitecaps.
const SeaState foamy_gale{.cascades = 4, .resolution = 32, .wind_speed_mps = 20, .fetch_m = 100, .loop_period_s = 8};
const Arguments foamy_gale_flags = {"--cascades", "4",   "--resolution",  "32", "--wind-speed", "20",
                                    "--fetch",    "100", "--loop-period", "8"};
const SeaState gale_on_one_cascade{
    .cascades = 1, .resolution = 32, .wind_speed_mps = 20, .fetch_m = 100, .loop_period_s = 8};
const Arguments flags_of_one_cascade = {"--cascades", "1",   "--resolution",  "32", "--wind-speed", "20",
                                        "--fetch",    "100", "--loop-period", "8"};

Outcome run_foamy_gale(const Arguments& arguments, const Arguments& more = {},
                       const Arguments& sea = foamy_gale_flags) {
    Outcome outcome = run_pelagic(joined(joined(arguments, sea), more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
}

void export_foam_to(const std::filesystem::path& folder, const Arguments& more) {
    run_foamy_gale({"export", "--no-sync", "--out", folder.string()}, more, flags_of_one_cascade);
}

class FoamLibrary {
   public:
    explicit FoamLibrary(const SeaState& sea = gale_on_one_cascade) : sea_(sea) {}
    const Frame& frame_at(double time_s) { return ocean_.frame_at(time_s); }

   private:
    SeaState sea_;
    Ocean ocean_{sea_, {.executor = make_serial_executor(), .queries = true, .foam = true}};
};

/// Reads grey bytes with libpng's simplified reader, without conversion.
std::vector<std::uint8_t> read_grey_png(const std::filesystem::path& file, unsigned side) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << file;
    EXPECT_EQ(image.width, side);
    EXPECT_EQ(image.height, side);
    EXPECT_EQ(image.format & (PNG_FORMAT_FLAG_ALPHA | PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_LINEAR),
              PNG_FORMAT_GRAY);
    image.format = PNG_FORMAT_GRAY;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr));
    return bytes;
}

/// Reads the floats of a single-channel EXR file with OpenImageIO.
std::vector<float> read_grey_exr(const std::filesystem::path& file, std::size_t side) {
    std::vector<float> values(side * side);
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input || input->spec().nchannels != 1 ||
        !input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()))
        ADD_FAILURE() << file;
    return values;
}

/// Checks bytes against the means of the foam at the texels of the only cascade, a period away.
void expect_foam(const std::vector<std::uint8_t>& bytes, const Frame& frame, int level) {
    const FoamSampler foam(frame);
    const Cascade& cascade = frame.cascades[0];
    const int block = 1 << level, side = cascade.resolution() >> level;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            double sum = 0;
            for (int j = row * block; j < (row + 1) * block; ++j)
                for (int i = column * block; i < (column + 1) * block; ++i)
                    sum += double{foam.at((i + cascade.resolution()) * cascade.texel_m(),
                                          (j - cascade.resolution()) * cascade.texel_m())};
            // Half a byte, and rounding of places, which changes the weights of texels.
            ASSERT_NEAR(bytes[static_cast<std::size_t>(row * side + column)], 255 * sum / (block * block), 0.501)
                << column << ", " << row << " of level " << level;
        }
}

TEST(ExportedFoam, PngHoldsEveryLevel) {
    const TemporaryFolder folder;
    export_foam_to(folder.path(), {"--start", "3.03", "--maps", "foam", "--mips"});
    FoamLibrary library;
    const Frame& frame = library.frame_at(3.03);
    const json record = json::parse(read_file(folder / "sea.json"));
    for (int level = 0; level < 6; ++level) {
        const std::string file = "foam_0000" + (level == 0 ? "" : "_mip" + std::to_string(level)) + ".png";
        expect_foam(read_grey_png(folder / file, 32u >> level), frame, level);
        EXPECT_EQ(record["frames"][0]["files"][static_cast<std::size_t>(level)]["name"], file);
    }
    const auto foam = read_grey_png(folder / "foam_0000.png", 32);
    EXPECT_GT(*std::max_element(foam.begin(), foam.end()), 127) << "nothing breaks here";
    EXPECT_EQ(record["foam"]["cascades"][0]["makes_whitecaps"], true);
    EXPECT_EQ(files_in(folder.path()).size(), 6u + 3) << "sea.json, its record, its lock, and no other map";
    EXPECT_EQ(std::stoull(record["frames"][0]["foam_hash"].get<std::string>(), nullptr, 16), foam_hash_of(frame));
    EXPECT_EQ(std::stoull(record["frames"][0]["hash"].get<std::string>(), nullptr, 16), hash_of(frame));
}

// An export without the foam map has no foam files, and its other files are unchanged.
TEST(ExportedFoam, IsOmittedFromExportsWithoutTheFoamMap) {
    const TemporaryFolder folder;
    export_foam_to(folder / "with", {"--maps", "foam,gradient,displacement"});
    export_foam_to(folder / "without", {});
    const auto with = files_in(folder / "with"), without = files_in(folder / "without");
    for (const auto& [name, bytes] : without)
        if (name != "sea.json" && name != "sea_files.json") {
            EXPECT_EQ(with.at(name), bytes) << name;
        }
    EXPECT_EQ(with.size(), without.size() + 1);
    const json record = json::parse(without.at("sea.json"));
    EXPECT_FALSE(record.contains("foam") || record["frames"][0].contains("foam_hash") ||
                 record["channels"].contains("foam"));
}

TEST(ExportedFoam, TiffHoldsTheFramesFoam) {
    const TemporaryFolder folder;
    export_foam_to(folder.path(), {"--start", "2", "--maps", "foam", "--format", "tif"});
    FoamLibrary library;
    const auto input = OIIO::ImageInput::open((folder / "foam_0000.tif").string());
    ASSERT_TRUE(input);
    ASSERT_EQ(input->spec().nchannels, 1);
    EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT8);
    std::vector<std::uint8_t> bytes(32 * 32);
    ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data()));
    expect_foam(bytes, library.frame_at(2), 0);
}

// The snapshots of foam are recomputed for each shard and each resumed export. Floats are EXR files,
// which are written in less time than PNG files.
TEST(ExportedFoam, ShardedAndResumedExportsEqualOneRun) {
    const TemporaryFolder folder;
    const Arguments floats = {"--maps", "foam", "--fps", "12.5", "--bit-depth", "float"};
    const Arguments film = joined(floats, {"--frames", "8"});
    export_foam_to(folder / "film", film);
    const auto whole = files_in(folder / "film");
    // Files also hold the numbers of their frames.
    const auto floats_of = [&](const std::string& name, int frame) {
        return read_grey_exr(folder / name / ("foam_000" + std::to_string(frame) + ".exr"), 32);
    };

    export_foam_to(folder / "shard", joined(floats, {"--frames", "3", "--start", "0.4", "--threads", "1"}));
    for (const int frame : {0, 1, 2}) EXPECT_EQ(floats_of("shard", frame), floats_of("film", frame + 5));

    for (const char* lost : {"foam_0002.exr", "foam_0003.exr", "foam_0006.exr"})
        std::filesystem::remove(folder / "film" / lost);
    Arguments resumed = film;
    resumed.push_back("--resume");
    export_foam_to(folder / "film", resumed);
    EXPECT_TRUE(files_in(folder / "film") == whole);

    // The loop continues where it began.
    export_foam_to(folder / "later", joined(floats, {"--frames", "1", "--start", "16"}));
    EXPECT_EQ(floats_of("later", 0), floats_of("film", 0));
}

// A recorded frame without a foam hash does not belong to this export.
TEST(ExportedFoam, ResumeReplacesAFrameRecordedWithoutFoam) {
    const TemporaryFolder folder;
    export_foam_to(folder.path(), {"--maps", "foam"});
    const auto whole = files_in(folder.path());
    const Outcome other =
        run_pelagic({"export", "--out", folder.path().string(), "--maps", "gradient", "--resume", "--fetch", "100",
                     "--cascades", "1", "--resolution", "32", "--wind-speed", "20", "--loop-period", "8"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("whose export had other options: --maps was foam and is gradient"), std::string::npos)
        << other.err;
    json record = json::parse(read_file(folder / "sea_files.json"));
    record["frames"][0].erase("foam_hash");
    write_file(folder / "sea_files.json", record.dump());
    export_foam_to(folder.path(), {"--maps", "foam", "--resume"});
    EXPECT_TRUE(files_in(folder.path()) == whole);
}

// Cascades break where their sum does: their foam is in one image, whose place and scale are
// in sea.json.
TEST(ExportedFoam, OfSeveralCascadesIsOnePatch) {
    const TemporaryFolder folder;
    run_foamy_gale({"export", "--no-sync", "--out", folder.path().string(), "--start", "5.5"},
                   {"--maps", "foam,compression", "--foam-size", "60", "--foam-pixels", "48", "--axes", "z-up",
                    "--rows", "bottom"});
    FoamLibrary library(foamy_gale);
    const FoamSampler foam(library.frame_at(5.5));
    const json record = json::parse(read_file(folder / "sea.json"));
    const json& map = record["foam_map"];
    EXPECT_EQ(map["side_m"], 60);
    EXPECT_EQ(record["export"]["foam_pixels"], 48);
    const auto place = [&](const char* line, int number) {
        return map[line]["scale"].get<double>() * number + map[line]["offset"].get<double>();
    };
    const std::vector<std::uint8_t> bytes = read_grey_png(folder / "foam_0000.png", 48);
    for (int row = 0; row < 48; ++row)
        for (int column = 0; column < 48; ++column) {
            const double x_m = place("x_m_of_column", column), z_m = -place("y_m_of_row", row);
            EXPECT_NEAR(bytes[static_cast<std::size_t>(48 * row + column)], 255 * double{foam.at(x_m, z_m)}, 0.501);
            EXPECT_TRUE(x_m > 0 && x_m < 60 && z_m > 0 && z_m < 60);
        }
    EXPECT_GT(*std::max_element(bytes.begin(), bytes.end()), 127) << "nothing breaks here";
    EXPECT_EQ(run_pelagic({"verify", folder.path().string()}).exit_code, 0);
}

TEST(ExportedFoam, OptionsOfThePatchNeedOne) {
    const TemporaryFolder folder;
    const Arguments foam = {"export", "--out", (folder / "out").string(), "--maps", "foam"};
    expect_one_line(run_pelagic(joined(foam, {"--cascades", "1", "--foam-size", "60"})), 2,
                    "--foam-size is 60; it requires --maps foam and several cascades");
    expect_one_line(run_pelagic(joined(foam, {"--foam-pixels", "0"})), 2, "--foam-pixels is 0, expected a whole");
    expect_one_line(run_pelagic(joined(foam, {"--mips"})), 2, "--mips requires a map with mip levels");
    expect_one_line(run_pelagic(joined(foam, {"--half"})), 2, "--half requires a map of floats");
    expect_one_line(run_pelagic(joined(foam, {"--flipbook", "1x1"})), 2,
                    "--flipbook is 1x1, expected maps of cascades");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

// With the level and the ramp of sea.json, the sum of the maps is the foam that queries return
// where water breaks now. All cascades have a texel at the origin.
TEST(ExportedCompression, AddsUpToBreakingWater) {
    const TemporaryFolder folder;
    run_foamy_gale({"export", "--no-sync", "--out", folder.path().string(), "--maps", "compression", "--mips",
                    "--seed", "8", "--frames", "40", "--fps", "5"});
    const json record = json::parse(read_file(folder / "sea.json"));
    const double level = record["foam"]["level"], ramp = record["foam"]["ramp"];
    EXPECT_EQ(record["foam"]["fade_s"], 15 * 0.25);
    SeaState sea = foamy_gale;
    sea.seed = 8;  // water breaks at the origin
    FoamLibrary library(sea);
    int white = 0;
    for (int number = 0; number < 40; ++number) {
        const Frame& frame = library.frame_at(number / 5.);
        double sum = 0;
        for (std::size_t cascade = 0; cascade < 4; ++cascade) {
            const std::string mark = cascade == 0 ? "" : "c" + std::to_string(cascade) + "_";
            const auto name = [&](const std::string& end) {
                return folder / ("compression_" + mark + (number < 10 ? "000" : "00") + std::to_string(number) + end);
            };
            const std::vector<float> values = read_grey_exr(name(".exr"), 32);
            std::vector<float> expected(values.size());
            copy_compression(frame.cascades[cascade], expected);
            EXPECT_EQ(values, expected);
            sum += double{values[0]};
            const std::vector<float> half = read_grey_exr(name("_mip1.exr"), 16);
            EXPECT_NEAR(half[0],
                        (double{values[0]} + double{values[1]} + double{values[32]} + double{values[33]}) / 4, 1e-5);
        }
        // Bytes of four cascades are rounded by half a step, and foam changes by 1 / ramp of it.
        const double breaking = std::clamp(0.5 + (sum - level) / ramp, 0., 1.);
        const double rounding = 4 * 0.5 * double{SnapshotFoam::step} / ramp;
        if (breaking > 0) {
            EXPECT_GE(double{FoamSampler(frame).at(0, 0)}, breaking - rounding) << number;
        }
        white += breaking > 0.5;
    }
    EXPECT_GT(white, 0) << "nothing breaks at the origin";
}

TEST(ExportedFoam, SeaJsonAndInfoDescribeFoamAccumulationAndDrift) {
    const TemporaryFolder folder;
    run_foamy_gale({"export", "--no-sync", "--out", folder.path().string(), "--maps", "compression"});
    const json recorded = json::parse(read_file(folder / "sea.json"))["foam"];
    EXPECT_EQ(recorded, json::parse(run_foamy_gale({"info", "--json"}).out)["foam"]);

    FoamLibrary library(foamy_gale);
    const Frame& frame = library.frame_at(0);
    EXPECT_EQ(recorded["level"], frame.statistics.foam_level);
    EXPECT_EQ(recorded["tick_s"], 0.25);  // of a loop of 8 s
    EXPECT_EQ(recorded["ticks_per_loop"], 32);
    EXPECT_EQ(recorded["warm_up_ticks"], 16);
    EXPECT_NEAR(recorded["whitecap_cover"].get<double>(), 3.84e-6 * std::pow(20, 3.41), 1e-9);
    const double x = frame.statistics.foam_drift_x_mps, z = frame.statistics.foam_drift_z_mps;
    EXPECT_NEAR(recorded["drift_mps"].get<double>(), std::hypot(x, z), 1e-12);
    EXPECT_NEAR(recorded["drift_direction_deg"].get<double>(), std::atan2(z, x) * 180 / 3.14159265358979323846, 1e-9);
    for (std::size_t i = 0; i < 4; ++i) {
        const Cascade& cascade = frame.cascades[i];
        const CascadeGrid::Vector a_loop = cascade.grid.in_cascade(8 * x, 8 * z);
        const json& of_cascade = recorded["cascades"][i];
        const double columns = of_cascade["columns_per_loop"], rows = of_cascade["rows_per_loop"];
        EXPECT_NEAR(columns, a_loop.along / cascade.texel_m(), 0.5001);
        EXPECT_NEAR(rows, a_loop.across / cascade.texel_m(), 0.5001);
        EXPECT_NEAR(of_cascade["drift_mps"].get<double>(), std::hypot(columns, rows) * cascade.texel_m() / 8, 1e-12);
        EXPECT_EQ(of_cascade["side_m"], cascade.grid.side_m);
    }

    const std::string table = run_foamy_gale({"info", "--measured"}).out;
    for (const char* part : {"Foam accumulation", "whitecap_cover", "warm_up_ticks               16", "drift_mps",
                             "makes no whitecaps", "columns_per_loop"})
        EXPECT_NE(table.find(part), std::string::npos) << table << "lacks " << part;
}

TEST(QueriedFoam, IsAnOptionalColumn) {
    const TemporaryFolder folder;
    std::string text = "x,z\n";
    std::vector<double> x, z;
    for (int i = 0; i < 60; ++i) {
        x.push_back(31.25 * i), z.push_back(700 - 17.5 * i);
        text += std::to_string(x.back()) + "," + std::to_string(z.back()) + "\n";
    }
    write_file(folder / "points.csv", text);
    const Arguments asked = {"query",           "--points", (folder / "points.csv").string(), "--time", "5.5",
                             "--interpolation", "linear"};
    const Outcome with = run_foamy_gale(asked, {"--foam"}), without = run_foamy_gale(asked),
                  as_json = run_foamy_gale(asked, {"--foam", "--json"});
    FoamLibrary library(foamy_gale);
    std::vector<float> foam(x.size());
    SurfaceQuery(library.frame_at(5.5)).sample({x, z}, {.foam = foam});
    EXPECT_GT(*std::max_element(foam.begin(), foam.end()), 0.2f);

    std::istringstream lines(with.out), others(without.out);
    std::string line, other;
    std::getline(lines, line), std::getline(others, other);
    EXPECT_EQ(line, "x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,foam,converged");
    const json objects = json::parse(as_json.out);
    for (std::size_t i = 0; i < foam.size(); ++i) {
        std::getline(lines, line), std::getline(others, other);
        const std::size_t last = line.rfind(','), before = line.rfind(',', last - 1);
        EXPECT_EQ(std::stof(line.substr(before + 1, last - before - 1)), foam[i]);
        EXPECT_EQ(line.substr(0, before) + line.substr(last), other);
        EXPECT_EQ(objects[i]["foam"].get<float>(), foam[i]);
    }
    const Outcome own_column = [&] {
        write_file(folder / "own.csv", "x,z,foam\n1,2,3\n");
        return run_pelagic({"query", "--foam", "--points", (folder / "own.csv").string()});
    }();
    EXPECT_EQ(own_column.exit_code, 2);
    EXPECT_NE(own_column.err.find("the points' column foam has the name"), std::string::npos) << own_column.err;
}

}  // namespace
}  // namespace pelagic
