#include "bench/peers/oracle_judge.h"

#include <algorithm>

#include "bench/peers/judge.h"

#ifdef BOULE_HAS_MPFR
#include "tests/oracle/oracle.h"
#endif

namespace boule::bench {

#ifdef BOULE_HAS_MPFR

/// The nearest of all primitives, exactly; equal t: the lower id. The one that a ray leaves on its
/// outside, which is convex, is none of them.
const Hit& OracleJudge::nearest(std::size_t index) {
  const auto [entry, is_new] = nearest_.try_emplace(index);
  Hit& nearest = entry->second;
  if (!is_new) return nearest;
  const Ray ray = workload_.rays->get(index);
  std::optional<test::BigFloat> nearest_t;
  tree_.for_each_candidate(ray, [&](std::int32_t id) {
    if (id == ray.source && !ray.inside) return;
    const auto hit = with_primitive(*workload_.scene, id, [&](const auto& primitive) {
      return test::oracle_hit(ray, primitive);
    });
    if (!hit) return;
    const bool closer = !nearest_t || hit->t < *nearest_t;
    const bool tie = !closer && hit->t <= *nearest_t && id < nearest.id;
    if (!closer && !tie) return;
    nearest_t = hit->t;
    nearest = {hit->t.to_double(), id};
  });
  return nearest;
}

std::optional<OracleVerdict> OracleJudge::judge(const Answers& answers,
                                                const std::vector<std::size_t>& rays) {
  constexpr std::size_t most = 1000;
  OracleVerdict verdict;
  verdict.judged = std::min(most, rays.size());
  for (std::size_t k = 0; k < verdict.judged; ++k) {
    const std::size_t i = rays[k * rays.size() / verdict.judged];
    const Hit& truth = nearest(i);
    const bool right =
        asks_any(workload_.kind)
            ? (answers.occluded[i] != 0) == (truth.id != no_primitive)
            : same_in_float(*workload_.scene, workload_.rays->get(i), answers.hits[i], truth);
    if (!right) ++verdict.wrong;
  }
  return verdict;
}

#else

std::optional<OracleVerdict> OracleJudge::judge(const Answers&, const std::vector<std::size_t>&) {
  return std::nullopt;
}

#endif

}  // namespace boule::bench
