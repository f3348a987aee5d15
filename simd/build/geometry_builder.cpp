#include "simd/build/geometry_builder.h"

#include <cmath>
#include <limits>

#include "simd/abi/filter_bounds.h"

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

float round_up(double x) {
  const auto nearest = static_cast<float>(x);
  return double{nearest} < x ? std::nextafter(nearest, inf) : nearest;
}

bool filter_applies(const Sphere& s) {
  for (const float x : {s.center.x, s.center.y, s.center.z, s.radius}) {
    if (!(std::fabs(x) < filter::limit)) return false;  // NaN as well
  }
  return true;
}

}  // namespace

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes)
    : sphere_count_(spheres.size()),
      plane_count_(planes.size()),
      // Padding: a sphere of radius NaN is missed by every exact solve; r2p = -inf makes the
      // filter reject it first.
      center_x_(sphere_count_),
      center_y_(sphere_count_),
      center_z_(sphere_count_),
      radius_(sphere_count_, nan),
      reject_squared_(sphere_count_, -inf),
      reject_radius_(sphere_count_),
      // Padding: a normal of 0 gives n.d = 0, a miss.
      point_x_(plane_count_),
      point_y_(plane_count_),
      point_z_(plane_count_),
      normal_x_(plane_count_),
      normal_y_(plane_count_),
      normal_z_(plane_count_) {
  for (std::size_t i = 0; i < sphere_count_; ++i) set_sphere(i, spheres[i]);
  for (std::size_t i = 0; i < plane_count_; ++i) set_plane(i, planes[i]);
}

void Geometry::set_sphere(std::size_t i, const Sphere& sphere) {
  center_x_[i] = sphere.center.x;
  center_y_[i] = sphere.center.y;
  center_z_[i] = sphere.center.z;
  radius_[i] = sphere.radius;
  if (!filter_applies(sphere)) {
    reject_squared_[i] = inf;
    reject_radius_[i] = inf;
    return;
  }
  const double r = std::fabs(double{sphere.radius});
  constexpr double outward = 1 + filter::slack * filter::u;
  reject_squared_[i] = round_up(r * r * outward + filter::squared_floor);
  reject_radius_[i] = round_up(r * outward + filter::floor);
}

void Geometry::set_plane(std::size_t i, const Plane& plane) {
  point_x_[i] = plane.point.x;
  point_y_[i] = plane.point.y;
  point_z_[i] = plane.point.z;
  normal_x_[i] = plane.normal.x;
  normal_y_[i] = plane.normal.y;
  normal_z_[i] = plane.normal.z;
}

GeometryView Geometry::view() const {
  GeometryView view{};
  view.spheres = {center_x_.data(),       center_y_.data(),      center_z_.data(), radius_.data(),
                  reject_squared_.data(), reject_radius_.data(), sphere_count_};
  view.planes = {point_x_.data(),  point_y_.data(),
                 point_z_.data(),  normal_x_.data(),
                 normal_y_.data(), normal_z_.data(),
                 plane_count_,     static_cast<std::int32_t>(sphere_count_)};
  return view;
}

}  // namespace boule
