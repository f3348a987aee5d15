#include "bench/peers/judge.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "core/math/geometry.h"
#include "core/reference.h"

namespace boule::bench {
namespace {

constexpr std::size_t chunk = 1024;  // rays of one task

bool same_bits(const Hit& a, const Hit& b) {
  return a.id == b.id && std::bit_cast<std::uint64_t>(a.t) == std::bit_cast<std::uint64_t>(b.t);
}

bool same_distance(const Ray& ray, double t, double truth) {
  const double scale = length(vec_cast<double>(ray.dir));
  return std::fabs(t - truth) * scale <= std::max(1e-4 * truth * scale, 1e-5);
}

}  // namespace

bool same_in_float(const BenchScene& scene, const Ray& ray, const Hit& hit, const Hit& truth) {
  if (hit.id == no_primitive || truth.id == no_primitive) return hit.id == truth.id;
  if (!same_distance(ray, hit.t, truth.t)) return false;
  if (hit.id == truth.id) return true;
  const double other = with_primitive(scene, hit.id, [&](const auto& primitive) {
    return reference::intersect(ray, primitive, hit.id == ray.source);
  });
  return same_distance(ray, other, truth.t);
}

Judge::Judge(const Workload& workload, const DoubleTree& tree, const ParallelFor& parallel_for)
    : workload_(workload) {
  const std::size_t size = workload.rays->size();
  const bool any = asks_any(workload.kind);
  any ? truth_.occluded.resize(size) : truth_.hits.resize(size);
  parallel_for((size + chunk - 1) / chunk, [&](std::size_t task) {
    for (std::size_t i = task * chunk; i < std::min(size, (task + 1) * chunk); ++i) {
      const Ray ray = workload.rays->get(i);
      if (any) {
        truth_.occluded[i] = tree.any_hit(ray) ? 1 : 0;
      } else {
        truth_.hits[i] = tree.closest_hit(ray);
      }
    }
  });
}

std::size_t Judge::differ_from_reference(std::size_t samples,
                                         const ParallelFor& parallel_for) const {
  const std::size_t size = workload_.rays->size();
  const std::vector<Sphere>& spheres = workload_.scene->spheres;
  const std::vector<Capsule>& capsules = workload_.scene->capsules;
  std::atomic<std::size_t> differ = 0;
  samples = std::min(samples, size);
  parallel_for(samples, [&](std::size_t sample) {
    const std::size_t i = sample * size / samples;
    const Ray ray = workload_.rays->get(i);
    const bool same =
        asks_any(workload_.kind)
            ? reference::any_hit(ray, spheres, {}, capsules) == (truth_.occluded[i] != 0)
            : same_bits(reference::closest_hit(ray, spheres, {}, capsules), truth_.hits[i]);
    if (!same) ++differ;
  });
  return differ;
}

std::vector<std::size_t> Judge::mismatches(const Answers& answers, bool exact) const {
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < truth_.occluded.size(); ++i) {
    if (answers.occluded[i] != truth_.occluded[i]) wrong.push_back(i);
  }
  for (std::size_t i = 0; i < truth_.hits.size(); ++i) {
    const bool same = exact ? same_bits(answers.hits[i], truth_.hits[i])
                            : same_in_float(*workload_.scene, workload_.rays->get(i),
                                            answers.hits[i], truth_.hits[i]);
    if (!same) wrong.push_back(i);
  }
  return wrong;
}

}  // namespace boule::bench
