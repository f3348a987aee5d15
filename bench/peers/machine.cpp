#include "bench/peers/machine.h"

#include <thread>

#include "bench/peers/embree/embree_peer.h"
#include "bench/tools/cpu_model.h"

namespace boule::bench {
Machine this_machine() {
  return {cpu_model(), std::thread::hardware_concurrency(), compiler, BOULE_BENCH_FLAGS,
          embree_version()};
}

}  // namespace boule::bench
