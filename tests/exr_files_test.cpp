// Parts, layers, tiles, levels and attributes of EXR files, read by OpenEXR.
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

constexpr int exr_side = 128;
const SeaState exr_sea{.cascades = 2, .resolution = exr_side, .wind_speed_mps = 20, .loop_period_s = 200};
const std::vector<std::string> exr_maps = {"displacement", "gradient", "compression"};

/// Exports frame 3 at 12 frames per second, with both cascades.
void export_exr_to(const std::filesystem::path& folder, const Arguments& flags) {
    Arguments arguments = joined({"export", "--out", folder.string(), "--cascades", "2", "--resolution", "128",
                                  "--fps", "12", "--frames", "3-3", "--wind-speed", "20"},
                                 flags);
    if (std::find(flags.begin(), flags.end(), "--maps") == flags.end())
        arguments.insert(arguments.end(), {"--maps", "displacement,gradient,compression"});
    const Outcome outcome = run_pelagic(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

constexpr double exr_time_s = 0.25;

/// The values of that frame from the library, by cascade, map and channel.
class ExpectedFrame {
   public:
    ExpectedFrame()
        : ocean_(exr_sea, {.executor = make_serial_executor(), .gradients = true}),
          frame_(ocean_.frame_at(exr_time_s)),
          compressions_(2, std::vector<float>(exr_side * exr_side)) {
        for (std::size_t i = 0; i < 2; ++i) copy_compression(frame_.cascades[i], compressions_[i]);
    }

    float at(std::size_t cascade, const std::string& map, char channel, int i, int j) const {
        const Cascade& of = frame_.cascades[cascade];
        const auto texel = static_cast<std::size_t>(j * exr_side + i);
        if (map == "displacement") return (channel == 'R' ? of.dx : channel == 'G' ? of.height : of.dz).at(i, j);
        if (map == "compression") return compressions_[cascade][texel];
        const int shift = channel == 'R' ? 0 : channel == 'G' ? 8 : channel == 'B' ? 16 : 24;
        return static_cast<float>(of.gradient_rgba8[texel] >> shift & 0xFF);
    }
    const Cascade& cascade(std::size_t number) const { return frame_.cascades[number]; }

   private:
    Ocean ocean_;
    const Frame& frame_;
    std::vector<std::vector<float>> compressions_;
};

const ExpectedFrame& expected() {
    static const ExpectedFrame frame;
    return frame;
}

std::string channels_of(const std::string& map) {
    return map == "displacement" ? "RGB" : map == "gradient" ? "RGBA" : "Y";
}

/// Reads a channel of one level of a part as floats, from any pixel type.
template <class Part>
std::vector<float> read_channel(Part& part, const std::string& channel, int level = 0) {
    const int width = exr_side >> level;
    std::vector<float> pixels(static_cast<std::size_t>(width) * width);
    Imf::FrameBuffer buffer;
    buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), sizeof(float),
                                      sizeof(float) * static_cast<std::size_t>(width)));
    part.setFrameBuffer(buffer);
    if constexpr (std::is_same_v<Part, Imf::TiledInputPart>)
        part.readTiles(0, part.numXTiles(level) - 1, 0, part.numYTiles(level) - 1, level);
    else
        part.readPixels(0, width - 1);
    return pixels;
}

/// Floats must equal the frame's; bytes are stored as fractions of 255, rounded to half.
void expect_map(const std::vector<float>& pixels, std::size_t cascade, const std::string& map, char channel) {
    for (int j = 0; j < exr_side; ++j)
        for (int i = 0; i < exr_side; ++i) {
            const float value = pixels[static_cast<std::size_t>(j * exr_side + i)];
            const float is = map == "gradient" ? std::round(255 * value) : value;
            ASSERT_EQ(is, expected().at(cascade, map, channel, i, j)) << map << cascade << channel << i << "," << j;
        }
}

std::string mark_of(std::size_t cascade) { return cascade > 0 ? "_c" + std::to_string(cascade) : ""; }

TEST(ExrFiles, PartsHoldEveryMapOfEveryCascade) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--pack", "parts"});
    Imf::MultiPartInputFile file((folder / "sea_0003.exr").c_str());
    ASSERT_EQ(file.parts(), 6);
    int number = 0;
    for (std::size_t cascade = 0; cascade < 2; ++cascade)
        for (const std::string& map : exr_maps) {
            Imf::InputPart part(file, number++);
            EXPECT_EQ(part.header().name(), map + mark_of(cascade));
            EXPECT_EQ(part.header().type(), Imf::SCANLINEIMAGE);
            for (const char channel : channels_of(map))
                expect_map(read_channel(part, map + mark_of(cascade) + "." + channel), cascade, map, channel);
        }
}

