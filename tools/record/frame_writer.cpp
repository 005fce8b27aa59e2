#include "pelagic/tools/record/frame_writer.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame_buffers.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/files/digest.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* file_category = "file";

/// Returns the name of the work on a map in traces.
std::string_view trace_name(MapKind map) {
    switch (map) {
        case MapKind::displacement: return "encode displacement";
        case MapKind::gradient: return "encode gradient";
        case MapKind::normal: return "encode normal";
        case MapKind::foam: return "encode foam";
        case MapKind::velocity: return "encode velocity";
        case MapKind::jacobian: return "encode jacobian";
        case MapKind::slope: return "encode slope";
        case MapKind::compression: return "encode compression";
        case MapKind::dynamic_waves: return "encode dynamic-waves";
    }
    return "";
}

FileRecord write_file(const OutputFolder& folder, const std::string& name, std::span<const unsigned char> content,
                      TraceSink* trace) {
    const TraceScope writing(trace, "write", file_category, {{{"bytes", static_cast<double>(content.size())}}});
    const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
    folder.write(name, bytes);
    return {name, digest_of(bytes)};
}

/// Encodes and writes an image.
FileRecord write_image(const ImageFile& file, const ExportOptions& options, const OutputFolder& folder, int number,
                       const Frame& frame, TraceSink* trace) {
    const std::vector<unsigned char> image = [&] {
        const ImagePart& part = file.parts.front();
        const TraceScope encoding(trace, file.parts.size() > 1 ? "encode sea" : trace_name(part.map), file_category,
                                  {{{"level", static_cast<double>(part.first_level)}}});
        return encode_image_file(file, frame, number, options);
    }();
    return write_file(folder, file.name, image, trace);
}

/// Writes the images of a frame, several at once. After a failure no further images are started.
std::vector<FileRecord> write_images(const ExportOptions& options, const OutputFolder& folder, int number,
                                     const Frame& frame, std::size_t at_once, TraceSink* trace) {
    const std::vector<ImageFile> files = image_files(options, number);
    std::vector<FileRecord> records(files.size());
    std::atomic<std::size_t> next = 0;
    const auto write_some = [&] {
        try {
            for (std::size_t i = next++; i < files.size(); i = next++)
                records[i] = write_image(files[i], options, folder, number, frame, trace);
        } catch (...) {
            next = files.size();
            throw;
        }
    };
    std::vector<std::future<void>> others;
    try {
        while (others.size() + 1 < std::min(at_once, files.size()))
            others.push_back(std::async(std::launch::async, write_some));
    } catch (const std::system_error&) {
        // The system cannot start more threads.
    }
    write_some();
    for (std::future<void>& other : others) other.get();
    return records;
}

/// Writes the images and meshes of a frame.
std::vector<FileRecord> write_files(const ExportOptions& options, const OutputFolder& folder, int number,
                                    const Frame& frame, std::size_t images_at_once, TraceSink* trace) {
    const TraceScope scope(trace, "files", file_category,
                           {{{"frame", static_cast<double>(number)}, {"time_s", frame.time_s}}});
    std::vector<FileRecord> records = write_images(options, folder, number, frame, images_at_once, trace);
    const std::vector<MeshFile> meshes = mesh_files(options, number);
    if (meshes.empty()) return records;
    const Mesh mesh = exported_mesh(frame, options);
    for (const MeshFile& file : meshes) {
        const auto content = [&] {
            const TraceScope encoding(trace, "encode mesh", file_category);
            return encode_mesh_file(file.format, mesh);
        }();
        records.push_back(write_file(folder, file.name, content, trace));
    }
    return records;
}

/// Replaces views of an ocean by views of copies. The bindings name every member of a type: a new
/// member does not compile before it is treated here.
class ViewCopier {
   public:
    explicit ViewCopier(std::vector<std::shared_ptr<const void>>& memory) : memory_(memory) {}

    void copy_views(Cascade& cascade) {
        auto& [grid, level_m, dx, height, dz, velocity_x, velocity_y, velocity_z, water, folds, contraction,
               displacement, gradient, slopes, moments, slope_ranges, compression, snapshots, snapshots_version,
                   drift_columns,
               drift_rows, compression_scale, front_x, front_z, slope_variance, bounds] = cascade;
        auto& [blocks, around, max_sum, largest_m, stretch, steepness] = contraction;
        copy_planes(dx, height, dz, velocity_x, velocity_y, velocity_z);
        copy(folds, blocks, around, gradient, compression);
        for (auto& image : snapshots) copy(image);
        displacement = {};
        steepness = nullptr;
        slopes = moments = {};
        water = {};
    }
    /// Copies all views but those of cascades.
    void copy_views(Frame& frame) {
        auto& [time_s, sea, sea_changes, statistics, isa, cascades, bounds, dynamic_waves, shore, has_foam, foam,
               droplets, water_frame] = frame;
        auto& [resolution, grid_texel_m, first_x, first_z, grid_height, vertical_velocity, grid_foam, grid_bounds] =
            dynamic_waves;
        copy(grid_height, vertical_velocity, grid_foam);
        auto& [columns, rows, texel_m, x_m, z_m, depth, weights, height, velocity, potential, reach, shore_foam,
               shore_bounds, weights_change] = shore;
        copy(depth, weights, height, velocity, potential, reach, shore_foam, droplets);
    }

