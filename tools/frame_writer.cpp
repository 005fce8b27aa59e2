#include "pelagic/tools/frame_writer.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/export_names.hpp"

namespace pelagic::tools {
namespace {

/// What a frame's files need of it, copied, so that its images can be encoded while the ocean goes on.
class FrameCopy {
   public:
    explicit FrameCopy(const Frame& frame)
        : frame_(frame), tiles_(frame.tiles.begin(), frame.tiles.end()), hash_(hash_of(frame)) {
        for (Tile& tile : tiles_) copies_.push_back(copied(tile));
        frame_.tiles = tiles_;
    }
    FrameCopy(const FrameCopy&) = delete;

    const Frame& frame() const { return frame_; }
    std::uint64_t hash() const { return hash_; }  ///< of the whole frame

   private:
    struct Copies {
        std::vector<float> planes;
        std::vector<std::uint16_t> halves;
        std::vector<std::uint32_t> gradient;
        std::vector<std::uint8_t> foam;
    };

    /// Of what the tile's views show, which show the copies from now on.
    static Copies copied(Tile& tile) {
        Copies copies;
        const int side = tile.resolution();
        const std::size_t texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        copies.planes.resize(3 * texels);
        float* to = copies.planes.data();
        for (PlaneView* plane : {&tile.dx, &tile.height, &tile.dz}) {
            copy_plane(*plane, {to, texels});
            *plane = {to, side, side, side, 0};
            to += texels;
        }
        copies.halves.assign(tile.displacement_rgba16f.begin(), tile.displacement_rgba16f.end());
        copies.gradient.assign(tile.gradient_rgba8.begin(), tile.gradient_rgba8.end());
        copies.foam.assign(tile.foam_r8.begin(), tile.foam_r8.end());
        tile.displacement_rgba16f = copies.halves;
        tile.gradient_rgba8 = copies.gradient;
        tile.slopes_rgba8 = tile.moments_rgba8 = {};  // no file of them
        tile.foam_r8 = copies.foam;
        return copies;
    }

    Frame frame_;
    std::vector<Tile> tiles_;
    std::vector<Copies> copies_;
    std::uint64_t hash_;
};

constexpr const char* file_category = "file";

/// The images of one frame, one after the other.
class FrameFiles {
   public:
    FrameFiles(const ExportOptions& options, const OutputFolder& folder, int number, const Frame& frame,
               TraceSink* trace)
        : options_(options), folder_(folder), number_(number), frame_(frame), trace_(trace) {}

    std::vector<FileRecord> write() {
        int number = 0;
        for (const Tile& tile : frame_.tiles) write_tile(number++, tile);
        return std::move(files_);
    }

   private:
    void write_tile(int number, const Tile& tile) {
        if (options_.displacement) write_image(displacement_name(options_, number, number_), displacement(tile));
        for (int level = 0; level < gradient_levels(options_); ++level)
            write_image(gradient_name(options_, number, number_, level), gradient(tile, level));
        for (int level = 0; level < foam_levels(options_); ++level)
            write_image(foam_name(options_, number, number_, level), foam(tile, level));
    }

    std::vector<unsigned char> displacement(const Tile& tile) const {
        const TraceScope scope(trace_, "encode displacement", file_category);
        return encode_displacement(tile, options_.format, options_.half);
    }

    std::vector<unsigned char> gradient(const Tile& tile, int level) const {
        const TraceScope scope(trace_, "encode gradient", file_category, {{{"level", static_cast<double>(level)}}});
        return encode_gradient(tile, level, options_.format);
    }

    std::vector<unsigned char> foam(const Tile& tile, int level) const {
        const TraceScope scope(trace_, "encode foam", file_category, {{{"level", static_cast<double>(level)}}});
        return encode_foam(tile, level, options_.format);
    }

    void write_image(const std::string& name, const std::vector<unsigned char>& image) {
        const TraceScope scope(trace_, "write", file_category, {{{"bytes", static_cast<double>(image.size())}}});
        const std::string_view bytes(reinterpret_cast<const char*>(image.data()), image.size());
        folder_.write(name, bytes);
        files_.push_back({name, digest_of(bytes)});
    }

    const ExportOptions& options_;
    const OutputFolder& folder_;
    int number_;
    const Frame& frame_;
    TraceSink* trace_;
    std::vector<FileRecord> files_;
};

FrameRecord write_frame(const ExportOptions& options, const OutputFolder& folder, int number, const FrameCopy& copy,
                        TraceSink* trace) {
    const Frame& frame = copy.frame();
    const TraceScope scope(trace, "files", file_category,
                           {{{"frame", static_cast<double>(number)}, {"time_s", frame.time_s}}});
    return {.frame = number,
            .time_s = frame.time_s,
            .hash = hex_text(copy.hash()),
            .foam_hash = options.foam ? hex_text(foam_hash_of(frame)) : "",
            .significant_wave_height_m = measured_significant_wave_height_m(frame),
            .height_min_m = frame.bounds.height_min_m,
            .height_max_m = frame.bounds.height_max_m,
            .files = FrameFiles(options, folder, number, frame, trace).write()};
}

}  // namespace

std::size_t frames_in_flight(const ExportOptions& options, std::size_t most_bytes) {
    const std::size_t threads = options.compute.threads == 0 ? std::max(1u, std::thread::hardware_concurrency())
                                                             : static_cast<std::size_t>(options.compute.threads);
    const auto side = static_cast<std::size_t>(resolution_of(options.sea.sea));
    const std::size_t texels = side * side * static_cast<std::size_t>(cascades_of(options.sea.sea));
    return std::min(threads, std::max<std::size_t>(1, most_bytes / (texels * bytes_per_texel_in_flight)));
}

FrameWriter::FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                         std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t most_bytes)
    : options_(options),
      folder_(folder),
      journal_(journal),
      records_(records),
      trace_(trace),
      most_(frames_in_flight(options, most_bytes)) {}

void FrameWriter::write(int number, const Frame& frame) {
    while (in_flight_.size() >= most_) take_oldest();
    in_flight_.push_back(start([this, number, copy = std::make_shared<const FrameCopy>(frame)] {
        return write_frame(options_, folder_, number, *copy, trace_);
    }));
}

std::future<FrameRecord> FrameWriter::start(const std::function<FrameRecord()>& work) {
    try {
        if (most_ > 1) return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        // The system has no thread to give.
    }
    return std::async(std::launch::deferred, work);
}

void FrameWriter::finish() {
    while (!in_flight_.empty()) take_oldest();
}

void FrameWriter::take_oldest() {
    std::future<FrameRecord> oldest = std::move(in_flight_.front());
    in_flight_.pop_front();
    FrameRecord record = wait_for(oldest);
    journal_.add(record);
    const int number = record.frame;
    records_.emplace(number, std::move(record));
}

FrameRecord FrameWriter::wait_for(std::future<FrameRecord>& files) {
    const TraceScope scope(trace_, "wait for files", file_category);
    return files.get();
}

}  // namespace pelagic::tools
