// The camera's motion and the layers of `pelagic render`, beside the surface that `pelagic query`
// prints.
#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

/// The named channels of an EXR file.
class Layers {
   public:
    explicit Layers(const std::filesystem::path& file) : image_(file.string()) {
        EXPECT_TRUE(image_.read(0, 0, true, OIIO::TypeDesc::FLOAT)) << image_.geterror();
    }
    double at(int x, int y, const std::string& channel) const {
        const int number = image_.spec().channelindex(channel);
        EXPECT_GE(number, 0) << channel;
        return double{image_.getchannel(x, y, 0, number)};
    }
    Vector vector(int x, int y, const std::string& layer) const {
        return {at(x, y, layer + ".X"), at(x, y, layer + ".Y"), at(x, y, layer + ".Z")};
    }
    const std::vector<std::string>& names() const { return image_.spec().channelnames; }

   private:
    OIIO::ImageBuf image_;
};

constexpr int width = 96, height = 54;

Outcome render(const std::filesystem::path& exr, const Arguments& more, const std::string& quality = "low") {
    const Arguments small = {"render", "--quality", quality, "--clouds", "0", "--size", "96x54", "--hdr", exr.string()};
    return run_pelagic(joined(small, more));
}

/// Rows of `pelagic query`, by column.
std::vector<std::vector<double>> query(const std::filesystem::path& points, const std::vector<Vector>& at,
                                       const Arguments& more) {
    std::string text = "x,z\n";
    for (const Vector& point : at) {
        std::array<char, 80> line;
        std::snprintf(line.data(), line.size(), "%.9g,%.9g\n", point[0], point[2]);
        text += line.data();
    }
    write_file(points, text);
    const Outcome run = run_pelagic(joined({"query", "--interpolation", "linear", "--points", points.string()}, more));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::vector<std::vector<double>> rows;
    for (const std::string& line : lines_of(run.out)) {
        std::vector<double> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::atof(cell.c_str()));
        rows.push_back(row);
    }
    EXPECT_FALSE(rows.empty());
    rows.erase(rows.begin());  // names of columns
    EXPECT_EQ(rows.size(), at.size());
    return rows;
}

const Arguments sea = {"--preset", "beaufort-9", "--resolution", "64"};

