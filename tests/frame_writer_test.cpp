// The exporter's writer: it writes several frames concurrently, within its memory limit.
#include "pelagic/tools/record/frame_writer.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/files/digest.hpp"

namespace pelagic::tools {
namespace {

/// Measures the maximum number of frames that are written at one time.
class FramesAtOnce final : public TraceSink {
   public:
    void work(const TraceSpan& span) noexcept override {
        if (span.name != "files") return;
        const std::lock_guard lock(mutex_);
        spans_.push_back({span.start, span.end});
    }
    void in_flight(const TraceSpan&) noexcept override {}

    std::size_t max() const {
        std::size_t max = 0;
        for (const Span& one : spans_)
            max = std::max(
                max, static_cast<std::size_t>(std::count_if(spans_.begin(), spans_.end(), [&](const Span& other) {
                    return other.start <= one.start && one.start < other.end;
                })));
        return max;
    }
    std::size_t frames() const { return spans_.size(); }

   private:
    struct Span {
        TraceClock::time_point start, end;
    };
    std::mutex mutex_;
    std::vector<Span> spans_;
};

/// While an instance exists, starting a thread with the default stack size fails, because that size
/// cannot be mapped.
class NoThreads {
   public:
    NoThreads() {
        pthread_attr_t refused;
        pthread_getattr_default_np(&usual_);
        pthread_attr_init(&refused);
        pthread_attr_setstacksize(&refused, std::size_t{1} << 60);
        pthread_setattr_default_np(&refused);
        pthread_attr_destroy(&refused);
    }
    ~NoThreads() {
        pthread_setattr_default_np(&usual_);
        pthread_attr_destroy(&usual_);
    }
    NoThreads(const NoThreads&) = delete;

