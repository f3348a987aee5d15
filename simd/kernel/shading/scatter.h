#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/optics/incidence.h"
#include "core/optics/reflectance.h"
#include "simd/abi/whitted.h"
#include "simd/kernel/shading/going_on.h"
#include "simd/kernel/shading/lane_materials.h"
#include "simd/kernel/vectors.h"

/// The mirrored and refracted rays of Whitted's method, W hits at a time.
namespace boule::BOULE_KERNEL_ISA {

/// Rays that leave to one side of W surfaces.
struct ScatteredRays {
  LeavingRays rays;
  Vec3<Real> throughput;
};

BOULE_INLINE ScatteredRays scattered_rays(LeavingRays rays, const Vec3<Real>& before,
                                          const Vec3<Real>& weight) {
  const Vec3<Real> throughput = light_product(before, weight);
  rays.chosen &= bits(~is_black_in<Wide>(throughput));
  return {rays, throughput};
}

/// The rays of one side in memory, to be picked one by one.
struct StoredRays {
  alignas(64) double org[3][width];
  alignas(64) float numbers[6][width];  ///< direction, throughput
  unsigned inside;                      ///< by the bit of its lane

  BOULE_INLINE explicit StoredRays(const ScatteredRays& side) : inside(bits(side.rays.inside)) {
    store({org[0], org[1], org[2]}, 0, side.rays.org);
    const Vec3<Real> direction = narrow(side.rays.direction);
    const Real* const all[] = {&direction.x,       &direction.y,       &direction.z,
                               &side.throughput.x, &side.throughput.y, &side.throughput.z};
    for (std::size_t k = 0; k < 6; ++k) store(numbers[k], *all[k]);
  }

  BOULE_INLINE void add(std::size_t lane, std::int32_t source, std::uint32_t sample,
                        GoingOn& spawned) const {
    const std::size_t at = spawned.size++;
    const RayStream& rays = spawned.rays;
    rays.org_x[at] = org[0][lane];
    rays.org_y[at] = org[1][lane];
    rays.org_z[at] = org[2][lane];
    rays.dir_x[at] = numbers[0][lane];
    rays.dir_y[at] = numbers[1][lane];
    rays.dir_z[at] = numbers[2][lane];
    rays.tmin[at] = 0;
    rays.tmax[at] = std::numeric_limits<float>::infinity();
    rays.source[at] = source;
    rays.inside[at] = static_cast<std::uint8_t>(inside >> lane & 1U);
    spawned.throughput.r[at] = numbers[3][lane];
    spawned.throughput.g[at] = numbers[4][lane];
    spawned.throughput.b[at] = numbers[5][lane];
    spawned.sample[at] = sample;
    spawned.density[at] = 0;
  }
};

/// Appends the rays of both sides, hit by hit, the mirrored one first. Sums of samples depend on
/// that order, so it is the same for every W.
BOULE_INLINE void add_both_sides(const ScatteringHits& hits, std::size_t first,
                                 const ScatteredRays& mirrored, const ScatteredRays& refracted,
                                 GoingOn& spawned) {
  const StoredRays back(mirrored), through(refracted);
  const unsigned go_back = mirrored.rays.chosen, go_through = refracted.rays.chosen;
  for (unsigned lanes = go_back | go_through; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
    const std::int32_t id = hits.id[first + lane];
    const std::uint32_t sample = hits.sample[first + lane];
    if ((go_back >> lane & 1U) != 0) back.add(lane, id, sample, spawned);
    if ((go_through >> lane & 1U) != 0) through.add(lane, id, sample, spawned);
  }
}

BOULE_INLINE void scatter_packet(const ScatteringHits& hits, std::size_t first, unsigned live,
                                 GoingOn& spawned) {
  const FlatMaterial* of_lane[width];
  pick_live(hits.material + first, live, of_lane);
  const CoefficientsOf<Wide> material = load_materials<LobeKind::clear>(of_lane);
  const SurfaceStream& found = hits.surfaces;
  const IncidenceOf<Wide> met{load(found.normal, first), load(found.view, first),
                              load(found.mirrored, first), load(found.cosine + first),
                              load_set(found.inner + first)};
  const ScatterOf<Wide> weights = scatter(material, met);
  const Vec3<Real> before = load(hits.throughput, first);
  const Bits ids = load_integers(hits.id + first);
  const ScatteredRays mirrored = scattered_rays(
      {load(found.org, first), met.mirrored, ids, narrow(load_set(found.inside + first)), live},
      before, weights.reflection);
  const Bits beyond_first = ids + Bits(0U - static_cast<std::uint32_t>(hits.first_plane));
  const WideMask solid = widen(Bits(hits.planes) <= beyond_first);
  const Vec3<Wide> beyond =
      move_off(load(found.point, first), met.normal * Wide(-1.0), load(found.reach + first));
  const ScatteredRays refracted =
      scattered_rays({beyond, weights.refracted, ids, narrow(solid & ~met.inner), live}, before,
                     weights.refraction);
  if (mirrored.rays.chosen != 0 && refracted.rays.chosen != 0) {
    add_both_sides(hits, first, mirrored, refracted, spawned);
    return;
  }
  const ScatteredRays& side = refracted.rays.chosen == 0 ? mirrored : refracted;
  add_going_on(side.rays, side.throughput, load_integers(hits.sample + first), Real(0.0F), spawned);
}

BOULE_INLINE void scatter_rays(const ScatteringHits& hits, GoingOn& spawned) {
  for (std::size_t first = 0; first < hits.size; first += width) {
    const unsigned live = bits(load_set(hits.scatters + first));
    if (live != 0) scatter_packet(hits, first, live, spawned);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
