#include "bench/peers/machine.h"

#include <fstream>
#include <thread>

#include "bench/peers/embree_peer.h"

namespace boule::bench {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

#if defined(__clang__)
constexpr const char* compiler = __VERSION__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

Machine this_machine() {
  return {cpu_model(), std::thread::hardware_concurrency(), compiler, BOULE_BENCH_FLAGS,
          embree_version()};
}

}  // namespace boule::bench
