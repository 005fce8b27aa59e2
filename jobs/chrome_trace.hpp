// Recording of trace spans in memory and export as Chrome trace JSON, for ui.perfetto.dev and
// chrome://tracing.
//
//   const auto trace = std::make_shared<ChromeTrace>();
//   Ocean ocean({}, {.trace = trace});
//   ocean.frame_at(0);
//   std::ofstream file("trace.json");
//   trace->write(file);
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/jobs/trace.hpp"

namespace pelagic {

/// A trace sink that stores spans in memory. Several oceans may share one. A span costs 0.12
/// microseconds, half of which are the two clock reads (Zen 3). The first span of a name or a
/// thread allocates memory; if that fails, the program ends.
class ChromeTrace final : public TraceSink {
   public:
    /// Memory of 64 bytes per span is reserved at construction, so that recording never
    /// reallocates. Most systems commit pages only when they are used. A million spans are about
    /// 15,000 frames of N = 256; viewers become slow beyond that.
    static constexpr std::size_t default_max_spans = 1'000'000;

    /// Times are relative to the construction. The calling thread is named "application".
    /// \param max_spans  maximum number of stored spans; further spans are counted, but not stored
    explicit ChromeTrace(std::size_t max_spans = default_max_spans);

    void work(const TraceSpan& span) noexcept override;
    void in_flight(const TraceSpan& span) noexcept override;

    /// Returns the number of spans that were not stored.
    std::size_t omitted() const;

    /// Writes the spans stored so far. Each span of work becomes a complete event ("ph": "X") on
    /// the track of its thread, each span in flight a pair of asynchronous events ("b", "e"). Also
    /// writes the names of the threads. Threads that record at the same time wait.
    void write(std::ostream& out) const;

   private:
    struct Kept {
        std::uint32_t name;    ///< index in names_
        std::uint32_t thread;  ///< index in threads_, or not_on_a_thread
        const char* category;
        std::array<TraceArg, 2> args;
        TraceClock::time_point start, end;
    };
    static_assert(sizeof(Kept) <= 64 || sizeof(void*) != 8);
    static constexpr std::uint32_t not_on_a_thread = UINT32_MAX;

    void keep(const TraceSpan& span, bool on_this_thread) noexcept;
    std::string event(const Kept& kept, char phase, TraceClock::time_point when) const;

    const std::size_t max_spans_;
    mutable std::mutex mutex_;
    TraceClock::time_point origin_ = TraceClock::now();
    std::vector<std::string> names_;
    std::vector<std::thread::id> threads_ = {std::this_thread::get_id()};
    std::vector<Kept> spans_;
    std::size_t omitted_ = 0;
};

}  // namespace pelagic
