// Limits of CPU time by Linux control groups, as containers have.
#pragma once

#include <string>

namespace pelagic {

/// Returns the number of CPUs whose time this process may use, rounded up, or 0 if it has no limit.
/// The smallest limit of its group and the groups above applies. Reads versions 1 and 2.
/// \param root  of the file system, "" for the system's own
/// \see Linux, Documentation/admin-guide/cgroup-v2.rst (cpu.max), scheduler/sched-bwc.rst
int cpus_of_quota(const std::string& root);

}  // namespace pelagic
