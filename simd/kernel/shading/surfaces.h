#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/ray.h"
#include "core/optics/incidence.h"
#include "simd/abi/geometry.h"
#include "simd/abi/shading.h"
#include "simd/kernel/search/leaf/primitive_access.h"
#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/search/packet/parts.h"
#include "simd/kernel/vectors.h"

/// Hit points, normals and origins of leaving rays, W at a time.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE void store(std::uint8_t* p, const WideMask& m) {
  const unsigned set = bits(m);
  for (int lane = 0; lane < width; ++lane) p[lane] = static_cast<std::uint8_t>(set >> lane & 1U);
}

using Arrivals = ArrivalOf<Wide>;
using Contacts = ContactOf<Wide>;

/// The primitives that the lanes of a packet hit.
class MetPrimitives {
 public:
  /// The first `live` hits, up to W, from `first` on. Geometry: GeometryView, or PartsGeometry.
  template <class Geometry>
  MetPrimitives(const Geometry& geometry, const CapsuleView& capsules, const HitStream& hits,
                std::size_t first, std::size_t live)
      : planes_(geometry.planes), capsules_(capsules), id_(hits.id + first) {
    const Bits ids = load_integers(id_);
    const unsigned hit = first_lanes(live) & ~bits(ids == Bits(no_primitive));
    // Ids may be wrong where a file supplies the slots: every id that is neither a plane's nor a
    // capsule's counts as the slot's sphere.
    if (planes_.size > 0) planes_met_ = hit & bits(is_plane(ids));
    for (float* const numbers : {x_, y_, z_}) store(numbers, Real(0.0F));
    store(radius_, Real(1.0F));
    if (capsules_.slots > 0) add_capsules(hit & ~planes_met_, hits.slot + first);
    spheres_ = hit & ~planes_met_ & ~capsules_met_;
    for (unsigned left = spheres_; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
      const SlotSphere met = get_slot(geometry.spheres, hits.slot[first + lane]);
      x_[lane] = met.x;
      y_[lane] = met.y;
      z_[lane] = met.z;
      radius_[lane] = met.radius;
    }
  }

  [[nodiscard]] bool none() const { return (spheres_ | planes_met_ | capsules_met_) == 0; }

  /// `ids`: the ids of the primitives.
  [[nodiscard]] BOULE_INLINE Contacts meet(const Arrivals& rays, const Bits& ids) const {
    Contacts met = meet_others(rays, ids);
    if (capsules_met_ == 0) return met;
    const Vec3<Wide> a = widen(Vec3<Real>{load(x_), load(y_), load(z_)});
    const Vec3<Wide> b = widen(Vec3<Real>{load(end_x_), load(end_y_), load(end_z_)});
    const Contacts capsule = meet_capsule(rays, a, b - a, widen(load(radius_)));
    const WideMask lanes = widen(load_integers(is_capsule_) == Bits(1U));
    met.outward = select(lanes, capsule.outward, met.outward);
    met.reach = select(lanes, capsule.reach, met.reach);
    met.inner = select(lanes, capsule.inner, met.inner);
    return met;
  }

  /// The lanes of spheres and capsules.
  [[nodiscard]] BOULE_INLINE WideMask is_solid(const Bits& ids) const {
    const WideMask sphere = widen(~(Bits(planes_.first_id) <= ids));
    if (capsules_met_ == 0) return sphere;
    return sphere | widen(load_integers(is_capsule_) == Bits(1U));
  }

 private:
  [[nodiscard]] BOULE_INLINE Contacts meet_others(const Arrivals& rays, const Bits& ids) const {
    const Vec3<Wide> center = widen(Vec3<Real>{load(x_), load(y_), load(z_)});
    const Wide radius = widen(load(radius_));
    if (planes_met_ == 0) return meet_sphere(rays, center, radius);
    PrimitiveOf<Wide> met{Wide(1.0) < Wide(0.0), center, radius, center, center};
    for (unsigned left = planes_met_; left != 0;) {
      const std::int32_t id = id_[__builtin_ctz(left)];
      const RealMask same = ids == Bits(id);
      add_plane(static_cast<std::uint32_t>(id) - static_cast<std::uint32_t>(planes_.first_id),
                widen(same), met);
      left &= ~bits(same);
    }
    return meet_primitive(rays, met);
  }

