#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/leaf/plane.h"
#include "simd/kernel/search/leaf/sphere.h"

/// The loading of primitives into lanes: the same one into all, for a packet of W rays (OneForAll),
/// or W different ones, for a single ray (OnePerLane). Scans and traversal are written once over
/// "steps": a step is one pass of a loop.
namespace boule::BOULE_KERNEL_ISA {

/// For packets: step i is primitive i, in every lane.
struct OneForAll {
  static constexpr bool one_ray = false;
  static std::size_t steps(std::size_t size) { return size; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) { return values[step]; }
  BOULE_INLINE static Bits get(const std::int32_t* values, std::size_t step) {
    return Bits(values[step]);
  }
  /// The indices of the primitives of a step, where the array's first primitive has the index
  /// `first`.
  BOULE_INLINE static Bits indices(std::size_t first, std::size_t step) {
    return Bits(static_cast<std::uint32_t>(first + step));
  }
};

/// For single rays: step i is the primitives iW .. iW + W - 1, one a lane. The last step reaches
/// into the padding.
struct OnePerLane {
  static constexpr bool one_ray = true;
  static std::size_t steps(std::size_t size) { return (size + width - 1) / width; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) {
    return load(values + step * width);
  }
  BOULE_INLINE static Bits get(const std::int32_t* values, std::size_t step) {
    return load_integers(values + step * width);
  }
  BOULE_INLINE static Bits indices(std::size_t first, std::size_t step) {
    return count_from(static_cast<std::uint32_t>(first + step * width));
  }
};

/// The slot that marks the absence of a sphere.
inline constexpr std::uint32_t no_slot = 0xffffffffU;

/// The sphere in a slot.
struct SlotSphere {
  float x, y, z, radius;
};

BOULE_INLINE SlotSphere get_slot(const SphereView& s, std::size_t slot) {
  const SphereBlock& block = s.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {block.center_x[k], block.center_y[k], block.center_z[k], block.radius[k]};
}

/// Whether an id comes before another: ids are unsigned 32-bit numbers, with no_primitive as the
/// last.
BOULE_INLINE bool is_lower(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint32_t>(a) < static_cast<std::uint32_t>(b);
}

/// The id of the sphere in a slot.
BOULE_INLINE std::int32_t id_of(const SphereView& s, std::size_t slot) { return s.id[slot]; }

/// The spheres of W slots. (Gather instructions are slower.) Spheres: SphereView, or PartSpheres
/// (parts.h).
template <class Spheres>
BOULE_INLINE SphereLanes gather_spheres(const Spheres& s, const Bits& slots) {
  alignas(64) std::uint32_t slot[width];
  alignas(64) float x[width], y[width], z[width], r[width];
  alignas(64) std::int32_t id[width];
  store(slot, slots);
  for (int lane = 0; lane < width; ++lane) {
    const SlotSphere sphere = get_slot(s, slot[lane]);
    x[lane] = sphere.x;
    y[lane] = sphere.y;
    z[lane] = sphere.z;
    r[lane] = sphere.radius;
    id[lane] = id_of(s, slot[lane]);
  }
  return {{load(x), load(y), load(z)}, load(r), load_integers(id)};
}

/// The spheres outside the leaves, step by step.
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
  [[nodiscard]] BOULE_INLINE Bits id(std::size_t step) const {
    return Access::get(spheres.id, step);
  }
  [[nodiscard]] BOULE_INLINE Bits slot(std::size_t step) const { return Access::indices(0, step); }
  /// Lanes whose ray leaves the very sphere of the step.
  [[nodiscard]] BOULE_INLINE RealMask own(const RayLanes& rays, std::size_t step) const {
    return rays.exact.source == id(step);
  }

  /// Lanes that certainly miss.
  [[nodiscard]] BOULE_INLINE RealMask out(const FilterRays& rays, std::size_t step) const {
    return rejected(rays, center(step), Access::get(spheres.reject_radius, step));
  }
  /// The same where every origin is a float.
  [[nodiscard]] BOULE_INLINE RealMask out_exact(const FilterRays& rays, std::size_t step) const {
    return rejected_exact(rays, center(step), Access::get(spheres.reject_squared, step));
  }
};

/// The places of the spheres of a leaf, or of another block.
struct LeafRef {
  const SphereBlock& block;
  const std::int32_t* ids;
  std::size_t first_slot;
};

/// The spheres of one leaf, step by step. All are within the range of the filters.
template <class Access>
struct LeafSpheres {
  const SphereBlock& leaf;
  const std::int32_t* ids;
  std::size_t first_slot;
  std::uint32_t size;

  BOULE_INLINE LeafSpheres(const LeafRef& at, std::uint32_t leaf_size)
      : leaf(at.block), ids(at.ids), first_slot(at.first_slot), size(leaf_size) {}

  [[nodiscard]] BOULE_INLINE Vec3<Real> center(std::size_t step) const {
    return {Access::get(leaf.center_x, step), Access::get(leaf.center_y, step),
            Access::get(leaf.center_z, step)};
  }
  [[nodiscard]] BOULE_INLINE Real radius(std::size_t step) const {
    return Access::get(leaf.radius, step);
  }
  [[nodiscard]] BOULE_INLINE Bits id(std::size_t step) const { return Access::get(ids, step); }
  [[nodiscard]] BOULE_INLINE Bits slot(std::size_t step) const {
    return Access::indices(first_slot, step);
  }
  /// Lanes whose ray leaves the very sphere of the step.
  [[nodiscard]] BOULE_INLINE RealMask own(const RayLanes& rays, std::size_t step) const {
    return rays.exact.source == id(step);
  }

  /// Lanes that certainly miss, or whose slot is empty.
  [[nodiscard]] BOULE_INLINE RealMask out(const FilterRays& rays, std::size_t step) const {
    const RealMask misses = rejected(rays, center(step), grown_on_the_spot(radius(step)));
    if constexpr (Access::one_ray) {
      return misses | (Bits(size) <= Access::indices(0, step));
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
      Access::indices(static_cast<std::size_t>(p.first_id), step)};
}

}  // namespace boule::BOULE_KERNEL_ISA
