// `pelagic render` as run from a shell: images, statistics, and one line of error where something
// is missing.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

/// Returns the root mean square difference, in 8-bit steps, of blocks of 4 x 4 pixels. A wave that
/// a driver rounds to the next pixel does not count; a changed colour or shape does.
double difference(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
    const auto blocks_of = [](const OIIO::ImageBuf& image) {
        return OIIO::ImageBufAlgo::resize(image, "box", 0, {0, image.spec().width / 4, 0, image.spec().height / 4});
    };
    return 255 * OIIO::ImageBufAlgo::compare(blocks_of(a), blocks_of(b), 0, 0).rms_error;
}

OIIO::ImageBuf read_pixels(const std::filesystem::path& file) {
    OIIO::ImageBuf image(file.string());
    EXPECT_TRUE(image.read(0, 0, true, OIIO::TypeDesc::FLOAT)) << image.geterror();
    return image;
}

// Headset shading draws no spray by default. Without clouds, whose shader takes half of the time.
TEST(RenderCommand, DrawsSpray) {
    const TemporaryFolder folder;
    const auto droplets = [&](const std::string& file, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render",      "--preset",
                                          "beaufort-10", "--resolution",
                                          "64",          "--size",
                                          "96x54",       "--quality",
                                          "low",         "--clouds",
                                          "0",           "--json",
                                          "--out",       (folder / file).string()};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome run = run_pelagic(words);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out)["statistics"]["spray_droplets"].get<int>();
    };
    const int all = droplets("with.png", {});
    EXPECT_GT(all, 500);
    EXPECT_EQ(droplets("without.png", {"--spray", "off"}), 0);
    EXPECT_GT(difference(read_pixels(folder / "with.png"), read_pixels(folder / "without.png")), 0);
    EXPECT_EQ(droplets("headset.png", {"--shading", "headset"}), 0);
    EXPECT_EQ(droplets("asked_for.png", {"--shading", "headset", "--spray", "on"}), all);
}

// The reference images were made by the command itself and inspected; PELAGIC_UPDATE_IMAGES=1 makes
// new ones.
TEST(RenderCommand, ImagesMatchTheReferences) {
    const std::filesystem::path references = in_sources("tests/golden/images");
    const TemporaryFolder folder;
    for (const std::string preset : {"calm", "moderate", "storm"}) {
        const std::filesystem::path file = folder / (preset + ".png");
        const Outcome run = run_pelagic(
            {"render", "--preset", preset, "--size", "320x180", "--quality", "low", "--out", file.string()});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        if (std::getenv("PELAGIC_UPDATE_IMAGES"))
            std::filesystem::copy_file(file, references / (preset + ".png"),
                                       std::filesystem::copy_options::overwrite_existing);
        const OIIO::ImageBuf made = read_pixels(file), kept = read_pixels(references / (preset + ".png"));
        for (const OIIO::ImageBuf* image : {&made, &kept})
            ASSERT_EQ(image->roi(), OIIO::ROI(0, 320, 0, 180, 0, 1, 0, 3)) << preset;
        // In 8-bit steps. Rounding and libm of other machines give 0.0 to 0.5; a visible change
        // gives more than 3.
        EXPECT_LE(difference(made, kept), 3) << preset;
        if (preset == "calm") continue;
        // A different sea is a visible change: 30 and 51.
        EXPECT_GT(difference(made, read_pixels(references / "calm.png")), 3) << preset;
    }
}

TEST(RenderCommand, StopsWithOneLineAndLeavesCompleteImages) {
    const TemporaryFolder folder, logs;
    constexpr std::ptrdiff_t frames = 500;
    const pid_t process =
        start_pelagic({"render", "--preset", "calm", "--clouds", "0", "--size", "64x36", "--quality", "low",
                       "--frames", std::to_string(frames), "--out", (folder / "sea.png").string()},
                      logs / "out", logs / "err");
    EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(folder / "sea_0001.png"); }));
    ::kill(process, SIGINT);
    EXPECT_EQ(wait_for(process), 128 + SIGINT);
    EXPECT_EQ(read_file(logs / "out"), "");
    EXPECT_EQ(read_file(logs / "err"), "pelagic: stopped; the same command with --resume renders the rest\n");
    std::ptrdiff_t images = 0;
    for (const auto& [name, bytes] : files_in(folder.path())) {
        EXPECT_TRUE(name.starts_with("sea_")) << name;
        EXPECT_EQ(read_pixels(folder / name).spec().width, 64) << name;
        ++images;
    }
    EXPECT_GE(images, 2);
    EXPECT_LT(images, frames);
}

