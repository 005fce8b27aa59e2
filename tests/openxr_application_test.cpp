// examples/openxr_application as a user starts it; the runtime in openxr_runtime/ replaces the
// headset.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

using Json = nlohmann::json;
using Environment = std::map<std::string, std::string>;

/// One run of the application, and the stand-in's record of it.
struct ApplicationRun {
    TemporaryFolder folder;
    Outcome outcome;
    Json record;  ///< null if the program created no instance

    ApplicationRun(const std::vector<std::string>& arguments, Environment environment) {
        environment.insert({"XR_RUNTIME_JSON", PELAGIC_STAND_IN_MANIFEST});
        environment.insert({"PELAGIC_STAND_IN_FOLDER", folder.path()});
        // suppresses the loader's messages on stderr
        environment.insert({"XR_LOADER_DEBUG", "none"});
        // Mesa's multithreaded software driver may sample mips before they are written; images must
        // be reproducible.
        environment.insert({"LP_NUM_THREADS", "0"});
        outcome = run_pelagic(arguments, [&] {
            for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
        });
        if (std::filesystem::exists(folder / "record.json")) record = Json::parse(read_file(folder / "record.json"));
    }
    std::vector<std::string> states() const {
        std::vector<std::string> names;
        for (const std::string name : record["states"])
            names.push_back(name.substr(std::strlen("XR_SESSION_STATE_")));
        return names;
    }
    std::vector<int> layers() const {
        std::vector<int> counts;
        for (const Json& frame : record["frames"]) counts.push_back(frame["layers"]);
        return counts;
    }
};

const std::vector<std::string> whole_session = {"IDLE",    "READY",        "SYNCHRONIZED", "VISIBLE", "FOCUSED",
                                                "VISIBLE", "SYNCHRONIZED", "STOPPING",     "IDLE",    "EXITING"};

struct RgbaImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

RgbaImage read_ppm(const std::filesystem::path& file) {
    RgbaImage image;
    std::istringstream text(read_file(file));
    std::string kind;
    int max = 0;
    text >> kind >> image.width >> image.height >> max;
    text.get();
    image.rgb.assign(std::istreambuf_iterator<char>(text), {});
    EXPECT_EQ(image.rgb.size(), 3u * static_cast<std::size_t>(image.width * image.height)) << file;
    return image;
}

/// An eye of the last frame from the stand-in's record, in world coordinates. The application's
/// origin is 3 m and a significant wave height above the rest level.
struct RecordedEye {
    glm::dvec3 place_m;
    glm::dquat turn;
    double left, right, up, down;  ///< tangents

    RecordedEye(const Json& eye, const Frame& frame)
        : place_m(glm::dvec3(eye["pose"]["x"], eye["pose"]["y"], eye["pose"]["z"]) +
                  glm::dvec3(0, 3 + frame.statistics.significant_wave_height_m, 0)),
          turn(eye["pose"]["qw"], eye["pose"]["qx"], eye["pose"]["qy"], eye["pose"]["qz"]),
          left(std::tan(eye["fov"]["left"].get<double>())),
          right(std::tan(eye["fov"]["right"].get<double>())),
          up(std::tan(eye["fov"]["up"].get<double>())),
          down(std::tan(eye["fov"]["down"].get<double>())) {}

    /// Returns the textbook's projection matrix, with a far plane beyond all drawn geometry.
    glm::dmat4 clip_from_world() const {
        constexpr double near_m = 0.1, far_m = 1e9;
        return glm::frustum(near_m * left, near_m * right, near_m * down, near_m * up, near_m, far_m) *
               glm::lookAt(place_m, place_m + turn * glm::dvec3(0, 0, -1), turn * glm::dvec3(0, 1, 0));
    }
    /// Returns the ray through a pixel's centre, counted from the upper left corner.
    glm::dvec3 ray(double column, double row, const RgbaImage& image) const {
        const double x = left + (right - left) * (column + 0.5) / image.width;
        const double y = up + (down - up) * (row + 0.5) / image.height;
        return turn * glm::dvec3(x, y, -1);
    }
    /// Returns the pixel in which a point is visible, counted from the upper left corner.
    glm::dvec2 pixel_of(const glm::dvec3& point_m, const RgbaImage& image) const {
        const glm::dvec3 seen = glm::conjugate(turn) * (point_m - place_m);
        const double x = seen.x / -seen.z, y = seen.y / -seen.z;
        return {(x - left) / (right - left) * image.width - 0.5, (up - y) / (up - down) * image.height - 0.5};
    }
};

