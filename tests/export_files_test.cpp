// Exported files, read by independent libraries: OpenEXR, libpng and OpenImageIO.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

const SeaState small_sea{.resolution = 32, .patch_size_m = 250, .loop_period_s = 200};

/// Exports the small sea with additional flags. \pre the folder is empty
Outcome export_small_sea(const std::filesystem::path& folder, const Arguments& flags) {
    Outcome outcome = run_pelagic(small_export(folder, flags));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
}

class SmallSea {
   public:
    explicit SmallSea(const SeaState& sea = small_sea) : ocean_(sea, {.executor = make_serial_executor()}) {}
    const Frame& frame_at(double time_s) { return ocean_.frame_at(time_s); }

   private:
    Ocean ocean_;
};

/// Reads a channel of an EXR file with OpenEXR, row by row; T is float or half.
template <class T>
std::vector<T> read_exr_channel(const std::filesystem::path& file, const char* channel, Imf::PixelType type) {
    Imf::InputFile input(file.c_str());
    const auto window = input.header().dataWindow();
    const int width = window.max.x + 1, height = window.max.y + 1;
    EXPECT_EQ(input.header().channels().findChannel(channel)->type, type);
    std::vector<T> pixels(static_cast<std::size_t>(width) * height);
    Imf::FrameBuffer buffer;
    buffer.insert(channel, Imf::Slice(type, reinterpret_cast<char*>(pixels.data()), sizeof(T), sizeof(T) * width));
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    return pixels;
}

TEST(ExportedFiles, ExrHoldsTheFramesFloatsExactly) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--start", "1.25"});
    SmallSea library;
    const Frame& frame = library.frame_at(1.25);
    const std::pair<const char*, const PlaneView*> channels[] = {
        {"R", &frame.cascades[0].dx}, {"G", &frame.cascades[0].height}, {"B", &frame.cascades[0].dz}};
    for (const auto& [channel, plane] : channels) {
        const auto pixels = read_exr_channel<float>(folder / "displacement_0000.exr", channel, Imf::FLOAT);
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(pixels[static_cast<std::size_t>(j * 32 + i)]),
                          std::bit_cast<std::uint32_t>(plane->at(i, j)));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "gradient_0000.png"));
}

TEST(ExportedFiles, OpenImageIOReadsEqualExrPixels) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {});
    SmallSea library;
    const Frame& frame = library.frame_at(0);
    const auto input = OIIO::ImageInput::open((folder / "displacement_0000.exr").string());
    ASSERT_TRUE(input);
    ASSERT_EQ(input->spec().nchannels, 3);
    std::vector<float> pixels(32 * 32 * 3);
    ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data()));
    for (std::size_t texel = 0; texel < 32 * 32; ++texel)
        ASSERT_EQ(pixels[3 * texel + 1],
                  frame.cascades[0].height.at(static_cast<int>(texel % 32), static_cast<int>(texel / 32)));
}

TEST(ExportedFiles, HalvesEqualTheFramesHalves) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--half"});
    SmallSea library;
    const Frame& frame = library.frame_at(0);
    const char* channels[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto pixels = read_exr_channel<Imath::half>(folder / "displacement_0000.exr", channels[c], Imf::HALF);
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i)
                ASSERT_EQ(pixels[static_cast<std::size_t>(j * 32 + i)].bits(),
                          frame.cascades[0].displacement_rgba16f[static_cast<std::size_t>(4 * (j * 32 + i)) + c]);
    }
}

/// Reads RGBA bytes with libpng's simplified reader, without conversion.
std::vector<std::uint8_t> read_rgba_png(const std::filesystem::path& file, unsigned side) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << file;
    EXPECT_EQ(image.width, side);
    EXPECT_EQ(image.height, side);
    EXPECT_EQ(image.format & (PNG_FORMAT_FLAG_ALPHA | PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_LINEAR),
              PNG_FORMAT_RGBA);
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr));
    return bytes;
}

