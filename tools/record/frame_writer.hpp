// Encoding and writing of frames, several at once, in bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <vector>

#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/record/export_journal.hpp"

namespace pelagic::tools {

/// Memory limits in bytes. An export with its ocean and its writing buffers stays under 2 GB
/// including libraries. If the ocean leaves less than the second limit, writing uses the second
/// limit nonetheless.
inline constexpr std::size_t max_bytes_of_export = std::size_t{1792} << 20;
inline constexpr std::size_t min_bytes_for_writing = std::size_t{256} << 20;

/// Returns the memory for frames that are being written, in bytes.
constexpr std::size_t bytes_for_writing(std::size_t ocean_bytes) {
    return std::max(min_bytes_for_writing, max_bytes_of_export - std::min(max_bytes_of_export, ocean_bytes));
}

/// Measured upper bounds, in bytes a texel: a copied frame with one file of each of its cascades
/// interleaved, encoded and compressed; and the additions for copied velocities, and for foam.
inline constexpr std::size_t bytes_per_texel_in_flight = 64, bytes_per_texel_of_velocities = 12,
                             bytes_per_texel_of_snapshots = 23;

/// Measured upper bound for such a file alone, in bytes a texel.
inline constexpr std::size_t bytes_per_texel_of_a_file = 32;

/// Measured upper bound for a vertex of a mesh, in bytes, in OBJ, the largest format.
inline constexpr std::size_t bytes_per_vertex_in_flight = 450;

/// How many frames and files are written concurrently.
struct WritingPlan {
    /// 1: written directly from the ocean's memory, while the ocean computes the next frame. More:
    /// copies.
    std::size_t frames = 1;
    std::size_t files_per_frame = 1;

    bool operator==(const WritingPlan&) const = default;
};

/// Returns a plan with as many concurrent files as threads, limited by the memory; at least one
/// file. If two copied frames do not fit, frames are not copied.
WritingPlan plan_writing(const ExportOptions& options, std::size_t max_bytes);

/// Returns the record of a frame without its files.
/// \param frame  as the ocean returns it, with the dynamic-wave grid if there is one
FrameRecord statistics_of(int number, const Frame& frame, bool has_foam);

/// Encodes and writes frames on several threads, as plan_writing() allows, and adds them to the
/// journal in order.
class FrameWriter {
   public:
    /// All arguments must outlive the writer.
    /// \param records    receives the finished frames
    /// \param trace      may be null
    /// \param max_bytes  memory limit, see bytes_for_writing()
    FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t max_bytes);

    /// Starts writing a copy of the frame; first waits for an earlier frame if too many are in
    /// flight. If copies do not fit, it writes the frame before it returns. Throws FileError if
    /// writing failed.
    void write(int number, const Frame& frame);

    /// Waits until all frames are written and in the journal. Throws FileError if writing failed.
    void finish();

   private:
    /// Runs `work` on a new thread. If the plan has no threads or the system cannot start one,
    /// `work` runs when its result is requested.
    std::future<FrameRecord> start(const std::function<FrameRecord()>& work);
    void take_oldest();
    void add(FrameRecord record);
    FrameRecord wait_for(std::future<FrameRecord>& files);

    const ExportOptions& options_;
    const OutputFolder& folder_;
    ExportJournal& journal_;
    std::map<int, FrameRecord>& records_;
    TraceSink* trace_;
    WritingPlan plan_;
    std::deque<std::future<FrameRecord>> in_flight_;
};

/// Copies every view of a frame, so that files can be encoded while the ocean computes. Textures
/// for drawing, which no file holds, are left out: displacement_rgba16f, slopes_rgba8 and
/// moments_rgba8 are empty.
class FrameCopy {
   public:
    explicit FrameCopy(const Frame& frame);
    FrameCopy(const FrameCopy&) = delete;

    const Frame& frame() const { return frame_; }

   private:
    Frame frame_;
    std::vector<Cascade> cascades_;
    std::vector<std::shared_ptr<const void>> memory_;  ///< of the views
};

}  // namespace pelagic::tools
