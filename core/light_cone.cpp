#include "core/light_cone.h"

#include <algorithm>
#include <cmath>

#include "core/math/geometry.h"
#include "core/math/warp.h"

namespace boule {

LightCone::LightCone(const Vec3d& point, const Vec3d& center, double radius)
    : point_(point), axis_(center - point), distance_(length(axis_)), radius_(radius) {
  if (!(distance_ > radius)) return;
  axis_ = axis_ * (1 / distance_);
  const double sine = radius / distance_;
  height_ = sine * sine / (1 + std::sqrt(1 - sine * sine));  // no cancellation
  if (height_ > 0) density_ = cone_density(height_);
}

Vec3d LightCone::direction(const UnitPair& numbers) const {
  return direction_about(axis_, warp_to_cone(numbers.u, height_), numbers.v);
}

bool LightCone::meets(const Vec3d& direction, double distance) const {
  if (!(density_ > 0) || !(dot(direction, axis_) > 0)) return false;
  const Vec3d aside = cross(direction, axis_) * distance_;
  const double squared = dot(aside, aside);
  return squared <= radius_ * radius_ && distance_to(std::sqrt(squared)) < distance;
}

double LightCone::distance_to(double aside) const {
  const double along = std::sqrt(std::max(0.0, distance_ * distance_ - aside * aside));
  return along - std::sqrt(std::max(0.0, radius_ * radius_ - aside * aside));
}

Ray LightCone::way(const Vec3d& direction) const {
  // Rounding turns the direction by up to u, so the line passes the centre by up to u distance
  // nearer; twice that is taken. The nearer it passes, the earlier it meets the sphere.
  const Vec3d aside = cross(direction, axis_) * distance_;
  const double nearest = std::max(0.0, length(aside) - 2 * unit_roundoff * distance_);
  Ray ray{point_, vec_cast<float>(direction)};
  ray.tmax = static_cast<float>(distance_to(nearest) * (1 - 4 * unit_roundoff));
  return ray;
}

}  // namespace boule