/// Computes the application's default sea here, without foam and on this thread alone.
Ocean moderate_sea(bool queries = false) {
    SeaState sea = sea_preset_named("moderate")->sea;
    sea.resolution = 128;
    return Ocean(sea, {.executor = make_serial_executor(), .queries = queries});
}

double seconds_between(std::int64_t first_ns, std::int64_t then_ns) {
    return static_cast<double>(then_ns - first_ns) * 1e-9;
}

double mean_square_difference(const RgbaImage& a, const RgbaImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::pow(a.rgb[i] - b.rgb[i], 2);
    return sum / static_cast<double>(a.rgb.size());
}

/// Renders the image that the stand-in is expected to receive: the same sea from the same
/// positions, with other projections and another kind of framebuffer.
std::array<RgbaImage, 2> drawn_here(const std::array<RecordedEye, 2>& eyes, const Frame& frame, int side) {
    const gl::HeadlessContext context;
    const gl::Functions& gl = context.functions();
    gl::RenderTarget target(gl, side, side, 0);
    gl::SeaPass pass(gl,
                     {.resolution = frame.cascades[0].resolution(),
                      .cascades = frame.cascades.size(),
                      .shading = gl::Shading::headset},
                     quadtree_preset_named("low")->options(2048));
    gl::SkyBaker baker(make_default_executor(), 128);
    baker.schedule({.sun_azimuth_rad = -0.6f, .sun_elevation_rad = 0.8f});
    pass.renderer().set_sky(baker.complete());
    pass.upload(frame);

    const glm::dvec3 viewer = (eyes[0].place_m + eyes[1].place_m) / 2.0;
    std::array<RgbaImage, 2> images;
    for (std::size_t i = 0; i < 2; ++i) {
        const gl::Eye eye{eyes[i].clip_from_world(), eyes[i].place_m, {0, 0, side, side}};
        target.clear();
        pass.draw({.eyes = {&eye, 1}, .viewer_m = viewer});
        images[i] = {side, side, {}};
        const std::vector<std::uint8_t> rgba = target.read();
        for (std::size_t at = 0; at < rgba.size(); at += 4)
            images[i].rgb.insert(images[i].rgb.end(), &rgba[at], &rgba[at] + 3);
    }
    return images;
}

TEST(OpenXrApplication, ShowsThreeHundredFramesOfTheRightSeaUnderValidation) {
    const TemporaryFolder folder;
    const ApplicationRun run({"--quality", "low", "--frames", "300", "--hashes", folder / "seas.txt"},
                             {{"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation"},
                              {"XR_CORE_VALIDATION_EXPORT_TYPE", "text"},
                              {"XR_CORE_VALIDATION_FILE_NAME", folder / "validation.txt"},
                              {"LD_PRELOAD", PELAGIC_PAST_VALIDATION}});
    ASSERT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.outcome.out, "300 frames shown, 96 x 96 an eye, a pass for each\n");
    EXPECT_NE(run.outcome.err.find("Core Validation output type: text"), std::string::npos)
        << "the layer was not there";
    EXPECT_EQ(read_file(folder / "validation.txt"), "");
    EXPECT_EQ(run.record["refusals"], Json::array());
    EXPECT_EQ(run.states(), whole_session);

    // The first frame makes the headset show the program, so it is not visible itself.
    const Json& frames = run.record["frames"];
    ASSERT_EQ(frames.size(), 301u);
    EXPECT_EQ(frames[0]["layers"], 0);
    std::istringstream lines(read_file(folder / "seas.txt"));
    Ocean ocean = moderate_sea();
    for (std::size_t n = 1; n < frames.size(); ++n) {
        SCOPED_TRACE(n);
        const std::int64_t shown_ns = frames[n]["display_time_ns"];
        EXPECT_EQ(shown_ns, 5'000'000'000'000 + static_cast<std::int64_t>(n) * 1'000'000'000 / 72);
        EXPECT_EQ(frames[n]["layers"], 1);
        const double time_s = seconds_between(frames[0]["display_time_ns"], shown_ns);
        char expected[64];
        std::snprintf(expected, sizeof expected, "%.9f %016" PRIx64, time_s, hash_of(ocean.frame_at(time_s)));
        std::string line;
        std::getline(lines, line);
        ASSERT_EQ(line, expected);
    }
}

