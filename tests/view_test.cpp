// Tests `pelagic view` with a real window under Xvfb, mouse and keys by XTest, and screenshots.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

/// Returns the output of a command; its status is asserted.
std::string shell(const std::string& command) {
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    char bytes[4096];
    while (const std::size_t count = fread(bytes, 1, sizeof bytes, pipe)) text.append(bytes, count);
    EXPECT_EQ(pclose(pipe), 0) << command;
    return text;
}

bool wait_until(const std::function<bool()>& condition) {
    for (int i = 0; i < 1200; ++i) {  // two minutes: a software driver under a sanitizer is slow
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
}

/// An X server with a free display number of its choice.
class Display {
   public:
    Display() : number_file_(folder_ / "number") {
        process_ = fork();
        if (process_ == 0) {
            if (freopen(number_file_.c_str(), "w", stdout) && freopen("/dev/null", "w", stderr))
                // Without -noreset the server resets when its last client disconnects, and rejects
                // clients meanwhile.
                execlp("Xvfb", "Xvfb", "-noreset", "-displayfd", "1", "-screen", "0", "800x600x24", nullptr);
            _exit(127);
        }
        EXPECT_TRUE(wait_until([&] { return read_file(number_file_).find('\n') != std::string::npos; }))
            << "no Xvfb; Debian: xvfb";
        const std::string number = read_file(number_file_);
        name_ = ":" + number.substr(0, number.find('\n'));
    }
    ~Display() {
        kill(process_, SIGTERM);
        wait_for(process_);
    }
    const std::string& name() const { return name_; }

    /// Runs xdotool with arguments such as "key p".
    void act(const std::string& words) const { shell("DISPLAY=" + name_ + " xdotool " + words); }
    /// Returns the whole screen as RGB, three bytes a pixel.
    std::string screen() const {
        const std::string ppm = shell("DISPLAY=" + name_ + " xwd -root -silent | xwdtopnm 2>/dev/null");
        constexpr std::size_t values = 800 * 600 * 3;
        // Some versions of netpbm write two bytes a value, the high byte first.
        const std::size_t bytes_per_value = ppm.size() > 2 * values ? 2 : 1;
        std::string rgb(values, 0);
        for (std::size_t i = 0; i < values; ++i) rgb[i] = ppm.at(ppm.size() - (values - i) * bytes_per_value);
        return rgb;
    }

   private:
    TemporaryFolder folder_;
    std::filesystem::path number_file_;
    pid_t process_ = -1;
    std::string name_;
};

/// The program with its window.
class ViewTest : public testing::Test {
   protected:
    /// Without clouds by default, which take half of the time before the first image.
    void start(const Arguments& more = {"--clouds", "0"}) {
        process_ = start_pelagic(joined({"view", "--resolution", "64", "--quality", "low", "--size", "480x560",
                                         "--wind-speed", "3", "--images", folder_.path().string()},
                                        more),
                                 out_, err_, [&] { setenv("DISPLAY", display_.name().c_str(), 1); });
        ASSERT_TRUE(wait_until([&] {
            return shell("DISPLAY=" + display_.name() + " xdotool search --name Pelagic || true")
                       .find_first_of("123456789") != std::string::npos;
        })) << read_file(err_);
        display_.act("search --sync --onlyvisible --name Pelagic windowfocus --sync");
        // The window shows an image and not one colour.
        ASSERT_TRUE(wait_until([&] { return colours(display_.screen()) > 1000; }));
    }
    static std::size_t colours(const std::string& pixels) {
        std::set<std::string> all;
        for (std::size_t i = 0; i < pixels.size(); i += 3) all.insert(pixels.substr(i, 3));
        return all.size();
    }
    /// Dear ImGui polls events once a frame, and the sea moves with each frame. Waits for three,
    /// because one may have begun before.
    void wait_for_frames() const {
        for (int frame = 0; frame < 3; ++frame) {
            const std::string last = display_.screen();
            ASSERT_TRUE(wait_until([&] { return display_.screen() != last; }));
        }
    }
    std::size_t images() const { return files_in(folder_.path()).size(); }

    /// Presses the key and waits until the image's file exists under its name.
    void take_image() {
        const std::size_t before = images();
        display_.act("key p");
        ASSERT_TRUE(wait_until([&] {
            const auto files = files_in(folder_.path());
            return files.size() > before &&
                   std::ranges::none_of(files, [](const auto& file) { return file.first.ends_with(".part"); });
        }));
    }
    std::string end() {
        display_.act("key Escape");
        EXPECT_EQ(wait_for(process_), 0) << read_file(err_);
        return read_file(out_);
    }
    static double wind_in(const std::string& text) {
        std::smatch found;
        EXPECT_TRUE(std::regex_search(text, found, std::regex("--wind-speed ([0-9.]+)"))) << text;
        return found.empty() ? 0 : std::stod(found[1]);
    }

    Display display_;
    TemporaryFolder folder_, log_;
    std::filesystem::path out_ = log_ / "out", err_ = log_ / "err";
    pid_t process_ = -1;
};

// The slider "wind" is the first row of the panel: 233 pixels from x = 18 for 1 to 30 m/s.
TEST_F(ViewTest, ASliderChangesTheWindAndAKeySavesAnImage) {
    ASSERT_NO_FATAL_FAILURE(start());
    ASSERT_NO_FATAL_FAILURE(take_image());
    const std::string before = display_.screen();
    display_.act("mousemove 60 46 mousedown 1");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    display_.act("mousemove 200 46");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    display_.act("mouseup 1");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    EXPECT_NE(display_.screen(), before);
    ASSERT_NO_FATAL_FAILURE(take_image());

    const auto files = files_in(folder_.path());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files.count("pelagic_0001.png") + files.count("pelagic_0002.png"), 2u);
    for (const auto& [name, bytes] : files) EXPECT_EQ(bytes.substr(1, 3), "PNG") << name;
    EXPECT_NE(files.at("pelagic_0001.png"), files.at("pelagic_0002.png"));

    const std::string said = end();
    // x = 200 is 0.78 of the range. The width of the grab and the ends of the slider allow an error
    // of 1 to 2 m/s.
    EXPECT_NEAR(wind_in(said), 1 + 29 * (200 - 18) / 233.0, 2) << said;
}

