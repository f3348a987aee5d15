#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/ray.h"
#include "core/optics/incidence.h"
#include "simd/abi/geometry.h"
#include "simd/abi/shading.h"
#include "simd/kernel/search/parts.h"
#include "simd/kernel/search/primitive_access.h"
#include "simd/kernel/search/ray_lanes.h"
#include "simd/kernel/vectors.h"

/// Hit points, normals and where rays leave, W at a time.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE void store(std::uint8_t* p, const WideMask& m) {
  const unsigned set = bits(m);
  for (int lane = 0; lane < width; ++lane) p[lane] = static_cast<std::uint8_t>(set >> lane & 1U);
}

using Arrivals = ArrivalOf<Wide>;
using Contacts = ContactOf<Wide>;

BOULE_INLINE Contacts meet_plane(const Arrivals& rays, const PlaneView& planes, std::size_t k) {
  const auto broadcast = [k](const float* x, const float* y, const float* z) {
    return widen(Vec3<Real>{x[k], y[k], z[k]});
  };
  return boule::meet_plane(rays, broadcast(planes.point_x, planes.point_y, planes.point_z),
                           broadcast(planes.normal_x, planes.normal_y, planes.normal_z));
}

/// What each lane of a packet met. The spheres are met in all lanes at once, then one plane after
/// the other.
class MetPrimitives {
 public:
  /// The first `live` hits, up to W, from `first` on. Geometry: GeometryView, or PartsGeometry.
  template <class Geometry>
  MetPrimitives(const Geometry& geometry, const HitStream& hits, std::size_t first,
                std::size_t live)
      : planes_(geometry.planes), id_(hits.id + first) {
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(width); ++lane) {
      const std::int32_t primitive = lane < live ? id_[lane] : no_primitive;
      // Of what a file says of its slots, ids may be wrong: what is no plane is the slot's sphere.
      const bool hit = primitive != no_primitive;
      const std::size_t plane =
          static_cast<std::uint32_t>(primitive) - static_cast<std::uint32_t>(planes_.first_id);
      const bool is_plane = hit && plane < planes_.size;
      const bool sphere = hit && !is_plane;
      const SlotSphere met =
          sphere ? get_slot(geometry.spheres, hits.slot[first + lane]) : SlotSphere{0, 0, 0, 1};
      x_[lane] = met.x;
      y_[lane] = met.y;
      z_[lane] = met.z;
      radius_[lane] = met.radius;
      spheres_ |= static_cast<unsigned>(sphere) << lane;
      planes_met_ |= static_cast<unsigned>(is_plane) << lane;
    }
  }

  [[nodiscard]] bool none() const { return (spheres_ | planes_met_) == 0; }

  /// `ids`: those of the primitives.
  [[nodiscard]] BOULE_INLINE Contacts meet(const Arrivals& rays, const Bits& ids) const {
    Contacts met =
        meet_sphere(rays, widen(Vec3<Real>{load(x_), load(y_), load(z_)}), widen(load(radius_)));
    for (unsigned left = planes_met_; left != 0;) {
      const std::int32_t id = id_[__builtin_ctz(left)];
      const WideMask same = widen(ids == Bits(id));
      const Contacts plane =
          meet_plane(rays, planes_,
                     static_cast<std::uint32_t>(id) - static_cast<std::uint32_t>(planes_.first_id));
      met.outward = select(same, plane.outward, met.outward);
      met.reach = select(same, plane.reach, met.reach);
      met.inner = select(same, plane.inner, met.inner);
      left &= ~bits(same);
    }
    return met;
  }

  [[nodiscard]] BOULE_INLINE WideMask is_sphere(const Bits& ids) const {
    return widen(~(Bits(planes_.first_id) <= ids));
  }

 private:
  const PlaneView& planes_;
  const std::int32_t* id_;
  alignas(64) float x_[width], y_[width], z_[width], radius_[width];
  unsigned spheres_ = 0, planes_met_ = 0;
};

/// The surfaces of a packet.
struct MetSurfaces {
  Vec3<Wide> point, view, normal;
  Wide cosine, reach;
  WideMask inner, sphere;
};

BOULE_INLINE MetSurfaces surfaces_of_packet(const MetPrimitives& primitives, const RayStream& rays,
                                            const HitStream& hits, std::size_t first) {
  const VectorStream orgs{rays.org_x, rays.org_y, rays.org_z};
  const Real tmin = load(rays.tmin + first);
  const Bits ids = load_integers(hits.id + first);
  Arrivals arrived{load(orgs, first),
                   widen(Vec3<Real>{load(rays.dir_x + first), load(rays.dir_y + first),
                                    load(rays.dir_z + first)}),
                   {},
                   widen(ids == load_integers(rays.source + first)),
                   widen((tmin <= Real(0.0F)) & (Real(0.0F) <= tmin))};
  arrived.point = arrived.org + arrived.dir * load(hits.t + first);
  const Contacts met = primitives.meet(arrived, ids);
  const Vec3<Wide> view = normalize(arrived.dir), normal = facing_normal(met, view);
  return {arrived.point,
          view,
          normal,
          facing_cosine(normal, view),
          met.reach,
          met.inner,
          primitives.is_sphere(ids)};
}

template <class Geometry>
BOULE_INLINE void find_surfaces(const Geometry& geometry, const RayStream& rays,
                                const HitStream& hits, const SurfaceStream& surfaces) {
  for (std::size_t first = 0; first < rays.size; first += width) {
    const MetPrimitives primitives(geometry, hits, first, rays.size - first);
    if (primitives.none()) continue;
    const MetSurfaces met = surfaces_of_packet(primitives, rays, hits, first);
    store(surfaces.point, first, met.point);
    store(surfaces.normal, first, met.normal);
    store(surfaces.view, first, met.view);
    store(surfaces.mirrored, first, mirror(met.view, met.normal, met.cosine));
    store(surfaces.org, first, move_off(met.point, met.normal, met.reach));
    store(surfaces.cosine + first, met.cosine);
    store(surfaces.reach + first, met.reach);
    store(surfaces.inner + first, met.inner);
    store(surfaces.inside + first, met.inner & met.sphere);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