TEST(RenderCommand, ReportsASoftwareDriver) {
    const TemporaryFolder folder;
    for (const std::string quality : {"low", "medium"}) {
        const Outcome run = run_pelagic({"render", "--clouds", "0", "--size", "32x18", "--quality", quality, "--json",
                                         "--out", (folder / "sea.png").string()});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const std::string renderer = nlohmann::json::parse(run.out)["statistics"]["renderer"];
        const bool is_software = renderer.find("llvmpipe") != std::string::npos;
        EXPECT_EQ(run.err,
                  is_software && quality != "low"
                      ? "note: " + renderer + " draws without a graphics processor; --quality low is faster\n"
                      : "");
    }
}

// One half of the image is land, sand in daylight; the other half is deep water.
TEST(RenderCommand, ReadsTheSeaFloorFromAnImage) {
    const TemporaryFolder folder;
    OIIO::ImageBuf heights(OIIO::ImageSpec(4, 4, 1, OIIO::TypeDesc::UINT16));
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) heights.setpixel(i, j, {i < 2 ? 0.f : 1.f});
    ASSERT_TRUE(heights.write((folder / "floor.png").string())) << heights.geterror();
    const std::filesystem::path file = folder / "sea.png";
    // Straight down, +x is at the top.
    const Outcome run = run_pelagic({"render",
                                     "--preset",
                                     "calm",
                                     "--clouds",
                                     "0",
                                     "--resolution",
                                     "32",
                                     "--size",
                                     "64x64",
                                     "--quality",
                                     "low",
                                     "--floor",
                                     (folder / "floor.png").string(),
                                     "--floor-size",
                                     "400",
                                     "--floor-heights",
                                     "-100,5",
                                     "--camera",
                                     "0,100,0",
                                     "--target",
                                     "0,0,0",
                                     "--out",
                                     file.string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const OIIO::ImageBuf image = read_pixels(file);
    const auto brightness = [&](int y) { return image.getchannel(32, y, 0, 1); };
    EXPECT_GT(brightness(8), 2 * brightness(56));
    const Outcome lake = run_pelagic({"render", "--floor", (folder / "floor.png").string(), "--shore", "--surface",
                                      "lake", "--out", file.string()});
    EXPECT_EQ(lake.exit_code, 2);
    EXPECT_EQ(lake.err, "pelagic: --shore requires --surface open\n");
    const Outcome wrong = run_pelagic({"render", "--floor", (folder / "sea.png").string(), "--out", "a.png"},
                                      [&] { write_file(folder / "sea.png", "no image"); });
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("expected a PNG or EXR image"), std::string::npos) << wrong.err;
    EXPECT_EQ(std::count(wrong.err.begin(), wrong.err.end(), '\n'), 1) << wrong.err;
}

// A box of 4 x 1 x 2 m in the middle of the view changes the image, and its pose is the one that
// `pelagic query` prints.
TEST(RenderCommand, DrawsAHullWhereItFloats) {
    const TemporaryFolder folder;
    write_file(folder / "box.obj",
               "v -2 0 -1\nv 2 0 -1\nv 2 1 -1\nv -2 1 -1\nv -2 0 1\nv 2 0 1\nv 2 1 1\nv -2 1 1\n"
               "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
    const std::vector<std::string> hull = {
        "--hull", (folder / "box.obj").string(), "--mass", "2000",  "--resolution", "32", "--wind-speed",
        "6",      "--events-resolution",         "128",    "--json"};
    const auto render = [&](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "--clouds", "0", "--size", "64x64", "--quality", "low", "--camera",
                                   "0,8,0.1", "--target", "0,0,0", "--out", (folder / name).string()});
        return run_pelagic(more);
    };
    const Outcome with_hull = render("hull.png", hull);
    ASSERT_EQ(with_hull.exit_code, 0) << with_hull.err;
    std::vector<std::string> query = hull;
    query.insert(query.begin(), "query");
    const Outcome queried = run_pelagic(query);
    ASSERT_EQ(queried.exit_code, 0) << queried.err;
    EXPECT_EQ(nlohmann::json::parse(with_hull.out)["statistics"]["hull"], nlohmann::json::parse(queried.out)[0]);
    ASSERT_EQ(render("sea.png", {"--resolution", "32", "--wind-speed", "6"}).exit_code, 0);
    // In 8-bit steps. A visible change gives more than 3 (ImagesMatchTheReferences).
    EXPECT_GT(difference(read_pixels(folder / "hull.png"), read_pixels(folder / "sea.png")), 3);
    for (const std::string more : {"--stereo", "--wireframe"}) {
        std::vector<std::string> wrong = hull;
        wrong.push_back(more);
        const Outcome run = render("wrong.png", wrong);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.err, "pelagic: --hull cannot be combined with " + more + "\n");
    }
}