TEST(OpenXrApplication, ValidationReportsAWrongCall) {
    // Without the preloaded library that hides OpenGL ES from the layer (past_validation.hpp), the
    // same program makes a call that the layer rejects.
    const TemporaryFolder folder;
    const ApplicationRun run({"--quality", "low", "--frames", "1"},
                             {{"XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation"},
                              {"XR_CORE_VALIDATION_EXPORT_TYPE", "text"},
                              {"XR_CORE_VALIDATION_FILE_NAME", folder / "validation.txt"}});
    EXPECT_EQ(run.outcome.exit_code, 1);
    EXPECT_NE(read_file(folder / "validation.txt").find("VUID-XrSessionCreateInfo-next-next"), std::string::npos);
}

class OpenXrImages : public testing::Test {
   protected:
    static constexpr int side = 900;
    /// The first frames are hidden, so that the head has turned before the first visible frame. The
    /// images are large enough to measure the eyes' distance in pixels.
    static void SetUpTestSuite() {
        saved_ = new TemporaryFolder;
        run_ = new ApplicationRun(
            {"--quality", "low", "--frames", "2", "--images", saved_->path()},
            {{"PELAGIC_STAND_IN_EYE", std::to_string(side)}, {"PELAGIC_STAND_IN_EVENTS", "1:hide 90:show"}});
        ASSERT_EQ(run_->outcome.exit_code, 0) << run_->outcome.err;
        ocean_ = new Ocean(sea(), {.queries = true, .foam = true});
        frame_ = &ocean_->frame_at(
            seconds_between(run_->record["frames"][0]["display_time_ns"], run_->record["last_display_time_ns"]));
    }
    static void TearDownTestSuite() {
        delete ocean_;
        delete run_;
        delete saved_;
    }
    static SeaState sea() {
        SeaState sea = sea_preset_named("moderate")->sea;
        sea.resolution = 128;
        return sea;
    }
    static RecordedEye eye(std::size_t which) { return {run_->record["eyes"][which], *frame_}; }
    static RgbaImage shown(const char* name) { return read_ppm(run_->folder / name); }

    static inline TemporaryFolder* saved_ = nullptr;
    static inline ApplicationRun* run_ = nullptr;
    static inline Ocean* ocean_ = nullptr;
    static inline const Frame* frame_ = nullptr;
};

TEST_F(OpenXrImages, EqualTheOnesThatTheApplicationSaved) {
    for (const char* name : {"left.ppm", "right.ppm"})
        EXPECT_TRUE(read_file(*saved_ / name) == read_file(run_->folder / name)) << name;
    EXPECT_EQ(files_in(saved_->path()).size(), 2u);
}

TEST_F(OpenXrImages, AreSubmittedWithoutAnInvalidCall) { EXPECT_EQ(run_->record["refusals"], Json::array()); }

TEST_F(OpenXrImages, AreRenderedFromThePredictedEyePoses) {
    for (const Json& recorded : run_->record["eyes"]) {
        for (const auto& [name, value] : recorded["pose"].items())
            EXPECT_EQ(value, recorded["submitted_pose"][name]) << name;
        EXPECT_EQ(recorded["fov"], recorded["submitted_fov"]);
    }
}

TEST_F(OpenXrImages, ShowTheSeaThroughTheEyesProjections) {
    const std::array<RgbaImage, 2> both = {shown("left.ppm"), shown("right.ppm")};
    const std::array<RgbaImage, 2> expected = drawn_here({eye(0), eye(1)}, *frame_, side);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_EQ(both[i].rgb.size(), expected[i].rgb.size());
        // 54 dB: bytes are rounded by the framebuffer there and in the shader here, and float
        // rounding of the two projections moves single pixels at wave edges. An image shifted by a
        // pixel has 40 dB.
        const double psnr = 10 * std::log10(255 * 255 / mean_square_difference(both[i], expected[i]));
        EXPECT_GT(psnr, 48);
    }
}

TEST_F(OpenXrImages, AreIdenticalInOnePassForBothEyes) {
    // The driver's calls are doubled (multiview_stand_in.cpp), and the program detects
    // OVR_multiview2.
    const ApplicationRun one_pass({"--quality", "low", "--frames", "2"},
                                  {{"PELAGIC_STAND_IN_EYE", std::to_string(side)},
                                   {"PELAGIC_STAND_IN_EVENTS", "1:hide 90:show"},
                                   {"LD_PRELOAD", PELAGIC_MULTIVIEW_STAND_IN}});
    EXPECT_EQ(one_pass.record["refusals"], Json::array());
    EXPECT_EQ(one_pass.outcome.out, "2 frames shown, 900 x 900 an eye, both in one pass\n") << one_pass.outcome.err;
    for (const char* name : {"left.ppm", "right.ppm"})
        EXPECT_TRUE(shown(name).rgb == read_ppm(one_pass.folder / name).rgb) << name;
}

