#include "tests/oracle/hard_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"

namespace boule::test {

double ulp_of(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, std::max(exponent - 24, -149));
}

namespace {

/// max(F, r); F without overflow.
double scale_of(const Ray& ray, const Sphere& sphere) {
  const Vec3d f = vec_cast<double>(sphere.center) - ray.org;
  return std::fmax(std::hypot(f.x, f.y, f.z), std::fabs(double{sphere.radius}));
}
double scale_of(const Ray& ray, const Plane& plane) {
  const Vec3d f = vec_cast<double>(plane.point) - ray.org;
  return std::hypot(f.x, f.y, f.z);
}
double scale_of(const Ray& ray, const Capsule& capsule) {
  const Vec3d a = vec_cast<double>(capsule.a), f = a - ray.org, u = vec_cast<double>(capsule.b) - a;
  return std::max({length(f), length(u), double{capsule.radius}});
}

/// Whether t is well-posed: see max_clear_ulp.
bool is_clear(const Ray& ray, const Sphere& sphere, const OracleHit& truth) {
  const double speed = length(vec_cast<double>(ray.dir)), scale = scale_of(ray, sphere);
  const double t = std::fabs(truth.t.to_double()) * speed;
  const double other = std::fabs(truth.other->to_double()) * speed;
  const double half_chord = 0.5 * std::fabs((*truth.other - truth.t).to_double()) * speed;
  return half_chord * t > 0x1p-21 * std::fabs(double{sphere.radius}) * scale &&
         t * other > 0x1p-22 * scale * scale;
}
bool is_clear(const Ray&, const Plane&, const OracleHit&) { return true; }
bool is_clear(const Ray& ray, const Capsule& capsule, const OracleHit& truth) {
  const double t = truth.t.to_double();
  const Vec3d d = vec_cast<double>(ray.dir), p = ray.org + d * t;
  const Vec3d a = vec_cast<double>(capsule.a), u = vec_cast<double>(capsule.b) - a;
  const double uu = dot(u, u), s = uu > 0 ? std::clamp(dot(p - a, u) / uu, 0.0, 1.0) : 0;
  const double across = std::fabs(dot(normalize(p - (a + u * s)), d));  // |d| cos
  return std::fabs(t) * across > 0x1p-20 * scale_of(ray, capsule);
}

}  // namespace

template <class Primitive>
void HardFigures::add(const Ray& ray, const Primitive& primitive, double t,
                      const std::optional<OracleHit>& truth) {
  ++pairs;
  const bool hit = std::isfinite(t);
  if (hit != truth.has_value()) ++wrong_decisions;
  if (!hit || !truth) return;
  ++hits;
  const BigFloat error = abs(BigFloat(t) - truth->t);
  if (truth->other && abs(BigFloat(t) - *truth->other) < error) ++wrong_roots;

  const double exact_t = truth->t.to_double();
  const auto float_t = double{static_cast<float>(t)};
  const double ulp = ulp_of(exact_t);
  const double ulps = (abs(BigFloat(float_t) - truth->t) / BigFloat(ulp)).to_double();
  ulps_.push_back(ulps);

  const Vec3d d = vec_cast<double>(ray.dir);
  const double speed = length(d), scale = scale_of(ray, primitive);
  if (std::fabs(exact_t) * speed > 0x1p-20 * scale) {
    max_far_ulp = std::fmax(max_far_ulp, ulps);
    if (is_clear(ray, primitive, *truth)) max_clear_ulp = std::fmax(max_clear_ulp, ulps);
  }
  const double residual = std::fabs(oracle_residual(ray, primitive, float_t).to_double());
  const double residual64 = std::fabs(oracle_residual(ray, primitive, t).to_double());
  max_residual = std::fmax(max_residual, residual / (0x1p-24 * scale));
  max_residual64 = std::fmax(max_residual64, residual64 / (0x1p-48 * scale));
  const double allowed = 0.5 * ulp_of(float_t) * speed + 0x1p-48 * scale;
  max_excess = std::fmax(max_excess, residual / allowed);
}

template void HardFigures::add(const Ray&, const Sphere&, double, const std::optional<OracleHit>&);
template void HardFigures::add(const Ray&, const Plane&, double, const std::optional<OracleHit>&);
template void HardFigures::add(const Ray&, const Capsule&, double, const std::optional<OracleHit>&);

double HardFigures::ulp_quantile(double p) {
  if (ulps_.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(p * static_cast<double>(ulps_.size() - 1));
  std::nth_element(ulps_.begin(), ulps_.begin() + at, ulps_.end());
  return ulps_[static_cast<std::size_t>(at)];
}

}  // namespace boule::test
