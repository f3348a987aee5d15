#include "core/scene/axis_extremes.h"

#include <cstddef>

namespace boule {
namespace {

/// By `measure` of AxisExtremes: a number that is smallest for the outermost sphere.
double depth_of(const Sphere& s, std::size_t measure) {
  const auto radius = static_cast<double>(s.radius);
  if (measure == 0) return -radius;
  const std::size_t axis = (measure - 1) / 4, kind = (measure - 1) % 4;
  const double along = static_cast<double>(axis == 0   ? s.center.x
                                           : axis == 1 ? s.center.y
                                                       : s.center.z);
  const double inward = kind % 2 == 0 ? along : -along;
  return kind < 2 ? inward : inward - radius;
}

}  // namespace

void AxisExtremes::add(const Sphere& sphere) {
  for (std::size_t i = 0; i < size; ++i) {
    if (!least_[i] || depth_of(sphere, i) < depth_of(*least_[i], i)) least_[i] = sphere;
  }
}

void AxisExtremes::add(const AxisExtremes& later) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::optional<Sphere>& one = later.least_[i];
    if (one && (!least_[i] || depth_of(*one, i) < depth_of(*least_[i], i))) least_[i] = one;
  }
}

std::vector<Sphere> AxisExtremes::spheres() const {
  std::vector<Sphere> all;
  for (const std::optional<Sphere>& one : least_) {
    if (one) all.push_back(*one);
  }
  return all;
}

}  // namespace boule
