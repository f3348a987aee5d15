#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/incidence.h"
#include "core/optics/lobes.h"
#include "simd/abi/paths.h"
#include "simd/kernel/shading/going_on.h"
#include "simd/kernel/shading/surfaces.h"
#include "simd/kernel/vectors.h"

/// The points from which paths continue, sorted by the kind of their material. Points of a kind lie
/// side by side, so that packets compute only formulas that most of their lanes need.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE Bits side_of(const MetSurfaces& met) {
  const auto bit = [](const WideMask& mask, std::uint32_t side) {
    return select(narrow(mask), Bits(side), Bits(std::uint32_t{0}));
  };
  const WideMask inner = met.met.inner;
  return bit(inner & met.solid, side_inside) | bit(met.solid & ~inner, side_beyond) |
         bit(inner, side_inner);
}

/// facing_normal() in these lanes. The view takes a root and a quotient and is rarely needed.
BOULE_INLINE Vec3<Wide> normal_of(const MetSurfaces& met, unsigned lanes) {
  Vec3<Wide> turned = turned_normal(met.met);
  if ((lanes & ~bits(all_finite(turned))) == 0) return turned;
  return facing_normal(met.met, normalize(met.arrived.dir));
}

/// Appends the chosen points of a packet.
template <LobeKind kind>
BOULE_INLINE void add_points(const PathRays& paths, std::size_t first, const MetSurfaces& met,
                             const Vec3<Wide>& normal, unsigned chosen, LobePoints& points) {
  const std::size_t at = points.size;
  store_chosen(points.normal, at, normal, chosen);
  store_chosen(points.org, at, move_off(met.arrived.point, normal, met.met.reach), chosen);
  if constexpr (kind != LobeKind::matte) {
    store_chosen(points.point, at, met.arrived.point, chosen);
    store_chosen(points.reach + at, met.met.reach, chosen);
    store_chosen(points.dir, at, load_directions(paths.rays, first), chosen);
  }
  store_chosen(points.side + at, side_of(met), chosen);
  store_chosen(points.id + at, load_integers(paths.hits.id + first), chosen);
  store_chosen(points.ray + at, count_from(static_cast<std::uint32_t>(first)), chosen);
  store_chosen(points.throughput, at, load(paths.throughput, first), chosen);
  store_chosen(points.sample + at, load_integers(paths.sample + first), chosen);
  points.size += static_cast<std::size_t>(count_bits(chosen));
}

/// Geometry: GeometryView, or PartsGeometry.
template <class Geometry>
BOULE_INLINE void find_points(const Geometry& geometry, const CapsuleView& capsules,
                              const PathRays& paths, LobePoints& matte, LobePoints& glossy,
                              LobePoints& clear) {
  for (std::size_t first = 0; first < paths.rays.size; first += width) {
    const Bits kinds = load_integers(paths.kind + first);
    const auto of_kind = [&](LobeKind kind) {
      return bits(kinds == Bits(static_cast<std::uint32_t>(kind)));
    };
    const unsigned mattes = of_kind(LobeKind::matte), glossies = of_kind(LobeKind::glossy),
                   clears = of_kind(LobeKind::clear);
    if ((mattes | glossies | clears) == 0) continue;
    const MetPrimitives primitives(geometry, capsules, paths.hits, first, paths.rays.size - first);
    const MetSurfaces met = surfaces_of_packet(primitives, paths.rays, paths.hits, first);
    const Vec3<Wide> normal = normal_of(met, mattes | glossies | clears);
    if (mattes != 0) add_points<LobeKind::matte>(paths, first, met, normal, mattes, matte);
    if (glossies != 0) add_points<LobeKind::glossy>(paths, first, met, normal, glossies, glossy);
    if (clears != 0) add_points<LobeKind::clear>(paths, first, met, normal, clears, clear);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
