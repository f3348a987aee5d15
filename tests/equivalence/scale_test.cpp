// Units do not matter: a scene or a direction scaled by a power of two has the same hits, and the
// same mantissas in every t.
#include <cmath>

#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

constexpr int exponents[] = {-60, -40, -20, -7, 7, 20, 40, 60};

float scaled(float x, int k) { return std::ldexp(x, k); }
double scaled(double x, int k) { return std::ldexp(x, k); }
Vec3f scaled(const Vec3f& v, int k) { return {scaled(v.x, k), scaled(v.y, k), scaled(v.z, k)}; }

/// Everything that is a length times 2^k.
HardCase scaled_scene(HardCase scene, int k) {
  for (Sphere& sphere : scene.spheres) {
    sphere.center = scaled(sphere.center, k);
    sphere.radius = scaled(sphere.radius, k);
  }
  for (Plane& plane : scene.planes) plane.point = scaled(plane.point, k);
  for (Ray& ray : scene.rays) {
    ray.org = ray.org * std::ldexp(1.0, k);
    ray.tmin = scaled(ray.tmin, k);
    ray.tmax = scaled(ray.tmax, k);
  }
  return scene;
}

HardCase scaled_directions(HardCase scene, int k) {
  for (Ray& ray : scene.rays) {
    ray.dir = scaled(ray.dir, k);
    ray.tmin = scaled(ray.tmin, -k);
    ray.tmax = scaled(ray.tmax, -k);
  }
  return scene;
}

HardCase scaled_normals(HardCase scene, int k) {
  for (Plane& plane : scene.planes) plane.normal = scaled(plane.normal, k);
  return scene;
}

/// Rows in ordinary units, whose numbers stay normal floats at every scale.
std::vector<HardCase> cases() {
  std::vector<HardCase> all;
  for (const HardCaseSpec& spec : {HardCaseSpec{"S0"},
                                   {"S1", 4},
                                   {"S2", 5},
                                   {"S4", 16},
                                   {"S5", 0},
                                   {"S6", 12},
                                   {"S10", 5},
                                   {"P0"},
                                   {"P1", 20},
                                   {"P2", 3},
                                   {"L", 3}})
    all.push_back(make_hard_case(spec, 31, 310));
  return all;
}

class Scale : public OnEachIsa {
 protected:
  [[nodiscard]] std::vector<Hit> hits_of(const HardCase& scene, Form form) const {
    const Geometry geometry(scene.spheres, scene.planes);
    return run_closest(*kernels, geometry.view(), scene.rays,
                       {Solver::robust, form, Coherence::none});
  }
  /// Every t of `scene` is that of `original` times 2^t_exponent, every id the same.
  void expect_scaled(const HardCase& original, const HardCase& scene, int t_exponent) const {
    for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
      const auto expected = hits_of(original, form), hits = hits_of(scene, form);
      std::size_t met = 0;
      for (std::size_t i = 0; i < hits.size(); ++i) {
        met += expected[i].id >= 0 ? 1U : 0U;
        const Hit wanted{std::ldexp(expected[i].t, t_exponent), expected[i].id};
        ASSERT_TRUE(same_bits(hits[i], wanted)) << i << " 2^" << t_exponent;
      }
      ASSERT_GT(met, hits.size() / 10);
    }
  }
};

TEST_P(Scale, OfTheSceneScalesT) {
  for (const HardCase& scene : cases())
    for (const int k : exponents) expect_scaled(scene, scaled_scene(scene, k), k);
}

TEST_P(Scale, OfDirectionsDividesT) {
  for (const HardCase& scene : cases())
    for (const int k : exponents) expect_scaled(scene, scaled_directions(scene, k), -k);
}

TEST_P(Scale, OfPlaneNormalsDoesNotMatter) {
  for (const HardCase& scene : cases())
    for (const int k : exponents) expect_scaled(scene, scaled_normals(scene, k), 0);
}

INSTANTIATE_TEST_SUITE_P(Tables, Scale, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
