// `pelagic query --shore` gives the library's results on a sea floor from an image; invalid input
// is rejected.
#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

constexpr double sample_m = 25, middle_x = 1e6, middle_z = -3e5;

/// Returns a beach along x, placed as the command places an image of 24 x 20 pixels that is 600 m
/// wide.
ShoreOptions beach_of_image() {
    ShoreOptions shore = shore_of(24, 20, sample_m, [](double x, double z) { return -14 + x * 0.03 + z * 0.01; });
    shore.corner_x_m = middle_x - 0.5 * sample_m * 23;
    shore.corner_z_m = middle_z - 0.5 * sample_m * 19;
    return shore;
}

void write_image(const std::filesystem::path& file, const ShoreOptions& shore) {
    OIIO::ImageBuf image(OIIO::ImageSpec(shore.columns, shore.rows, 1, OIIO::TypeDesc::FLOAT));
    for (int j = 0; j < shore.rows; ++j)
        for (int i = 0; i < shore.columns; ++i)
            image.setpixel(i, j, {shore.heights_m[static_cast<std::size_t>(j * shore.columns + i)]});
    ASSERT_TRUE(image.write(file.string())) << image.geterror();
}

Outcome query_shore(const TemporaryFolder& folder, const std::string& points, std::vector<std::string> more) {
    write_file(folder / "points.csv", points);
    more.insert(more.begin(), {"query", "--points", (folder / "points.csv").string()});
    return run_pelagic(more);
}

TEST(ShoreCommand, QueriesAreBitIdenticalToTheLibrary) {
    const TemporaryFolder folder;
    const ShoreOptions shore = beach_of_image();
    write_image(folder / "floor.exr", shore);
    std::string points;
    std::vector<double> x, z;
    for (const double from_middle : {-250.0, -90.5, 60.25, 140.0, -2000.0}) {
        x.push_back(middle_x + from_middle);
        z.push_back(middle_z + 0.3 * from_middle);
        std::array<char, 64> text;
        char* end = std::to_chars(text.data(), text.data() + 30, x.back()).ptr;
        *end++ = ',';
        end = std::to_chars(end, text.data() + text.size(), z.back()).ptr;
        points += std::string(text.data(), end) + "\n";
    }
    const std::vector<std::string> sea = {"--resolution", "32",  "--cascades",      "3",     "--wind-speed", "8",
                                          "--time",       "7.3", "--interpolation", "linear"};
    const Arguments with_shore = {
        "--floor", (folder / "floor.exr").string(), "--floor-size", "600", "--floor-middle", "1e6,-3e5", "--shore"};
    const Outcome outcome = query_shore(folder, points, joined(with_shore, sea)),
                  open = query_shore(folder, points, sea);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 8},
                {.executor = make_serial_executor(), .queries = true, .shore = shore});
    std::vector<float> height(x.size()), normal_x(x.size());
    SurfaceQuery(ocean.frame_at(7.3)).sample({x, z}, {.height_m = height, .normal_x = normal_x});
    std::istringstream lines(outcome.out), open_lines(open.out);
    std::string line, open_line;
    std::getline(lines, line);
    std::getline(open_lines, open_line);
    EXPECT_EQ(line, "x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,depth,converged");
    for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_TRUE(std::getline(lines, line) && std::getline(open_lines, open_line));
        double numbers[4] = {};
        const char* at = line.data();
        for (double& number : numbers) at = std::from_chars(at, line.data() + line.size(), number).ptr + 1;
        EXPECT_EQ(static_cast<float>(numbers[2]), height[i]) << line;
        EXPECT_EQ(static_cast<float>(numbers[3]), normal_x[i]) << line;
        // The floor rises by 0.03 along x and by 0.01 along z from -14 m in its corner. Outside,
        // the depth continues with the value at the edge.
        const std::size_t depth_at = line.rfind(',', line.rfind(',') - 1);
        double depth_m = 0;
        std::from_chars(line.data() + depth_at + 1, line.data() + line.size(), depth_m);
        const double from_x = std::max(0.0, x[i] - shore.corner_x_m), from_z = std::max(0.0, z[i] - shore.corner_z_m);
        EXPECT_NEAR(depth_m, 14 - from_x * 0.03 - from_z * 0.01, 1e-4) << line;
        // Only the last point is outside, where the water is deep enough for the open sea.
        EXPECT_EQ(line.substr(0, depth_at) == open_line.substr(0, open_line.rfind(',')), i + 1 == x.size()) << line;
    }
}