// A planing boat in a calm, from 30 m above: its jets leave the sides of the bow, and water closes
// behind its stern. White water reflects ten times as much as the sea, which is 30 of 255 brighter even
// if a tenth of it is white. Nothing changes abeam of the stern.
TEST(RenderCommand, AHullAtEightMetresPerSecondThrowsSprayAndLeavesFoam) {
    const TemporaryFolder folder;
    const std::vector<std::string> boat = {"--hull", in_sources("examples/boat/boat.obj"), "--mass", "4400",
                                           "--hull-thrust", "26000", "--resolution", "32", "--wind-speed", "3"};
    std::vector<std::string> query = boat;
    query.insert(query.begin(), {"query", "--json"});
    const Outcome queried = run_pelagic(query);
    ASSERT_EQ(queried.exit_code, 0) << queried.err;
    const nlohmann::json hull = nlohmann::json::parse(queried.out)[0];
    const auto at = [&](const char* name) { return hull[name].get<double>(); };
    EXPECT_NEAR(std::hypot(at("vx"), at("vz")), 8, 0.5);
    constexpr int width = 192, height = 108;
    constexpr double above_m = 30;
    const auto image = [&](const std::string& spray) {
        std::vector<std::string> render = boat;
        const std::string place = std::to_string(at("x")) + "," + std::to_string(above_m) + ",";
        render.insert(render.begin(), {"render", "--size", "192x108", "--quality", "low", "--shading", "medium",
                                       "--clouds", "0", "--exposure", "14", "--spray", spray, "--camera",
                                       place + std::to_string(at("z") + 0.01), "--target",
                                       std::to_string(at("x")) + ",0," + std::to_string(at("z")), "--out",
                                       (folder / (spray + ".png")).string()});
        const Outcome run = run_pelagic(render);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return read_pixels(folder / (spray + ".png"));
    };
    const OIIO::ImageBuf with = image("on"), without = image("off");
    // Returns the mean change of green in a rectangle of 6 x 2 m.
    const auto change = [&](double ahead_m, double beside_m) {
        const double heading = at("heading") * std::numbers::pi / 180;
        double sum = 0;
        int count = 0;
        for (double along = ahead_m - 3; along <= ahead_m + 3; along += 0.5)
            for (double across = beside_m - 1; across <= beside_m + 1; across += 0.5, ++count) {
                const double x = along * std::cos(heading) - across * std::sin(heading),
                             z = along * std::sin(heading) + across * std::cos(heading);
                const double pixels_per_m = 0.5 * height / std::tan(std::numbers::pi / 6) / above_m;
                const auto column = static_cast<int>(0.5 * width + x * pixels_per_m),
                           row = static_cast<int>(0.5 * height + z * pixels_per_m);
                sum += 255 * (with.getchannel(column, row, 0, 1) - without.getchannel(column, row, 0, 1));
            }
        return sum / count;
    };
    EXPECT_GT(change(-8, 0), 30) << "behind the stern";
    EXPECT_GT(change(4, 2.5), 30) << "starboard of the bow";
    EXPECT_GT(change(4, -2.5), 30) << "port of the bow";
    EXPECT_NEAR(change(-5, 10), 0, 2) << "undisturbed";
}

