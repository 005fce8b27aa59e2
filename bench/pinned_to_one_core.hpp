// Pinning of the measuring thread.
#pragma once

#include <sched.h>

namespace pelagic::bench {

/// Pins the calling thread to the last core that it may use, until destroyed.
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
