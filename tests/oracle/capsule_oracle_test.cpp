// Hard cases of capsules, judged in 1400 bits: wrong decisions, ulp of t, distance from the
// surface. BOULE_HARD_RAYS sets the rays per row and parameter.
#include <cstdio>

#include "core/reference.h"
#include "tests/oracle/hard_figures.h"
#include "tests/oracle/oracle.h"
#include "tests/support/hard_capsules.h"
#include "tests/support/test_size.h"

#include <gtest/gtest.h>

namespace boule::test {
namespace {

class CapsuleOracle : public testing::TestWithParam<CapsuleCaseSpec> {};
INSTANTIATE_TEST_SUITE_P(HardRows, CapsuleOracle, testing::ValuesIn(capsule_case_specs()),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(CapsuleOracle, TheScalarPathIsRight) {
  const std::size_t rays = test_size("BOULE_HARD_RAYS", 640);
  const CapsuleCase all = make_capsule_case(GetParam(), (rays + 63) / 64, rays);
  HardFigures figures;
  for (std::size_t i = 0; i < rays; ++i) {
    const Capsule& capsule = all.capsules[i % all.capsules.size()];
    const Ray& ray = all.rays[i];
    const double t = reference::intersect(ray, capsule, false);
    figures.add(ray, capsule, t, oracle_hit(ray, capsule));
  }
  std::printf("%-8s %6zu hits, wrong %zu %zu, clear ulp %.4g, residual %.3g * 2^-48 scale\n",
              name_of(GetParam()).c_str(), figures.hits, figures.wrong_decisions,
              figures.wrong_roots, figures.max_clear_ulp, figures.max_residual64);
  EXPECT_GT(figures.hits, rays / 10);
  EXPECT_EQ(figures.wrong_decisions, 0U);
  EXPECT_EQ(figures.wrong_roots, 0U);
  EXPECT_LE(figures.max_clear_ulp, 0.52);
  EXPECT_LE(figures.max_residual64, 1);
  EXPECT_LE(figures.max_excess, 1);
}

}  // namespace
}  // namespace boule::test
