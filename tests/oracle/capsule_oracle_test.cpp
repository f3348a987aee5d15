// Hard cases of capsules, judged in 1400 bits: wrong decisions, ulp of t, distance from the
// surface. BOULE_HARD_RAYS sets the rays per row and parameter.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "tests/oracle/hard_figures.h"
#include "tests/oracle/oracle.h"
#include "tests/support/hard_capsules.h"
#include "tests/support/test_size.h"

#include <gtest/gtest.h>

namespace boule::test {
namespace {

struct CapsuleFigures {
  std::size_t hits = 0, wrong_decisions = 0, wrong_roots = 0;
  double max_clear_ulp = 0;   ///< of t in float, where |t||d| |cos| > 2^-20 scale
  double max_residual64 = 0;  ///< of t in double, in 2^-48 scale

  void add(const Ray& ray, const Capsule& capsule, double t) {
    const auto truth = oracle_hit(ray, capsule);
    if (std::isfinite(t) != truth.has_value()) ++wrong_decisions;
    if (!std::isfinite(t) || !truth) return;
    ++hits;
    const BigFloat error = abs(BigFloat(t) - truth->t);
    if (truth->other && abs(BigFloat(t) - *truth->other) < error) ++wrong_roots;
    const double exact_t = truth->t.to_double();
    const double speed = length(vec_cast<double>(ray.dir));
    const Vec3d f = vec_cast<double>(capsule.a) - ray.org;
    const Vec3d u = vec_cast<double>(capsule.b) - vec_cast<double>(capsule.a);
    const double scale = std::fmax(std::fmax(length(f), length(u)), double{capsule.radius});
    if (std::fabs(exact_t) * speed * cosine(ray, capsule, exact_t) > 0x1p-20 * scale) {
      const auto float_t = double{static_cast<float>(t)};
      const double off = abs(BigFloat(float_t) - truth->t).to_double();
      max_clear_ulp = std::fmax(max_clear_ulp, off / ulp_of(exact_t));
    }
    const double residual = oracle_residual(ray, capsule, t).to_double();
    max_residual64 = std::fmax(max_residual64, std::fabs(residual) / (0x1p-48 * scale));
  }

 private:
  /// Of the ray and the surface that it meets at t.
  static double cosine(const Ray& ray, const Capsule& capsule, double t) {
    const Vec3d d = vec_cast<double>(ray.dir), p = ray.org + d * t;
    const Vec3d a = vec_cast<double>(capsule.a), u = vec_cast<double>(capsule.b) - a;
    const double uu = dot(u, u), s = uu > 0 ? std::clamp(dot(p - a, u) / uu, 0.0, 1.0) : 0;
    return std::fabs(dot(normalize(p - (a + u * s)), normalize(d)));
  }
};

class CapsuleOracle : public testing::TestWithParam<CapsuleCaseSpec> {};
INSTANTIATE_TEST_SUITE_P(HardRows, CapsuleOracle, testing::ValuesIn(capsule_case_specs()),
                         [](const auto& tested) { return name_of(tested.param); });

TEST_P(CapsuleOracle, TheScalarPathIsRight) {
  const std::size_t rays = test_size("BOULE_HARD_RAYS", 640);
  const CapsuleCase all = make_capsule_case(GetParam(), (rays + 63) / 64, rays);
  CapsuleFigures figures;
  for (std::size_t i = 0; i < rays; ++i) {
    const Capsule& capsule = all.capsules[i % all.capsules.size()];
    figures.add(all.rays[i], capsule, reference::intersect(all.rays[i], capsule, false));
  }
  std::printf("%-8s %6zu hits, wrong %zu %zu, clear ulp %.4g, residual %.3g * 2^-48 scale\n",
              name_of(GetParam()).c_str(), figures.hits, figures.wrong_decisions,
              figures.wrong_roots, figures.max_clear_ulp, figures.max_residual64);
  EXPECT_GT(figures.hits, rays / 10);
  EXPECT_EQ(figures.wrong_decisions, 0U);
  EXPECT_EQ(figures.wrong_roots, 0U);
  EXPECT_LE(figures.max_clear_ulp, 0.52);
  EXPECT_LE(figures.max_residual64, 1);
}

}  // namespace
}  // namespace boule::test
