#include "bench/report/growth.h"

#include <ctime>

#include <algorithm>

#include "bench/bench_scenes.h"
#include "bench/camera_rays.h"
#include "simd/build/geometry_builder.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

struct Way {
  const KernelTable* kernels;
  std::string isa, form;
  Query query;
  std::vector<double> seconds;
};

std::vector<Way> all_ways() {
  std::vector<Way> ways;
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported || info.isa == Isa::scalar) continue;
    const KernelTable* const kernels = select_kernels(info.name).value();
    const std::string isa(info.name);
    ways.push_back(
        {kernels, isa, "bundle", {Solver::robust, Form::automatic, Coherence::common_origin}, {}});
    ways.push_back({kernels, isa, "packet", {Solver::robust, Form::packet, Coherence::none}, {}});
    ways.push_back({kernels, isa, "single", {Solver::robust, Form::single, Coherence::none}, {}});
  }
  return ways;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void trace(Way& way, const Geometry& geometry, RayBuffer& rays, HitBuffer& hits) {
  constexpr std::size_t block = 16384;
  const RayStream all = rays.view();
  const HitStream out = hits.view();
  const double begin = thread_seconds();
  for (std::size_t first = 0; first < rays.size(); first += block) {
    const std::size_t size = std::min(block, rays.size() - first);
    way.kernels->closest_hit(geometry.view(), part_of(all, first, size), way.query,
                             {out.t + first, out.id + first, size});
  }
  way.seconds.push_back(thread_seconds() - begin);
}

}  // namespace

std::vector<Growth> measure_growth(int most_decades, int side, int repetitions) {
  std::vector<Growth> growth;
  std::size_t spheres = 10;
  for (int decades = 2; decades <= most_decades; ++decades) {
    spheres *= 10;
    const BenchScene scene = make_scene("u" + std::to_string(spheres)).value();
    const Geometry geometry(scene.spheres, {});
    RayBuffer rays = primary_rays(scene, side);
    HitBuffer hits(rays.size());
    std::vector<Way> ways = all_ways();
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      for (Way& way : ways) trace(way, geometry, rays, hits);
    }
    for (Way& way : ways) {
      std::sort(way.seconds.begin(), way.seconds.end());
      const double ns = 1e9 / static_cast<double>(rays.size());
      growth.push_back({spheres, way.isa, way.form, ns * way.seconds[way.seconds.size() / 2],
                        ns * way.seconds.front(), ns * way.seconds.back()});
    }
  }
  return growth;
}

}  // namespace boule::bench
