#include "bench/errors/capsule_errors.h"

#include <cmath>
#include <limits>
#include <optional>

#include "bench/errors/embree_curves.h"
#include "bench/textbook/book_capsule.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {
namespace {

/// t of each ray of a target; NaN: not asked. Empty: none was asked.
using Roots = std::vector<double>;

/// A capsule, and the rays that are aimed at it.
struct Target {
  Capsule capsule;
  std::vector<Ray> rays;
};

std::vector<Target> targets_of(const test::CapsuleCase& all) {
  std::vector<Target> targets;
  for (const Capsule& capsule : all.capsules) targets.push_back({capsule, {}});
  for (std::size_t i = 0; i < all.rays.size(); ++i) {
    Ray ray = all.rays[i];
    ray.org = vec_cast<double>(vec_cast<float>(ray.org));
    ray.tmin = 0;
    ray.tmax = std::numeric_limits<float>::infinity();
    targets[i % targets.size()].rays.push_back(ray);
  }
  return targets;
}

Roots robust(const Target& target) {
  Geometry geometry({}, {});
  geometry.add_capsules({target.capsule});
  const std::size_t size = target.rays.size();
  RayBuffer stream(size);
  HitBuffer hits(size);
  for (std::size_t i = 0; i < size; ++i) stream.set(i, target.rays[i]);
  select_kernels("auto").value()->closest_hit(
      geometry.view(), stream.view(), {Solver::robust, Form::packet, Coherence::none}, hits.view());
  Roots t;
  for (std::size_t i = 0; i < size; ++i) t.push_back(hits.get(i).t);
  return t;
}

template <class Real>
Roots textbook(const Target& target) {
  Roots t;
  for (const Ray& ray : target.rays) t.push_back(book_capsule<Real>(ray, target.capsule));
  return t;
}

Roots embree(const Target& target) { return embree_curve_hits(target.capsule, target.rays); }

struct CapsuleSolver {
  const char* name;
  Roots (*solve)(const Target& target);
};
constexpr CapsuleSolver capsule_solvers[] = {{"robust", robust},
                                             {"textbook", textbook<float>},
                                             {"textbook_double", textbook<double>},
                                             {"embree_curves", embree}};

}  // namespace

std::vector<HardErrors> capsule_errors(const test::CapsuleCaseSpec& spec, std::size_t rays) {
  constexpr std::size_t rays_per_capsule = 64;
  const std::size_t capsules = (rays + rays_per_capsule - 1) / rays_per_capsule;
  std::vector<HardErrors> rows;
  for (const CapsuleSolver& solver : capsule_solvers) rows.push_back({solver.name, {}});
  for (const Target& target : targets_of(make_capsule_case(spec, capsules, rays))) {
    std::vector<std::optional<test::OracleHit>> truth;
    for (const Ray& ray : target.rays) truth.push_back(test::oracle_hit(ray, target.capsule));
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Roots t = capsule_solvers[k].solve(target);
      for (std::size_t i = 0; i < t.size(); ++i) {
        if (!std::isnan(t[i])) rows[k].figures.add(target.rays[i], target.capsule, t[i], truth[i]);
      }
    }
  }
  std::erase_if(rows, [](const HardErrors& row) { return row.figures.pairs == 0; });
  return rows;
}

}  // namespace boule::bench
