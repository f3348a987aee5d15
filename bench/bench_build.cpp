// Build rates: Boule's Geometry (tree and leaves) against Embree's built-in spheres at its default
// build quality, with 1, 2, 4 ... threads, interleaved in one run; medians.
//
//   bench_build [spheres...]
//
// The clocks run over what a renderer waits for: of Boule the making of a Geometry that takes the
// caller's spheres, as Renderer::create() does, of Embree rtcCommitScene() for a geometry that
// shares the caller's buffer. Both have threads that wait for work.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/embree/embree_version.h"
#include "bench/scenes/uniform_spheres.h"
#include "bench/tools/median.h"
#include "bench/tools/wall_seconds.h"
#include "core/base/parallel.h"
#include "render/frame/scheduler.h"
#include "simd/geometry/geometry.h"

namespace boule::bench {
namespace {

/// Four floats a sphere, in the layout of Embree's spheres.
std::vector<float> embree_points(const std::vector<Sphere>& spheres) {
  std::vector<float> points;
  for (const Sphere& s : spheres)
    points.insert(points.end(), {s.center.x, s.center.y, s.center.z, s.radius});
  return points;
}

double embree_seconds(RTCDevice device, std::vector<float>& points) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, points.data(),
                             0, 4 * sizeof(float), points.size() / 4);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  const double time = wall_seconds([&] { rtcCommitScene(scene); });
  rtcReleaseScene(scene);
  return time;
}

double our_seconds(std::vector<Sphere> spheres, const ParallelFor& loop) {
  std::optional<Geometry> built;
  return wall_seconds(
      [&] { built.emplace(std::move(spheres), std::vector<Plane>(), Structure::bvh, loop); });
}

void compare(std::size_t n, unsigned threads) {
  const auto spheres = uniform_spheres(n);
  auto points = embree_points(spheres);
  RTCDevice device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  Scheduler scheduler(threads);
  const ParallelFor loop = scheduler.parallel_for();
  std::vector<double> ours, theirs, ratios;
  const int repetitions = n < 500'000 ? 31 : 9;
  for (int i = 0; i < repetitions; ++i) {
    theirs.push_back(embree_seconds(device, points));
    ours.push_back(our_seconds(spheres, loop));
    ratios.push_back(theirs.back() / ours.back());
  }
  rtcReleaseDevice(device);
  const double million = static_cast<double>(n) * 1e-6;
  std::printf("u%-8zu %u thread(s): Embree %6.2f  Boule %6.2f Mspheres/s  ratio %.2f (best %.2f)\n",
              n, threads, million / median(theirs), million / median(ours), median(ratios),
              *std::min_element(theirs.begin(), theirs.end()) /
                  *std::min_element(ours.begin(), ours.end()));
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {10'000, 100'000, 1'000'000};
  for (const std::size_t n : sizes) {
    for (const unsigned threads : boule::bench::thread_counts()) boule::bench::compare(n, threads);
  }
  return 0;
}
