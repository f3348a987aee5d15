#include "simd/geometry/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/math/ray.h"
#include "simd/abi/filter_bounds.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/refit.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

float round_up(double x) {
  const auto nearest = static_cast<float>(x);
  return double{nearest} < x ? std::nextafter(nearest, inf) : nearest;
}

bool wants_tree(std::size_t spheres, Structure structure) {
  return structure == Structure::bvh ||
         (structure == Structure::automatic && spheres > tuning::most_scanned);
}

/// The largest absolute coordinate of any box of a tree.
float extent_of(const LargeArray<BvhNode>& nodes) {
  float extent = 0;
  if (nodes.empty()) return extent;
  const BvhNode& root = nodes[0];
  const float* const rows[] = {root.min_x, root.min_y, root.min_z,
                               root.max_x, root.max_y, root.max_z};
  for (const float* row : rows) {
    for (int k = 0; k < root.size; ++k) extent = std::max(extent, std::fabs(row[k]));
  }
  return extent;
}

/// The largest absolute coordinate of any sphere, rounded up. NaN is left out, because rays miss
/// it.
float extent_of(const LargeArray<SphereBlock>& blocks) {
  float extent = 0;
  for (const SphereBlock& block : blocks) {
    for (const float* row : {block.center_x, block.center_y, block.center_z}) {
      for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
        const double end = std::fabs(double{row[k]}) + std::fabs(double{block.radius[k]});
        if (end > double{extent}) extent = round_up(end);
      }
    }
  }
  return extent;
}

/// A view of a tree, which must outlive it.
Bvh borrowed(const Bvh& tree) {
  const auto view = []<class T>(const LargeArray<T>& array) {
    return LargeArray<T>::borrowed(array.data(), array.size());
  };
  return {view(tree.nodes),  view(tree.slots),          tree.scanned,
          view(tree.blocks), tree.materials.borrowed(), tree.copies};
}

}  // namespace

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes,
                   Structure structure, const ParallelFor& parallel_for)
    : Geometry(wants_tree(spheres.size(), structure) ? build_bvh(spheres, parallel_for)
                                                     : no_bvh(spheres),
               spheres.size(), planes) {}

Geometry::Geometry(std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
                   Structure structure, const ParallelFor& parallel_for)
    : Geometry(std::size_t{spheres.size()}, std::move(spheres), planes, structure, parallel_for) {}

/// The number of spheres is read before they are consumed.
Geometry::Geometry(std::size_t count, std::vector<Sphere>&& spheres,
                   const std::vector<Plane>& planes, Structure structure,
                   const ParallelFor& parallel_for)
    : Geometry(wants_tree(count, structure) ? build_bvh(std::move(spheres), parallel_for)
                                            : no_bvh(spheres),
               count, planes) {
  std::vector<Sphere>().swap(spheres);
}

Geometry::Geometry(Bvh bvh, std::size_t spheres, const std::vector<Plane>& planes)
    : bvh_(std::move(bvh)),
      extent_(bvh_.nodes.empty() ? extent_of(bvh_.blocks) : extent_of(bvh_.nodes)),
      sphere_count_(spheres),
      plane_count_(planes.size()),
      // Padding: every exact solve misses a sphere of radius NaN, and with r2p = -inf the filter
      // rejects it before that.
      center_x_(bvh_.scanned),
      center_y_(bvh_.scanned),
      center_z_(bvh_.scanned),
      radius_(bvh_.scanned, nan),
      reject_squared_(bvh_.scanned, -inf),
      reject_radius_(bvh_.scanned),
      // Padding: a normal of 0 gives n.d = 0, a miss.
      point_x_(plane_count_),
      point_y_(plane_count_),
      point_z_(plane_count_),
      normal_x_(plane_count_),
      normal_y_(plane_count_),
      normal_z_(plane_count_) {
  for (std::size_t slot = 0; slot < bvh_.scanned; ++slot) {
    if (bvh_.slots[slot] >= 0) set_scanned(slot);
  }
  for (std::size_t i = 0; i < plane_count_; ++i) set_plane(i, planes[i]);
}

Geometry Geometry::of_parts(std::vector<GeometryPart> parts, const std::vector<Plane>& planes) {
  Geometry geometry(no_bvh({}), 0, planes);
  geometry.parts_ = std::make_shared<const GeometryParts>(std::move(parts));
  geometry.sphere_count_ = geometry.parts_->sphere_count();
  geometry.bvh_.copies = geometry.parts_->copies();
  return geometry;
}

