// Measures elapsed time: of the application's work, or of calls in which a driver may copy pixels
// or transform vertices.
#pragma once

#include <chrono>

namespace pelagic::gl {

class Stopwatch {
   public:
    /// Returns the time since construction.
    double milliseconds() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

   private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace pelagic::gl
