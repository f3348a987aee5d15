// Solver fast is judged by its band: a wrong hit or miss only within 3u max(F, r) of the rim.
#include <cmath>

#include "core/math/geometry.h"
#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

/// How far hit or miss is from changing, in units of u max(F, r): the distance of the line from the
/// rim, or of the origin from the surface. Double is exact enough to judge float.
double rim_distance(const Ray& ray, const Sphere& sphere) {
  const Vec3d d = vec_cast<double>(ray.dir);
  const Vec3d f = vec_cast<double>(sphere.center) - ray.org;
  const Vec3d l = f - d * (dot(f, d) / dot(d, d));
  const double r = double{sphere.radius};
  const double scale = unit_roundoff * std::fmax(length(f), r);
  return std::fmin(std::fabs(length(l) - r), std::fabs(length(f) - r)) / scale;
}

/// Distance of o + t d from the surface, in units of u max(F, r).
double residual(const Ray& ray, const Sphere& sphere, double t) {
  const Vec3d f = vec_cast<double>(sphere.center) - ray.org;
  const double off = length(vec_cast<double>(ray.dir) * t - f) - double{sphere.radius};
  return std::fabs(off) / (unit_roundoff * std::fmax(length(f), double{sphere.radius}));
}

/// Rows on which the band is promised: rays that leave no surface, and sizes whose squares float
/// can hold.
bool has_band(const HardCaseSpec& spec) {
  const std::string row = spec.row;
  const bool scaled = row == "S9" || row == "P4" || row == "P6";
  return row != "S12" && row != "S13" && !leaves_surfaces(spec) &&
         !(scaled && std::abs(spec.k) >= 18);
}

class FastBand : public OnEachIsa {};

TEST_P(FastBand, SphereErrorsLieNearTheRim) {
  double worst_decision = 0, worst_residual = 0;
  std::size_t hits_seen = 0;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    if (spec.row[0] != 'S' || !has_band(spec)) continue;
    const HardCase all = make_hard_case(spec, 1, 2000);
    const Geometry geometry(all.spheres, {});
    std::vector<Ray> rays = all.rays;
    for (Ray& ray : rays) {  // whole rays: the band speaks of the surface, not of tmin and tmax
      ray.tmin = 0;
      ray.tmax = std::numeric_limits<float>::infinity();
    }
    for (const Form form : {Form::packet, Form::single}) {
      const auto hits =
          run_closest(*kernels, geometry.view(), rays, {Solver::fast, form, Coherence::none});
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit exact = reference::closest_hit(rays[i], all.spheres, {});
        if ((hits[i].id < 0) != (exact.id < 0)) {
          worst_decision = std::fmax(worst_decision, rim_distance(rays[i], all.spheres[0]));
        } else if (exact.id == 0) {
          ++hits_seen;
          worst_residual = std::fmax(worst_residual, residual(rays[i], all.spheres[0], hits[i].t));
        }
      }
    }
  }
  RecordProperty("worst_decision_in_u", std::to_string(worst_decision));
  RecordProperty("worst_residual_in_u", std::to_string(worst_residual));
  std::printf("worst decision %.3f u, worst residual %.3f u\n", worst_decision, worst_residual);
  EXPECT_GT(hits_seen, 50000U);
  EXPECT_LE(worst_decision, 3);
  EXPECT_LE(worst_residual, 6);
}

TEST_P(FastBand, PlaneErrorsLieNearTheHorizon) {
  double worst = 0;
  for (const HardCaseSpec& spec : hard_case_specs()) {
    if (spec.row[0] != 'P' || !has_band(spec)) continue;
    const HardCase all = make_hard_case(spec, 1, 2000);
    const Geometry geometry({}, all.planes);
    const Vec3d n = normalize(vec_cast<double>(all.planes[0].normal));
    std::vector<Ray> rays = all.rays;
    for (Ray& ray : rays) ray.tmax = std::numeric_limits<float>::infinity();
    for (const Form form : {Form::packet, Form::single}) {
      const auto hits =
          run_closest(*kernels, geometry.view(), rays, {Solver::fast, form, Coherence::none});
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit exact = reference::closest_hit(rays[i], {}, all.planes);
        if (hits[i].id == exact.id) continue;
        // Wrong only where the sign of the height or of n.d is within rounding of 0.
        const Vec3d f = vec_cast<double>(all.planes[0].point) - rays[i].org;
        const Vec3d d = normalize(vec_cast<double>(rays[i].dir));
        const double scale = length(vec_cast<double>(all.planes[0].point)) + length(f);
        const double height = std::fabs(dot(f, n)) / (unit_roundoff * scale);
        const double slope = std::fabs(dot(d, n)) / unit_roundoff;
        worst = std::fmax(worst, std::fmin(height, slope));
      }
    }
  }
  std::printf("worst plane decision %.3f u\n", worst);
  EXPECT_LE(worst, 4);
}

INSTANTIATE_TEST_SUITE_P(Tables, FastBand, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
