#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/incidence.h"
#include "core/optics/lobes.h"
#include "simd/abi/paths.h"
#include "simd/kernel/shading/surfaces.h"
#include "simd/kernel/vectors.h"

/// The points where paths go on, sorted by what their materials do: each kind of them side by side,
/// so that packets need no formula that few of their lanes do.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE Vec3<Real> load(const ColorStream& colors, std::size_t first) {
  return {load(colors.r + first), load(colors.g + first), load(colors.b + first)};
}
BOULE_INLINE void store_chosen(const ColorStream& colors, std::size_t first, const Vec3<Real>& c,
                               unsigned chosen) {
  store_chosen(colors.r + first, c.x, chosen);
  store_chosen(colors.g + first, c.y, chosen);
  store_chosen(colors.b + first, c.z, chosen);
}

BOULE_INLINE Bits side_of(const MetSurfaces& met) {
  const auto bit = [](const WideMask& mask, std::uint32_t side) {
    return select(narrow(mask), Bits(side), Bits(std::uint32_t{0}));
  };
  return bit(met.inner & met.sphere, side_inside) | bit(met.sphere & ~met.inner, side_beyond) |
         bit(met.inner, side_inner);
}

/// Adds the chosen points of a packet.
template <LobeKind kind>
BOULE_INLINE void add_points(const PathRays& paths, std::size_t first, const MetSurfaces& met,
                             unsigned chosen, LobePoints& points) {
  const std::size_t at = points.size;
  store_chosen(points.point, at, met.point, chosen);
  store_chosen(points.normal, at, met.normal, chosen);
  store_chosen(points.org, at, move_off(met.point, met.normal, met.reach), chosen);
  if constexpr (kind != LobeKind::matte) {
    store_chosen(points.view, at, met.view, chosen);
    store_chosen(points.beyond, at, move_off(met.point, met.normal * Wide(-1.0), met.reach),
                 chosen);
    store_chosen(points.cosine + at, met.cosine, chosen);
  }
  store_chosen(points.side + at, side_of(met), chosen);
  store_chosen(points.ray + at, count_from(static_cast<std::uint32_t>(first)), chosen);
  store_chosen(points.throughput, at, load(paths.throughput, first), chosen);
  store_chosen(points.sample + at, load_integers(paths.sample + first), chosen);
  points.size += static_cast<std::size_t>(__builtin_popcount(chosen));
}

/// Geometry: GeometryView, or PartsGeometry.
template <class Geometry>
BOULE_INLINE void find_points(const Geometry& geometry, const PathRays& paths, LobePoints& matte,
                              LobePoints& glossy, LobePoints& clear) {
  for (std::size_t first = 0; first < paths.rays.size; first += width) {
    const Bits kinds = load_integers(paths.kind + first);
    const auto of_kind = [&](LobeKind kind) {
      return bits(kinds == Bits(static_cast<std::uint32_t>(kind)));
    };
    const unsigned mattes = of_kind(LobeKind::matte), glossies = of_kind(LobeKind::glossy),
                   clears = of_kind(LobeKind::clear);
    if ((mattes | glossies | clears) == 0) continue;
    const MetPrimitives primitives(geometry, paths.hits, first, paths.rays.size - first);
    const MetSurfaces met = surfaces_of_packet(primitives, paths.rays, paths.hits, first);
    if (mattes != 0) add_points<LobeKind::matte>(paths, first, met, mattes, matte);
    if (glossies != 0) add_points<LobeKind::glossy>(paths, first, met, glossies, glossy);
    if (clears != 0) add_points<LobeKind::clear>(paths, first, met, clears, clear);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
