// Contents of exported maps: every pixel of every map, decoded by sea.json alone, is compared with
// the frame in double.
#include <gtest/gtest.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/tests/read_image.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic {
namespace {

using nlohmann::json;

// A gale at short fetch. The second cascade is rotated.
const SeaState mapped_gale{
    .cascades = 2, .resolution = 32, .wind_speed_mps = 20, .fetch_m = 400, .lean = 0.3, .loop_period_s = 8};
const Arguments mapped_gale_flags = {"--cascades", "2",   "--resolution",  "32", "--wind-speed", "20",
                                     "--fetch",    "400", "--lean",        "0.3", "--loop-period", "8"};

Outcome run_mapped_gale(const Arguments& arguments, const Arguments& more = {}) {
    return run_pelagic(joined(joined(arguments, mapped_gale_flags), more));
}

struct Vector {
    double x = 0, y = 0, z = 0;
};

/// The surface at a texel in Pelagic's axes, in double.
struct Truth {
    Vector displacement, velocity, normal;  ///< the normal is a unit vector
    double jacobian = 0, h_x = 0, h_z = 0, compression = 0;
};

Truth truth_at(const Cascade& cascade, int i, int j) {
    const int n = cascade.resolution();
    const CascadeGrid& grid = cascade.grid;
    const auto slopes = [&](const PlaneView& plane) {
        const auto at = [&](int a, int b) { return static_cast<double>(plane.at((a + n) % n, (b + n) % n)); };
        const double along = (at(i + 1, j) - at(i - 1, j)) / (2 * cascade.texel_m());
        const double across = (at(i, j + 1) - at(i, j - 1)) / (2 * cascade.texel_m());
        return grid.in_world(along, across);  // of x and z
    };
    // The trace of the gradient by the derivative of slope maps (sim/slope_sum.hpp).
    const auto wide = [&](const PlaneView& plane) {
        const auto at = [&](int a, int b) { return static_cast<double>(plane.at((a + n) % n, (b + n) % n)); };
        constexpr double far = -0.2194, near = 0.9388;
        return grid.in_world(
            (near * (at(i + 1, j) - at(i - 1, j)) + far * (at(i + 2, j) - at(i - 2, j))) / cascade.texel_m(),
            (near * (at(i, j + 1) - at(i, j - 1)) + far * (at(i, j + 2) - at(i, j - 2))) / cascade.texel_m());
    };
    const double trace = wide(cascade.dx).along + wide(cascade.dz).across;
    const double front = double{cascade.compression_front_x} * wide(cascade.height).along +
                         double{cascade.compression_front_z} * wide(cascade.height).across;
    const CascadeGrid::Vector dx = slopes(cascade.dx), h = slopes(cascade.height), dz = slopes(cascade.dz);
    const Vector along_x{1 + dx.along, h.along, dz.along}, along_z{dx.across, h.across, 1 + dz.across};
    const Vector normal{along_z.y * along_x.z - along_z.z * along_x.y, along_z.z * along_x.x - along_z.x * along_x.z,
                        along_z.x * along_x.y - along_z.y * along_x.x};
    const double length = std::hypot(normal.x, normal.y, normal.z);
    const auto at = [&](const PlaneView& plane) { return static_cast<double>(plane.at(i, j)); };
    return {.displacement = {at(cascade.dx), at(cascade.height), at(cascade.dz)},
            .velocity = {at(cascade.velocity_x), at(cascade.velocity_y), at(cascade.velocity_z)},
            .normal = {normal.x / length, normal.y / length, normal.z / length},
            .jacobian = normal.y,
            .h_x = h.along,
            .h_z = h.across,
            .compression = -double{cascade.compression_scale} * (trace + front)};
}

/// Reference positions of texels, from the layout alone, in Pelagic's x and z.
class Places {
   public:
    explicit Places(const json& cascade) : x_(cascade.at("x_m")), is_z_up_(cascade.contains("y_m")) {
        other_ = cascade.at(is_z_up_ ? "y_m" : "z_m");
    }
    Vector at(int column, int row) const {
        const double other = on(other_, column, row);
        return {on(x_, column, row), 0, is_z_up_ ? -other : other};
    }
    /// Unit vectors towards the image's right and lower edges.
    Vector to_the_right() const { return step(1, 0); }
    Vector down() const { return step(0, 1); }