void expect_bytes(const std::vector<std::uint8_t>& bytes, std::span<const std::uint32_t> texels) {
    ASSERT_EQ(bytes.size(), 4 * texels.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], texels[i / 4] >> 8 * (i % 4) & 0xFF) << i;
}

TEST(ExportedFiles, PngHoldsEveryGradientByteOfEveryLevel) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--mips", "--maps", "gradient"});
    SmallSea library;
    const Frame& frame = library.frame_at(0);
    expect_bytes(read_rgba_png(folder / "gradient_0000.png", 32), frame.cascades[0].gradient_level(0));
    for (int level = 1; level < mip_levels(32); ++level)
        expect_bytes(read_rgba_png(folder / ("gradient_0000_mip" + std::to_string(level) + ".png"), 32u >> level),
                     frame.cascades[0].gradient_level(level));
    EXPECT_FALSE(std::filesystem::exists(folder / "gradient_0000_mip6.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "displacement_0000.exr"));
}

/// A cascade's map, read from its files only; interpolated bilinearly and periodically.
class ReadCascade {
   public:
    ReadCascade(const std::filesystem::path& folder, const nlohmann::json& layout)
        : n_(layout.at("resolution")),
          side_m_(layout.at("side_m")),
          cosine_(layout.at("rotation").at("cosine")),
          sine_(layout.at("rotation").at("sine")) {
        const std::string mark = layout.at("in_file_names");
        const auto file = folder / ("displacement_" + (mark.empty() ? "" : mark + "_") + "0000.exr");
        for (std::size_t i = 0; i < 3; ++i) {
            const char* channels[] = {"R", "G", "B"};
            planes_[i] = read_exr_channel<float>(file, channels[i], Imf::FLOAT);
        }
    }

    std::array<double, 3> at(double x_m, double z_m) const {
        const double u = (cosine_ * x_m + sine_ * z_m) / side_m_ * n_,
                     v = (cosine_ * z_m - sine_ * x_m) / side_m_ * n_;
        const double column = std::floor(u), row = std::floor(v);
        std::array<double, 3> sum{};
        for (int corner = 0; corner < 4; ++corner) {
            const double weight = (corner % 2 ? u - column : 1 - u + column) * (corner / 2 ? v - row : 1 - v + row);
            const auto wrapped = [&](double of) { return static_cast<std::size_t>(of - std::floor(of / n_) * n_); };
            const std::size_t texel =
                wrapped(row + corner / 2) * static_cast<std::size_t>(n_) + wrapped(column + corner % 2);
            for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * static_cast<double>(planes_[i][texel]);
        }
        return sum;
    }

   private:
    int n_;
    double side_m_, cosine_, sine_;
    std::array<std::vector<float>, 3> planes_;
};

// Cascades are added as the exporter's documentation specifies. A query is within its tolerance of
// 1 mm, on slopes below 1.
TEST(ExportedFiles, CascadesSumToTheSurfaceOfQueries) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_pelagic({"export", "--out", folder.path().string(), "--cascades", "3", "--resolution", "64"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto record = nlohmann::json::parse(read_file(folder / "sea.json"));
    std::vector<ReadCascade> cascades;
    for (const auto& cascade : record.at("layout").at("cascades")) cascades.emplace_back(folder.path(), cascade);
    ASSERT_EQ(cascades.size(), 3u);

    Ocean ocean({.cascades = 3, .resolution = 64},
                {.executor = make_serial_executor(), .queries = true, .gradients = true});
    const Frame& frame = ocean.frame_at(0);
    const SurfaceQuery water(frame);
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
        const double x = 7.3 * i - 900, z = 1700 - 11.9 * i;
        double drawn_x = x, height = 0, drawn_z = z;
        for (const ReadCascade& cascade : cascades) {
            const std::array<double, 3> part = cascade.at(x, z);
            drawn_x += part[0], height += part[1], drawn_z += part[2];
        }
        float answer = 0, jacobian = 0;
        water.sample({.x = {&drawn_x, 1}, .z = {&drawn_z, 1}},
                     {.height_m = {&answer, 1}, .jacobian = {&jacobian, 1}});
        if (jacobian < 0.3f) continue;  // the surface may have several sheets there
        ++compared;
        ASSERT_NEAR(answer, height, 2e-3) << x << ", " << z;
    }
    EXPECT_GT(compared, 450);

    for (std::size_t i = 1; i < frame.cascades.size(); ++i)
        expect_bytes(read_rgba_png(folder / ("gradient_c" + std::to_string(i) + "_0000.png"), 64),
                     frame.cascades[i].gradient_level(0));
}

TEST(ExportedFiles, TiffHoldsTheFramesPixels) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--format", "tif", "--maps", maps_with_png});
    SmallSea library;
    const Frame& frame = library.frame_at(0);
    OIIO::ImageSpec as_it_is;
    // without it, the reader multiplies normals by smoothness
    as_it_is.attribute("oiio:UnassociatedAlpha", 1);
    auto gradient = OIIO::ImageInput::open((folder / "gradient_0000.tif").string(), &as_it_is);
    ASSERT_TRUE(gradient);
    EXPECT_EQ(gradient->spec().get_int_attribute("oiio:UnassociatedAlpha"), 1);
    std::vector<std::uint8_t> bytes(32 * 32 * 4);
    ASSERT_TRUE(gradient->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data()));
    expect_bytes(bytes, frame.cascades[0].gradient_level(0));

    auto displacement = OIIO::ImageInput::open((folder / "displacement_0000.tif").string());
    ASSERT_TRUE(displacement);
    EXPECT_EQ(displacement->spec().format, OIIO::TypeDesc::FLOAT);
    std::vector<float> pixels(32 * 32 * 3);
    ASSERT_TRUE(displacement->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data()));
    for (std::size_t texel = 0; texel < 32 * 32; ++texel)
        ASSERT_EQ(pixels[3 * texel + 1],
                  frame.cascades[0].height.at(static_cast<int>(texel % 32), static_cast<int>(texel / 32)));
}

