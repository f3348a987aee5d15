#include "render/threads/cpu_quota.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace boule {
namespace {

constexpr double no_quota = std::numeric_limits<double>::infinity();

/// The first number of a file; 0 if there is none, or it is not positive.
double first_number(const std::string& path) {
  double number = 0;
  std::ifstream(path) >> number;
  return std::max(number, 0.0);
}

/// The processors that a control group may use: "QUOTA PERIOD" in microseconds, "max" for none.
double processors_of(const std::string& folder) {
  double quota = 0, period = 0;
  if (!(std::ifstream(folder + "/cpu.max") >> quota >> period)) {  // version 1; -1 for none
    quota = first_number(folder + "/cpu.cfs_quota_us");
    period = first_number(folder + "/cpu.cfs_period_us");
  }
  return quota > 0 && period > 0 ? quota / period : no_quota;
}

/// Whether a line "NUMBER:CONTROLLERS:/GROUP" is of processors; one of version 2 has no
/// controllers.
bool has_processors(const std::string& controllers) {
  return controllers.empty() || ("," + controllers + ",").find(",cpu,") != std::string::npos;
}

}  // namespace

unsigned quota_threads(const std::string& groups, const std::string& root) {
  double least = no_quota;
  std::istringstream lines(groups);
  for (std::string number, controllers, group; std::getline(lines, number, ':') &&
                                               std::getline(lines, controllers, ':') &&
                                               std::getline(lines, group);) {
    if (!has_processors(controllers)) continue;
    const std::string mount = root + (controllers.empty() ? "" : "/" + controllers);
    // In a container the group's name may be the one outside: what is there is the mount itself.
    for (;; group.resize(std::min(group.rfind('/'), group.size()))) {
      least = std::min(least, processors_of(mount + group));
      if (group.find('/') == std::string::npos) break;
    }
  }
  constexpr double most = 1 << 20;
  return least < most ? static_cast<unsigned>(std::ceil(least)) : 0;
}

}  // namespace boule