   private:
    static double on(const json& line, int column, int row) {
        return line.at("column").get<double>() * column + line.at("row").get<double>() * row +
               line.at("offset").get<double>();
    }
    Vector step(int columns, int rows) const {
        const Vector from = at(0, 0), to = at(columns, rows);
        const double length = std::hypot(to.x - from.x, to.z - from.z);
        return {(to.x - from.x) / length, 0, (to.z - from.z) / length};
    }

    json x_, other_;
    bool is_z_up_;
};

/// Returns a texel's values by name; values of a normal map are in the cascade's own axes.
std::map<std::string, double> named_numbers(const Truth& truth, const Places& places, bool is_z_up) {
    const auto& [x, y, z] = truth.velocity;
    const auto along = [&](const Vector& axis) { return truth.normal.x * axis.x + truth.normal.z * axis.z; };
    return {{"Dx", truth.displacement.x},
            {"Dy", -truth.displacement.z},
            {"Dz", truth.displacement.z},
            {"height", truth.displacement.y},
            {"velocity_x", x},
            {"velocity_y", is_z_up ? -z : y},
            {"velocity_z", is_z_up ? y : z},
            {"normal_x", truth.normal.x},
            {"normal_y", -truth.normal.z},
            {"normal_z", truth.normal.z},
            {"jacobian", truth.jacobian},
            {"normal_right", along(places.to_the_right())},
            {"normal_image_up", -along(places.down())},
            {"normal_image_down", along(places.down())},
            {"normal_out", truth.normal.y},
            {"dh_dx", truth.h_x},
            {"dh_dy", -truth.h_z},
            {"dh_dz", truth.h_z},
            {"compression", truth.compression}};
}

/// The largest accepted error of a pixel of the given type. Floats are differences of floats: a few
/// units of 2^-24 m over texels of decimetres. A half has eleven bits.
double bound(const std::string& type, double scale, double value) {
    const double of_floats = 4e-6 * (1 + std::fabs(value));
    if (type == "uint8") return scale / 2 / 255 + of_floats;
    if (type == "uint16") return scale / 2 / 65535 + of_floats;
    return type == "half" ? of_floats + std::fabs(value) / 2048 + 6e-8 : of_floats;
}

struct MapRequest {
    const char* name;
    Arguments flags;
};

class ExportedMaps : public testing::TestWithParam<MapRequest> {
   protected:
    void SetUp() override {
        Arguments flags = GetParam().flags;
        flags.insert(flags.end(), {"--no-sync", "--mips", "--start", "1.5", "--maps",
                                   "displacement,gradient,normal,velocity,jacobian,slope,compression"});
        const Outcome outcome = run_mapped_gale({"export", "--out", folder_.path().string()}, flags);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        record_ = json::parse(read_file(folder_ / "sea.json"));
    }

    std::string mark_of(const json& cascade) const {
        const std::string mark = cascade.at("in_file_names");
        return mark.empty() ? "" : mark + "_";
    }
    /// Returns the single file of a map whose name starts with `start`, with any extension.
    ReadImage image(const std::string& start) const {
        for (const json& file : record_["frames"][0]["files"])
            if (file["name"].get<std::string>().starts_with(start + "."))
                return read_image(folder_ / file["name"].get<std::string>());
        ADD_FAILURE() << "no " << start;
        return {};
    }