TEST(RenderCommand, PrintsStatisticsAndNumbersItsImages) {
    const TemporaryFolder folder;
    const Outcome run = run_pelagic({"render", "--resolution", "64", "--size", "64x48", "--quality", "low",
                                     "--frames", "2", "--stereo", "--json", "--out", (folder / "sea.png").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto statistics = nlohmann::json::parse(run.out).at("statistics");
    EXPECT_EQ(statistics.at("views"), 2);
    EXPECT_LE(statistics.at("sea_draw_calls_per_view"), 17);
    const int texels = (4 * 64 * 64 - 1) / 3, without_snapshots = 4 * (64 * 64 * 8 + 2 * 4 * texels);
    EXPECT_EQ((statistics.at("uploaded_bytes").get<int>() - without_snapshots) % (3 * 4 * texels), 0);
    EXPECT_GT(statistics.at("triangles"), 0);
    EXPECT_TRUE(statistics.at("median_ms").contains("draw_in_driver"));
    EXPECT_EQ(read_pixels(folder / "sea_0000.png").spec().width, 64);
    EXPECT_EQ(read_pixels(folder / "sea_0001.png").spec().height, 48);
}

std::function<void()> in_folder(const std::filesystem::path& folder) {
    return [folder] { std::filesystem::current_path(folder); };
}

TEST(RenderCommand, WritesSeaPngByDefault) {
    const TemporaryFolder folder;
    const Outcome run = run_pelagic({"render", "--resolution", "32", "--size", "32x18", "--quality", "low"},
                                    in_folder(folder.path()));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read_pixels(folder / "sea.png").spec().width, 32);
    EXPECT_EQ(run.out.find("sea.png: 1 image of 32x18"), 0u) << run.out;
}

TEST(RenderCommand, NamesImagesByAPatternAndResumes) {
    const TemporaryFolder folder;
    const std::vector<std::string> command = {"render",  "rough.%03d.png", "--clouds",  "0",   "--resolution", "32",
                                              "--size",  "32x18",          "--quality", "low", "--frames",     "3",
                                              "--quiet", "--resume"};
    ASSERT_EQ(run_pelagic(command, in_folder(folder.path())).out, "");
    const auto first = files_in(folder.path());
    ASSERT_EQ(first.size(), 3u);
    for (const char* const name : {"rough.000.png", "rough.001.png", "rough.002.png"})
        EXPECT_TRUE(first.contains(name)) << name;
    // An image that exists is kept, a missing one is rendered with the same bytes.
    write_file(folder / "rough.000.png", "kept");
    std::filesystem::remove(folder / "rough.001.png");
    ASSERT_EQ(run_pelagic(command, in_folder(folder.path())).exit_code, 0);
    const auto second = files_in(folder.path());
    EXPECT_EQ(second.at("rough.000.png"), "kept");
    EXPECT_EQ(second.at("rough.001.png"), first.at("rough.001.png"));
}

// A stand-in for ffmpeg stores its input: five seconds of RGBA images, and no film if it fails.
TEST(RenderCommand, SendsTheFramesOfAFilmToFfmpeg) {
    const TemporaryFolder folder;
    const auto with_ffmpeg = [&](const std::string& script) {
        write_file(folder / "ffmpeg", "#!/bin/sh\n" + script);
        std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
        return run_pelagic({"render", "sea.mp4", "--clouds", "0", "--resolution", "32", "--size", "32x18",
                            "--quality", "low", "--fps", "1"},
                           [&] {
                               std::filesystem::current_path(folder.path());
                               ::setenv("PATH", (folder.path().string() + ":/usr/bin:/bin").c_str(), 1);
                           });
    };
    const Outcome failed = with_ffmpeg("echo no such encoder >&2\nexit 1\n");
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_EQ(failed.err, "pelagic: can't write sea.mp4: ffmpeg failed: no such encoder\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "sea.mp4"));
    const Outcome made = with_ffmpeg("exec cat\n");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(read_file(folder / "sea.mp4").size(), 5u * 32 * 18 * 4);
}

TEST(RenderCommand, RejectsNamesOfFilmsAndImages) {
    for (const auto& [arguments, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"sea.jpg"}, "--out is sea.jpg, expected a file named *.png or *.mp4"},
             {{"sea.%04d.mp4"}, "--out is sea.%04d.mp4, expected a name without # and %: it is one file"},
             {{"sea.##.##.png"}, "--out is sea.##.##.png, expected a name with one number"},
             {{"sea.mp4", "--resume"}, "--resume cannot be combined with a film"},
             {{"sea.mp4", "--size", "33x18"}, "--size is 33x18, expected an even width and height"}}) {
        std::vector<std::string> command = {"render"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const Outcome run = run_pelagic(command);
        EXPECT_EQ(run.exit_code, 2) << says;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err << "lacks " << says;
    }
}

/// Renders a view, and a wider view with more bright and dark sky on both sides.
std::vector<OIIO::ImageBuf> narrow_and_wide(const std::filesystem::path& folder, const std::string& exposure) {
    std::vector<OIIO::ImageBuf> images;
    for (const std::string size : {"64x96", "256x96"}) {
        const std::filesystem::path file = folder / (size + exposure + ".png");
        const Outcome run =
            run_pelagic({"render", "--resolution", "32", "--clouds", "0", "--quality", "low", "--size", size, "--sun",
                         "80,12", "--bloom", "0", "--exposure", exposure, "--out", file.string()});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        images.push_back(read_pixels(file));
    }
    // The middle of the wide image is the narrow image: its rows are equally high.
    images[1] = OIIO::ImageBufAlgo::cut(images[1], {96, 160, 0, 96});
    return images;
}

TEST(RenderCommand, FixedExposureDoesNotDependOnTheView) {
    const TemporaryFolder folder;
    // The narrow view draws fewer patches, from other positions in the same buffers: rounding
    // differs by at most one step.
    const auto fixed = narrow_and_wide(folder.path(), "14");
    EXPECT_LT(difference(fixed[0], fixed[1]), 0.5);
    const auto metered = narrow_and_wide(folder.path(), "auto");
    EXPECT_GT(difference(metered[0], metered[1]), 3);
}

// A dark rock in the middle of the image, and its reflection in the water in front of it.
TEST(RenderCommand, RockInTheSeaIsReflected) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "sea.exr";
    const Outcome run =
        run_pelagic({"render",    "--preset", "beaufort-0", "--resolution", "32",       "--clouds", "0",
                     "--quality", "low",      "--size",     "48x48",        "--camera", "0,3,0",    "--target",
                     "30,-1,0",   "--sun",    "60,30",      "--rock",       "25,0",     "--hdr",    file.string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const OIIO::ImageBuf image = read_pixels(file);
    const auto green = [&](int x, int y) { return image.getchannel(x, y, 0, 1); };
    // Above its foot, in row 25, is the rock; below it the water reflects the rock, and the sky on
    // both sides.
    EXPECT_LT(green(24, 18), 0.5f * green(4, 18));
    float before_rock = 0, beside = 0;
    for (int x = 0; x < 4; ++x) {
        before_rock += green(21 + 2 * x, 26);
        beside += green(x < 2 ? 4 + x : 41 + x, 26);
    }
    EXPECT_LT(before_rock, 0.6f * beside);
}

// Several runs make the images of one film, each from a different first frame.
TEST(RenderCommand, ImageOfAFilmDoesNotDependOnTheFirstFrame) {
    const TemporaryFolder folder;
    const std::vector<std::string> scene = {"render", "--resolution", "32", "--quality", "low", "--size",
                                            "64x48",  "--clouds",     "0",  "--fps",     "2"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), scene.begin(), scene.end());
        const Outcome run = run_pelagic(more);
        EXPECT_EQ(run.exit_code, 0) << run.err;
    };
    with({"--frames", "2", "--time", "3", "--out", (folder / "film.png").string()});
    with({"--time", "3.5", "--out", (folder / "second.png").string()});
    EXPECT_EQ(read_file(folder / "film_0001.png"), read_file(folder / "second.png"));
}

