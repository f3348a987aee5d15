#include "render/cli/image_threads.h"

#include <algorithm>

#include "render/frame/scheduler.h"

namespace boule::cli {

int image_threads(unsigned wanted) {
  constexpr unsigned at_load = 4;
  static bool loaded = false;
  const unsigned first = loaded ? 0 : at_load;
  if (!can_start_threads(first + 1)) return loaded ? 1 : 0;  // TIFF takes one more
  loaded = true;
  // OpenImageIO begins with as many as the hardware runs; OpenEXR has a pool of its own.
  const unsigned pools = std::max(wanted, Scheduler(0).workers()) + wanted;
  return wanted > 1 && can_start_threads(first + pools) ? static_cast<int>(wanted) : 1;
}

}  // namespace boule::cli