   private:
    pthread_attr_t usual_;
};

/// Returns the maximum number of frames written concurrently by 8 threads within `max_bytes`;
/// checks that all 24 are written.
std::size_t frames_at_once(std::size_t max_bytes) {
    const TemporaryFolder path;
    ExportOptions options;
    options.sea.sea = {.resolution = 64, .patch_size_m = 250};
    options.compute.threads = 8;
    options.folder = path.path();
    options.times.ranges = {{0, 23}};
    options.times.fps = 24;
    options.maps.mips = true;
    options.sync = false;
    const OutputFolder folder(options.folder, Sync::no);
    ExportJournal journal(options, folder);
    journal.begin();
    std::map<int, FrameRecord> records;
    FramesAtOnce seen;
    Ocean ocean(options.sea.sea, {.executor = make_serial_executor()});
    FrameWriter writer(options, folder, journal, records, &seen, max_bytes);
    for (int frame = 0; frame < 24; ++frame) writer.write(frame, ocean.frame_at(options.times.time_of(frame)));
    writer.finish();
    EXPECT_EQ(seen.frames(), 24u);
    EXPECT_EQ(records.size(), 24u);
    return seen.max();
}

constexpr std::size_t bytes_of_a_frame = 64 * 64 * bytes_per_texel_in_flight;

TEST(FrameWriter, HoldsNoMoreFramesThanFitInItsMemory) {
    EXPECT_LE(frames_at_once(2 * bytes_of_a_frame), 2u);
    EXPECT_LE(frames_at_once(3 * bytes_of_a_frame + 1), 3u);
    EXPECT_EQ(frames_at_once(1), 1u) << "one frame is written, however large it is";
}

TEST(FrameWriter, HoldsNoMoreFramesThanThreads) { EXPECT_LE(frames_at_once(std::size_t{1} << 40), 8u); }

TEST(FrameWriter, WritesEveryFrameWithoutThreads) {
    image_codec();  // loading it starts the threads of its libraries
    const NoThreads none;
    ASSERT_THROW(std::thread([] {}).join(), std::system_error);
    EXPECT_EQ(frames_at_once(std::size_t{1} << 40), 1u);
}

// Data of a frame is not read after the ocean has overwritten it. Without threads, files are
// written when the writer is waited for.
TEST(FrameWriter, RecordsFramesAsTheyWerePassed) {
    image_codec();  // loading it starts the threads of its libraries
    const NoThreads none;
    const TemporaryFolder path;
    ExportOptions options;
    options.sea.sea = {.cascades = 1, .resolution = 32, .wind_speed_mps = 20};
    options.compute.threads = 8;
    options.folder = path.path();
    options.maps.maps.push_back(MapKind::foam);
    options.times.fps = 24;
    const OutputFolder folder(options.folder, Sync::no);
    ExportJournal journal(options, folder);
    journal.begin();
    std::map<int, FrameRecord> records;
    Ocean ocean(options.sea.sea, {.executor = make_serial_executor(), .gradients = true, .foam = true});
    FrameWriter writer(options, folder, journal, records, nullptr, std::size_t{1} << 40);
    const Frame& frame = ocean.frame_at(0);
    const std::string hash = hex_text(hash_of(frame)), foam_hash = hex_text(foam_hash_of(frame));
    writer.write(0, frame);
    for (const double later : {50.0, 60.0}) ocean.frame_at(later);
    writer.finish();
    EXPECT_EQ(records.at(0).hash, hash);
    EXPECT_EQ(records.at(0).foam_hash, foam_hash);
}

// Meshes of a stack of cascades need the snapshots of their foam, too.
TEST(FrameWriter, WritesMeshesOfFramesAsTheyWerePassed) {
    image_codec();  // loading it starts the threads of its libraries
    const TemporaryFolder path;
    ExportOptions options;
    options.sea.sea = {.cascades = 2, .resolution = 32, .wind_speed_mps = 20};
    options.compute.threads = 8;
    options.folder = path.path();
    options.maps.maps.clear();
    options.meshes = {.formats = {MeshFormat::ply}, .patch = {.side_m = 64, .steps = 32, .cascades = 2}};
    options.times.fps = 24;
    const OutputFolder folder(options.folder, Sync::no);
    ExportJournal journal(options, folder);
    journal.begin();
    Ocean ocean(options.sea.sea, {.executor = make_serial_executor(), .foam = true});
    const auto hash_of_mesh = [&](std::size_t max_bytes) {
        std::map<int, FrameRecord> records;
        FrameWriter writer(options, folder, journal, records, nullptr, max_bytes);
        writer.write(0, ocean.frame_at(0));
        for (const double later : {50.0, 60.0}) ocean.frame_at(later);
        writer.finish();
        return records.at(0).files.at(0).xxh3;
    };
    const std::string written_at_once = hash_of_mesh(1);
    const NoThreads none;
    EXPECT_EQ(hash_of_mesh(std::size_t{1} << 40), written_at_once);
}

/// Calls `visit` for every view of a cascade.
template <class Visit>
void each_view(Cascade& c, Visit visit) {
    for (PlaneView* plane : {&c.dx, &c.height, &c.dz, &c.velocity_x, &c.velocity_y, &c.velocity_z}) visit(*plane);
    visit(c.folds), visit(c.contraction.blocks), visit(c.contraction.around), visit(c.gradient_rgba8);
    visit(c.compression_r8);
    for (auto& image : c.snapshots_rgba8) visit(image);
}
/// Calls `visit` for every view of a frame and of its cascades.
template <class Visit>
void each_view(Frame& frame, std::vector<Cascade>& cascades, Visit visit) {
    for (Cascade& cascade : cascades) each_view(cascade, visit);
    DynamicWavesView& waves = frame.dynamic_waves;
    visit(waves.height_m), visit(waves.vertical_velocity_mps), visit(waves.foam);
    ShoreSurface& shore = frame.shore;
    visit(shore.depth_m), visit(shore.weights_rgba8), visit(shore.height_m), visit(shore.vertical_velocity_mps);
    visit(shore.potential_m2ps), visit(shore.reach_m), visit(shore.foam);
}

/// Memory of views, with different contents for each.
struct ViewMemory {
    static constexpr int side = 4;
    std::vector<std::vector<float>> floats;
    std::vector<std::vector<std::uint32_t>> words;
    std::vector<std::vector<std::uint8_t>> bytes;
    int next = 1;

