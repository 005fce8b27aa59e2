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

/// Most memory for frames that are being written, beside the ocean, as long as one file at a time fits.
inline constexpr std::size_t most_bytes_in_flight = std::size_t{512} << 20;

/// A copied frame, with one file of each of its tiles interleaved, encoded and compressed: at most so many bytes a texel, measured.
inline constexpr std::size_t bytes_per_texel_in_flight = 64;

/// Such a file alone: at most so many bytes a texel, measured.
inline constexpr std::size_t bytes_per_texel_of_a_file = 32;

/// What is written at once.
struct WritingPlan {
    /// One: written straight from the ocean's own memory, while it computes the next frame. More: copies.
    std::size_t frames = 1;
    std::size_t files_a_frame = 1;

    bool operator==(const WritingPlan&) const = default;
};

/// As much as there are threads, but no more than fits into the memory; at least one file. Two frames that don't fit aren't
/// copied.
WritingPlan plan_writing(const ExportOptions& options, std::size_t most_bytes);

/// Encodes and writes frames on a few threads and journals them in order, as many at once as plan_writing() says.
class FrameWriter {
   public:
    /// All of it outlives the writer.
    /// \param records  gets the frames that are done
    /// \param trace    may be none
    FrameWriter(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                std::map<int, FrameRecord>& records, TraceSink* trace, std::size_t most_bytes = most_bytes_in_flight);

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