/// Returns the green channel, the strongest one.
double green(const RgbaImage& image, int column, int row) {
    return image.rgb[3 * static_cast<std::size_t>(row * image.width + column) + 1];
}

/// Returns the correlation of two squares of pixels, 1 at most; it does not depend on brightness.
double likeness(const RgbaImage& a, glm::ivec2 at, const RgbaImage& b, glm::ivec2 there) {
    constexpr int reach = 9;
    double n = 0, sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double va = green(a, at.x + dx, at.y + dy), vb = green(b, there.x + dx, there.y + dy);
            n += 1, sum_a += va, sum_b += vb, aa += va * va, bb += vb * vb, ab += va * vb;
        }
    return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n) + 1e-9);
}

TEST_F(OpenXrImages, DifferByTheDistanceBetweenTheEyes) {
    // Rays of the left eye meet the water where a query gives it. In the right eye's image that
    // water is further left, the more the nearer it is. The measured shift is that of the best
    // match along the row.
    const RgbaImage left = shown("left.ppm"), right = shown("right.ppm");
    const RecordedEye left_eye = eye(0), right_eye = eye(1);
    const SurfaceQuery query(*frame_);
    std::vector<double> errors;
    for (int row = 580; row <= 840; row += 30)
        for (int column = 300; column <= 840; column += 30) {
            const glm::dvec3 ray = left_eye.ray(column, row, left);
            const auto hit = first_hit(
                query, {{left_eye.place_m.x, left_eye.place_m.y, left_eye.place_m.z}, {ray.x, ray.y, ray.z}, 100});
            ASSERT_TRUE(hit);
            const glm::dvec3 water(hit->position_m[0], hit->position_m[1], hit->position_m[2]);
            const glm::dvec2 expected = right_eye.pixel_of(water, right);
            // With eyes at one position, the water would be here.
            const glm::dvec2 if_far = right_eye.pixel_of(right_eye.place_m + 1e6 * ray, right);
            ASSERT_GT(if_far.x - expected.x, 3) << "near water should be seen apart";
            const glm::ivec2 about(glm::round(expected));
            if (about.x < 24 || about.x > right.width - 24) continue;
            double best = -1;
            int best_shift = 0;
            for (int shift = -12; shift <= 12; ++shift)
                if (const double like = likeness(left, {column, row}, right, about + glm::ivec2(shift, 0));
                    like > best)
                    best = like, best_shift = shift;
            // smooth water, or the sun's glitter, whose position differs between the eyes
            if (best < 0.9) continue;
            errors.push_back(about.x + best_shift - expected.x);
        }
    ASSERT_GT(errors.size(), 30u);
    std::ranges::sort(errors);
    // Pixels are discrete, and the mesh differs slightly from the query.
    EXPECT_NEAR(errors[errors.size() / 2], 0, 1);
    EXPECT_NEAR(errors[errors.size() / 8], 0, 1.5);
    EXPECT_NEAR(errors[errors.size() * 7 / 8], 0, 1.5);
}