   private:
    template <class... Texels>
    void copy(std::span<const Texels>&... views) {
        (copy_view(views), ...);
    }
    template <class Texel>
    void copy_view(std::span<const Texel>& view) {
        if (view.empty()) return;
        const auto copied = std::make_shared<const std::vector<Texel>>(view.begin(), view.end());
        memory_.push_back(copied);
        view = *copied;
    }
    template <class... Planes>
    void copy_planes(Planes&... planes) {
        (copy_plane_view(planes), ...);
    }
    void copy_plane_view(PlaneView& plane) {
        if (!plane.data) return;
        const int side = plane.resolution;
        const auto copied =
            std::make_shared<std::vector<float>>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        copy_plane(plane, *copied);
        memory_.push_back(copied);
        plane = {copied->data(), side, side, side, 0};
    }

    std::vector<std::shared_ptr<const void>>& memory_;
};

}  // namespace

FrameRecord statistics_of(int number, const Frame& frame, bool has_foam) {
    return {.frame = number,
            .time_s = frame.time_s,
            .hash = hex_text(hash_of(frame)),
            .foam_hash = has_foam ? hex_text(foam_hash_of(frame)) : "",
            .dynamic_waves_hash = frame.dynamic_waves ? hex_text(hash_of(frame.dynamic_waves)) : "",
            .significant_wave_height_m = measured_significant_wave_height_m(frame),
            .height_min_m = frame.bounds.height_min_m,
            .height_max_m = frame.bounds.height_max_m,
            .files = {}};
}

WritingPlan plan_writing(const ExportOptions& options, std::size_t max_bytes) {
    const auto threads = static_cast<std::size_t>(options.compute.threads == 0 ? default_thread_count()
                                                                               : options.compute.threads);
    const auto side = static_cast<std::size_t>(resolution_of(options.sea.sea));
    const auto cascades = static_cast<std::size_t>(cascades_of(options.sea.sea));
    const std::size_t bytes_per_texel =
        bytes_per_texel_in_flight + (options.maps.has(MapKind::velocity) ? bytes_per_texel_of_velocities : 0) +
        (options.has_foam() ? bytes_per_texel_of_snapshots : 0);
    const std::size_t row = options.meshes.any() ? static_cast<std::size_t>(options.meshes.patch.steps) + 1 : 0;
    const auto grid = static_cast<std::size_t>(options.events ? options.events->water.resolution : 0);
    const auto foam = static_cast<std::size_t>(options.maps.foam_patch ? options.maps.foam_patch->pixels : 0);
    const std::size_t bytes = side * side * cascades * bytes_per_texel + grid * grid * bytes_per_texel_in_flight +
                              row * row * bytes_per_vertex_in_flight + foam * foam * bytes_per_texel_of_a_file;
    const std::size_t frames = std::min(threads, max_bytes / bytes);
    if (frames >= 2) return {frames, std::min((threads + frames - 1) / frames, cascades)};
    const std::size_t files = max_bytes / (side * side * bytes_per_texel_of_a_file);
    return {1, std::clamp<std::size_t>(files, 1, threads)};
}

FrameWriter::FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                         std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t max_bytes)
    : options_(options),
      folder_(folder),
      journal_(journal),
      records_(records),
      trace_(trace),
      plan_(plan_writing(options, max_bytes)) {}

void FrameWriter::write(int number, const Frame& frame) {
    FrameRecord record = statistics_of(number, frame, options_.has_foam());
    if (plan_.frames == 1) {
        record.files = write_files(options_, folder_, number, frame, plan_.files_per_frame, trace_);
        return add(std::move(record));
    }
    while (in_flight_.size() >= plan_.frames) take_oldest();
    const auto copy = std::make_shared<const FrameCopy>(frame);
    in_flight_.push_back(start([this, copy, record = std::move(record)]() mutable {
        record.files = write_files(options_, folder_, record.frame, copy->frame(), plan_.files_per_frame, trace_);
        return std::move(record);
    }));
}

std::future<FrameRecord> FrameWriter::start(const std::function<FrameRecord()>& work) {
    try {
        return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        // The system cannot start a thread.
    }
    return std::async(std::launch::deferred, work);
}

void FrameWriter::finish() {
    while (!in_flight_.empty()) take_oldest();
}

void FrameWriter::take_oldest() {
    std::future<FrameRecord> oldest = std::move(in_flight_.front());
    in_flight_.pop_front();
    add(wait_for(oldest));
}

void FrameWriter::add(FrameRecord record) {
    journal_.add(record);
    const int number = record.frame;
    records_.emplace(number, std::move(record));
}

FrameRecord FrameWriter::wait_for(std::future<FrameRecord>& files) {
    const TraceScope scope(trace_, "wait for files", file_category);
    return files.get();
}

FrameCopy::FrameCopy(const Frame& frame) : frame_(frame), cascades_(frame.cascades.begin(), frame.cascades.end()) {
    ViewCopier copier(memory_);
    copier.copy_views(frame_);
    for (Cascade& cascade : cascades_) copier.copy_views(cascade);
    frame_.cascades = cascades_;
}

}  // namespace pelagic::tools
