// How long particle files take by the wall clock, from the page cache.
//
//   bench_particles FILE [THREADS]
//
// Opens the file, which finds its frames, then reads the frame in the middle and the last one.
// load_peers.py makes files for it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/parallel.h"
#include "render/files/particle_file/particle_file.h"
#include "render/frame/scheduler.h"

namespace boule::bench {
namespace {

class Clock {
 public:
  /// Milliseconds since this was asked last.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> passed = now - last_;
    last_ = now;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

bool time_file(const std::string& path, const ParallelFor& parallel_for) {
  Clock clock;
  auto file = ParticleFile::open(path, {}, parallel_for);
  if (!file) {
    std::fprintf(stderr, "%s\n", format_diagnostic(file.error()).c_str());
    return false;
  }
  std::printf("open: %zu frames, %.1f ms\n", file.value().frames(), clock.lap());
  const auto middle = static_cast<long>(file.value().frames() / 2);
  for (const long frame : {middle, -1L}) {
    clock.lap();
    const auto read = file.value().read(frame, parallel_for);
    if (!read) {
      std::fprintf(stderr, "%s\n", format_diagnostic(read.error()).c_str());
      return false;
    }
    std::printf("frame %ld: %zu particles, %.1f ms\n", frame, read.value().size(), clock.lap());
  }
  return true;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_particles FILE [THREADS]\n");
    return 2;
  }
  boule::Scheduler scheduler(argc > 2 ? static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10))
                                      : 1);
  return boule::bench::time_file(argv[1], scheduler.parallel_for()) ? 0 : 1;
}
