// The conservative reject of the kernels, with less slack than is shipped. With 24, and with the 17
// that the proof needs, no hit may be lost; with 2 some must be, or the test could not see a
// mistake. The slack is taken away through the data, r2p and the reject radius.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_size.h"

namespace boule::test::reject_sweep {
namespace {

constexpr double u = unit_roundoff;
constexpr double shipped = 24;

struct Pair {
  Sphere sphere;
  Ray ray;
};

std::size_t rays_per_case() { return test_size("BOULE_HARD_RAYS", 400); }

/// The hits among the rows that are a sphere and a ray from afar.
std::vector<Pair> hits_of_rows(const std::vector<std::string>& rows) {
  std::vector<Pair> pairs;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    if (std::find(rows.begin(), rows.end(), spec.row) == rows.end()) continue;
    const HardCase all = make_hard_case(spec, 50, rays_per_case());
    for (std::size_t i = 0; i < all.rays.size(); ++i) {
      const Pair pair{all.spheres[i % all.spheres.size()], all.rays[i]};
      if (std::isfinite(reference::intersect(pair.ray, pair.sphere, false))) pairs.push_back(pair);
    }
  }
  return pairs;
}

/// A geometry of one sphere whose numbers for the reject can be replaced.
class OneSphere {
 public:
  explicit OneSphere(const Sphere& sphere)
      : geometry_({sphere}, {}), squared_(1, -std::numeric_limits<float>::infinity()), radius_(1) {
    squared_[0] = geometry_.view().spheres.reject_squared[0];
    radius_[0] = geometry_.view().spheres.reject_radius[0];
  }
  float& reject_squared() { return squared_[0]; }
  float& reject_radius() { return radius_[0]; }
  [[nodiscard]] bool is_lost(const KernelTable& kernels, const Ray& ray) const {
    GeometryView view = geometry_.view();
    view.spheres.reject_squared = squared_.data();
    view.spheres.reject_radius = radius_.data();
    const Query query{Solver::robust, Form::packet, Coherence::none};
    return run_closest(kernels, view, {ray}, query)[0].id == no_primitive;
  }

 private:
  Geometry geometry_;
  AlignedArray<float> squared_, radius_;
};

/// The r2p with which the reject has `slack` in all. (A part of the shipped slack is in h.)
float weakened(const Pair& pair, double slack) {
  const Vec3d f = vec_cast<double>(pair.sphere.center) - pair.ray.org;
  const double b = dot(f, normalize(vec_cast<double>(pair.ray.dir)));
  const double r = pair.sphere.radius;
  return static_cast<float>(r * r * (1 + slack * u) - (shipped - slack) * u * b * b);
}

class RejectSweep : public OnEachIsa {};

TEST_P(RejectSweep, SlackIsSufficientAndNecessary) {
  const std::vector<Pair> pairs =
      hits_of_rows({"S0", "S1", "S2", "S3", "S4", "S4b", "S6", "S8", "S10"});
  ASSERT_GT(pairs.size(), 20 * rays_per_case());
  const auto count_lost = [&](double slack) {
    std::size_t lost = 0;
    for (const Pair& pair : pairs) {
      OneSphere sphere(pair.sphere);
      sphere.reject_squared() = weakened(pair, slack);
      lost += sphere.is_lost(*kernels, pair.ray) ? 1U : 0U;
    }
    return lost;
  };
  std::printf("%s, %zu hits; lost with slack", GetParam().c_str(), pairs.size());
  for (const double slack : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 17.0, shipped}) {
    const std::size_t lost = count_lost(slack);
    std::printf(" %g: %zu", slack, lost);
    if (slack <= 2) {
      EXPECT_GT(lost, 0U) << slack;
    }
    if (slack >= 17) {
      EXPECT_EQ(lost, 0U) << slack;
    }
  }
  std::printf("\n");
}

/// Origins that no float holds: the sphere grows by the rounding error of the origin.
TEST_P(RejectSweep, SpheresGrowByTheOriginsError) {
  CaseRandom random(77);
  std::vector<Pair> pairs;
  while (pairs.size() < 10 * rays_per_case()) {
    const double far = random.decade(2, 7);
    const Vec3d at = random.direction() * far;
    const Vec3d view = random.direction();
    const Vec3d across = random.perpendicular(view);
    const double beta = 1 - random.decade(-6, 0);
    Pair pair{{vec_cast<float>(at), 1, 0}, {}};
    pair.ray.org = vec_cast<double>(pair.sphere.center) - view * 10.0 + across * beta;
    pair.ray.dir = vec_cast<float>(view);
    if (std::isfinite(reference::intersect(pair.ray, pair.sphere, false))) pairs.push_back(pair);
  }
  std::printf("%s, %zu hits; lost with a share of the error", GetParam().c_str(), pairs.size());
  for (const double share : {0.0, 0.25, 0.5, 0.6, 0.8, 1.0}) {
    std::size_t lost = 0;
    for (const Pair& pair : pairs) {
      const Vec3d error = pair.ray.org - vec_cast<double>(vec_cast<float>(pair.ray.org));
      const double sum = std::fabs(error.x) + std::fabs(error.y) + std::fabs(error.z);
      OneSphere sphere(pair.sphere);
      sphere.reject_radius() += static_cast<float>((share - 1) * sum);
      lost += sphere.is_lost(*kernels, pair.ray) ? 1U : 0U;
    }
    std::printf(" %g: %zu", share, lost);
    if (share <= 0.5) {
      EXPECT_GT(lost, 0U) << share;
    }
    if (share == 1) {
      EXPECT_EQ(lost, 0U);
    }
  }
  std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(Tables, RejectSweep, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::reject_sweep