TEST(ExportedFiles, SeaJsonDescribesTheExport) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--loop-frames", "4", "--loop-period", "8", "--wind-direction", "30"});
    const json sea = json::parse(read_file(folder / "sea.json"));
    EXPECT_EQ(sea["sea"]["resolution"], 32);
    EXPECT_EQ(sea["sea"]["wind_direction_deg"], 30);
    EXPECT_EQ(sea["sea"]["spectrum"], "jonswap");
    EXPECT_EQ(sea["sea"].size(), sea_state_fields().size() + 3)
        << "every option of a sea, its waves, spectrum and spreading";

    SeaState same = small_sea;
    same.loop_period_s = 8;
    same.wind_direction_rad = 30 * 3.14159265358979323846 / 180;
    SmallSea library(same);
    double height = 0;
    ASSERT_EQ(sea["frames"].size(), 4u);
    for (int i = 0; i < 4; ++i) {
        const Frame& frame = library.frame_at(2.0 * i);
        const json& recorded = sea["frames"][static_cast<std::size_t>(i)];
        EXPECT_EQ(recorded["time_s"], 2.0 * i);
        EXPECT_EQ(std::stoull(recorded["hash"].get<std::string>(), nullptr, 16), hash_of(frame));
        EXPECT_EQ(recorded["height_max_m"], frame.bounds.height_max_m);
        for (const json& file : recorded["files"]) EXPECT_TRUE(std::filesystem::exists(folder / file["name"]));
        height += measured_significant_wave_height_m(frame) / 4;
    }
    const ExpectedWaves expected = expected_waves(same);
    const json& waves = sea["waves"];
    EXPECT_NEAR(waves["significant_wave_height_m"]["measured"].get<double>(), height, 1e-12);
    EXPECT_EQ(waves["significant_wave_height_m"]["expected"], expected.significant_wave_height_m);
    EXPECT_EQ(waves["peak_period_s"]["expected"], expected.peak_period_s);
    EXPECT_EQ(waves["peak_period_s"]["measured"], measured_peak_period_s(same));
    EXPECT_EQ(waves["loop_frequencies"]["for_90_percent"], loop_frequencies(same).for_90_percent);
    EXPECT_EQ(waves["loop_frequencies"]["largest_share"], loop_frequencies(same).largest_share);
    EXPECT_EQ(sea["warnings"].get<std::vector<std::string>>(), warnings_about(same));
}