TEST(ShoreCommand, WarnsOfCoarseTexels) {
    const TemporaryFolder folder;
    write_image(folder / "floor.exr", beach_of_image());
    const std::vector<std::string> on = {
        "--floor", (folder / "floor.exr").string(), "--shore", "--resolution", "32", "--cascades", "3"};
    std::vector<std::string> fine = on, coarse = on;
    fine.insert(fine.end(), {"--floor-size", "600"});
    coarse.insert(coarse.end(), {"--floor-size", "30000"});
    EXPECT_EQ(query_shore(folder, "0,0\n", fine).err.find("coarse"), std::string::npos);
    const Outcome outcome = query_shore(folder, "0,0\n", coarse);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("note: texels of 112.7 m are coarse for the shore's shortest long waves, "),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("; --floor-size sets them\n"), std::string::npos) << outcome.err;
}

TEST(ShoreCommand, InvalidOptionsAreNamed) {
    const TemporaryFolder folder;
    write_image(folder / "floor.exr", beach_of_image());
    const std::string file = (folder / "floor.exr").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--shore"}, "pelagic: --shore requires --floor FILE, the heights of the sea floor\n"},
        {{"--floor-size", "20", "--shore"}, "pelagic: --shore requires --floor FILE, the heights of the sea floor\n"},
        {{"--floor", file}, "pelagic: --floor needs --shore: only a shore uses the floor\n"},
        {{"--floor-middle", "3,4"}, "pelagic: --floor-middle is 3,4, expected --floor beside it\n"},
        {{"--floor", "reef.jpg", "--shore"},
         "pelagic: --floor is reef.jpg, expected a PNG or EXR image, each side from 2 to 4096 pixels\n"},
        {{"--floor", file, "--floor-size", "1e6", "--shore"},
         "pelagic: --floor is " + file +
             ", expected heights in metres (metres_per_sample 41666.666666666664 is out of range [0.001, 10000])\n"},
        {{"--floor", file, "--shore", "--patch-size", "250"},
         "pelagic: --cascades is 1, expected 2 to 4 where there is a shore, which takes the coarsest cascade's "
         "waves\n"},
        {{"--floor", file, "--shore", "--waves", "pond"},
         "pelagic: --waves is pond, expected spectrum or analytic where there is a shore\n"},
        {{"--floor", file, "--shore", "--sea-level", "1"}, "pelagic: --sea-level cannot be combined with --shore\n"},
        {{"--floor", file, "--shore", "--current", "1,0"}, "pelagic: --current cannot be combined with --shore\n"},
    };
    for (const auto& [arguments, line] : cases) {
        const Outcome run = query_shore(folder, "0,0\n", arguments);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(run.err, line);
    }
    write_file(folder / "weather.toml", "cascades = 3\n[[change]]\nfrom = 10\nover = 20\nwind_speed = 9\n");
    const Outcome weather = run_pelagic({"query", "--points", (folder / "points.csv").string(), "--weather",
                                         (folder / "weather.toml").string(), "--floor", file, "--shore"});
    EXPECT_EQ(weather.exit_code, 2);
    EXPECT_EQ(weather.err, "pelagic: --shore cannot be combined with --weather\n");
}

/// The bytes of an EXR file by its specification, without pixels: everything that is read before
/// the pixels.
class ExrBytes {
   public:
    ExrBytes() { number(20000630).number(2); }