TEST(ExrFiles, LayersHoldEveryMapOfEveryCascade) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--pack", "layers"});
    Imf::MultiPartInputFile file((folder / "sea_0003.exr").c_str());
    ASSERT_EQ(file.parts(), 1);
    Imf::InputPart part(file, 0);
    std::set<std::string> layers;
    part.header().channels().layers(layers);
    EXPECT_EQ(layers, (std::set<std::string>{"compression", "compression_c1", "displacement", "displacement_c1",
                                             "gradient", "gradient_c1"}));
    for (std::size_t cascade = 0; cascade < 2; ++cascade)
        for (const std::string& map : exr_maps)
            for (const char channel : channels_of(map))
                expect_map(read_channel(part, map + mark_of(cascade) + "." + channel), cascade, map, channel);
}

/// The mean of the texels that a pixel of a level covers.
double mean_displacement(std::size_t cascade, char channel, int level, int i, int j) {
    double sum = 0;
    const int texels = 1 << level;
    for (int row = j * texels; row < (j + 1) * texels; ++row)
        for (int column = i * texels; column < (i + 1) * texels; ++column)
            sum += static_cast<double>(expected().at(cascade, "displacement", channel, column, row));
    return sum / (texels * texels);
}

TEST(ExrFiles, TiledFilesHoldAllLevels) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--tiled", "--mips"});
    for (std::size_t cascade = 0; cascade < 2; ++cascade) {
        Imf::MultiPartInputFile file((folder / ("displacement" + mark_of(cascade) + "_0003.exr")).c_str());
        Imf::TiledInputPart part(file, 0);
        EXPECT_EQ(part.tileXSize(), 64u);
        EXPECT_EQ(part.tileYSize(), 64u);
        EXPECT_EQ(part.levelMode(), Imf::MIPMAP_LEVELS);
        EXPECT_EQ(part.levelRoundingMode(), Imf::ROUND_DOWN);
        ASSERT_EQ(part.numLevels(), 8);
        for (const char channel : channels_of("displacement")) {
            expect_map(read_channel(part, {channel}), cascade, "displacement", channel);
            for (int level = 1; level < part.numLevels(); ++level) {
                const std::vector<float> pixels = read_channel(part, {channel}, level);
                const int width = exr_side >> level;
                // For values up to 20 m each level rounds three sums, by at most 3 x 2^-24 of the
                // values.
                for (int j = 0; j < width; ++j)
                    for (int i = 0; i < width; ++i)
                        ASSERT_NEAR(pixels[static_cast<std::size_t>(j * width + i)],
                                    mean_displacement(cascade, channel, level, i, j), level * 3 * 20 * 0x1p-24);
            }
        }
    }
    // PNG has no levels, so each is a file.
    EXPECT_TRUE(std::filesystem::exists(folder / "gradient_0003_mip7.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "displacement_0003_mip1.exr"));
}

TEST(ExrFiles, TiledPartsHoldTheFramesOwnLevels) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--pack", "parts", "--tiled", "--mips"});
    Imf::MultiPartInputFile file((folder / "sea_0003.exr").c_str());
    ASSERT_EQ(file.parts(), 6);
    Imf::TiledInputPart part(file, 4);
    ASSERT_EQ(part.header().name(), "gradient_c1");
    for (int level = 0; level < 8; ++level) {
        const std::vector<float> red = read_channel(part, "gradient_c1.R", level);
        const auto texels = expected().cascade(1).gradient_level(level);
        for (std::size_t texel = 0; texel < texels.size(); ++texel)
            ASSERT_EQ(std::lround(255 * red[texel]), texels[texel] & 0xFF) << level;
    }
}

template <class Value>
Value attribute(const Imf::Header& header, const std::string& name) {
    const auto* found = header.findTypedAttribute<Imf::TypedAttribute<Value>>(name);
    EXPECT_TRUE(found) << name;
    return found ? found->value() : Value{};
}

TEST(ExrFiles, HeadersDescribeTheParts) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--pack", "parts", "--compression", "piz"});
    const auto record = nlohmann::json::parse(read_file(folder / "sea.json"));
    Imf::MultiPartInputFile file((folder / "sea_0003.exr").c_str());
    for (int number : {0, 4}) {
        const Imf::Header& header = file.header(number);
        const nlohmann::json& cascade = record.at("layout").at("cascades").at(number / 3);
        const Imath::Box2i whole({0, 0}, {exr_side - 1, exr_side - 1});
        EXPECT_EQ(header.dataWindow(), whole);
        EXPECT_EQ(header.displayWindow(), whole);
        EXPECT_EQ(header.compression(), Imf::PIZ_COMPRESSION);
        EXPECT_EQ(Imf::wrapmodes(header), "periodic,periodic");
        EXPECT_EQ(Imf::framesPerSecond(header), Imf::Rational(12, 1));
        EXPECT_EQ(attribute<int>(header, "pelagic:frame"), 3);
        EXPECT_EQ(attribute<int>(header, "pelagic:cascade"), number / 3);
        EXPECT_EQ(attribute<double>(header, "pelagic:time_s"), exr_time_s);
        EXPECT_EQ(attribute<double>(header, "pelagic:side_m"), cascade.at("side_m"));
        EXPECT_EQ(attribute<double>(header, "pelagic:rotation_cosine"), cascade.at("rotation").at("cosine"));
        EXPECT_EQ(attribute<double>(header, "pelagic:rotation_sine"), cascade.at("rotation").at("sine"));
        EXPECT_EQ(attribute<std::string>(header, "pelagic:axes"), "+x east, +y up, +z south");
        for (const char* none : {"capDate", "owner", "worldToCamera", "worldToNDC", "Software"})
            EXPECT_EQ(header.find(none), header.end()) << none;
    }
    EXPECT_EQ(attribute<std::string>(file.header(0), "pelagic:channels"), "Dx = R m; height = G m; Dz = B m");
    EXPECT_EQ(attribute<std::string>(file.header(4), "pelagic:channels"),
              "normal_x = 2 R - 1; normal_z = 2 G - 1; jacobian = 2 B - 1; smoothness = A");
    EXPECT_EQ(attribute<std::string>(file.header(4), "pelagic:map"), "gradient");
}