// Values without a short decimal form, so that a missing digit would change the sea.
TEST(ExportedFiles, SeaJsonReproducesTheSeaExactly) {
    const TemporaryFolder folder;
    export_small_sea(folder / "out", {"--preset", "rough", "--wind-direction", "33.3", "--wind-speed",
                                      "11.100000000000001", "--fetch", "123456.789", "--loop-period", "61.7",
                                      "--seed", "4294967295", "--depth", "0.1", "--spreading", "hasselmann"});
    const std::string record = (folder / "out" / "sea.json").string();
    const json recorded = json::parse(read_file(record));
    const Outcome info = run_pelagic({"info", "--json", "--config", record});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_EQ(json::parse(info.out)["first_frame"]["hash"], recorded["frames"][0]["hash"]);
    EXPECT_EQ(json::parse(info.out)["sea"], recorded["sea"]);

    ASSERT_EQ(
        run_pelagic({"export", "--config", record, "--out", (folder / "again").string(), "--maps", "displacement"})
            .exit_code,
        0);
    EXPECT_EQ(files_in(folder / "again"), files_in(folder / "out"));

    // The output of info can be read back, and flags override it.
    write_file(folder / "info.json", info.out);
    const Outcome other = run_pelagic({"info", "--json", "--config", (folder / "info.json").string(), "--seed", "2"});
    ASSERT_EQ(other.exit_code, 0) << other.err;
    json sea = json::parse(other.out)["sea"];
    EXPECT_EQ(sea["seed"], 2);
    sea["seed"] = recorded["sea"]["seed"];
    EXPECT_EQ(sea, recorded["sea"]);
}

/// Returns the value of the named channel, decoded as sea.json specifies; 0 if there is no such
/// channel.
double value_of(const json& channels, const char* name, const std::map<std::string, double>& pixel) {
    for (const json& channel : channels)
        if (channel["name"] == name)
            return channel["scale"].get<double>() * pixel.at(channel["channel"]) + channel["offset"].get<double>();
    ADD_FAILURE() << "no channel " << name;
    return 0;
}