    ExrBytes& number(std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8) text_ += static_cast<char>(value >> shift & 0xFF);
        return *this;
    }
    ExrBytes& attribute(const std::string& name, const std::string& type, const std::string& value) {
        text_.append(name).append(1, '\0').append(type).append(1, '\0');
        number(static_cast<std::uint32_t>(value.size()));
        text_ += value;
        return *this;
    }
    /// Float channels c1000, c1001, ... and everything else that a header needs, for 4096 x 4096
    /// pixels.
    ExrBytes& usual(int channels) {
        const auto numbers = [](std::initializer_list<std::uint32_t> values) {
            ExrBytes bytes;
            bytes.text_.clear();
            for (const std::uint32_t value : values) bytes.number(value);
            return bytes.text_;
        };
        std::string list;
        for (int i = 0; i < channels; ++i)
            list += "c" + std::to_string(1000 + i) + std::string(1, '\0') + numbers({2, 0, 1, 1});
        const std::string box = numbers({0, 0, 4095, 4095});
        return attribute("channels", "chlist", list + std::string(1, '\0'))
            .attribute("compression", "compression", std::string(1, '\3'))
            .attribute("dataWindow", "box2i", box)
            .attribute("displayWindow", "box2i", box)
            .attribute("lineOrder", "lineOrder", std::string(1, '\0'))
            .attribute("pixelAspectRatio", "float", numbers({0x3F800000}))
            .attribute("screenWindowCenter", "v2f", numbers({0, 0}))
            .attribute("screenWindowWidth", "float", numbers({0x3F800000}));
    }
    /// The null byte, and the offsets of 256 blocks of 16 lines.
    std::string whole() const { return text_ + std::string(1 + 256 * 8, '\0'); }
    std::string torn() const { return text_; }

   private:
    std::string text_;
};

TEST(ShoreCommand, NamesADamagedImageInOneLine) {
    const TemporaryFolder folder;
    write_image(folder / "floor.exr", beach_of_image());
    write_image(folder / "floor.png", beach_of_image());
    for (const char* name : {"floor.exr", "floor.png"}) {
        if (is_sanitized && name == std::string("floor.png")) continue;  // OpenImageIO's PNG reader leaks then
        const std::string file = (folder / name).string(), whole = read_file(file);
        for (const std::size_t bytes : {whole.size() / 2, whole.size() - 40}) {
            write_file(file, whole.substr(0, bytes));
            const Outcome run = run_pelagic({"query", "--times", "0:0:1", "--floor", file, "--shore"});
            expect_one_line(run, 2, "--floor is " + file + ", expected a PNG or EXR image");
            EXPECT_EQ(run.err.find("\\n"), std::string::npos) << run.err;
        }
    }
}

TEST(ShoreCommand, RejectsHeadersThatNeedTooMuchMemory) {
    ExrBytes attributes, long_attribute;
    for (int i = 0; i < 100'000; ++i) attributes.attribute("a" + std::to_string(i), "int", std::string(4, '\0'));
    std::string two_gigabytes =
        long_attribute.usual(1).torn() + "a" + std::string(1, '\0') + "string" + std::string(1, '\0');
    two_gigabytes += std::string("\xff\xff\xff\x7f", 4) + std::string(100, 'x');
    const std::vector<std::pair<std::string, std::string>> files = {
        {ExrBytes().usual(1000).whole(), "it has 1000 channels, expected at most 4"},
        {attributes.usual(1).whole(), "its EXR header has more than 4000 attributes"},
        {two_gigabytes, "its EXR header has no end within the first 1 MiB"},
        {ExrBytes().usual(1).torn(), "its EXR header has no end"},
        {"no image at all", "it is no EXR file"},
        {"", "its EXR header has no end"}};
    EXPECT_LT(files[0].first.size(), 27'000u);
    const TemporaryFolder folder;
    write_file(folder / "points.csv", "0,0\n");
    for (const auto& [bytes, says] : files) {
        write_file(folder / "floor.exr", bytes);
        const Outcome run = run_pelagic({"query", "--points", (folder / "points.csv").string(), "--floor",
                                         (folder / "floor.exr").string(), "--shore"},
                                        [] {
                                            // The channels would be 67 GB, the attributes 100,000
                                            // squared comparisons.
                                            const rlimit memory{rlim_t{2} << 30, rlim_t{2} << 30}, seconds{10, 10};
                                            if (!is_sanitized) ::setrlimit(RLIMIT_AS, &memory);
                                            ::setrlimit(RLIMIT_CPU, &seconds);
                                        });
        EXPECT_EQ(run.exit_code, 2) << says << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err << "lacks " << says;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

}  // namespace
}  // namespace pelagic
