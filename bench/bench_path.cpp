// Path tracing, measured: the share of the time that is spent on tracing rays, and the error at
// equal time of our samples and of plain random ones, as figures for a plot.
//   bench_path SCENE [SAMPLES]     SCENE: .toml; SAMPLES of the reference, 4096 if left out

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include "bench/errors/path_errors.h"
#include "bench/tools/median.h"
#include "bench/tools/thread_seconds.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

/// The kernels that are timed, and the time they took. These are globals because a kernel table
/// holds plain functions; one thread uses them.
const KernelTable* timed_kernels = nullptr;
double kernel_seconds = 0;

void timed_closest_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                       const HitStream& hits) {
  const double begin = thread_seconds();
  timed_kernels->closest_hit(geometry, rays, query, hits);
  kernel_seconds += thread_seconds() - begin;
}

void timed_any_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                   std::uint8_t* occluded) {
  const double begin = thread_seconds();
  timed_kernels->any_hit(geometry, rays, query, occluded);
  kernel_seconds += thread_seconds() - begin;
}

/// Rays per second of the whole renderer and of its tracing kernels alone, over the same rays. The
/// first sample is not timed: it makes the memory that a picture of many samples needs once.
void measure_speed(const PathScene& scene, const KernelTable& kernels) {
  timed_kernels = &kernels;
  KernelTable timed = kernels;
  timed.closest_hit = timed_closest_hit;
  timed.any_hit = timed_any_hit;
  std::vector<double> whole, traversal, ratio;
  for (int run = 0; run < 9; ++run) {
    PathPicture picture(scene, timed, 1);
    picture.add(0, Samples::sequence);
    const std::uint64_t before = picture.counts().total();
    kernel_seconds = 0;
    const double begin = thread_seconds();
    for (int sample = 1; sample <= 16; ++sample) picture.add(sample, Samples::sequence);
    const double seconds = thread_seconds() - begin;
    const double rays = static_cast<double>(picture.counts().total() - before) * 1e-6;
    whole.push_back(rays / seconds);
    traversal.push_back(rays / kernel_seconds);
    ratio.push_back(kernel_seconds / seconds);
  }
  std::printf("isa %s: %.2f Mray/s path traced, %.2f traversal only, ratio %.3f (medians of 9)\n",
              std::string(isa_name(kernels.isa)).c_str(), median(whole), median(traversal),
              median(ratio));
}

void print_errors(const PathErrors& errors) {
  std::printf("samples,seconds,rms_error,random_seconds,random_rms_error\n");
  for (std::size_t i = 0; i < errors.sequence.size(); ++i) {
    const PathError &ours = errors.sequence[i], &random = errors.random[i];
    std::printf("%d,%.4f,%.6f,%.4f,%.6f\n", ours.samples, ours.seconds, ours.error, random.seconds,
                random.error);
  }
}

int run(const char* file, int reference) {
  const auto scene = load_path_scene(file);
  if (!scene) {
    std::fprintf(stderr, "%s\n", format_diagnostic(scene.error()).c_str());
    return 3;
  }
  const KernelTable& kernels = *select_kernels("auto").value();
  measure_speed(scene.value(), kernels);
  print_errors(measure_path_errors(scene.value(), kernels, reference));
  return 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  int most = 4096;
  const std::string_view text = argc > 2 ? argv[2] : "4096";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), most);
  if (argc < 2 || argc > 3 || error != std::errc{} || end != text.data() + text.size() ||
      most < 8) {
    std::fprintf(stderr, "usage: bench_path SCENE [SAMPLES], SAMPLES >= 8\n");
    return 2;
  }
  return boule::bench::run(argv[1], most);
}