    template <class Texel>
    std::vector<Texel>& added(std::vector<std::vector<Texel>>& to) {
        std::vector<Texel>& values = to.emplace_back();
        while (values.size() < side * side) values.push_back(static_cast<Texel>(next++ % 251));
        return values;
    }
    void operator()(PlaneView& view) { view = {added(floats).data(), side, 2, 2, 2 * side}; }
    void operator()(std::span<const float>& view) { view = added(floats); }
    void operator()(std::span<const std::uint32_t>& view) { view = added(words); }
    void operator()(std::span<const std::uint8_t>& view) { view = added(bytes); }
};

std::vector<double> contents_of(Frame frame) {
    std::vector<double> all;
    const auto add = [&]<class View>(const View& view) {
        if constexpr (std::is_same_v<View, PlaneView>)
            for (int j = 0; j < view.resolution; ++j)
                for (int i = 0; i < view.resolution; ++i) all.push_back(static_cast<double>(view.at(i, j)));
        else
            for (const auto value : view) all.push_back(static_cast<double>(value));
    };
    std::vector<Cascade> cascades(frame.cascades.begin(), frame.cascades.end());
    each_view(frame, cascades, add);
    return all;
}

TEST(FrameCopy, HasItsOwnMemoryForEveryView) {
    ViewMemory memory;
    std::vector<Cascade> cascades(2);
    Frame frame;
    each_view(frame, cascades, std::ref(memory));
    const std::vector<std::uint16_t> halves(4 * 16);
    for (Cascade& cascade : cascades) {
        cascade.displacement_rgba16f = halves;
        cascade.slopes_rgba8 = cascade.moments_rgba8 = cascade.gradient_rgba8;
    }
    frame.cascades = cascades;
    const std::vector<double> passed = contents_of(frame);
    EXPECT_EQ(passed.size(), (2 * 15 + 10) * 16u);
    const FrameCopy copy(frame);
    each_view(frame, cascades, []<class View>(View& view) { view = {}; });
    memory = {};
    EXPECT_EQ(contents_of(copy.frame()), passed);
    for (const Cascade& cascade : copy.frame().cascades)
        EXPECT_TRUE(cascade.displacement_rgba16f.empty() && cascade.slopes_rgba8.empty() &&
                    cascade.moments_rgba8.empty());
}

// Frames of a large sea are not copied, and two files of N = 2048 are written at once for any
// number of threads: the documented limit is 2 GB for four such cascades. Smaller frames are
// copied, one per thread.
TEST(FrameWriter, DividesTheMemoryLeftByTheOcean) {
    constexpr std::size_t mib = std::size_t{1} << 20;
    ExportOptions options;
    options.sea.sea = {.cascades = 4, .resolution = 2048};
    options.compute.threads = 1024;
    EXPECT_EQ(bytes_for_writing(1500 * mib), 292 * mib);
    EXPECT_EQ(bytes_for_writing(5000 * mib), 256 * mib);
    EXPECT_EQ(plan_writing(options, 292 * mib), (WritingPlan{.frames = 1, .files_per_frame = 2}));
    options.compute.threads = 1;
    EXPECT_EQ(plan_writing(options, 292 * mib), (WritingPlan{.frames = 1, .files_per_frame = 1}));
    options.sea.sea.resolution = 512;
    options.compute.threads = 16;
    EXPECT_EQ(plan_writing(options, 1600 * mib), (WritingPlan{.frames = 16, .files_per_frame = 1}));
    EXPECT_EQ(plan_writing(options, 512 * mib), (WritingPlan{.frames = 8, .files_per_frame = 2}));
}

}  // namespace
}  // namespace pelagic::tools
