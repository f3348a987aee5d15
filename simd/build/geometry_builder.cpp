#include "simd/build/geometry_builder.h"

#include <cmath>
#include <limits>
#include <utility>

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

bool wants_tree(std::size_t spheres, Structure structure) {
  constexpr std::size_t few = 64;
  return structure == Structure::bvh || (structure == Structure::automatic && spheres > few);
}

}  // namespace

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes,
                   Structure structure)
    : Geometry(
          spheres, planes,
          wants_tree(spheres.size(), structure) ? build_bvh(spheres) : no_bvh(spheres.size())) {}

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes, Bvh bvh)
    : nodes_(std::move(bvh.nodes)),
      sphere_count_(spheres.size()),
      slot_count_(bvh.slots.size()),
      scanned_(bvh.scanned),
      plane_count_(planes.size()),
      // Padding: a sphere of radius NaN is missed by every exact solve; r2p = -inf makes the
      // filter reject it first.
      id_(slot_count_, -2),
      center_x_(slot_count_),
      center_y_(slot_count_),
      center_z_(slot_count_),
      radius_(slot_count_, nan),
      reject_squared_(slot_count_, -inf),
      reject_radius_(slot_count_),
      // Padding: a normal of 0 gives n.d = 0, a miss.
      point_x_(plane_count_),
      point_y_(plane_count_),
      point_z_(plane_count_),
      normal_x_(plane_count_),
      normal_y_(plane_count_),
      normal_z_(plane_count_) {
  for (std::size_t slot = 0; slot < slot_count_; ++slot) {
    const std::int32_t id = bvh.slots[slot];
    if (id < 0) continue;
    id_[slot] = id;
    set_sphere(slot, spheres[static_cast<std::size_t>(id)]);
  }
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
  view.spheres = {center_x_.data(),
                  center_y_.data(),
                  center_z_.data(),
                  radius_.data(),
                  reject_squared_.data(),
                  reject_radius_.data(),
                  id_.data(),
                  slot_count_,
                  scanned_};
  view.planes = {point_x_.data(),  point_y_.data(),
                 point_z_.data(),  normal_x_.data(),
                 normal_y_.data(), normal_z_.data(),
                 plane_count_,     static_cast<std::int32_t>(sphere_count_)};
  view.bvh = {nodes_.data(), nodes_.size()};
  return view;
}

}  // namespace boule
