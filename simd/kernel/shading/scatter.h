#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/optics/incidence.h"
#include "core/optics/reflectance.h"
#include "simd/abi/whitted.h"
#include "simd/kernel/shading/lobe_points.h"
#include "simd/kernel/shading/path_step.h"
#include "simd/kernel/vectors.h"

/// The mirrored and refracted rays of Whitted's method, W hits at a time.
namespace boule::BOULE_KERNEL_ISA {

/// Rays that go on to one side of W surfaces.
struct ScatteredRays {
  Vec3<Wide> org, direction;
  Vec3<Real> throughput;
  Bits inside;
  unsigned chosen = 0;  ///< the lanes that have one
};

BOULE_INLINE ScatteredRays scattered_rays(const Vec3<Wide>& org, const Vec3<Wide>& direction,
                                          const Vec3<Real>& before, const Vec3<Real>& weight,
                                          const WideMask& inside, unsigned live) {
  const Vec3<Real> throughput{light_product(before.x, weight.x), light_product(before.y, weight.y),
                              light_product(before.z, weight.z)};
  return {org, direction, throughput,
          select(narrow(inside), Bits(std::uint32_t{1}), Bits(std::uint32_t{0})),
          live & bits(~is_black_in<Wide>(throughput))};
}

/// Adds the rays of one side; those of the other side have none.
BOULE_INLINE void add_side(const ScatteringHits& hits, std::size_t first, const ScatteredRays& side,
                           GoingOn& spawned) {
  std::size_t at = spawned.size;
  store_chosen(spawned.rays, at, side.org, side.direction,
               Real(std::numeric_limits<float>::infinity()), side.chosen);
  store_chosen(spawned.throughput, at, side.throughput, side.chosen);
  store_chosen(spawned.sample + at, load_integers(hits.sample + first), side.chosen);
  store_anywhere(spawned.density + at, Real(0.0F));
  alignas(64) std::uint32_t inside[width];
  store(inside, side.inside);
  for (unsigned lanes = side.chosen; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
    spawned.rays.source[at] = hits.id[first + lane];
    spawned.rays.inside[at] = static_cast<std::uint8_t>(inside[lane]);
    ++at;
  }
  spawned.size = at;
}

/// The rays of one side in memory, to be picked one by one.
struct StoredRays {
  alignas(64) double org[3][width];
  alignas(64) float numbers[6][width];  ///< direction, throughput
  alignas(64) std::uint32_t inside[width];

  BOULE_INLINE explicit StoredRays(const ScatteredRays& rays) {
    store({org[0], org[1], org[2]}, 0, rays.org);
    const Vec3<Real> direction = narrow(rays.direction);
    const Real* const all[] = {&direction.x,       &direction.y,       &direction.z,
                               &rays.throughput.x, &rays.throughput.y, &rays.throughput.z};
    for (std::size_t k = 0; k < 6; ++k) store(numbers[k], *all[k]);
    store(inside, rays.inside);
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
    rays.inside[at] = static_cast<std::uint8_t>(inside[lane]);
    spawned.throughput.r[at] = numbers[3][lane];
    spawned.throughput.g[at] = numbers[4][lane];
    spawned.throughput.b[at] = numbers[5][lane];
    spawned.sample[at] = sample;
    spawned.density[at] = 0;
  }
};

/// Adds the rays of both sides, hit by hit the mirrored one first: sums of samples depend on that
/// order, which must not depend on W.
BOULE_INLINE void add_both_sides(const ScatteringHits& hits, std::size_t first,
                                 const ScatteredRays& mirrored, const ScatteredRays& refracted,
                                 GoingOn& spawned) {
  const StoredRays back(mirrored), through(refracted);
  for (unsigned lanes = mirrored.chosen | refracted.chosen; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
    const std::int32_t id = hits.id[first + lane];
    const std::uint32_t sample = hits.sample[first + lane];
    if ((mirrored.chosen >> lane & 1U) != 0) back.add(lane, id, sample, spawned);
    if ((refracted.chosen >> lane & 1U) != 0) through.add(lane, id, sample, spawned);
  }
}

BOULE_INLINE void scatter_packet(const ScatteringHits& hits, std::size_t first, unsigned live,
                                 GoingOn& spawned) {
  const LobeMaterial* of_lane[width];
  const auto any = static_cast<std::size_t>(__builtin_ctz(live));
  for (std::size_t lane = 0; lane < width; ++lane)
    of_lane[lane] = hits.material[first + ((live >> lane & 1U) != 0 ? lane : any)];
  const CoefficientsOf<Wide> material = load_materials<LobeKind::clear>(of_lane);
  const SurfaceStream& found = hits.surfaces;
  const IncidenceOf<Wide> met{load(found.normal, first), load(found.view, first),
                              load(found.mirrored, first), load(found.cosine + first),
                              load_set(found.inner + first)};
  const ScatterOf<Wide> weights = scatter(material, met);
  const Vec3<Real> before = load(hits.throughput, first);
  const ScatteredRays mirrored =
      scattered_rays(load(found.org, first), met.mirrored, before, weights.reflection,
                     load_set(found.inside + first), live);
  const WideMask sphere = widen(~(Bits(hits.first_plane) <= load_integers(hits.id + first)));
  const ScatteredRays refracted = scattered_rays(
      move_off(load(found.point, first), met.normal * Wide(-1.0), load(found.reach + first)),
      weights.refracted, before, weights.refraction, sphere & ~met.inner, live);
  if (refracted.chosen == 0) {
    add_side(hits, first, mirrored, spawned);
  } else if (mirrored.chosen == 0) {
    add_side(hits, first, refracted, spawned);
  } else {
    add_both_sides(hits, first, mirrored, refracted, spawned);
  }
}

BOULE_INLINE void scatter_rays(const ScatteringHits& hits, GoingOn& spawned) {
  for (std::size_t first = 0; first < hits.size; first += width) {
    const unsigned live = bits(load_set(hits.scatters + first));
    if (live != 0) scatter_packet(hits, first, live, spawned);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