/// Returns width and height from a PNG's header.
std::pair<int, int> size_of_png(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(i));
        return value;
    };
    return {number(16), number(20)};
}

// Runs the printed command. It must be valid and render an image with the window's size and time.
// The second has the clouds of the default.
TEST_F(ViewTest, ThePrintedCommandRendersTheSameTimeAndSize) {
    for (const Arguments& more : std::vector<Arguments>{{"--spreading", "hasselmann", "--clouds", "0"},
                                                        {"--preset", "analytic-calm"}}) {
        ASSERT_NO_FATAL_FAILURE(start(more));
        const std::string said = end();
        std::smatch command, time;
        ASSERT_TRUE(std::regex_search(said, command, std::regex("pelagic (render --out sea\\.png .*)\n"))) << said;
        const std::string words = command[1];
        ASSERT_TRUE(std::regex_search(words, time, std::regex(" --time ([0-9.]+)"))) << words;
        EXPECT_GT(std::stod(time[1]), 0) << words;
        const bool is_spectrum = more[0] == "--spreading";
        EXPECT_NE(words.find(is_spectrum ? "--spreading hasselmann" : "--waves analytic"), std::string::npos) << words;
        std::vector<std::string> arguments;
        std::istringstream stream(words);
        for (std::string word; stream >> word;)
            arguments.push_back(word == "sea.png" ? (log_ / "sea.png").string() : word);
        const Outcome run = run_pelagic(arguments);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(size_of_png(read_file(log_ / "sea.png")), (std::pair{480, 560}));
    }
}