// The sun is over +z, a quarter of the sky image right of its middle; above the sun's side of the
// sea the light is brighter.
TEST(RenderCommand, WritesLinearLightAndTheSkyMap) {
    const TemporaryFolder folder;
    const Outcome run =
        run_pelagic({"render", "--resolution", "64", "--size", "64x48", "--quality", "low", "--clouds", "0", "--sun",
                     "90,20", "--hdr", (folder / "sea.exr").string(), "--sky", (folder / "sky.exr").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(files_in(folder.path()).size(), 2u);
    const OIIO::ImageBuf sea = read_pixels(folder / "sea.exr"), sky = read_pixels(folder / "sky.exr");
    EXPECT_EQ(sea.roi(), OIIO::ROI(0, 64, 0, 48, 0, 1, 0, 3));
    EXPECT_EQ(sky.roi(), OIIO::ROI(0, 2048, 0, 1024, 0, 1, 0, 3));
    EXPECT_EQ(sea.spec().format, OIIO::TypeDesc::FLOAT);
    // 20 degrees of elevation are 398 rows from the top. The brightest light is near the sun; the
    // disc itself would be 6e4 times as bright.
    const float at_sun = sky.getchannel(1536, 398, 0, 1), away = sky.getchannel(512, 398, 0, 1);
    EXPECT_GT(at_sun, 5 * away);
    EXPECT_LT(at_sun, 10);
    const auto mean = OIIO::ImageBufAlgo::computePixelStats(sea).avg;
    EXPECT_GT(mean[1], 0.001f);
    EXPECT_LT(mean[1], 0.3f);
}

TEST(RenderCommand, NamesOptionValueAndRange) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--out", "a.jpg"}, "pelagic: --out is a.jpg, expected a file named *.png or *.mp4\n"},
        {{"--out", "a.png", "--size", "12x9000"},
         "pelagic: --size is 12x9000, expected WIDTHxHEIGHT, each from 16 to 8192\n"},
        {{"--out", "a.png", "--sun", "3"},
         "pelagic: --sun is 3, expected AZIMUTH,ELEVATION in degrees, elevation in [-90, 90]\n"},
        {{"--out", "a.png", "--clouds", "2"}, "pelagic: --clouds is 2, expected a fraction in [0, 1]\n"},
        {{"--out", "a.png", "--cloud-seed", "-1"},
         "pelagic: --cloud-seed is -1, expected a whole number from 0 to 4294967295\n"},
        {{"--out", "a.png", "--frames", "0"}, "pelagic: --frames is 0, expected a whole number from 1 to 100000\n"},
        {{"--out", "a.png", "--floor", "reef.jpg"},
         "pelagic: --floor is reef.jpg, expected a PNG or EXR image, each side from 2 to 4096 pixels\n"},
        {{"--out", "a.png", "--floor", "no such.png"},
         "pelagic: --floor is no such.png, which can't be read, expected a PNG or EXR image, each side from 2 to "
         "4096 "
         "pixels (No such file or directory)\n"},
        {{"--out", "a.png", "--shore"}, "pelagic: --shore requires --floor FILE, the heights of the sea floor\n"},
        {{"--out", "a.png", "--floor-size", "20"}, "pelagic: --floor-size is 20, expected --floor beside it\n"},
        {{"--out", "a.png", "--floor", "a.exr", "--floor-heights", "0,1"},
         "pelagic: --floor-heights is 0,1, expected a PNG: an EXR holds metres\n"},
        {{"--out", "a.png", "--floor", "a.png", "--floor-heights", "3,-1"},
         "pelagic: --floor-heights is 3,-1, expected LOW,HIGH in metres above rest, -11000 <= LOW < HIGH <= 9000\n"},
        {{"--out", "a.png", "--moon", "10,91"},
         "pelagic: --moon is 10,91, expected AZIMUTH,ELEVATION in degrees, elevation in [-90, 90]\n"},
        {{"--out", "a.png", "--visibility", "2"}, "pelagic: --visibility is 2, expected metres in [500, 300000]\n"},
        {{"--out", "a.png", "--light", "moonlit"},
         "pelagic: --light is moonlit, expected noon, golden-hour, overcast, storm or moonlight (the nearest is "
         "moonlight)\n"},
        {{"--out", "a.png", "--exposure", "21"},
         "pelagic: --exposure is 21, expected auto, or an exposure value in [-10, 20]\n"},
        {{"--out", "a.png", "--exposure-bias", "6"}, "pelagic: --exposure-bias is 6, expected stops in [-5, 5]\n"},
        {{"--out", "a.png", "--crest-glow", "11"}, "pelagic: --crest-glow is 11, expected a factor in [0, 10]\n"},
        {{"--out", "a.png", "--rock", "3"},
         "pelagic: --rock is 3, expected X,Z in metres, each in [-10000, 10000]\n"},
        {{"--out", "a.png", "--rock", "3,4", "--stereo"},
         "pelagic: --rock is 3,4, expected an image without --stereo and --wireframe\n"},
        {{"--out", "a.png", "--bloom", "-1"}, "pelagic: --bloom is -1, expected a fraction in [0, 1]\n"},
        {{"--hdr", "a.png"}, "pelagic: --hdr is a.png, expected a file named *.exr\n"},
        {{"--sky", "a%d.exr"}, "pelagic: --sky is a%d.exr, expected a name without # and %: it is one file\n"},
        {{"--hdr", "a.exr", "--sky", "a.exr"}, "pelagic: --sky is a.exr, expected another file than --hdr\n"},
        {{"--hdr", "a.exr", "--wireframe"},
         "pelagic: --hdr is a.exr, expected a sea without --wireframe, whose colours are no radiance\n"},
        {{"--out", "a.png", "--surface", "sea"},
         "pelagic: --surface is sea, expected open, lake, coast, river or pond\n"},
        {{"--out", "a.png", "--spray", "some"}, "pelagic: --spray is some, expected auto, on or off\n"},
        {{"--out", "a.png", "--spray", "on", "--surface", "lake"}, "pelagic: --spray on requires --surface open\n"},
        {{"--out", "a.png", "--flow", "a.png"}, "pelagic: --flow requires --surface river\n"},
        {{"--out", "a.png", "--surface", "river", "--flow", "/dev/null"},
         "pelagic: --flow is /dev/null, expected a square PNG of 1 to 4096 pixels a side, RGB or RGBA with 8 bits a "
         "channel\n"},
    };
    for (const auto& [arguments, line] : cases) {
        std::vector<std::string> words = {"render"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome run = run_pelagic(words);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.err, line);
    }
}