// Pixels decoded by sea.json alone match surface queries at the pixels' positions.
TEST(ExportedFiles, SeaJsonDefinesThePixels) {
    const TemporaryFolder folder;
    export_small_sea(folder.path(), {"--wind-direction", "40", "--maps", maps_with_png});
    const json record = json::parse(read_file(folder / "sea.json"));
    SeaState sea = small_sea;
    sea.wind_direction_rad = 40 * 3.14159265358979323846 / 180;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true});
    const Frame& frame = ocean.frame_at(0);
    const double roughness = frame.statistics.roughness;
    const SurfaceQuery water(frame);

    const auto bytes = read_rgba_png(folder / "gradient_0000.png", 32);
    std::map<std::string, std::vector<float>> floats;
    for (const char* channel : {"R", "G", "B"})
        floats[channel] = read_exr_channel<float>(folder / "displacement_0000.exr", channel, Imf::FLOAT);
    const auto at = [&](const char* line, int number) {
        const json& recorded = record["layout"][line];
        return recorded["scale"].get<double>() * number + recorded["offset"].get<double>();
    };
    for (int j = 0; j < 32; ++j) {
        for (int i = 0; i < 32; ++i) {
            const auto texel = static_cast<std::size_t>(32 * j + i);
            std::map<std::string, double> numbers, parts;
            for (const auto& [channel, plane] : floats) numbers[channel] = static_cast<double>(plane[texel]);
            for (std::size_t c = 0; c < 4; ++c) parts[std::string(1, "RGBA"[c])] = bytes[4 * texel + c] / 255.0;
            const json &displacement = record["channels"]["displacement"], &gradient = record["channels"]["gradient"];

            const double x[] = {at("x_m_of_column", i) + value_of(displacement, "Dx", numbers)};
            const double z[] = {at("z_m_of_row", j) + value_of(displacement, "Dz", numbers)};
            float height[1], normal_x[1], normal_z[1], jacobian[1];
            water.sample({x, z},
                         {.height_m = height, .normal_x = normal_x, .normal_z = normal_z, .jacobian = jacobian});
            // A horizontal error of 1 mm, the query's tolerance, changes less than that here:
            // texels are 8 m apart.
            EXPECT_NEAR(value_of(displacement, "height", numbers), height[0], 1e-3);
            const double half_a_byte = 1 / 255.0 + 1e-3;
            EXPECT_NEAR(value_of(gradient, "normal_x", parts), normal_x[0], half_a_byte);
            EXPECT_NEAR(value_of(gradient, "normal_z", parts), normal_z[0], half_a_byte);
            EXPECT_NEAR(value_of(gradient, "jacobian", parts), std::clamp(jacobian[0], -1.f, 1.f), half_a_byte);
            EXPECT_NEAR(value_of(gradient, "smoothness", parts), 1 - std::sqrt(roughness), half_a_byte);
            // Texel i covers u from i / 32 to (i + 1) / 32.
            EXPECT_NEAR(at("u_of_column", i), (i + 0.5) / 32, 1e-12);
            EXPECT_NEAR(at("v_down_of_row", j), (j + 0.5) / 32, 1e-12);
        }
    }
    EXPECT_EQ(record["layout"]["repeats_after_m"], 250.0);
}

TEST(ExportedFiles, HelpDefinesThePixels) {
    const std::string help = run_pelagic({"export", "--help-pixels"}).out;
    for (const char* part : {"normal x = 2R - 1", "J = 2B - 1", "clamped to [-1, 1]", "u = (i + 0.5)/N", "upper edge",
                             "+x east, +y up, +z south", "non-colour"})
        EXPECT_NE(help.find(part), std::string::npos) << part;
}

TEST(ExportedFiles, DoNotDependOnThreadCountAndInstructionSet) {
    const TemporaryFolder first;
    const std::vector<std::string> common_flags = {"--frames", "5", "--mips", "--maps",
                                                   "displacement,gradient,normal,velocity,jacobian,slope"};
    export_small_sea(first.path(), common_flags);
    const auto expected = files_in(first.path());
    // Each number of threads and each instruction set is used once; the Determinism suite covers
    // all pairs.
    const std::vector<Isa> isas = isas_here();
    for (std::size_t i = 0; i < std::max<std::size_t>(3, isas.size()); ++i) {
        const std::string threads = std::to_string(1 + i % 3), isa(name_of(isas[i % isas.size()]));
        const TemporaryFolder other;
        auto flags = common_flags;
        flags.insert(flags.end(), {"--threads", threads, "--isa", isa});
        export_small_sea(other.path(), flags);
        EXPECT_EQ(files_in(other.path()), expected) << threads << " " << isa;
    }
}