TEST(ExrFiles, HeadersDescribeLayersByName) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--pack", "layers"});
    Imf::MultiPartInputFile file((folder / "sea_0003.exr").c_str());
    EXPECT_EQ(attribute<std::string>(file.header(0), "pelagic:compression_c1:channels"), "compression = Y");
    EXPECT_EQ(attribute<double>(file.header(0), "pelagic:compression_c1:side_m"), expected().cascade(1).grid.side_m);
    EXPECT_EQ(attribute<int>(file.header(0), "pelagic:frame"), 3);
}

TEST(ExrFiles, LosslessCompressionsAreExact) {
    const std::pair<const char*, Imf::Compression> compressions[] = {{"none", Imf::NO_COMPRESSION},
                                                                     {"zip", Imf::ZIP_COMPRESSION},
                                                                     {"zips", Imf::ZIPS_COMPRESSION},
                                                                     {"piz", Imf::PIZ_COMPRESSION}};
    for (const auto& [name, compression] : compressions) {
        const TemporaryFolder folder;
        export_exr_to(folder.path(), {"--maps", "displacement", "--compression", name});
        Imf::MultiPartInputFile file((folder / "displacement_c1_0003.exr").c_str());
        EXPECT_EQ(file.header(0).compression(), compression);
        Imf::InputPart part(file, 0);
        for (const char channel : channels_of("displacement"))
            expect_map(read_channel(part, {channel}), 1, "displacement", channel);
    }
}

// The documented error is 1 % of the largest wave; the test accepts 5 %.
TEST(ExrFiles, DwaaErrorIsSmall) {
    const TemporaryFolder folder;
    export_exr_to(folder.path(), {"--maps", "displacement", "--compression", "dwaa"});
    Imf::MultiPartInputFile file((folder / "displacement_0003.exr").c_str());
    Imf::InputPart part(file, 0);
    const std::vector<float> heights = read_channel(part, "G");
    float max = 0, largest = 0;
    for (int j = 0; j < exr_side; ++j)
        for (int i = 0; i < exr_side; ++i) {
            const float height = expected().at(0, "displacement", 'G', i, j);
            max = std::max(max, std::abs(heights[static_cast<std::size_t>(j * exr_side + i)] - height));
            largest = std::max(largest, std::abs(height));
        }
    EXPECT_GT(max, 0) << "it keeps every bit";
    EXPECT_LT(max, 0.05f * largest);
}

// The records restore the options, and recomputed frames have identical bytes.
TEST(ExrFiles, PassVerification) {
    const std::vector<std::vector<std::string>> exports = {
        {"--pack", "parts", "--tiled", "--mips", "--compression", "none"}, {"--maps", "compression"}};
    for (const std::vector<std::string>& flags : exports) {
        const TemporaryFolder folder;
        export_exr_to(folder.path(), flags);
        const Outcome outcome = run_pelagic({"verify", folder.path().string()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    }
}

TEST(ExrFiles, TiffFilesUseTheGivenCompression) {
    for (const std::string compression : {"zip", "lzw", "none"}) {
        const TemporaryFolder folder;
        export_exr_to(folder.path(), {"--maps", "displacement", "--format", "tif", "--compression", compression});
        const auto input = OIIO::ImageInput::open((folder / "displacement_0003.tif").string());
        ASSERT_TRUE(input);
        EXPECT_EQ(input->spec().get_string_attribute("compression"), compression);
        std::vector<float> pixels(exr_side * exr_side * 3);
        ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data()));
        for (int j = 0; j < exr_side; ++j)
            for (int i = 0; i < exr_side; ++i)
                ASSERT_EQ(pixels[static_cast<std::size_t>(3 * (j * exr_side + i) + 1)],
                          expected().at(0, "displacement", 'G', i, j));
    }
}

}  // namespace
}  // namespace pelagic
