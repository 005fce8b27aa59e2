#include "pelagic/jobs/chrome_trace.hpp"

#include <algorithm>
#include <charconv>
#include <ostream>
#include <string_view>

#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

/// Returns microseconds with three decimals.
std::string microseconds(TraceClock::duration time) {
    char text[64];
    const double value = std::chrono::duration<double, std::micro>(time).count();
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 3).ptr};
}

std::string quoted(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20)
            quoted.append("\\u00").append({digits[code >> 4], digits[code & 15]});
        else if (c == '"' || c == '\\')
            quoted.append({'\\', c});
        else
            quoted += c;
    }
    return quoted + '"';
}

/// Returns the index of `value` in the list and appends a new value. The search is linear, because
/// a trace has few names and threads.
template <class List, class Value>
std::uint32_t index_in(List& list, const Value& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto index = static_cast<std::uint32_t>(found - list.begin());
    if (found == list.end()) list.emplace_back(value);
    return index;
}

/// Tracks count from 1, because viewers give track 0 a special meaning.
std::string track(std::uint32_t thread) { return R"("pid":1,"tid":)" + number_text(thread + 1); }

std::string metadata(const char* key, std::uint32_t thread, const std::string& name) {
    return R"({"ph":"M","name":")" + std::string(key) + "\"," + track(thread) + R"(,"args":{"name":)" + quoted(name) +
           "}}";
}

}  // namespace

ChromeTrace::ChromeTrace(std::size_t max_spans) : max_spans_(max_spans) { spans_.reserve(max_spans); }

void ChromeTrace::work(const TraceSpan& span) noexcept { keep(span, true); }

void ChromeTrace::in_flight(const TraceSpan& span) noexcept { keep(span, false); }

void ChromeTrace::keep(const TraceSpan& span, bool on_this_thread) noexcept {
    const std::lock_guard lock(mutex_);
    if (spans_.size() == max_spans_) {
        ++omitted_;
        return;
    }
    const std::uint32_t thread = on_this_thread ? index_in(threads_, std::this_thread::get_id()) : not_on_a_thread;
    spans_.push_back({index_in(names_, span.name), thread, span.category, span.args, span.start, span.end});
}

std::size_t ChromeTrace::omitted() const {
    const std::lock_guard lock(mutex_);
    return omitted_;
}

std::string ChromeTrace::event(const Kept& kept, char phase, TraceClock::time_point when) const {
    std::string args;
    for (const TraceArg& arg : kept.args)
        if (arg.name) args += (args.empty() ? "" : ",") + quoted(arg.name) + ":" + number_text(arg.value);
    return R"({"ph":")" + std::string(1, phase) + R"(","name":)" + quoted(names_[kept.name]) + R"(,"cat":)" +
           quoted(kept.category) + "," + track(kept.thread == not_on_a_thread ? 0 : kept.thread) + R"(,"ts":)" +
           microseconds(when - origin_) + R"(,"args":{)" + args + "}";
}

void ChromeTrace::write(std::ostream& out) const {
    const std::lock_guard lock(mutex_);
    out << R"({"displayTimeUnit":"ns","otherData":{"spans_omitted":)" << number_text(omitted_)
        << "},\"traceEvents\":[\n"
        << metadata("process_name", 0, "pelagic");
    for (std::uint32_t thread = 0; thread < threads_.size(); ++thread)
        out << ",\n"
            << metadata("thread_name", thread, thread == 0 ? "application" : "worker " + number_text(thread));
    for (std::size_t i = 0; i < spans_.size(); ++i) {
        const Kept& kept = spans_[i];
        if (kept.thread != not_on_a_thread) {
            out << ",\n"
                << event(kept, 'X', kept.start) << R"(,"dur":)" << microseconds(kept.end - kept.start) << "}";
            continue;
        }
        // The index in the list is a unique identifier of the pair of events.
        const std::string id = R"(,"id":)" + number_text(i + 1) + "}";
        out << ",\n" << event(kept, 'b', kept.start) << id << ",\n" << event(kept, 'e', kept.end) << id;
    }
    out << "\n]}\n";
}

}  // namespace pelagic