// Regression: opening a FIFO waited for a reader, and SIGTERM did not end the wait.
TEST(RenderCommand, ReplacesOnlyRegularFiles) {
    const TemporaryFolder folder;
    write_file(folder / "victim", "mine");
    for (const std::string name : {"sea.png", ".sea.png.part"}) {
        const std::filesystem::path place = folder / name;
        ASSERT_EQ(::mkfifo(place.c_str(), 0666), 0);
        for (const std::string kind : {"a FIFO", "a symbolic link"}) {
            const Outcome run = run_pelagic(
                {"render", "--resolution", "16", "--size", "16x16", "--out", (folder / "sea.png").string()},
                [] { ::alarm(60); });
            EXPECT_EQ(run.exit_code, 1);
            EXPECT_NE(run.err.find(place.string() + ": it is " + kind), std::string::npos) << run.err;
            EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
            EXPECT_TRUE(std::filesystem::remove(place)) << "still there";
            if (kind == "a FIFO") std::filesystem::create_symlink(folder / "victim", place);
        }
    }
    EXPECT_EQ(read_file(folder / "victim"), "mine");
}

// libglvnd takes its list of drivers from the variable; with an empty list EGL loads but cannot
// draw.
TEST(RenderCommand, NamesTheMissingPackageWithoutADriver) {
    const TemporaryFolder folder;
    const auto without_driver = [] { ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1); };
    const Outcome render = run_pelagic({"render", "--out", (folder / "sea.png").string()}, without_driver);
    EXPECT_EQ(render.exit_code, 1);
    EXPECT_NE(render.err.find("libgl1-mesa-dri"), std::string::npos) << render.err;
    EXPECT_EQ(std::count(render.err.begin(), render.err.end(), '\n'), 1);
    EXPECT_TRUE(files_in(folder.path()).empty());
    EXPECT_EQ(
        run_pelagic({"export", "--resolution", "16", "--out", (folder / "sea").string()}, without_driver).exit_code,
        0);
}

}  // namespace
}  // namespace pelagic