TEST(RenderLayers, AgreeWithTheCameraAndWithQueries) {
    const TemporaryFolder folder;
    const Outcome run =
        render(folder / "sea.exr", joined(sea, {"--time", "12", "--camera", "3,6,-2", "--target",
                                                "30,0,20", "--fov", "50", "--aov",
                                                "depth,normal,foam,velocity,position"}), "ultra");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Layers layers(folder / "sea.exr");
    EXPECT_EQ(layers.names().size(), 14u);

    const Vector eye = {3, 6, -2}, ahead = unit(difference({30, 0, 20}, eye)), right = unit(cross(ahead, {0, 1, 0})),
                 up = cross(right, ahead);
    const double scale = std::tan(25 * M_PI / 180);  // half of the vertical field of view
    int water = 0, empty = 0;
    std::vector<Vector> near, normals, velocities;
    std::vector<double> foam;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vector position = layers.vector(x, y, "P"), from_eye = difference(position, eye);
            const double depth = layers.at(x, y, "depth.Z");
            if (depth == 1e10f) {
                ++empty;
                EXPECT_EQ(position, Vector());
                EXPECT_EQ(layers.vector(x, y, "N"), Vector());
                continue;
            }
            ++water;
            // Floats of the position resolve 1e-5 of a pixel; interpolation in the driver, a hundredth.
            EXPECT_NEAR(dot(from_eye, ahead), depth, 1e-5 * depth + 1e-5);
            EXPECT_NEAR(dot(from_eye, right) / depth / scale * height, 2 * (x + 0.5) - width, 0.02);
            EXPECT_NEAR(dot(from_eye, up) / depth / scale * height, height - 2 * (y + 0.5), 0.02);
            EXPECT_NEAR(dot(layers.vector(x, y, "N"), layers.vector(x, y, "N")), 1, 1e-5);
            if (depth > 30) continue;
            near.push_back(position);
            normals.push_back(layers.vector(x, y, "N"));
            velocities.push_back(layers.vector(x, y, "velocity"));
            foam.push_back(layers.at(x, y, "foam.Y"));
        }
    EXPECT_GT(empty, 500);
    ASSERT_GT(water, 2000);
    ASSERT_GT(near.size(), 1000u);

    // Columns: x, z, height_m, normal_x, normal_y, normal_z, ...
    const auto at = [&](const std::string& time) {
        return query(folder / "p.csv", near, joined(sea, {"--foam", "--time", time}));
    };
    const auto now = at("12"), before = at("11.98"), after = at("12.02");
    std::array<std::vector<double>, 2> foam_of_query;  // where queries have no foam, and much
    double height_error = 0, velocity_error = 0, velocity_square = 0;
    std::array<double, 3> product{}, square{};
    for (std::size_t i = 0; i < near.size(); ++i) {
        const Vector slopes = {-now[i][3] / now[i][4], 0, -now[i][5] / now[i][4]};
        height_error += std::pow(now[i][2] - near[i][1], 2);
        const double queried = now[i][now[i].size() - 2];
        if (queried < 0.01 || queried > 0.3) foam_of_query[queried > 0.3 ? 1 : 0].push_back(foam[i]);
        // A point that moves with the water stays on the surface: dh/dt = vy - v . grad h.
        const double rate = (after[i][2] - before[i][2]) / 0.04;
        velocity_error += std::pow(velocities[i][1] - dot(velocities[i], slopes) - rate, 2);
        velocity_square += rate * rate;
        for (const int axis : {0, 2}) {
            product[axis] -= normals[i][axis] / normals[i][1] * slopes[axis];
            square[axis] += slopes[axis] * slopes[axis];
        }
    }
    const auto count = static_cast<double>(near.size());
    // Vertices are 0.13 m apart; between them the surface of four cascades of 64 bends by millimetres.
    EXPECT_LT(std::sqrt(height_error / count), 5e-3);
    // Central differences over 0.04 s, and kinks where a point passes between texels (0.04 measured).
    EXPECT_LT(std::sqrt(velocity_error / velocity_square), 0.1);
    // Ripples of the shader are independent of the cascades. Linear interpolation leaves a query 67 % of
    // the slope variance (surface_query.hpp), which is a factor of 1.22 in the slopes.
    for (const int axis : {0, 2}) {
        EXPECT_GT(product[axis] / square[axis], 1);
        EXPECT_LT(product[axis] / square[axis], 1.3);
    }
    // The texture opens foam, and windrows carry old films where nothing breaks (0.61 and 0.03 measured).
    ASSERT_GT(foam_of_query[1].size(), 500u);
    ASSERT_GT(foam_of_query[0].size(), 500u);
    EXPECT_GT(mean(foam_of_query[1]), 0.4);
    EXPECT_LT(mean(foam_of_query[0]), 0.1);
}

TEST(RenderCamera, EyeHeightFollowsTheWaterBelowTheCamera) {
    const TemporaryFolder folder;
    for (const std::string time : {"0", "3"}) {
        const auto water = query(folder / "p.csv", {{7, 0, -4}}, joined(sea, {"--time", time}));
        const double eye_m = water[0][2] + 1.5;
        const Arguments common =
            joined(sea, {"--aov", "position", "--time", time, "--target", "60,0,40", "--camera"});
        ASSERT_EQ(render(folder / "eye.exr", joined(common, {"7,-4", "--eye-height", "1.5"})).exit_code, 0);
        ASSERT_EQ(render(folder / "still.exr", joined(common, {"7," + std::to_string(eye_m) + ",-4"})).exit_code, 0);
        const Layers eye(folder / "eye.exr"), still(folder / "still.exr");
        for (int x = 0; x < width; ++x)
            for (int axis = 0; axis < 3; ++axis)
                // The query prints nine digits, and std::to_string() six decimals.
                EXPECT_NEAR(eye.vector(x, height - 1, "P")[axis], still.vector(x, height - 1, "P")[axis], 1e-3);
    }
}

