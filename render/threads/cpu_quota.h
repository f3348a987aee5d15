#pragma once

#include <string>

namespace boule {

/// How many threads are worth starting under the quotas of control groups: the processors' time
/// that the tightest one gives, rounded up; 0 where there is none. `groups` is the text of
/// /proc/self/cgroup, `root` the folder where the control groups are mounted, of version 2
/// (cpu.max) or 1 (cpu.cfs_quota_us). Takes any text and any files.
unsigned quota_threads(const std::string& groups, const std::string& root);

}  // namespace boule