TEST(ExportedFiles, FlagsOverrideTheConfigFileAndThePreset) {
    const TemporaryFolder folder;
    write_file(folder / "sea.toml", "preset = \"storm\"\nresolution = 64\nwind_speed = 7\nchoppiness = 0.25\n");
    export_small_sea(folder / "out", {"--config", (folder / "sea.toml").string(), "--wind-speed", "9.5"});
    const json sea = json::parse(read_file(folder / "out" / "sea.json"))["sea"];
    EXPECT_EQ(sea["resolution"], 32);       // flag
    EXPECT_EQ(sea["wind_speed_mps"], 9.5);  // flag
    EXPECT_EQ(sea["choppiness"], 0.25);     // file
    EXPECT_EQ(sea["fetch_m"], 400000.0);    // preset
    EXPECT_EQ(sea["depth_m"], 4000.0);      // default
}

TEST(ExportedFiles, NothingIsWrittenToStderrInAPipe) {
    const TemporaryFolder folder;
    const Outcome outcome = export_small_sea(folder.path(), {"--frames", "3"});
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("3 frames"), std::string::npos);
}

TEST(ExportedFiles, AShorterExportReplacesALongerOne) {
    const TemporaryFolder folder, fresh;
    write_file(folder / "compression_notes.txt", "mine");
    export_small_sea(folder.path(), {"--frames", "4", "--mips", "--maps", two_exr_maps});
    export_small_sea(folder.path(), {"--frames", "2", "--overwrite", "--maps", two_exr_maps});
    export_small_sea(fresh.path(), {"--frames", "2", "--maps", two_exr_maps});
    auto expected = files_in(fresh.path());
    expected["compression_notes.txt"] = "mine";
    EXPECT_EQ(files_in(folder.path()), expected);
}

