#include <limits>
#include <vector>

#include "core/reference.h"
#include "simd/dispatch/dispatch.h"

namespace boule {
namespace {

Plane get_plane(const PlaneView& p, std::size_t i) {
  return {
      {p.point_x[i], p.point_y[i], p.point_z[i]}, {p.normal_x[i], p.normal_y[i], p.normal_z[i]}, 0};
}

/// The geometry back as plain primitives in the order of their ids: what the reference path reads.
/// Copies of a sphere that the tree's builder left out have no radius: nothing hits them.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> slots;  ///< by the sphere's id
  std::vector<Plane> planes;

  explicit Primitives(const GeometryView& view) {
    const SphereView& s = view.spheres;
    const Sphere nowhere{{0, 0, 0}, std::numeric_limits<float>::quiet_NaN(), 0};
    spheres.resize(static_cast<std::size_t>(view.planes.first_id), nowhere);
    slots.resize(spheres.size());
    for (std::size_t slot = 0; slot < s.block_count * bvh_leaf_size; ++slot) {
      if (s.id[slot] < 0) continue;
      const SphereBlock& block = s.blocks[slot / bvh_leaf_size];
      const std::size_t k = slot % bvh_leaf_size;
      const auto id = static_cast<std::size_t>(s.id[slot]);
      spheres[id] = {{block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k], 0};
      slots[id] = static_cast<std::uint32_t>(slot);
    }
    const PlaneView& p = view.planes;
    for (std::size_t i = 0; i < p.size; ++i) planes.push_back(get_plane(p, i));
  }
};

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
                 const HitStream& hits) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    const Hit hit = reference::closest_hit(get_ray(rays, i), all.spheres, all.planes);
    hits.t[i] = hit.t;
    hits.id[i] = hit.id;
    const auto id = static_cast<std::size_t>(hit.id);
    if (id < all.slots.size()) hits.slot[i] = all.slots[id];
  }
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query&,
             std::uint8_t* occluded) {
  const Primitives all(geometry);
  for (std::size_t i = 0; i < rays.size; ++i) {
    occluded[i] = reference::any_hit(get_ray(rays, i), all.spheres, all.planes) ? 1 : 0;
  }
}

}  // namespace

const KernelTable& reference_kernels() {
  static const KernelTable table = [] {
    KernelTable made = *select_kernels("scalar").value();
    made.closest_hit = closest_hit;
    made.any_hit = any_hit;
    return made;
  }();
  return table;
}

}  // namespace boule
