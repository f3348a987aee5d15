#include "bench/peers/machine.h"

#include <thread>

#include "bench/cpu_model.h"
#include "bench/peers/embree_peer.h"

namespace boule::bench {
Machine this_machine() {
  return {cpu_model(), std::thread::hardware_concurrency(), compiler, BOULE_BENCH_FLAGS,
          embree_version()};
}

}  // namespace boule::bench
