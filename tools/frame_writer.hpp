// Frames as files, several at once, in bounded memory.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>

#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/export_journal.hpp"

namespace pelagic::tools {

/// Most memory for frames that are being written, as long as one of them fits.
inline constexpr std::size_t most_bytes_in_flight = std::size_t{2} << 30;

/// A frame in flight is copied, interleaved, encoded and compressed: about so many bytes a texel, measured.
inline constexpr std::size_t bytes_per_texel_in_flight = 64;

/// And a vertex of meshes, as OBJ, which is the largest, measured likewise.
inline constexpr std::size_t bytes_per_vertex_in_flight = 450;

/// How many frames are written at once: one a thread, no more than fit, and at least one.
std::size_t frames_in_flight(const ExportOptions& options, std::size_t most_bytes);

/// Encodes and writes frames on a few threads and journals them in order, frames_in_flight() at once.
class FrameWriter {
   public:
    /// All of it outlives the writer.
    /// \param records  gets the frames that are done
    /// \param trace    may be none
    FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t most_bytes = most_bytes_in_flight);

    /// Copies the frame; waits for an earlier one if too many are in flight. Throws FileError if that one failed.
    void write(int number, const Frame& frame);

    /// Returns when all are done and journaled. Throws FileError likewise.
    void finish();

   private:
    /// On a thread of its own; where there is to be none or the system refuses one, when it is waited for.
    std::future<FrameRecord> start(const std::function<FrameRecord()>& work);
    void take_oldest();
    FrameRecord wait_for(std::future<FrameRecord>& files);

    const ExportOptions& options_;
    const OutputFolder& folder_;
    ExportJournal& journal_;
    std::map<int, FrameRecord>& records_;
    TraceSink* trace_;
    std::size_t most_;
    std::deque<std::future<FrameRecord>> in_flight_;
};

}  // namespace pelagic::tools
