// `pelagic query --shore`: the library's answers on a floor from an image, and what is refused.
#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

constexpr double sample_m = 25, middle_x = 1e6, middle_z = -3e5;

/// A beach along x, as the command places an image of 24 x 20 pixels that is 600 m wide.
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

Outcome query(const TemporaryFolder& folder, const std::string& points, std::vector<std::string> more) {
    write_file(folder / "points.csv", points);
    more.insert(more.begin(), {"query", "--points", (folder / "points.csv").string()});
    return run_pelagic(more);
}

TEST(ShoreCommand, QueriesTellTheLibrarysAnswersToTheLastBit) {
    const TemporaryFolder folder;
    const ShoreOptions shore = beach_of_image();
    write_image(folder / "floor.exr", shore);
    std::string points;
    std::vector<double> x, z;
    for (const double from_middle : {-250.0, -90.5, 60.25, 140.0, 2000.0}) {
        x.push_back(middle_x + from_middle);
        z.push_back(middle_z + 0.3 * from_middle);
        std::array<char, 64> text;
        char* end = std::to_chars(text.data(), text.data() + 30, x.back()).ptr;
        *end++ = ',';
        end = std::to_chars(end, text.data() + text.size(), z.back()).ptr;
        points += std::string(text.data(), end) + "\n";
    }
    const std::vector<std::string> sea = {"--resolution", "32", "--cascades", "3",
                                          "--wind-speed", "8",  "--time",     "7.3"};
    std::vector<std::string> with_shore = {
        "--floor", (folder / "floor.exr").string(), "--floor-size", "600", "--floor-middle", "1e6,-3e5", "--shore"};
    with_shore.insert(with_shore.end(), sea.begin(), sea.end());
    const Outcome outcome = query(folder, points, with_shore), open = query(folder, points, sea);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 8},
                {.executor = make_serial_executor(), .queries = true, .shore = shore});
    std::vector<float> height(x.size()), normal_x(x.size());
    SurfaceQuery(ocean.frame_at(7.3)).sample({x, z}, {.height_m = height, .normal_x = normal_x});
    std::istringstream lines(outcome.out), open_lines(open.out);
    std::string line, open_line;
    std::getline(lines, line);
    std::getline(open_lines, open_line);
    for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_TRUE(std::getline(lines, line) && std::getline(open_lines, open_line));
        double numbers[4] = {};
        const char* at = line.data();
        for (double& number : numbers) at = std::from_chars(at, line.data() + line.size(), number).ptr + 1;
        EXPECT_EQ(static_cast<float>(numbers[2]), height[i]) << line;
        EXPECT_EQ(static_cast<float>(numbers[3]), normal_x[i]) << line;
        // Only the last point is outside.
        EXPECT_EQ(line == open_line, i + 1 == x.size()) << line;
    }
}

TEST(ShoreCommand, NamesWhatAShoreNeeds) {
    const TemporaryFolder folder;
    write_image(folder / "floor.exr", beach_of_image());
    const std::string file = (folder / "floor.exr").string();
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--shore"}, "pelagic: --shore is given, needs --floor FILE beside it: the heights that waves feel\n"},
        {{"--floor-size", "20", "--shore"},
         "pelagic: --shore is given, needs --floor FILE beside it: the heights that waves feel\n"},
        {{"--floor", file}, "pelagic: --floor is given, needs --shore beside it: no other water feels its floor\n"},
        {{"--floor-middle", "3,4"}, "pelagic: --floor-middle is 3,4, needs --floor beside it\n"},
        {{"--floor", "reef.jpg", "--shore"},
         "pelagic: --floor is reef.jpg, needs a PNG or EXR image, each side from 2 to 4096 pixels\n"},
        {{"--floor", file, "--floor-size", "1e6", "--shore"},
         "pelagic: --floor is " + file +
             ", needs heights in metres (metres_a_sample is 41666.666666666664, needs (0, 10000])\n"},
        {{"--floor", file, "--shore", "--patch-size", "250"},
         "pelagic: --cascades is 1, needs 2 to 4 where there is a shore, which takes the coarsest tile's waves\n"},
        {{"--floor", file, "--shore", "--waves", "exp-sine"},
         "pelagic: --waves is exp-sine, needs spectrum or analytic where there is a shore\n"},
    };
    for (const auto& [arguments, line] : cases) {
        const Outcome run = query(folder, "0,0\n", arguments);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(run.err, line);
    }
    write_file(folder / "weather.toml", "cascades = 3\n[[change]]\nfrom = 10\nover = 20\nwind_speed = 9\n");
    const Outcome weather = run_pelagic({"query", "--points", (folder / "points.csv").string(), "--weather",
                                         (folder / "weather.toml").string(), "--floor", file, "--shore"});
    EXPECT_EQ(weather.exit_code, 2);
    EXPECT_EQ(weather.err, "pelagic: --shore is given, needs a sea that never changes, without --weather\n");
}

}  // namespace
}  // namespace pelagic