    TemporaryFolder folder_;
    json record_;
    Ocean ocean_{mapped_gale, {.executor = make_serial_executor(), .velocities = Velocities::drawn, .gradients = true}};
};

TEST_P(ExportedMaps, DecodedBySeaJsonEqualTheFrame) {
    const Frame& frame = ocean_.frame_at(1.5);
    const bool is_z_up = record_["layout"]["axes"]["up"] == "+z";
    for (std::size_t t = 0; t < frame.cascades.size(); ++t) {
        const Cascade& cascade = frame.cascades[t];
        const json& layout = record_["layout"]["cascades"][t];
        const Places places(layout);
        const int n = cascade.resolution();
        ASSERT_EQ(layout["resolution"], n);
        std::vector<std::map<std::string, double>> numbers;  // of each texel, by rows of the image
        for (int row = 0; row < n; ++row)
            for (int column = 0; column < n; ++column) {
                const Vector rest = places.at(column, row);
                const CascadeGrid::Vector place = cascade.grid.in_cascade(rest.x, rest.z);
                const double i = place.along / cascade.texel_m(), j = place.across / cascade.texel_m();
                ASSERT_NEAR(i, column, 1e-6);
                ASSERT_NEAR(j, std::round(j), 1e-6);
                numbers.push_back(
                    named_numbers(truth_at(cascade, column, static_cast<int>(std::round(j))), places, is_z_up));
            }
        for (const auto& [map, channels] : record_["channels"].items()) {
            const ReadImage pixels = image(map + "_" + mark_of(layout) + "0000");
            ASSERT_EQ(pixels.channels, static_cast<int>(channels.size())) << map;
            ASSERT_EQ(pixels.width, n);
            ASSERT_EQ(pixels.height, n);
            for (int c = 0; c < pixels.channels; ++c) {
                const json& channel = channels[static_cast<std::size_t>(c)];
                const std::string name = channel["name"];
                if (name == "smoothness") continue;  // constant over all texels of level 0
                EXPECT_EQ(channel["type"], pixels.type) << map;
                const double scale = channel["scale"], offset = channel["offset"];
                const bool has_range = channel.contains("range");
                const double min = has_range ? channel["range"][0].get<double>() : 0,
                             max = has_range ? channel["range"][1].get<double>() : 0;
                for (int row = 0; row < n; ++row)
                    for (int column = 0; column < n; ++column) {
                        const double read = scale * pixels.at(column, row, c) + offset;
                        double expected = numbers[static_cast<std::size_t>(row * n + column)].at(name);
                        if (has_range) expected = std::clamp(expected, min, max);
                        ASSERT_NEAR(read, expected, bound(pixels.type, scale, expected))
                            << map << "." << name << " of cascade " << t << " at " << column << ", " << row;
                    }
            }
        }
    }
}

/// A texel of a level, in double: the mean of the texels of level 0 that it covers, which are taken
/// as exact.
std::vector<double> mean_of_block(const ReadImage& finest, int column, int row, int level) {
    std::vector<double> mean(static_cast<std::size_t>(finest.channels));
    const int side = 1 << level;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            for (int c = 0; c < finest.channels; ++c)
                mean[static_cast<std::size_t>(c)] += finest.at(side * column + i, side * row + j, c) / (side * side);
    return mean;
}

using LevelsOfExportedMaps = ExportedMaps;

TEST_P(LevelsOfExportedMaps, AreMeansAndNormalsStayUnitVectors) {
    for (const char* map : {"normal", "jacobian", "slope", "compression"}) {
        const json& channels = record_["channels"][map];
        const double scale = channels[0]["scale"], offset = channels[0]["offset"];
        const ReadImage finest = image(std::string(map) + "_c1_0000");
        for (int level = 1; level <= 5; ++level) {
            const ReadImage pixels = image(std::string(map) + "_c1_0000_mip" + std::to_string(level));
            ASSERT_EQ(pixels.width, 32 >> level);
            for (int row = 0; row < pixels.height; ++row)
                for (int column = 0; column < pixels.width; ++column) {
                    std::vector<double> expected = mean_of_block(finest, column, row, level);
                    for (double& value : expected) value = scale * value + offset;
                    double length = 1;
                    if (std::string(map) == "normal") length = std::hypot(expected[0], expected[1], expected[2]);
                    for (int c = 0; c < pixels.channels; ++c) {
                        const double read = scale * pixels.at(column, row, c) + offset;
                        const double value = expected[static_cast<std::size_t>(c)] / length;
                        // Level 0 is rounded too, and normalising a short mean enlarges that error.
                        const double steps = 2 / length + 1;
                        // Compressions have both signs, so a small mean has the rounding of values
                        // up to 4.
                        const double rounded = std::string(map) == "compression" ? 4 : value;
                        EXPECT_NEAR(read, value, steps * bound(pixels.type, scale, rounded)) << map << " " << level;
                    }
                }
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "velocity_0000_mip1.exr"));
}

INSTANTIATE_TEST_SUITE_P(MapRequest, LevelsOfExportedMaps,
                         testing::Values(MapRequest{"Bytes", {"--bit-depth", "8"}},
                                         MapRequest{"Halves",
                                                    {"--half", "--bit-depth", "float", "--rows", "bottom"}}),
                         [](const auto& asked) { return asked.param.name; });
INSTANTIATE_TEST_SUITE_P(
    MapRequest, ExportedMaps,
    testing::Values(
        MapRequest{"AsTheyAre", {}},
        MapRequest{"ForDirectXIn8Bits", {"--bit-depth", "8", "--normal-y", "down", "--rows", "bottom"}},
        MapRequest{"ZUpInCentimetresAsTiff",
                   {"--format", "tif", "--bit-depth", "16", "--axes", "z-up", "--unit", "cm", "--rows", "bottom"}},
        MapRequest{"ZUpInHalves", {"--half", "--bit-depth", "float", "--axes", "z-up", "--normal-y", "down"}},
        MapRequest{"FloatsInCentimetres", {"--bit-depth", "float", "--unit", "cm", "--rows", "bottom"}}),
    [](const auto& asked) { return asked.param.name; });

TEST(ExportedNormals, Have16BitsByDefaultWhereFilesAreImages) {
    for (const auto& [format, type] : std::vector<std::pair<std::string, std::string>>{
             {"exr", "uint16"}, {"tif", "uint16"}, {"ktx2", "uint8"}, {"dds", "uint8"}}) {
        const TemporaryFolder folder;
        const Outcome outcome = run_mapped_gale({"export", "--out", folder.path().string()},
                                                {"--no-sync", "--maps", "normal", "--format", format});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(read_file(folder / "sea.json").find("\"" + type + "\""), std::string::npos) << format;
        if (format == "exr") {
            // The header of a PNG file has the bits of a sample at byte 24.
            EXPECT_EQ(read_file(folder / "normal_0000.png").at(24), 16);
        }
    }
}

// Imath is an independent implementation.
TEST(HalfOf, MatchesImathForEveryHalfAndNearEveryMidpoint) {
    for (std::uint32_t bits = 0; bits < 0x7BFF; ++bits) {
        const auto value = [](std::uint32_t of) {
            Imath::half half;
            half.setBits(static_cast<std::uint16_t>(of));
            return static_cast<float>(half);
        };
        const float here = value(bits), next = value(bits + 1), middle = here + (next - here) / 2;
        for (const float x : {here, middle, std::nextafter(middle, 0.f), std::nextafter(middle, 1e9f)}) {
            ASSERT_EQ(half_of(x), Imath::half(x).bits()) << x;
            ASSERT_EQ(half_of(-x), Imath::half(-x).bits()) << -x;
        }
    }
    // The largest half is 65504; larger values are clamped to it.
    for (const float x : {65504.f, 65519.9f, 65520.f, 1e30f, std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(half_of(x), 0x7BFF) << x;
        EXPECT_EQ(half_of(-x), 0xFBFF) << -x;
    }
    EXPECT_EQ(half_of(-1e-30f), 0x8000);
}

TEST(FloatOfHalf, MatchesImathForEveryHalf) {
    for (std::uint32_t bits = 0; bits <= 0xFFFF; ++bits) {
        Imath::half half;
        half.setBits(static_cast<std::uint16_t>(bits));
        const float value = float_of_half(static_cast<std::uint16_t>(bits)), expected = half;
        ASSERT_EQ(std::isnan(value), std::isnan(expected)) << bits;
        if (std::isnan(expected)) continue;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(expected)) << bits;
    }
}

/// A cascade of hand-made planes, still water by default.
struct Planes {
    std::vector<float> dx = std::vector<float>(16 * 16), height = dx, dz = dx;

