#include "simd/geometry/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/math/ray.h"
#include "simd/abi/filter_bounds.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// The id of a slot that holds no sphere: no ray's source, not even that of a ray that leaves
/// nothing, which is no_primitive.
constexpr std::int32_t empty_slot = no_primitive - 1;

float round_up(double x) {
  const auto nearest = static_cast<float>(x);
  return double{nearest} < x ? std::nextafter(nearest, inf) : nearest;
}

bool wants_tree(std::size_t spheres, Structure structure) {
  return structure == Structure::bvh ||
         (structure == Structure::automatic && spheres > tuning::most_scanned);
}

/// What the spheres are made of, by their slots.
SlotMaterials slot_materials(const std::vector<Sphere>& spheres,
                             const std::vector<std::int32_t>& slots) {
  const auto differs = [&](const Sphere& s) { return !(s.material == spheres[0].material); };
  if (spheres.empty()) return SlotMaterials();
  if (std::none_of(spheres.begin(), spheres.end(), differs))
    return SlotMaterials(spheres[0].material);
  AlignedArray<MaterialRef> by_slot(slots.size());
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    if (slots[slot] >= 0) by_slot[slot] = spheres[static_cast<std::size_t>(slots[slot])].material;
  }
  return SlotMaterials(std::move(by_slot));
}

/// The greatest coordinate of any box of a tree, without its sign.
float extent_of(const std::vector<BvhNode>& nodes) {
  float extent = 0;
  if (nodes.empty()) return extent;
  const BvhNode& root = nodes.front();
  const float* const rows[] = {root.min_x, root.min_y, root.min_z,
                               root.max_x, root.max_y, root.max_z};
  for (const float* row : rows) {
    for (int k = 0; k < root.size; ++k) extent = std::max(extent, std::fabs(row[k]));
  }
  return extent;
}

}  // namespace

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes,
                   Structure structure, const ParallelFor& parallel_for)
    : Geometry(spheres, planes,
               wants_tree(spheres.size(), structure) ? build_bvh(spheres, parallel_for)
                                                     : no_bvh(spheres.size())) {}

Geometry::Geometry(std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
                   Structure structure, const ParallelFor& parallel_for)
    : Geometry(spheres, planes, structure, parallel_for) {
  std::vector<Sphere>().swap(spheres);
}

Geometry::Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes, Bvh bvh)
    : nodes_(std::move(bvh.nodes)),
      extent_(extent_of(nodes_)),
      sphere_count_(spheres.size()),
      scanned_(bvh.scanned),
      block_count_((bvh.slots.size() + bvh_leaf_size - 1) / bvh_leaf_size),
      plane_count_(planes.size()),
      // Padding: every exact solve misses a sphere of radius NaN, and with r2p = -inf the filter
      // rejects it before that.
      id_(bvh.slots.size(), empty_slot),
      blocks_(std::move(bvh.blocks)),
      materials_(slot_materials(spheres, bvh.slots)),
      center_x_(scanned_),
      center_y_(scanned_),
      center_z_(scanned_),
      radius_(scanned_, nan),
      reject_squared_(scanned_, -inf),
      reject_radius_(scanned_),
      // Padding: a normal of 0 gives n.d = 0, a miss.
      point_x_(plane_count_),
      point_y_(plane_count_),
      point_z_(plane_count_),
      normal_x_(plane_count_),
      normal_y_(plane_count_),
      normal_z_(plane_count_) {
  blocks_.resize(block_count_, empty_block());
  for (std::size_t slot = 0; slot < bvh.slots.size(); ++slot) {
    const std::int32_t id = bvh.slots[slot];
    if (id < 0) continue;
    id_[slot] = id;
    if (slot >= scanned_) continue;
    set_in_block(slot, spheres[static_cast<std::size_t>(id)]);
    set_scanned(slot, spheres[static_cast<std::size_t>(id)]);
  }
  for (std::size_t i = 0; i < plane_count_; ++i) set_plane(i, planes[i]);
}

Sphere Geometry::sphere(std::uint32_t slot) const {
  const SphereBlock& block = blocks_[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {
      {block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k], materials_[slot]};
}

void Geometry::set_in_block(std::size_t i, const Sphere& sphere) {
  SphereBlock& block = blocks_[i / bvh_leaf_size];
  const std::size_t k = i % bvh_leaf_size;
  block.center_x[k] = sphere.center.x;
  block.center_y[k] = sphere.center.y;
  block.center_z[k] = sphere.center.z;
  block.radius[k] = sphere.radius;
}

void Geometry::set_scanned(std::size_t i, const Sphere& sphere) {
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
                  .scanned = scanned_,
                  .blocks = blocks_.data(),
                  .block_count = block_count_,
                  .id = id_.data()};
  view.planes = {.point_x = point_x_.data(),
                 .point_y = point_y_.data(),
                 .point_z = point_z_.data(),
                 .normal_x = normal_x_.data(),
                 .normal_y = normal_y_.data(),
                 .normal_z = normal_z_.data(),
                 .size = plane_count_,
                 .first_id = static_cast<std::int32_t>(sphere_count_)};
  view.bvh = {nodes_.data(), nodes_.size(), extent_};
  return view;
}

}  // namespace boule