// The panel covers the left of the window. Its title bar has a blue that the sea does not have.
TEST_F(ViewTest, KeyHHidesThePanel) {
    ASSERT_NO_FATAL_FAILURE(start());
    const auto shows_title = [&] {
        const std::string screen = display_.screen();
        const auto colour = [&](std::size_t channel) {
            return static_cast<unsigned char>(screen[(20 * 800 + 300) * 3 + channel]);
        };
        return colour(0) < 60 && colour(2) > 100;
    };
    // Not in the first frame: Dear ImGui measures a window before it shows it.
    ASSERT_TRUE(wait_until(shows_title));
    display_.act("key h");
    EXPECT_TRUE(wait_until([&] { return !shows_title(); }));
    display_.act("key h");
    EXPECT_TRUE(wait_until(shows_title));
    end();
}

// The boat's roof has a red that occurs nowhere else. After arrow keys and a click beside it, the
// roof is still visible. steered_boat_test.cpp tests the steering.
TEST_F(ViewTest, KeyBAddsAndRemovesABoat) {
    ASSERT_NO_FATAL_FAILURE(start());
    const auto roof = [&] {
        const std::string screen = display_.screen();
        int pixels = 0;
        for (std::size_t at = 0; at < screen.size(); at += 3) {
            const auto channel = [&](std::size_t i) { return int{static_cast<unsigned char>(screen[at + i])}; };
            pixels += channel(0) > 90 && channel(0) > 3 * channel(2) / 2 && channel(0) > 5 * channel(1) / 4;
        }
        return pixels;
    };
    EXPECT_EQ(roof(), 0);
    display_.act("key h key b");  // The panel would hide the boat.
    EXPECT_TRUE(wait_until([&] { return roof() > 20; }));
    display_.act("keydown Up keydown Right mousemove 300 400 click 1");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    display_.act("keyup Up keyup Right");
    EXPECT_GT(roof(), 0);
    display_.act("key b");
    EXPECT_TRUE(wait_until([&] { return roof() == 0; }));
    end();
}

// A frame of the software driver takes longer than a move and a click, so both often arrive within
// one frame. Ten clicks, from one side of the sea to the other. Such a click must not move the
// camera.
TEST_F(ViewTest, AClickAfterAMoveDoesNotMoveTheCamera) {
    const auto camera_in = [](const std::string& text) {
        std::smatch found;
        EXPECT_TRUE(std::regex_search(text, found, std::regex("--camera [^ ]+ --target [^ ]+"))) << text;
        return found.str();
    };
    ASSERT_NO_FATAL_FAILURE(start());
    const std::string resting = camera_in(end());
    EXPECT_NE(resting.find("--camera 0,8,0 "), std::string::npos) << resting;
    ASSERT_NO_FATAL_FAILURE(start());
    display_.act("key h");  // The panel handles clicks itself.
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    for (int click = 0; click < 5; ++click) {
        display_.act("mousemove 60 500 click 1 mousemove 420 80 click 1");
        ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    }
    EXPECT_EQ(camera_in(end()), resting);
}

// A drag of forty pixels turns the camera, wherever frames begin and end.
TEST_F(ViewTest, ADragTurnsTheCamera) {
    ASSERT_NO_FATAL_FAILURE(start());
    display_.act("key h");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    display_.act("mousemove 300 300 mousedown 1 mousemove 340 300");
    ASSERT_NO_FATAL_FAILURE(wait_for_frames());
    display_.act("mouseup 1");
    const std::string printed = end();
    ASSERT_NE(printed.find("--camera "), std::string::npos) << printed;
    EXPECT_EQ(printed.find("--camera 0,8,0 "), std::string::npos) << printed;
}

TEST(View, WithoutADisplayPrintsAnError) {
    const Outcome run = run_pelagic({"view", "--resolution", "32"}, [] {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
    });
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("no display"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("xvfb"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
}

}  // namespace
}  // namespace pelagic
