// A trace for people to look at: spans kept in memory, written as Chrome's trace JSON, which ui.perfetto.dev and
// chrome://tracing open.
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

/// A span costs 0.12 microseconds, half of that the two looks at the clock (Zen 3). May be shared by several oceans.
/// Recording a name or a thread for the first time allocates; out of memory, that ends the program.
class ChromeTrace final : public TraceSink {
   public:
    /// The room for 64 bytes a span is reserved at once, so that recording never moves it; most systems only hand it
    /// out where it is used. A million is about 15 thousand frames of N = 256, and as much as a viewer is
    /// comfortable with.
    static constexpr std::size_t default_max_spans = 1'000'000;

    /// Times are counted from here, and the calling thread is named the application.
    /// \param max_spans  later ones are counted, but not kept
    explicit ChromeTrace(std::size_t max_spans = default_max_spans);

    void work(const TraceSpan& span) noexcept override;
    void in_flight(const TraceSpan& span) noexcept override;

    std::size_t left_out() const;  ///< spans that came when the room was full

    /// Writes what there is by now: a complete event ("ph": "X") for each span of work on the track of its thread, a
    /// pair of asynchronous ones ("b", "e") for each in flight, and the names of the threads. Holds up who wants to
    /// record meanwhile.
    void write(std::ostream& out) const;

   private:
    struct Kept {
        std::uint32_t name;    ///< in names_
        std::uint32_t thread;  ///< in threads_, or not_on_a_thread
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
    std::size_t left_out_ = 0;
};

}  // namespace pelagic
