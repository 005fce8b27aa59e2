// Frames as files, several at once, in bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>

#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/record/export_journal.hpp"

namespace pelagic::tools {

/// What an export may take with its ocean and with what it writes, so that it stays under 2 GB with its libraries; where the ocean
/// leaves less than the second, that is for writing nonetheless.
inline constexpr std::size_t max_bytes_of_export = std::size_t{1792} << 20;
inline constexpr std::size_t min_bytes_for_writing = std::size_t{256} << 20;

/// How much of it is left for frames that are being written.
constexpr std::size_t bytes_for_writing(std::size_t ocean_bytes) {
    return std::max(min_bytes_for_writing, max_bytes_of_export - std::min(max_bytes_of_export, ocean_bytes));
}

/// A copied frame, with one file of each of its cascades interleaved, encoded and compressed: at most so many bytes a texel, measured,
/// and more for copies of velocities.
inline constexpr std::size_t bytes_per_texel_in_flight = 64, bytes_per_texel_of_velocities = 12;

/// Such a file alone: at most so many bytes a texel, measured.
inline constexpr std::size_t bytes_per_texel_of_a_file = 32;

/// And a vertex of meshes, as OBJ, which is the largest, measured likewise.
inline constexpr std::size_t bytes_per_vertex_in_flight = 450;

/// What is written at once.
struct WritingPlan {
    /// One: written straight from the ocean's own memory, while it computes the next frame. More: copies.
    std::size_t frames = 1;
    std::size_t files_a_frame = 1;

    bool operator==(const WritingPlan&) const = default;
};

/// As much as there are threads, but no more than fits into the memory; at least one file. Two frames that don't fit aren't
/// copied.
WritingPlan plan_writing(const ExportOptions& options, std::size_t max_bytes);

/// All of a frame's record but the files, of a frame as the ocean hands it out, with the dynamic-wave grid if there is one.
FrameRecord statistics_of(int number, const Frame& frame, bool has_foam);

/// Encodes and writes frames on a few threads and journals them in order, as many at once as plan_writing() says.
class FrameWriter {
   public:
    /// All of it outlives the writer.
    /// \param records     gets the frames that are done
    /// \param trace       may be none
    /// \param max_bytes  as bytes_for_writing() says
    FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t max_bytes);

    /// Copies the frame, and waits for an earlier one if too many are in flight; or writes it, where no copies fit. Throws FileError
    /// if that failed.
    void write(int number, const Frame& frame);

    /// Returns when all are done and journaled. Throws FileError likewise.
    void finish();

   private:
    /// On a thread of its own; where there is to be none or the system refuses one, when it is waited for.
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

}  // namespace pelagic::tools