  /// Adds the capsules among the primitives of these lanes, which are met in these slots.
  BOULE_INLINE void add_capsules(unsigned among, const std::uint32_t* slots) {
    for (float* const numbers : {end_x_, end_y_, end_z_}) store(numbers, Real(0.0F));
    store(is_capsule_, Bits(0U));
    for (; among != 0; among &= among - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(among));
      const std::size_t slot = slots[lane];
      if (is_lower(id_[lane], capsules_.first_id) || slot >= capsules_.slots) continue;
      const CapsuleBlock& block = capsules_.blocks[slot / bvh_leaf_size];
      const std::size_t k = slot % bvh_leaf_size;
      x_[lane] = block.a_x[k];
      y_[lane] = block.a_y[k];
      z_[lane] = block.a_z[k];
      end_x_[lane] = block.b_x[k];
      end_y_[lane] = block.b_y[k];
      end_z_[lane] = block.b_z[k];
      radius_[lane] = block.radius[k];
      is_capsule_[lane] = 1;
      capsules_met_ |= 1U << lane;
    }
  }

  /// Precondition: there are planes.
  [[nodiscard]] BOULE_INLINE RealMask is_plane(const Bits& ids) const {
    const auto first = static_cast<std::uint32_t>(planes_.first_id);
    return ids + Bits(0U - first) <= Bits(static_cast<std::uint32_t>(planes_.size - 1));
  }

  /// Plane k in these lanes. Numbers that are the same in all lanes are computed once.
  BOULE_INLINE void add_plane(std::size_t k, const WideMask& lanes, PrimitiveOf<Wide>& met) const {
    const auto broadcast = [](const Vec3d& v) { return Vec3<Wide>{v.x, v.y, v.z}; };
    const Vec3d point{planes_.point_x[k], planes_.point_y[k], planes_.point_z[k]};
    const Vec3d normal{planes_.normal_x[k], planes_.normal_y[k], planes_.normal_z[k]};
    met.plane = met.plane | lanes;
    met.place = select(lanes, broadcast(point), met.place);
    met.normal = select(lanes, broadcast(normal), met.normal);
    met.direction = select(lanes, broadcast(normalize(normal)), met.direction);
  }

  const PlaneView& planes_;
  const CapsuleView& capsules_;
  const std::int32_t* id_;
  alignas(64) float x_[width], y_[width], z_[width], radius_[width];
  unsigned spheres_ = 0, planes_met_ = 0, capsules_met_ = 0;
  // Of capsules only: the other end, and 1 in their lanes.
  alignas(64) float end_x_[width], end_y_[width], end_z_[width];
  alignas(64) std::uint32_t is_capsule_[width];
};

/// The surfaces at which the rays of a packet arrived.
struct MetSurfaces {
  Arrivals arrived;
  Contacts met;
  WideMask solid;  ///< spheres and capsules
};

BOULE_INLINE MetSurfaces surfaces_of_packet(const MetPrimitives& primitives, const RayStream& rays,
                                            const HitStream& hits, std::size_t first) {
  const std::size_t start = rays.places(first).start;
  const Real tmin = load(rays.tmin + start);
  const Bits ids = load_integers(hits.id + first);
  const Vec3<Wide> org = load_origins(rays, first), dir = widen(load_directions(rays, first));
  const Arrivals arrived{org, dir, org + dir * load(hits.t + first),
                         widen(ids == load_integers(rays.source + start)),
                         widen((tmin <= Real(0.0F)) & (Real(0.0F) <= tmin))};
  return {arrived, primitives.meet(arrived, ids), primitives.is_solid(ids)};
}

template <class Geometry>
BOULE_INLINE void find_surfaces(const Geometry& geometry, const CapsuleView& capsules,
                                const RayStream& rays, const HitStream& hits,
                                const SurfaceStream& surfaces) {
  for (std::size_t first = 0; first < rays.size; first += width) {
    const MetPrimitives primitives(geometry, capsules, hits, first, rays.size - first);
    if (primitives.none()) continue;
    const auto [arrived, met, solid] = surfaces_of_packet(primitives, rays, hits, first);
    const Vec3<Wide> view = normalize(arrived.dir), normal = facing_normal(met, view);
    const Wide cosine = facing_cosine(normal, view);
    store(surfaces.point, first, arrived.point);
    store(surfaces.normal, first, normal);
    store(surfaces.view, first, view);
    store(surfaces.mirrored, first, mirror(view, normal, cosine));
    store(surfaces.org, first, move_off(arrived.point, normal, met.reach));
    store(surfaces.cosine + first, cosine);
    store(surfaces.reach + first, met.reach);
    store(surfaces.inner + first, met.inner);
    store(surfaces.inside + first, met.inner & solid);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
