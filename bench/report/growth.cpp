#include "bench/report/growth.h"

#include <algorithm>

#include "bench/scenes/bench_scenes.h"
#include "bench/scenes/camera_rays.h"
#include "bench/scenes/ray_kinds.h"
#include "bench/tools/thread_seconds.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"

namespace boule::bench {
namespace {

struct Way {
  const KernelTable* kernels;
  std::string isa, form;
  Query query;
  std::vector<double> seconds;
};

std::vector<Way> all_ways(RayKind kind) {
  std::vector<Way> ways;
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported || info.isa == Isa::scalar) continue;
    const KernelTable* const kernels = select_kernels(info.name).value();
    const auto add = [&](const char* form, const Query& query) {
      ways.push_back({kernels, std::string(info.name), form, query, {}});
    };
    if (kind == RayKind::primary) {
      add("bundle", {Solver::robust, Form::automatic, Coherence::common_origin});
      add("packet", {Solver::robust, Form::packet, Coherence::none});
      add("single", {Solver::robust, Form::single, Coherence::none});
    } else {
      add("automatic", {Solver::robust, Form::automatic, coherence_of(kind)});
    }
  }
  return ways;
}

/// Room for all answers.
struct Answers {
  explicit Answers(std::size_t rays) : hits(rays), occluded(rays) {}
  HitBuffer hits;
  std::vector<std::uint8_t> occluded;
};

void trace(Way& way, const Geometry& geometry, RayKind kind, RayBuffer& rays, Answers& answers) {
  constexpr std::size_t block = 16384;
  const RayStream all = rays.view();
  const HitStream out = answers.hits.view();
  const double begin = thread_seconds();
  for (std::size_t first = 0; first < rays.size(); first += block) {
    const std::size_t size = std::min(block, rays.size() - first);
    const RayStream part = boule::part(all, first, size);
    if (asks_any(kind)) {
      way.kernels->any_hit(geometry.view(), part, way.query, answers.occluded.data() + first);
    } else {
      way.kernels->closest_hit(geometry.view(), part, way.query, boule::part(out, first, size));
    }
  }
  way.seconds.push_back(thread_seconds() - begin);
}

void measure_kind(const BenchScene& scene, const Geometry& geometry, RayKind kind, RayBuffer& rays,
                  int repetitions, std::vector<Growth>& growth) {
  Answers answers(rays.size());
  std::vector<Way> ways = all_ways(kind);
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (Way& way : ways) trace(way, geometry, kind, rays, answers);
  }
  for (Way& way : ways) {
    std::sort(way.seconds.begin(), way.seconds.end());
    const double ns = 1e9 / static_cast<double>(rays.size());
    growth.push_back({scene.spheres.size(), name_of(kind), way.isa, way.form,
                      ns * way.seconds[way.seconds.size() / 2], ns * way.seconds.front(),
                      ns * way.seconds.back()});
  }
}

std::vector<Hit> first_hits(const Geometry& geometry, RayBuffer& rays) {
  HitBuffer hits(rays.size());
  const KernelTable& kernels = *select_kernels("auto").value();
  kernels.closest_hit(geometry.view(), rays.view(),
                      {Solver::robust, Form::automatic, Coherence::common_origin}, hits.view());
  std::vector<Hit> all;
  for (std::size_t i = 0; i < rays.size(); ++i) all.push_back(hits.get(i));
  return all;
}

}  // namespace

std::vector<Growth> measure_growth(int most_decades, int side, int repetitions) {
  std::vector<Growth> growth;
  std::size_t spheres = 10;
  for (int decades = 2; decades <= most_decades; ++decades) {
    spheres *= 10;
    const BenchScene scene = make_scene("u" + std::to_string(spheres)).value();
    const Geometry geometry(scene.spheres, {});
    RayBuffer camera = primary_rays(scene, side);
    measure_kind(scene, geometry, RayKind::primary, camera, repetitions, growth);
    const std::vector<Hit> hits = first_hits(geometry, camera);
    for (const RayKind kind : ray_kinds()) {
      if (kind == RayKind::primary) continue;
      RayBuffer rays = make_rays(kind, scene, {side, &camera, &hits});
      measure_kind(scene, geometry, kind, rays, repetitions, growth);
    }
  }
  return growth;
}

}  // namespace boule::bench
