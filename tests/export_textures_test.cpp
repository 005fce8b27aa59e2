// export --format ktx2 and dds, --flipbook and --preview: bytes on disk, compared with the
// library's cascades and with libpng.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/encode/film.hpp"
#include "pelagic/tools/files/zstd.hpp"
#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic {
namespace {

using nlohmann::json;
using Texels = std::vector<unsigned char>;

// A gale at short fetch, so that there is foam.
const SeaState textured_gale{
    .cascades = 2, .resolution = 32, .wind_speed_mps = 20, .fetch_m = 100, .loop_period_s = 8};

/// \param cascades  "2", or "1" for maps of foam
Outcome export_textures_to(const std::filesystem::path& folder, const Arguments& more,
                           const std::string& cascades = "2") {
    const Arguments gale_flags = {
        "export", "--no-sync",    "--out", folder.string(), "--cascades", cascades,        "--resolution",
        "32",     "--wind-speed", "20",    "--fetch",       "100",        "--loop-period", "8"};
    return run_pelagic(joined(gale_flags, more));
}

void expect_export(const std::filesystem::path& folder, const Arguments& more, const std::string& cascades = "2") {
    const Outcome outcome = export_textures_to(folder, more, cascades);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

std::uint64_t little_endian_at(const std::string& file, std::size_t offset, std::size_t bytes) {
    std::uint64_t number = 0;
    for (std::size_t i = bytes; i-- > 0;) number = number << 8 | static_cast<unsigned char>(file.at(offset + i));
    return number;
}

/// Levels of a KTX2 file without supercompression, the largest first; the specification places
/// their index at bytes 40 and 80.
std::vector<Texels> ktx2_levels(const std::string& file) {
    std::vector<Texels> levels;
    for (std::size_t level = 0; level < little_endian_at(file, 40, 4); ++level) {
        const std::size_t offset = little_endian_at(file, 80 + 24 * level, 8),
                          size = little_endian_at(file, 88 + 24 * level, 8);
        EXPECT_LE(offset + size, file.size());
        const std::string texels = file.substr(offset, size);
        levels.emplace_back(texels.begin(), texels.end());
    }
    return levels;
}

template <class Value>
Texels as_bytes(std::span<const Value> values) {
    Texels bytes(values.size_bytes());
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string file_name_of(const std::string& map, std::size_t cascade, const std::string& rest) {
    return map + (cascade == 0 ? "" : "_c" + std::to_string(cascade)) + rest;
}

class ExportedTextures : public testing::Test {
   protected:
    ExportedTextures() : ocean_(textured_gale, {.executor = make_serial_executor(), .gradients = true}) {}

    TemporaryFolder folder_;
    Ocean ocean_;
};

TEST_F(ExportedTextures, HoldEveryLevelOfEveryMapOfEveryCascade) {
    expect_export(folder_.path(),
                  {"--start", "3.03", "--maps", "displacement,gradient", "--mips", "--format", "ktx2"});
    const Frame& frame = ocean_.frame_at(3.03);
    for (std::size_t number = 0; number < 2; ++number) {
        const Cascade& cascade = frame.cascades[number];
        const auto gradient = ktx2_levels(read_file(folder_ / file_name_of("gradient", number, "_0000.ktx2")));
        ASSERT_EQ(gradient.size(), 6u);
        for (int level = 0; level < 6; ++level)
            EXPECT_EQ(gradient[static_cast<std::size_t>(level)], as_bytes(cascade.gradient_level(level)));
    }
}

TEST_F(ExportedTextures, HoldEveryLevelOfTheFoamOfOneCascade) {
    expect_export(folder_.path(), {"--start", "3.03", "--maps", "foam", "--mips", "--format", "ktx2"}, "1");
    SeaState sea = textured_gale;
    sea.cascades = 1;
    Ocean ocean(sea, {.executor = make_serial_executor(), .foam = true});
    const tools::MapOptions options{.maps = {tools::MapKind::foam}};
    const auto expected = tools::map_levels(ocean.frame_at(3.03), 0, tools::MapKind::foam, 0, 6, options);
    const auto foam = ktx2_levels(read_file(folder_ / "foam_0000.ktx2"));
    ASSERT_EQ(foam.size(), 6u);
    for (std::size_t level = 0; level < 6; ++level)
        EXPECT_EQ(foam[level], as_bytes(std::span<const std::byte>(expected[level].pixels)));
}

// Level 0 holds the cascade's halves with alpha set to 1. Other levels are means, here computed in
// double over all texels.
TEST_F(ExportedTextures, DisplacementHasMeansOfItsTexels) {
    expect_export(folder_.path(), {"--start", "3.03", "--maps", "displacement", "--mips", "--format", "ktx2"});
    const Cascade& cascade = ocean_.frame_at(3.03).cascades[0];
    const auto levels = ktx2_levels(read_file(folder_ / "displacement_0000.ktx2"));
    ASSERT_EQ(levels.size(), 6u);
    std::vector<std::uint16_t> halves(cascade.displacement_rgba16f.begin(), cascade.displacement_rgba16f.end());
    for (std::size_t alpha = 3; alpha < halves.size(); alpha += 4) halves[alpha] = 0x3C00;
    EXPECT_EQ(levels[0], as_bytes(std::span<const std::uint16_t>(halves)));
    for (int level = 1; level < 6; ++level) {
        const int side = 32 >> level, block = 1 << level;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                double mean = 0;
                for (int y = 0; y < block; ++y)
                    for (int x = 0; x < block; ++x)
                        mean +=
                            static_cast<double>(cascade.height.at(i * block + x, j * block + y)) / (block * block);
                std::uint16_t half = 0;
                std::memcpy(&half,
                            &levels[static_cast<std::size_t>(level)][8 * static_cast<std::size_t>(j * side + i) + 2],
                            2);
                // Rounding to float may break a tie: the error is at most one half, and no mean
                // here is near 0.
                EXPECT_NEAR(half, half_of(static_cast<float>(mean)), 1) << level << ' ' << i << ' ' << j;
            }
    }
}

// Both containers hold equal levels; a DDS file stores them contiguously after 148 bytes.
TEST_F(ExportedTextures, DdsHoldsTheLevelsOfKtx2) {
    const Arguments what = {"--maps", "displacement,compression", "--mips", "--half", "--format"};
    for (const std::string format : {"ktx2", "dds"}) {
        Arguments arguments = what;
        arguments.push_back(format);
        expect_export(folder_ / format, arguments);
    }
    for (const std::string map : {"displacement", "displacement_c1", "compression"}) {
        std::string levels;
        for (const Texels& level : ktx2_levels(read_file(folder_ / "ktx2" / (map + "_0000.ktx2"))))
            levels.append(level.begin(), level.end());
        EXPECT_EQ(read_file(folder_ / "dds" / (map + "_0000.dds")).substr(148), levels) << map;
    }
}

TEST_F(ExportedTextures, DdsHoldsFloatsWithoutHalf) {
    expect_export(folder_.path(), {"--maps", "displacement", "--format", "dds"});
    const std::string file = read_file(folder_ / "displacement_0000.dds");
    EXPECT_EQ(little_endian_at(file, 128, 4), 2u);  // DXGI_FORMAT_R32G32B32A32_FLOAT
    const Cascade& cascade = ocean_.frame_at(0).cascades[0];
    std::array<float, 4> texel{};
    std::memcpy(texel.data(), &file[148 + 16 * (5 * 32 + 7)], 16);
    EXPECT_EQ(texel, (std::array{cascade.dx.at(7, 5), cascade.height.at(7, 5), cascade.dz.at(7, 5), 1.f}));
}

TEST_F(ExportedTextures, ResumeToIdenticalFiles) {
    const Arguments what = {"--maps", "displacement,gradient", "--mips", "--format", "ktx2", "--frames", "3"};
    expect_export(folder_.path(), what);
    const auto before = files_in(folder_.path());
    std::filesystem::remove(folder_ / "gradient_c1_0001.ktx2");
    Arguments again = what;
    again.push_back("--resume");
    expect_export(folder_.path(), again);
    EXPECT_EQ(files_in(folder_.path()), before);
}

TEST_F(ExportedTextures, InvalidOptionsAreRejectedInOneLine) {
    const std::vector<std::pair<Arguments, std::string>> wrong = {
        {{"--format", "ktx"}, "--format is ktx, expected exr, tif, ktx2 or dds"},
        {{"--compression", "zstd"}, "--compression is zstd, expected zip, zips, piz, dwaa or none"},
        {{"--format", "ktx2", "--compression", "gzip"}, "--compression is gzip, expected zstd or none"},
        {{"--flipbook", "8"}, "--flipbook is 8, expected columns and rows from 1 to 16384, as 8x4"},
        {{"--flipbook", "0x4"}, "--flipbook is 0x4, expected columns and rows"},
        {{"--flipbook", "2x2", "--frames", "5"}, "--flipbook is 2x2, expected room for 5 frames"},
        {{"--flipbook", "513x1"}, "--flipbook is 513x1, expected at most 512 frames of 32 texels along a side"},
        {{"--preview", "--resume"}, "--preview cannot be combined with --resume"},
    };
    for (const auto& [arguments, line] : wrong) {
        const Outcome outcome = export_textures_to(folder_ / "none", arguments);
        EXPECT_EQ(outcome.exit_code, 2) << line;
        EXPECT_EQ(outcome.err.find("pelagic: " + line), 0u) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
    if (tools::has_zstd()) return;
    const Outcome outcome = export_textures_to(folder_ / "none", {"--format", "ktx2", "--compression", "zstd"});
    EXPECT_EQ(outcome.err, "pelagic: --compression is zstd, expected a pelagic that was built with libzstd\n");
}

TEST_F(ExportedTextures, MeasureRejectsDds) {
    expect_export(folder_.path(), {"--format", "dds", "--frames", "2"});
    const Outcome outcome = run_pelagic({"info", "--measure", folder_.path().string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(": the maps are dds textures, expected an export with --format exr, tif or ktx2"),
              std::string::npos)
        << outcome.err;
}

/// Reads a PNG with libpng's simplified reader. \param format libpng's format, equal to the file's
Texels read_png_as(const std::filesystem::path& file, png_uint_32 format, unsigned width, unsigned height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << file << image.message;
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    image.format = format;
    Texels pixels(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    return pixels;
}

TEST_F(ExportedTextures, FlipbookShowsEachFrameInItsCell) {
    expect_export(folder_.path(), {"--maps", "normal", "--loop-frames", "5", "--flipbook", "3x2"});
    for (const std::string cascade : {"", "_c1"}) {
        const Texels atlas = read_png_as(folder_ / ("flipbook_normal" + cascade + ".png"), PNG_FORMAT_RGB, 96, 64);
        for (std::size_t frame = 0; frame < 6; ++frame) {
            const Texels single =
                frame == 5 ? Texels(3 * 32 * 32)  // no frame: black
                           : read_png_as(folder_ / ("normal" + cascade + "_000" + std::to_string(frame) + ".png"),
                                         PNG_FORMAT_RGB, 32, 32);
            for (std::size_t j = 0; j < 32; ++j)
                EXPECT_TRUE(std::equal(&single[96 * j], &single[96 * j] + 96,
                                       &atlas[288 * (frame / 3 * 32 + j) + frame % 3 * 96]))
                    << "frame " << frame << ", row " << j;
        }
    }
    const json book = json::parse(read_file(folder_ / "flipbook.json"));
    EXPECT_EQ(book["columns"], 3);
    EXPECT_EQ(book["rows"], 2);
    EXPECT_EQ(book["frames"], 5);
    EXPECT_EQ(book["fps"], 5. / 8);
    EXPECT_EQ(book["loop"], true);
    EXPECT_EQ(book["side"], 32);
    EXPECT_EQ(book["files"][1]["name"], "flipbook_normal_c1.png");

    // A later export without a flipbook removes it.
    expect_export(folder_.path(), {"--maps", "normal", "--overwrite"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "flipbook.json"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "flipbook_normal_c1.png"));
}

// Each level of the atlas holds the frames' own levels, so that no frame bleeds into its neighbour.
TEST_F(ExportedTextures, FlipbookHoldsTheFramesLevels) {
    expect_export(folder_.path(),
                  {"--maps", "gradient", "--frames", "2", "--flipbook", "2x1", "--mips", "--format", "ktx2"});
    const auto atlas = ktx2_levels(read_file(folder_ / "flipbook_gradient.ktx2"));
    const auto second = ktx2_levels(read_file(folder_ / "gradient_0001.ktx2"));
    ASSERT_EQ(atlas.size(), second.size());
    for (std::size_t level = 0; level < atlas.size(); ++level) {
        const std::size_t row = 4 * (32u >> level);
        for (std::size_t j = 0; j < 32u >> level; ++j)
            EXPECT_TRUE(
                std::equal(&second[level][row * j], &second[level][row * j] + row, &atlas[level][row * (2 * j + 1)]));
    }
}

TEST_F(ExportedTextures, PreviewDescribesTheExportWithoutWritingIt) {
    const Arguments what = {"--maps", "displacement,compression", "--frames", "2"};
    Arguments preview = what;
    preview.push_back("--preview");
    const Outcome outcome = export_textures_to(folder_ / "preview", preview);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files_in(folder_ / "preview")) names.push_back(name);
    EXPECT_EQ(names, (std::vector<std::string>{".sea.lock", "preview.png"}));
    // One row of four maps, each 444 pixels wide.
    const Texels sheet = read_png_as(folder_ / "preview" / "preview.png", PNG_FORMAT_RGB, 1896, 716);
    EXPECT_GT(std::set<unsigned char>(sheet.begin(), sheet.end()).size(), 50u) << "it shows hardly anything";

    expect_export(folder_ / "export", what);
    const auto made = files_in(folder_ / "export");
    const std::size_t without_lock = made.size() - 1;
    double bytes = 0;
    for (const auto& [name, text] : made)
        if (name != "sea.json" && name != "sea_files.json") bytes += static_cast<double>(text.size());
    EXPECT_NE(outcome.out.find("will have " + std::to_string(without_lock) + " files, about "), std::string::npos)
        << outcome.out;
    const double printed = std::stod(outcome.out.substr(outcome.out.find("about ") + 6));  // kB
    // compressed sizes differ between frames
    EXPECT_NEAR(printed, bytes / 1000, 0.05 * printed) << outcome.out;
}

TEST(Film, ReturnsTheEncodersErrorMessage) {
    const TemporaryFolder folder;
    write_file(folder / "ffmpeg", "#!/bin/sh\necho no such encoder >&2\nexit 1\n");
    std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
    tools::Film film(2, 2, 24);
    film.add(std::vector<std::uint8_t>(2 * 2 * 4));
    const tools::Film::Encoded encoded = film.finish();
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_TRUE(encoded.mp4.empty());
    EXPECT_EQ(encoded.reason, "ffmpeg failed: no such encoder");
}

}  // namespace
}  // namespace pelagic