TEST(Info, PrintsTheLibrarysValues) {
    const Outcome outcome = run_pelagic({"info", "--json", "--resolution", "32", "--patch-size", "250"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json info = json::parse(outcome.out);
    SmallSea library;
    const Frame& frame = library.frame_at(0);
    EXPECT_EQ(std::stoull(info["first_frame"]["hash"].get<std::string>(), nullptr, 16), hash_of(frame));
    EXPECT_EQ(info["waves"]["peak_period_s"]["expected"], expected_waves(small_sea).peak_period_s);
    EXPECT_GT(info["computing"]["memory_bytes"], 32 * 32 * 50);
    EXPECT_EQ(info["computing"]["stages"][0]["name"], "evolve+rows");
    const Outcome table = run_pelagic({"info", "--preset", "storm"});
    for (const char* part :
         {"wind_speed_mps", "19", "evolve+rows -> columns+finalize -> slopes+mipmaps", "peak_period_s"})
        EXPECT_NE(table.out.find(part), std::string::npos) << part;
}

TEST(Info, PrintsBeaufortNumberSeaStateDirectionSpreadAndSlopes) {
    const Outcome outcome =
        run_pelagic({"info", "--json", "--preset", "beaufort-5", "--cascades", "2", "--wind-direction", "30"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json waves = json::parse(outcome.out)["waves"];
    EXPECT_EQ(waves["beaufort"], (json{{"number", 5}, {"name", "fresh breeze"}}));
    EXPECT_EQ(waves["sea_state"], (json{{"number", 4}, {"name", "moderate"}}));
    EXPECT_NEAR(waves["mean_direction_deg"]["expected"].get<double>(), 30, 1);
    EXPECT_GT(waves["directional_spread_deg"]["measured"].get<double>(), 10);
    EXPECT_NEAR(
        waves["steepness"].get<double>(),
        waves["significant_wave_height_m"]["expected"].get<double>() / waves["peak_wavelength_m"].get<double>(),
        1e-12);
    const json& slopes = waves["slope_variance"];
    ASSERT_EQ(slopes["cascades"].size(), 2u);
    EXPECT_NEAR(slopes["cascades"][0]["total"].get<double>() + slopes["cascades"][1]["total"].get<double>(),
                slopes["all"]["total"].get<double>(), 1e-12);
    EXPECT_LT(slopes["all"]["total"], slopes["cox_and_munk"]["total"]);
    const std::string table = run_pelagic({"info", "--preset", "beaufort-5"}).out;
    for (const char* part :
         {"5, fresh breeze", "4, moderate", "slope_variance, all", "of Cox and Munk", "mean_direction_deg"})
        EXPECT_NE(table.find(part), std::string::npos) << part;
}

TEST(Info, BeginsWithASummaryOfFiveLines) {
    const std::vector<std::string> lines = lines_of(run_pelagic({"info", "--preset", "calm"}).out);
    ASSERT_GT(lines.size(), 10u);
    const char* const names[] = {"Sea ", "Waves ", "Periods ", "Repeats ", "Computes "};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(lines[i].starts_with(names[i])) << lines[i];
    EXPECT_EQ(lines[5], "");
    const char* const parts[] = {"preset calm, jonswap, wind 3.2 m/s", "Hs 0.297 m expected", "Tm01",
                                 "after 3600 s and after 140 m, the side of the coarsest of 4 cascades", "MB"};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NE(lines[i].find(parts[i]), std::string::npos) << lines[i];
    const std::string one = run_pelagic({"info", "--patch-size", "250", "--resolution", "32"}).out;
    EXPECT_NE(one.find("after 3600 s and after 250 m\n"), std::string::npos);
    const std::string swell = run_pelagic({"info", "--spectrum", "none", "--system", "height=1 period=9"}).out;
    EXPECT_NE(swell.find("Sea       no wind sea, wind "), std::string::npos) << swell;
    const std::string pond = run_pelagic({"info", "--preset", "pond"}).out;
    EXPECT_NE(pond.find("after 3600 s and after 7.2 m\n"), std::string::npos) << "six times 1.2 m, rounded";
}

TEST(Info, MarksMeasuredStatisticsAsNotMeasuredUnlessAskedForThem) {
    const std::vector<std::string> sea = {"info", "--preset", "swell"};
    const auto with = [&](const std::string& option) {
        std::vector<std::string> arguments = sea;
        arguments.push_back(option);
        return run_pelagic(arguments);
    };
    const std::string plain = run_pelagic(sea).out, measured = with("--measured").out;
    for (const char* row :
         {"peak_period_s               expected 12, ", "tm01_s                      expected 9.148, ",
          "swell, peak_period_s        expected 12, "}) {
        EXPECT_NE(plain.find(row + std::string("not measured")), std::string::npos) << row;
        EXPECT_NE(measured.find(row + std::string("measured ")), std::string::npos) << row;
    }
    for (const char* section : {"Foam accumulation", "Frame at 0 s"}) {
        EXPECT_EQ(plain.find(section), std::string::npos);
        EXPECT_NE(measured.find(section), std::string::npos);
    }
    EXPECT_NE(plain.find("--measured prints them"), std::string::npos);
    EXPECT_EQ(measured.find("not measured"), std::string::npos) << measured;
    // Values that neither realised waves nor a frame change are equal, digit by digit.
    const std::vector<std::string> of_measured = lines_of(measured);
    for (const std::string& line : lines_of(plain))
        if (line.starts_with("  ") && line.find("not measured") == std::string::npos &&
            line.find("memory_bytes") == std::string::npos) {
            EXPECT_NE(std::find(of_measured.begin(), of_measured.end(), line), of_measured.end()) << line;
        }
    EXPECT_NEAR(json::parse(with("--json").out)["computing"]["memory_bytes"].get<double>(),
                std::stod(plain.substr(plain.find("memory_bytes") + 12)), 0.1e6);
    const Outcome both = run_pelagic({"info", "--measured", "--measure", "."});
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_NE(both.err.find("--measured cannot be combined with --measure"), std::string::npos) << both.err;
}

TEST(Info, OmitsSentinelsAndLinesThatDoNotApply) {
    for (const std::vector<std::string>& sea :
         std::vector<std::vector<std::string>>{{},
                                               {"--preset", "pond"},
                                               {"--preset", "analytic-moderate"},
                                               {"--swell-height", "1"},
                                               {"--spectrum", "phillips-paper"},
                                               {"--wind-speed", "0.3"}}) {
        const Outcome outcome = run_pelagic(joined({"info"}, sea));
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const bool is_spectrum = sea.empty() || (sea[1] != "pond" && sea[1] != "analytic-moderate");
        const bool has_swell = !sea.empty() && sea[0] == "--swell-height";
        for (const std::string& line : lines_of(outcome.out)) {
            EXPECT_EQ(line.find("roughness                   -1"), std::string::npos);
            for (int power = 10; power < 30; ++power)
                EXPECT_EQ(line.find("e-" + std::to_string(power)), std::string::npos) << line;
            EXPECT_EQ(line.find("nan"), std::string::npos) << line;
            EXPECT_FALSE(!has_swell && line.find("swell_") != std::string::npos) << line;
            EXPECT_FALSE(is_spectrum && line.starts_with("  wave_")) << line;
            EXPECT_FALSE(!is_spectrum && line.starts_with("  fetch_m")) << line;
        }
        EXPECT_NE(outcome.out.find("from the wind"), std::string::npos);
    }
}

TEST(Info, PrintsNotesOnFetchAndResolution) {
    const Outcome limited = run_pelagic({"info", "--wind-speed", "3"});
    EXPECT_NE(limited.out.find("note: this wind's sea is fully developed after 15600 m of fetch"), std::string::npos)
        << limited.out;
    EXPECT_EQ(run_pelagic({"info", "--wind-speed", "12"}).out.find("fully developed"), std::string::npos);
    // A grid too coarse for its waves gets a note on resolution, not on the loop.
    const Outcome coarse = run_pelagic({"info", "--wind-speed", "3", "--patch-size", "200", "--resolution", "16"});
    EXPECT_EQ(coarse.out.find("a loop of"), std::string::npos) << coarse.out;
    EXPECT_NE(coarse.out.find("raise the resolution"), std::string::npos);
}

TEST(Info, PrintsMeanPeriodsSeparatePeaksAndRepeatLength) {
    const json info = json::parse(run_pelagic({"info", "--json", "--preset", "swell"}).out);
    const json &waves = info["waves"], &periods = waves["zero_crossing_period_s"];
    EXPECT_EQ(waves["swell"]["peak_period_s"]["expected"], 12.0);
    EXPECT_LT(waves["wind_sea"]["peak_period_s"]["expected"], 5.0);
    EXPECT_GT(waves["tm01_s"]["expected"], periods["expected"]) << "Tm01 is never the shorter one";
    EXPECT_EQ(waves["tm02_s"], periods);
    EXPECT_GT(waves["convergence_variance"]["measured"], 0);
    const SeaState swell = sea_preset_named("swell")->sea;
    double level_m = 0;
    Ocean ocean(swell, {.executor = make_serial_executor()});
    for (const Cascade& cascade : ocean.frame_at(0).cascades) level_m += static_cast<double>(cascade.level_m);
    EXPECT_NEAR(waves["level_m"]["measured"], level_m, 1e-7);
    EXPECT_EQ(info["repeats_after_m"], repeat_length_m(swell));
    EXPECT_FALSE(json::parse(run_pelagic({"info", "--json"}).out)["waves"].contains("swell"));

    const TemporaryFolder folder;
    ASSERT_EQ(run_pelagic(small_export(folder / "out", {"--frames", "1"})).exit_code, 0);
    EXPECT_EQ(json::parse(read_file(folder / "out" / "sea.json"))["repeats_after_m"], 250.0);
}

TEST(Info, WarnsIfThePatchIsShorterThanTwoPeakWavelengths) {
    const Outcome outcome = run_pelagic({"info", "--patch-size", "100", "--resolution", "32"});
    EXPECT_NE(outcome.out.find("shorter than two peak wavelengths"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace pelagic
