#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/plane.h"
#include "simd/kernel/search/sphere.h"

/// How primitives come into lanes: one for all rays of a packet, or W for a single ray. A scan is
/// written once over such a source of "steps".
namespace boule::BOULE_KERNEL_ISA {

/// Step i is primitive i in every lane: for packets.
struct OneForAll {
  static constexpr bool one_ray = false;
  static std::size_t steps(std::size_t size) { return size; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) { return values[step]; }
  /// The primitives' places in their arrays.
  BOULE_INLINE static Wide place(std::size_t step) { return static_cast<double>(step); }
  /// The bits of slots, of those from `first` on.
  BOULE_INLINE static Real slots(std::size_t first, std::size_t step) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(first + step));
  }
  BOULE_INLINE static Wide get(const std::int32_t* ids, std::size_t step) {
    return static_cast<double>(ids[step]);
  }
  /// Lanes whose ray leaves their primitive.
  BOULE_INLINE static RealMask own(const std::int32_t* ids, std::size_t step,
                                   const RayLanes& rays) {
    return equal(rays.source, ids[step]);
  }
};

/// Step i is primitives iW .. iW + W - 1, one a lane, the last step padded: for single rays.
struct OnePerLane {
  static constexpr bool one_ray = true;
  static std::size_t steps(std::size_t size) { return (size + width - 1) / width; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) {
    return load(values + step * width);
  }
  BOULE_INLINE static Wide place(std::size_t step) {
    return lane_numbers() + Wide(static_cast<double>(step * width));
  }
  BOULE_INLINE static Real slots(std::size_t first, std::size_t step) {
    return count_from(static_cast<std::uint32_t>(first + step * width));
  }
  BOULE_INLINE static Wide get(const std::int32_t* ids, std::size_t step) {
    return load_as_wide(ids + step * width);
  }
  BOULE_INLINE static RealMask own(const std::int32_t* ids, std::size_t step,
                                   const RayLanes& rays) {
    return equal(ids + step * width, rays.source[0]);
  }
};

/// The sphere in a slot.
struct SlotSphere {
  float x, y, z, radius;
};

BOULE_INLINE SlotSphere get_slot(const SphereView& s, std::size_t slot) {
  const SphereBlock& block = s.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {block.center_x[k], block.center_y[k], block.center_z[k], block.radius[k]};
}

/// The sphere of each lane's slot, which comes as bits.
BOULE_INLINE SphereLanes gather_spheres(const SphereView& s, const Real& slots) {
  alignas(64) float slot_bits[width], x[width], y[width], z[width], r[width];
  alignas(64) double id[width];
  store(slot_bits, slots);
  for (int lane = 0; lane < width; ++lane) {
    const std::size_t slot = std::bit_cast<std::uint32_t>(slot_bits[lane]);
    const SlotSphere sphere = get_slot(s, slot);
    x[lane] = sphere.x;
    y[lane] = sphere.y;
    z[lane] = sphere.z;
    r[lane] = sphere.radius;
    id[lane] = s.id[slot];
  }
  return {{load(x), load(y), load(z)}, load(r), load(id)};
}

/// The spheres that are in no leaf, step by step.
template <class Access>
struct ScannedSpheres {
  const SphereView& spheres;

  [[nodiscard]] BOULE_INLINE Vec3<Real> center(std::size_t step) const {
    return {Access::get(spheres.center_x, step), Access::get(spheres.center_y, step),
            Access::get(spheres.center_z, step)};
  }
  [[nodiscard]] BOULE_INLINE Real radius(std::size_t step) const {
    return Access::get(spheres.radius, step);
  }
  [[nodiscard]] BOULE_INLINE Wide id(std::size_t step) const {
    return Access::get(spheres.id, step);
  }
  [[nodiscard]] BOULE_INLINE Real slot(std::size_t step) const { return Access::slots(0, step); }
  /// Lanes whose ray leaves its sphere.
  [[nodiscard]] BOULE_INLINE RealMask own(const RayLanes& rays, std::size_t step) const {
    return Access::own(spheres.id, step, rays);
  }

  /// Lanes that certainly miss.
  template <bool origins_exact>
  [[nodiscard]] BOULE_INLINE RealMask out(const FilterRays& rays, std::size_t step) const {
    return rejected<origins_exact>(rays, center(step), Access::get(spheres.reject_squared, step),
                                   Access::get(spheres.reject_radius, step));
  }
};

/// The spheres of one leaf, step by step; all are within the filter's range.
template <class Access>
struct LeafSpheres {
  const SphereBlock& leaf;
  const std::int32_t* ids;
  std::size_t first_slot;
  float size;

  BOULE_INLINE LeafSpheres(const SphereView& spheres, std::uint32_t index, std::uint32_t leaf_size)
      : leaf(spheres.blocks[spheres.scanned / bvh_leaf_size + index]),
        ids(spheres.id + spheres.scanned + std::size_t{index} * bvh_leaf_size),
        first_slot(spheres.scanned + std::size_t{index} * bvh_leaf_size),
        size(static_cast<float>(leaf_size)) {}

  [[nodiscard]] BOULE_INLINE Vec3<Real> center(std::size_t step) const {
    return {Access::get(leaf.center_x, step), Access::get(leaf.center_y, step),
            Access::get(leaf.center_z, step)};
  }
  [[nodiscard]] BOULE_INLINE Real radius(std::size_t step) const {
    return Access::get(leaf.radius, step);
  }
  [[nodiscard]] BOULE_INLINE Wide id(std::size_t step) const { return Access::get(ids, step); }
  [[nodiscard]] BOULE_INLINE Real slot(std::size_t step) const {
    return Access::slots(first_slot, step);
  }
  /// Lanes whose ray leaves its sphere.
  [[nodiscard]] BOULE_INLINE RealMask own(const RayLanes& rays, std::size_t step) const {
    return Access::own(ids, step, rays);
  }

  /// Lanes that certainly miss, or hold no sphere.
  template <bool origins_exact>
  [[nodiscard]] BOULE_INLINE RealMask out(const FilterRays& rays, std::size_t step) const {
    const RealMask misses = rejected_on_the_spot<origins_exact>(rays, center(step), radius(step));
    if constexpr (Access::one_ray) {
      return misses | (Real(size) <= narrow(Access::place(step)));
    } else {
      return misses;
    }
  }
};

/// The sphere of one step.
template <class Spheres>
BOULE_INLINE SphereLanes get_sphere(const Spheres& spheres, std::size_t step) {
  return {spheres.center(step), spheres.radius(step), spheres.id(step)};
}

template <class Access>
BOULE_INLINE PlaneLanes get_plane(const PlaneView& p, std::size_t step) {
  return {
      {Access::get(p.point_x, step), Access::get(p.point_y, step), Access::get(p.point_z, step)},
      {Access::get(p.normal_x, step), Access::get(p.normal_y, step), Access::get(p.normal_z, step)},
      Access::place(step) + Wide(static_cast<double>(p.first_id))};
}

}  // namespace boule::BOULE_KERNEL_ISA