TEST(OpenXrSession, PausesWhileTheHeadsetIsOffAndEndsWithIt) {
    const ApplicationRun run({"--quality", "low"}, {{"PELAGIC_STAND_IN_EVENTS", "4:hide 6:show 8:stop 12:exit"},
                                                    {"PELAGIC_STAND_IN_EYE", "32"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.record["refusals"], Json::array());
    // Shown; hidden, and shown again; taken off; shown until the exit.
    const std::vector<std::string> states = {"IDLE",    "READY",        "SYNCHRONIZED", "VISIBLE",      "FOCUSED",
                                             "VISIBLE", "SYNCHRONIZED", "VISIBLE",      "SYNCHRONIZED", "STOPPING",
                                             "IDLE",    "READY",        "SYNCHRONIZED", "VISIBLE",      "FOCUSED",
                                             "VISIBLE", "SYNCHRONIZED", "STOPPING",     "IDLE",         "EXITING"};
    EXPECT_EQ(run.states(), states);
    EXPECT_EQ(run.layers(), (std::vector<int>{0, 1, 1, 1, 0, 0, 1, 1, 0, 1, 1, 1}));
}

TEST(OpenXrSession, ShowsNothingWithoutHeadTracking) {
    const ApplicationRun run({"--quality", "low", "--frames", "3"},
                             {{"PELAGIC_STAND_IN_EVENTS", "2:blind 4:see"}, {"PELAGIC_STAND_IN_EYE", "32"}});
    EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
    EXPECT_EQ(run.record["refusals"], Json::array());
    EXPECT_EQ(run.layers(), (std::vector<int>{0, 1, 0, 0, 1, 1}));
}

TEST(OpenXrSession, EndsWhenTheHeadsetIsLost) {
    for (const char* event : {"3:lose", "3:lose-instance"}) {
        const ApplicationRun run({"--quality", "low"},
                                 {{"PELAGIC_STAND_IN_EVENTS", event}, {"PELAGIC_STAND_IN_EYE", "32"}});
        EXPECT_EQ(run.outcome.exit_code, 0) << run.outcome.err;
        EXPECT_EQ(run.record["refusals"], Json::array());
        EXPECT_EQ(run.layers(), (std::vector<int>{0, 1, 1})) << event;
    }
}

/// Returns the one line with which the program ends.
std::string failure(const std::vector<std::string>& arguments, const Environment& environment) {
    const ApplicationRun run(arguments, environment);
    EXPECT_EQ(run.outcome.exit_code, 1);
    EXPECT_EQ(run.outcome.out, "");
    EXPECT_EQ(std::ranges::count(run.outcome.err, '\n'), 1) << run.outcome.err;
    return run.outcome.err;
}

TEST(OpenXrErrors, AreOneLineWithARemedy) {
    EXPECT_EQ(failure({}, {{"XR_RUNTIME_JSON", "/nowhere.json"}}),
              "openxr_application: xrCreateInstance: XR_ERROR_RUNTIME_UNAVAILABLE (is an OpenXR runtime installed "
              "and running? "
              "XR_RUNTIME_JSON names one)\n");
    EXPECT_EQ(failure({}, {{"PELAGIC_STAND_IN_REFUSES", "xrGetSystem:-35"}}),
              "openxr_application: xrGetSystem: XR_ERROR_FORM_FACTOR_UNAVAILABLE (is the headset connected?)\n");
    EXPECT_EQ(failure({}, {{"PELAGIC_STAND_IN_REFUSES", "xrCreateSession:-38"}}),
              "openxr_application: xrCreateSession: XR_ERROR_GRAPHICS_DEVICE_INVALID\n");
    EXPECT_EQ(failure({}, {{"PELAGIC_STAND_IN_REFUSES", "xrCreateSwapchain:-2"}}),
              "openxr_application: xrCreateSwapchain: XR_ERROR_RUNTIME_FAILURE (is an OpenXR runtime installed and "
              "running? "
              "XR_RUNTIME_JSON names one)\n");
    EXPECT_EQ(failure({}, {{"PELAGIC_STAND_IN_REFUSES", "xrWaitFrame:-17"}}),
              "openxr_application: xrWaitFrame: XR_ERROR_SESSION_LOST\n");
}

TEST(OpenXrErrors, NameAnInvalidOption) {
    const TemporaryFolder folder;
    const auto said = [](const std::vector<std::string>& arguments) { return failure(arguments, {}); };
    EXPECT_EQ(said({"--frames", "soon"}), "openxr_application: --frames is soon, expected a whole number from 1\n");
    EXPECT_EQ(said({"--frames"}),
              "openxr_application: --frames has no value; needs [--preset NAME] [--resolution N] [--quality NAME] "
              "[--frames N] "
              "[--images FOLDER] [--hashes FILE]\n");
    EXPECT_EQ(said({"--eyes", "3"}),
              "openxr_application: --eyes is no option; needs [--preset NAME] [--resolution N] [--quality NAME] "
              "[--frames N] "
              "[--images FOLDER] [--hashes FILE]\n");
    EXPECT_EQ(said({"--quality", "best"}),
              "openxr_application: --quality is best, expected one of low, medium, high, ultra, paper_low, "
              "paper_medium, paper_high, "
              "paper_ultra\n");
    EXPECT_EQ(said({"--resolution", "100"}),
              "openxr_application: --resolution is 100, expected a power of two from 16 to 2048, or 0: chosen\n");
    EXPECT_EQ(said({"--images", folder / "none"}), "openxr_application: --images is " + (folder / "none").string() +
                                                       ", expected a folder that is there\n");
    EXPECT_EQ(said({"--hashes", folder / "none/seas.txt"}),
              "openxr_application: --hashes is " + (folder / "none/seas.txt").string() +
                  ", expected the name of a file in a folder that is there\n");
    EXPECT_EQ(said({"--eyes\n", "3"}).substr(0, 45), "openxr_application: --eyes? is no option; nee");
    EXPECT_TRUE(files_in(folder.path()).empty());
}

}  // namespace
}  // namespace pelagic