    Cascade cascade() const {
        const auto view = [](const std::vector<float>& plane) { return PlaneView{plane.data(), 16, 16, 16, 0}; };
        Cascade cascade;
        cascade.grid.side_m = 32;
        cascade.dx = view(dx), cascade.height = view(height), cascade.dz = view(dz);
        return cascade;
    }
};

std::vector<std::uint8_t> normal_bytes(const Planes& planes, int level) {
    const Cascade cascade = planes.cascade();
    Frame frame;
    frame.cascades = {&cascade, 1};
    const tools::MapImage image = tools::map_image(frame, 0, tools::MapKind::normal, level, {});
    std::vector<std::uint8_t> bytes;
    for (const std::byte byte : image.pixels) bytes.push_back(std::to_integer<std::uint8_t>(byte));
    return bytes;
}

TEST(NormalMap, OfStillWaterPointsUp) {
    for (const int level : {0, 2, 4}) {
        const std::vector<std::uint8_t> bytes = normal_bytes({}, level);
        ASSERT_EQ(bytes.size(), 3u * (16 >> level) * (16 >> level));
        for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], i % 3 == 2 ? 255 : 128);
    }
}

// Water compressed to one point has no normal.
TEST(NormalMap, OfWaterCompressedToAPointPointsUp) {
    Planes planes;
    for (std::size_t j = 0; j < 16; ++j)
        for (std::size_t i = 0; i < 16; ++i) {
            planes.dx[16 * j + i] = -2.f * static_cast<float>(i);
            planes.dz[16 * j + i] = -2.f * static_cast<float>(j);
        }
    const std::vector<std::uint8_t> bytes = normal_bytes(planes, 0);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(bytes[3 * (16 * 8 + 8) + c], c == 2 ? 255 : 128);
}

