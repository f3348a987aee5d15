#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "core/math/ray.h"
#include "tests/support/hard_cases.h"

namespace boule::test {

/// A number that depends on every bit of what was put in, and on the order.
class BitHash {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15;
    state_ ^= state_ >> 29;
  }
  /// All NaN count as one: no processor promises a payload.
  void add(double value) {
    add(value != value ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value));
  }
  void add(float value) { add(double{value}); }
  void add(std::int32_t value) { add(static_cast<std::uint64_t>(value)); }
  template <class T>
  void add(const Vec3<T>& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void add(const Ray& ray) {
    add(ray.org);
    add(ray.dir);
    add(ray.tmin);
    add(ray.tmax);
    add(ray.source);
    add(std::int32_t{ray.inside});
  }
  void add(const std::vector<Hit>& hits) {
    for (const Hit& hit : hits) {
      add(hit.t);
      add(hit.id);
    }
  }
  void add(const HardCase& hard_case) {
    for (const Sphere& sphere : hard_case.spheres) {
      add(sphere.center);
      add(sphere.radius);
    }
    for (const Plane& plane : hard_case.planes) {
      add(plane.point);
      add(plane.normal);
    }
    for (const Ray& ray : hard_case.rays) add(ray);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace boule::test