Geometry::Geometry(std::shared_ptr<const Bvh> tree, std::size_t spheres,
                   const std::vector<Plane>& planes)
    : Geometry(borrowed(*tree), spheres, planes) {
  tree_ = std::move(tree);
}

void Geometry::add_capsules(const std::vector<Capsule>& capsules, const ParallelFor& parallel_for) {
  if (capsules.empty()) return;
  const auto first = static_cast<std::uint32_t>(sphere_count_ + plane_count_);
  capsules_ =
      std::make_shared<const CapsuleTree>(capsules, static_cast<std::int32_t>(first), parallel_for);
}

bool Geometry::refit(std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  if (!owns_spheres() || bvh_.nodes.empty() || !boule::refit(bvh_, spheres, parallel_for))
    return false;
  extent_ = extent_of(bvh_.nodes);
  for (std::size_t slot = 0; slot < bvh_.scanned; ++slot) {
    if (bvh_.slots[slot] >= 0) set_scanned(slot);
  }
  return true;
}

Geometry Geometry::with_spheres(std::vector<Sphere> spheres,
                                const ParallelFor& parallel_for) const {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < plane_count_; ++i)
    planes.push_back(plane(static_cast<std::int32_t>(sphere_count_ + i)));
  Geometry made(std::move(spheres), planes, Structure::automatic, parallel_for);
  made.capsules_ = capsules_;
  return made;
}

double Geometry::cost() const { return tree_cost(bvh_); }

std::vector<Sphere> Geometry::spheres() const {
  std::vector<Sphere> spheres(sphere_count_);
  for (std::size_t slot = 0; slot < bvh_.slots.size(); ++slot) {
    const std::int32_t id = bvh_.slots[slot];
    if (id >= 0) spheres[static_cast<std::size_t>(id)] = sphere(static_cast<std::uint32_t>(slot));
  }
  for (const SphereCopy& copy : bvh_.copies)
    spheres[static_cast<std::size_t>(copy.id)] = spheres[static_cast<std::size_t>(copy.first)];
  return spheres;
}

Sphere Geometry::sphere(std::uint32_t slot) const {
  if (parts_) return parts_->sphere(slot);
  const SphereBlock& block = bvh_.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {{block.center_x[k], block.center_y[k], block.center_z[k]},
          block.radius[k],
          bvh_.materials[slot]};
}

std::span<const SphereCopy> Geometry::copies_of(std::int32_t id) const {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  const auto& all = bvh_.copies;
  const auto first = std::lower_bound(all.begin(), all.end(), SphereCopy{id, least, least});
  const auto end =
      std::find_if(first, all.end(), [id](const auto& one) { return one.first != id; });
  return {first, end};
}

Plane Geometry::plane(std::int32_t id) const {
  const std::size_t i = static_cast<std::uint32_t>(id) - sphere_count_;
  return {{point_x_[i], point_y_[i], point_z_[i]}, {normal_x_[i], normal_y_[i], normal_z_[i]}};
}

void Geometry::set_scanned(std::size_t i) {
  const Sphere sphere = this->sphere(static_cast<std::uint32_t>(i));
  center_x_[i] = sphere.center.x;
  center_y_[i] = sphere.center.y;
  center_z_[i] = sphere.center.z;
  radius_[i] = sphere.radius;
  if (!in_filter_range(sphere)) {
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
  view.spheres = {.center_x = center_x_.data(),
                  .center_y = center_y_.data(),
                  .center_z = center_z_.data(),
                  .radius = radius_.data(),
                  .reject_squared = reject_squared_.data(),
                  .reject_radius = reject_radius_.data(),
                  .scanned = bvh_.scanned,
                  .blocks = bvh_.blocks.data(),
                  .block_count = bvh_.blocks.size(),
                  .id = bvh_.slots.data()};
  view.planes = {.point_x = point_x_.data(),
                 .point_y = point_y_.data(),
                 .point_z = point_z_.data(),
                 .normal_x = normal_x_.data(),
                 .normal_y = normal_y_.data(),
                 .normal_z = normal_z_.data(),
                 .size = plane_count_,
                 .first_id = static_cast<std::int32_t>(static_cast<std::uint32_t>(sphere_count_))};
  view.bvh = {bvh_.nodes.data(), bvh_.nodes.size(), extent_};
  if (parts_) {
    view.parts = parts_->view();
    view.bvh = parts_->bvh();
  }
  if (capsules_) view.capsules = capsules_->view();
  return view;
}

}  // namespace boule