// An overturned crest: its normals cannot point up, so they are horizontal and point away from the
// slope.
TEST(NormalMap, OfOverturnedWaterIsHorizontal) {
    Planes planes;
    const auto wave = [](std::size_t i) { return 2 * 3.14159265f * static_cast<float>(i) / 16; };
    for (std::size_t texel = 0; texel < 16 * 16; ++texel) {
        planes.height[texel] = 2 * std::cos(wave(texel % 16));
        planes.dx[texel] = -8 * std::sin(wave(texel % 16));  // J = 1 - 1.53 cos
    }
    const std::vector<std::uint8_t> bytes = normal_bytes(planes, 0);
    for (const std::size_t i : {1, 2, 14, 15}) {
        EXPECT_EQ(bytes[3 * i], i < 8 ? 255 : 0) << i;
        EXPECT_EQ(bytes[3 * i + 1], 128);
        EXPECT_EQ(bytes[3 * i + 2], 128);
    }
    for (const std::size_t i : {5, 8, 11}) EXPECT_GT(bytes[3 * i + 2], 200) << i;
}

// Measured wave statistics do not depend on the axes, unit and row order of the export.
TEST(ExportedMapsMeasured, DoNotDependOnAxesUnitAndRows) {
    const TemporaryFolder folder;
    const auto measured = [&](const std::string& name, const Arguments& flags) {
        const Arguments all = joined({"--maps", "displacement", "--no-sync", "--frames", "16", "--fps", "8"}, flags);
        EXPECT_EQ(run_mapped_gale({"export", "--out", (folder / name).string()}, all).exit_code, 0);
        const Outcome outcome = run_pelagic({"info", "--json", "--measure", (folder / name).string()});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return json::parse(outcome.out)["waves"];
    };
    const json usual = measured("usual", {});
    const json other = measured("other", {"--axes", "z-up", "--unit", "cm", "--rows", "bottom"});
    for (const char* figure : {"significant_wave_height_m", "mean_direction_deg", "peak_wavelength_m"}) {
        ASSERT_TRUE(usual[figure]["found"].is_number()) << figure;
        EXPECT_NEAR(usual[figure]["found"].get<double>(), other[figure]["found"].get<double>(), 1e-4) << figure;
    }

    json record = json::parse(read_file(folder / "other" / "sea.json"));
    const auto message_of = [&](const json& edited) {
        write_file(folder / "other" / "sea.json", edited.dump());
        const Outcome outcome = run_pelagic({"info", "--measure", (folder / "other").string()});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        return outcome.err;
    };
    json edited = record;
    edited["export"]["rows"] = "left";
    EXPECT_NE(message_of(edited).find("rows are neither top nor bottom"), std::string::npos);
    edited = record;
    edited["channels"]["displacement"][2]["channel"] = "Q";
    EXPECT_NE(message_of(edited).find("the channel of heights is none"), std::string::npos);
    edited = record;
    edited["channels"]["displacement"] = {1, "two", nullptr};
    EXPECT_NE(message_of(edited).find("has no channel of heights"), std::string::npos);
}

TEST(ExportedMapsRefused, EachWithOneLineThatNamesTheAcceptedValues) {
    const TemporaryFolder folder;
    const std::vector<std::pair<Arguments, std::string>> asked = {
        {{"--maps", "normal,speed"},
         "expected displacement, gradient, normal, foam, velocity, jacobian, slope, compression or some of them"},
        {{"--bit-depth", "12"}, "--bit-depth is 12, expected 8, 16 or float"},
        {{"--bit-depth", "16"}, "--bit-depth is 16, expected normal or foam among --maps"},
        {{"--normal-y", "left", "--maps", "normal"}, "--normal-y is left, expected up or down"},
        {{"--normal-y", "down"}, "--normal-y is down, expected normal among --maps"},
        {{"--axes", "x-up"}, "--axes is x-up, expected y-up or z-up"},
        {{"--unit", "ft"}, "--unit is ft, expected m or cm"},
        {{"--rows", "left"}, "--rows is left, expected top or bottom"},
        {{"--maps", "slope", "--format", "png"}, "--format is png, expected exr, tif, ktx2 or dds"}};
    for (const auto& [flags, words] : asked) {
        const Outcome outcome = run_mapped_gale({"export", "--out", (folder / "out").string()}, flags);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace pelagic
