#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/abi/geometry.h"
#include "simd/abi/shading.h"
#include "simd/kernel/search/ray_lanes.h"
#include "simd/kernel/vectors.h"

/// Hit points, normals and where rays leave, W at a time: core/surface.cpp in lanes, bit for bit.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE void store(std::uint8_t* p, const WideMask& m) {
  const unsigned set = bits(m);
  for (int lane = 0; lane < width; ++lane) p[lane] = static_cast<std::uint8_t>(set >> lane & 1U);
}

/// What a packet met.
struct MetLanes {
  Vec3<Wide> outward;  ///< unit length, or not finite
  Wide reach;
  WideMask inner;
};

BOULE_INLINE WideMask select(const WideMask& m, const WideMask& a, const WideMask& b) {
  return (m & a) | (~m & b);
}
BOULE_INLINE MetLanes select(const WideMask& m, const MetLanes& a, const MetLanes& b) {
  return {select(m, a.outward, b.outward), select(m, a.reach, b.reach),
          select(m, a.inner, b.inner)};
}

/// The rays of a packet, as far as their surfaces need them.
struct ArrivedLanes {
  Vec3<Wide> org, dir, point;
  Wide id, source;
  WideMask from_origin;  ///< tmin is 0
};

BOULE_INLINE MetLanes meet_spheres(const ArrivedLanes& rays, const float* const* rows) {
  const Columns sphere = load_rows(rows);
  const Vec3<Wide> center = widen(Vec3<Real>{sphere.x, sphere.y, sphere.z});
  const Wide r = widen(sphere.w);
  const Vec3<Wide> f = center - rays.org, outward = rays.point - center;
  const Wide ff = dot(f, f);
  const WideMask starts_inside = (rays.id == rays.source) | (ff - r * r <= Wide(0.0));
  const WideMask turned = Wide(0.0) < dot(outward, rays.dir);
  return {unit(outward), sqrt(ff) + r, select(rays.from_origin, starts_inside, turned)};
}

BOULE_INLINE MetLanes meet_plane(const ArrivedLanes& rays, const PlaneView& planes, std::size_t k) {
  const auto broadcast = [k](const float* x, const float* y, const float* z) {
    return widen(Vec3<Real>{x[k], y[k], z[k]});
  };
  const Vec3<Wide> n = broadcast(planes.normal_x, planes.normal_y, planes.normal_z);
  const Vec3<Wide> to_plane = broadcast(planes.point_x, planes.point_y, planes.point_z) - rays.org;
  const Vec3<Wide> way = rays.point - rays.org;
  return {unit(n), sqrt(dot(to_plane, to_plane)) + sqrt(dot(way, way)),
          Wide(0.0) < dot(rays.dir, n)};
}

/// The lanes of a packet that met anything, and what: spheres at once, planes one by one.
class MetPrimitives {
 public:
  MetPrimitives(const GeometryView& geometry, const SphereRows& spheres, const std::int32_t* id,
                std::size_t live)
      : planes_(geometry.planes), id_(id) {
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(width); ++lane) {
      const std::int32_t primitive = lane < live ? id[lane] : -1;
      const bool sphere = primitive >= 0 && primitive < planes_.first_id;
      rows_[lane] =
          sphere ? spheres.first + static_cast<std::size_t>(primitive) * spheres.stride : no_sphere;
      spheres_ |= static_cast<unsigned>(sphere) << lane;
      planes_met_ |= static_cast<unsigned>(primitive >= planes_.first_id) << lane;
    }
  }

  [[nodiscard]] bool none() const { return (spheres_ | planes_met_) == 0; }

  [[nodiscard]] BOULE_INLINE MetLanes meet(const ArrivedLanes& rays) const {
    MetLanes met = meet_spheres(rays, rows_);
    for (unsigned left = planes_met_; left != 0;) {
      const std::int32_t id = id_[__builtin_ctz(left)];
      const WideMask same = rays.id == Wide(static_cast<double>(id));
      met = select(same, meet_plane(rays, planes_, static_cast<std::size_t>(id - planes_.first_id)),
                   met);
      left &= ~bits(same);
    }
    return met;
  }

  [[nodiscard]] BOULE_INLINE WideMask is_sphere(const ArrivedLanes& rays) const {
    return rays.id < Wide(static_cast<double>(planes_.first_id));
  }

 private:
  static constexpr float no_sphere[4] = {0, 0, 0, 1};

  const PlaneView& planes_;
  const std::int32_t* id_;
  const float* rows_[width];
  unsigned spheres_ = 0, planes_met_ = 0;
};

/// p64 is known to 2^-49 of the distances that made it, axis by axis: see core/surface.cpp.
inline constexpr double relative_error = 0x1p-49;

BOULE_INLINE void find_surfaces_of_packet(const MetPrimitives& primitives, const RayStream& rays,
                                          const HitStream& hits, std::size_t first,
                                          const SurfaceStream& surfaces) {
  const VectorStream orgs{rays.org_x, rays.org_y, rays.org_z};
  const Real tmin = load(rays.tmin + first);
  ArrivedLanes arrived{load(orgs, first),
                       widen(Vec3<Real>{load(rays.dir_x + first), load(rays.dir_y + first),
                                        load(rays.dir_z + first)}),
                       {},
                       load_as_wide(hits.id + first),
                       load_as_wide(rays.source + first),
                       widen((tmin <= Real(0.0F)) & (Real(0.0F) <= tmin))};
  arrived.point = arrived.org + arrived.dir * load(hits.t + first);
  const MetLanes met = primitives.meet(arrived);
  const Vec3<Wide> view = unit(arrived.dir);
  const Vec3<Wide> turned = met.outward * select(met.inner, Wide(-1.0), Wide(1.0));
  const Wide largest(std::numeric_limits<double>::max());
  const WideMask finite =
      (abs(turned.x) <= largest) & (abs(turned.y) <= largest) & (abs(turned.z) <= largest);
  const Vec3<Wide> normal = select(finite, turned, view * Wide(-1.0));
  const Wide facing = dot(normal, view) * Wide(-1.0);
  const Wide cosine =
      select(facing < Wide(0.0), Wide(0.0), select(Wide(1.0) < facing, Wide(1.0), facing));
  store(surfaces.point, first, arrived.point);
  store(surfaces.normal, first, normal);
  store(surfaces.view, first, view);
  store(surfaces.mirrored, first, view + normal * (Wide(2.0) * cosine));
  store(surfaces.org, first,
        arrived.point + normal * (sum_abs(normal) * Wide(relative_error) * met.reach));
  store(surfaces.cosine + first, cosine);
  store(surfaces.reach + first, met.reach);
  store(surfaces.inner + first, met.inner);
  store(surfaces.inside + first, met.inner & primitives.is_sphere(arrived));
}

BOULE_INLINE void find_surfaces(const GeometryView& geometry, const SphereRows& spheres,
                                const RayStream& rays, const HitStream& hits,
                                const SurfaceStream& surfaces) {
  for (std::size_t first = 0; first < rays.size; first += width) {
    const MetPrimitives primitives(geometry, spheres, hits.id + first, rays.size - first);
    if (!primitives.none()) find_surfaces_of_packet(primitives, rays, hits, first, surfaces);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
