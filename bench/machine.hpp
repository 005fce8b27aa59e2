// What a figure was measured on, and keeping the measuring thread where it is.
#pragma once

#include <sched.h>

#include <string>

namespace pelagic::bench {

std::string cpu_name();       ///< as the operating system calls it
std::string compiler_name();  ///< that built this program

/// Keeps the calling thread on the last core that it may use, until destroyed.
class PinnedToOneCore {
   public:
    PinnedToOneCore();
    ~PinnedToOneCore();
    PinnedToOneCore(const PinnedToOneCore&) = delete;
    PinnedToOneCore& operator=(const PinnedToOneCore&) = delete;

   private:
    cpu_set_t before_;
};

}  // namespace pelagic::bench