// Keys on parabolas, at uneven times: the spline's derivatives are exact, and so is the path between
// the inner keys.
TEST(RenderCamera, PathPassesItsKeysAndFollowsParabolas) {
    const TemporaryFolder folder;
    const auto camera = [](double t) {
        std::array<char, 200> text;
        std::snprintf(text.data(), text.size(), "%.12g,%.12g,%.12g", 4 * t + t * t, 6 + 0.25 * t * t, 2 * t);
        return std::string(text.data());
    };
    const auto target = [](double t) {
        std::array<char, 200> text;
        std::snprintf(text.data(), text.size(), "%.12g,%.12g,%.12g", 40 + t, 0., 30 - t * t);
        return std::string(text.data());
    };
    std::string file = "\xEF\xBB\xBFtime,x,y,z,target_x,target_y,target_z\r\n";
    for (const double t : {1., 2., 4., 5.}) file += std::to_string(t) + "," + camera(t) + "," + target(t) + "\r\n";
    write_file(folder / "path.csv", file);
    const Arguments calm = {"--preset", "calm", "--resolution", "32", "--spray", "off", "--aov", "position"};
    const std::string path = (folder / "path.csv").string();
    const Outcome run = render(folder / "f.exr", joined(calm, {"--path", path, "--fps", "1"}));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_TRUE(std::filesystem::exists(folder / "f_0004.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder / "f_0005.exr"));
    for (const int frame : {0, 1, 2, 4}) {
        const double t = 1 + frame;
        ASSERT_EQ(render(folder / "still.exr", joined(calm, {"--time", std::to_string(t), "--camera", camera(t),
                                                             "--target", target(t)}))
                      .exit_code,
                  0);
        const std::string name = "f_000" + std::to_string(frame) + ".exr";
        if (frame != 2) {
            EXPECT_EQ(read_file(folder / name), read_file(folder / "still.exr")) << frame;
            continue;
        }
        const Layers moved(folder / name), still(folder / "still.exr");
        for (int x = 0; x < width; ++x)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(moved.vector(x, height - 1, "P")[axis], still.vector(x, height - 1, "P")[axis], 1e-4);
    }
}

// The centre of the spray moves with the camera, and droplets of earlier ticks must not depend on
// the frames before.
TEST(RenderCamera, PathResumesToTheSameImages) {
    const TemporaryFolder folder;
    write_file(folder / "path.csv",
               "time,x,z,target_x,target_y,target_z\n0,0,0,60,0,60\n0.5,40,0,100,0,60\n1,90,0,150,0,60\n");
    const Arguments storm = {"--preset", "beaufort-10",  "--resolution", "64",
                             "--path",   (folder / "path.csv").string(), "--eye-height", "3", "--fps", "4"};
    ASSERT_EQ(render(folder / "f.exr", storm).exit_code, 0);
    const std::string whole = read_file(folder / "f_0003.exr");
    std::filesystem::remove(folder / "f_0003.exr");
    ASSERT_EQ(render(folder / "f.exr", joined(storm, {"--resume"})).exit_code, 0);
    EXPECT_EQ(read_file(folder / "f_0003.exr"), whole);
    EXPECT_NE(read_file(folder / "f_0002.exr"), whole);
}

TEST(RenderLayers, SprayPointsAreTheDropletsOfTheImage) {
    const TemporaryFolder folder;
    const Outcome run = render(folder / "sea.exr", {"--preset", "beaufort-10", "--resolution", "64", "--json",
                                                    "--spray-points", (folder / "spray.ply").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string ply = read_file(folder / "spray.ply"), end = "end_header\n";
    const std::size_t header = ply.find(end) + end.size();
    const std::size_t count = nlohmann::json::parse(run.out)["statistics"]["spray_droplets"].get<std::size_t>();
    EXPECT_GT(count, 500u);
    EXPECT_NE(ply.find("element vertex " + std::to_string(count) + "\n"), std::string::npos);
    ASSERT_EQ(ply.size() - header, count * 9 * sizeof(float));
    for (std::size_t i = 0; i < count; ++i) {
        std::array<float, 9> point;
        std::memcpy(point.data(), &ply[header + i * sizeof(point)], sizeof(point));
        // reach_m of gl::drawn_spray, and what droplets fly in max_spray_lifetime_s at 40 m/s
        EXPECT_LT(std::hypot(point[0], point[2]), 160 + 1.5 * 40);
        EXPECT_LE(point[7], 1);
        EXPECT_LE(point[8], 1.5);
    }
}

TEST(RenderCamera, RejectsContradictionsInOneLine) {
    const TemporaryFolder folder;
    const std::string path = (folder / "path.csv").string();
    const std::string header = "time,x,y,z,target_x,target_y,target_z\n";
    write_file(folder / "path.csv", header + "0,0,6,0,60,0,60\n");
    for (const auto& [arguments, expected] : std::vector<std::pair<Arguments, std::string>>{
             {{"--eye-height", "2000000"}, "--eye-height 2000000 is out of range [-100, 10000] m"},
             {{"--eye-height", "2", "--camera", "1,2,3"},
              "--camera is 1,2,3, expected X,Z in metres with --eye-height"},
             {{"--path", path, "--camera", "0,1,0"}, "--path cannot be combined with --camera"},
             {{"--path", path, "--target", "0,1,0"}, "--path cannot be combined with --target"},
             {{"--path", path, "--eye-height", "2"}, "path.csv:1: the first line is " + header.substr(0, 37) +
                                                         ", expected the columns time,x,z,target_x,target_y,target_z"},
             {{"--path", path + "x"}, "which can't be read, expected a CSV file with the columns time,x,y,z"},
             {{"--spray-points", "a.ply", "--spray", "off"}, "--spray-points requires an image with spray"},
             {{"--spray-points", "a.exr"}, "--spray-points is a.exr, expected a file named *.ply"},
             {{"--aov", "depth"}, "--aov requires --hdr FILE.exr"},
             {{"--hdr", "a.exr", "--aov", "depht"},
              "--aov is depht, expected depth, normal, foam, velocity or position"},
             {{"--hdr", "a.exr", "--aov", "depth,depth"}, "--aov is depth,depth, expected each layer once"},
             {{"--hdr", "a.exr", "--aov", "depth", "--stereo"}, "--aov cannot be combined with --stereo"},
             {{"--hdr", "a.exr", "--aov", "depth", "--rock", "9,9"}, "--aov cannot be combined with --rock"},
             {{"--hdr", "a.exr", "--aov", "velocity", "--surface", "lake"},
              "--aov velocity requires --surface open"}}) {
        expect_one_line(run_pelagic(joined({"render"}, arguments)), 2, expected);
    }
    for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
             {"", "path.csv holds no keys, expected a first line time,x,y,z,target_x,target_y,target_z"},
             {header, "path.csv holds no keys"},
             {"time,x,z\n", "path.csv:1: the first line is time,x,z, expected the columns time,x,y,z"},
             {header + "\n0,0,6,0,60,0\n", "path.csv:3: the number of columns is 6, expected 7, as in the first line"},
             {header + "0,0,6,east,60,0,60\n", "path.csv:2: z is east, expected metres in [-1e7, 1e7]"},
             {header + "1e10,0,6,0,60,0,60\n", "path.csv:2: time is 1e10, expected seconds in [-1e9, 1e9]"},
             {header + "0,0,6,0,0,6,0\n", "path.csv:2: target_x,target_y,target_z is the camera's position"},
             {header + "0,0,6,0,60,0,60\n0,0,6,0,60,0,60\n", "path.csv:3: time is 0, expected more than 0"},
             {header + "0,0,6,0,60,0,60\n1e6,0,6,0,60,0,60\n",
              "--path has 24000001 frames, expected at most 100000"}}) {
        write_file(folder / "path.csv", text);
        expect_one_line(run_pelagic({"render", "--path", path}), 2, expected);
    }
    std::string many = header;
    for (int key = 0; key <= 100'000; ++key) many += std::to_string(key) + ",0,6,0,60,0,60\n";
    write_file(folder / "path.csv", many);
    expect_one_line(run_pelagic({"render", "--path", path}), 2,
                    "path.csv:100002: the number of keys is more, expected at most 100000");
}

}  // namespace
}  // namespace pelagic
