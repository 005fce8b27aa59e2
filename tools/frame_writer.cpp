#include "pelagic/tools/frame_writer.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/image_files.hpp"
#include "pelagic/tools/mesh_files.hpp"

namespace pelagic::tools {
namespace {

/// The views of a tile that the files show.
struct NeededViews {
    explicit NeededViews(const ExportOptions& options)
        : halves(options.maps.has(MapKind::displacement) &&
                 options.maps.sample_of(MapKind::displacement) == Sample::half),
          planes((options.maps.has(MapKind::displacement) &&
                  (!halves || (is_texture(options.maps.format) && options.maps.mips))) ||
                 options.meshes.any()),
          gradient(options.maps.has(MapKind::gradient)),
          foam(options.has_foam()) {}

    bool halves, planes, gradient, foam;
};

/// What a frame's files need of it, copied, so that its images can be encoded while the ocean goes on.
class FrameCopy {
   public:
    FrameCopy(const Frame& frame, const NeededViews& needed)
        : frame_(frame), tiles_(frame.tiles.begin(), frame.tiles.end()) {
        for (Tile& tile : tiles_) copies_.push_back(copied(tile, needed));
        frame_.tiles = tiles_;
    }
    FrameCopy(const FrameCopy&) = delete;

    /// With no views but the needed ones.
    const Frame& frame() const { return frame_; }

   private:
    struct Copies {
        std::vector<float> planes;
        std::vector<std::uint16_t> halves;
        std::vector<std::uint32_t> gradient;
        std::vector<std::uint8_t> foam;
    };

    static Copies copied(Tile& tile, const NeededViews& needed) {
        Copies copies;
        if (needed.planes) copy_planes(copies.planes, {&tile.dx, &tile.height, &tile.dz});
        copy_if(needed.halves, copies.halves, tile.displacement_rgba16f);
        copy_if(needed.gradient, copies.gradient, tile.gradient_rgba8);
        copy_if(needed.foam, copies.foam, tile.foam_r8);
        tile.slopes_rgba8 = tile.moments_rgba8 = {};
        return copies;
    }

    /// One behind the other, without gaps; the views show the copies from now on.
    static void copy_planes(std::vector<float>& copies, std::initializer_list<PlaneView*> planes) {
        const int side = (*planes.begin())->resolution;
        const std::size_t texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        copies.resize(planes.size() * texels);
        float* to = copies.data();
        for (PlaneView* plane : planes) {
            copy_plane(*plane, {to, texels});
            *plane = {to, side, side, side, 0};
            to += texels;
        }
    }

    template <class Texel>
    static void copy_if(bool is_needed, std::vector<Texel>& copies, std::span<const Texel>& view) {
        if (is_needed) copies.assign(view.begin(), view.end());
        view = copies;
    }

    Frame frame_;
    std::vector<Tile> tiles_;
    std::vector<Copies> copies_;
};

constexpr const char* file_category = "file";

/// What a trace calls the work on a map.
std::string_view trace_name(MapKind map) {
    switch (map) {
        case MapKind::displacement: return "encode displacement";
        case MapKind::gradient: return "encode gradient";
        case MapKind::foam: return "encode foam";
    }
    return "";
}

/// All but the files, of a frame as the ocean hands it out.
FrameRecord figures_of(int number, const Frame& frame, bool has_foam) {
    return {.frame = number,
            .time_s = frame.time_s,
            .hash = hex_text(hash_of(frame)),
            .foam_hash = has_foam ? hex_text(foam_hash_of(frame)) : "",
            .significant_wave_height_m = measured_significant_wave_height_m(frame),
            .height_min_m = frame.bounds.height_min_m,
            .height_max_m = frame.bounds.height_max_m,
            .files = {}};
}

/// The images and meshes of a frame, one after the other.
std::vector<FileRecord> write_files(const ExportOptions& options, const OutputFolder& folder, int number,
                                    const Frame& frame, TraceSink* trace) {
    const TraceScope scope(trace, "files", file_category,
                           {{{"frame", static_cast<double>(number)}, {"time_s", frame.time_s}}});
    std::vector<FileRecord> records;
    const auto write = [&](const std::string& name, std::span<const unsigned char> content) {
        const TraceScope writing(trace, "write", file_category, {{{"bytes", static_cast<double>(content.size())}}});
        const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
        folder.write(name, bytes);
        records.push_back({name, digest_of(bytes)});
    };
    for (const ImageFile& file : image_files(options, number)) {
        write(file.name, [&] {
            const ImagePart& part = file.parts.front();
            const TraceScope encoding(trace, trace_name(part.map), file_category,
                                      {{{"level", static_cast<double>(part.first_level)}}});
            return encode_image_file(file, frame, options.maps);
        }());
    }
    const std::vector<MeshFile> meshes = mesh_files(options.meshes, number);
    if (meshes.empty()) return records;
    const Mesh mesh = mesh_of(frame, options.meshes.patch);
    for (const MeshFile& file : meshes) {
        write(file.name, [&] {
            const TraceScope encoding(trace, "encode mesh", file_category);
            return encode_mesh_file(file.format, mesh);
        }());
    }
    return records;
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
    const auto copy = std::make_shared<const FrameCopy>(frame, NeededViews(options_));
    in_flight_.push_back(start([this, copy, record = figures_of(number, frame, options_.has_foam())]() mutable {
        record.files = write_files(options_, folder_, record.frame, copy->frame(), trace_);
        return std::move(record);
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
