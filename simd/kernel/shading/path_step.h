#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/light_cone.h"
#include "core/optics/incidence.h"
#include "core/optics/lobes.h"
#include "simd/abi/paths.h"
#include "simd/kernel/camera/look_up.h"
#include "simd/kernel/shading/going_on.h"
#include "simd/kernel/shading/lane_materials.h"
#include "simd/kernel/tuning.h"
#include "simd/kernel/vectors.h"

/// The continuation of paths, W points at a time: a shadow ray to a sampled light, and a ray in a
/// random direction.
namespace boule::BOULE_KERNEL_ISA {

template <LobeKind kind>
BOULE_INLINE IncidenceOf<Wide> load_incidence(const LobePoints& points, std::size_t first) {
  const Vec3<Wide> normal = load(points.normal, first);
  if constexpr (kind == LobeKind::matte) {
    return {normal, {}, {}, {}, {}};
  } else {
    const Vec3<Wide> view = normalize(widen(load(points.dir, first)));
    const Wide cosine = facing_cosine(normal, view);
    const Bits inner = load_integers(points.side + first) & Bits(side_inner);
    return {normal, view, mirror(view, normal, cosine), cosine, widen(inner == Bits(side_inner))};
  }
}

/// The lights that were picked for W points, and new random numbers in place of those that picked
/// them.
struct PickedSpheres {
  Vec3<Wide> center;
  Wide radius, share;
  Vec3<Real> radiance;
  Wide u;
};

/// For look_up(): finds a sphere among many by its random number, and gives the 9 numbers of
/// LightSphere.
struct FindSphere {
  const LightSphere* lights;
  std::size_t count;

  BOULE_INLINE void operator()(const SpacedNumbers& given, const SpacedNumbers& found) const {
    std::size_t first = 0, last = count - 1;  // the light is one of first .. last
    while (first < last) {
      const std::size_t middle = (first + last) / 2;
      const bool later = lights[middle + 1].before <= given[0];
      first = later ? middle + 1 : first;
      last = later ? last : middle;
    }
    const LightSphere& light = lights[first];
    for (std::size_t k = 0; k < 3; ++k) {
      found[k] = light.center[k];
      found[6 + k] = static_cast<double>(light.radiance[k]);
    }
    found[3] = light.radius;
    found[4] = light.share;
    found[5] = light.before;
  }
};

/// With few lights, compares one after the other; with many, each lane looks up its own.
BOULE_INLINE PickedSpheres pick_spheres(const PathStep& step, const Wide& u) {
  const LightSphere* light = step.lights;
  PickedSpheres picked{{light->center[0], light->center[1], light->center[2]},
                       light->radius,
                       light->share,
                       {light->radiance[0], light->radiance[1], light->radiance[2]},
                       u};
  Wide before = light->before;
  if (step.light_count > tuning::most_compared_lights) {
    const Numbers<Wide, 9> found =
        look_up<9>(Numbers<Wide, 1>{{u}}, FindSphere{light, step.light_count});
    picked.center = {found.at[0], found.at[1], found.at[2]};
    picked.radius = found.at[3];
    picked.share = found.at[4];
    picked.radiance = {narrow(found.at[6]), narrow(found.at[7]), narrow(found.at[8])};
    before = found.at[5];
  } else {
    for (std::size_t k = 1; k < step.light_count; ++k) {
      ++light;
      const WideMask later = Wide(light->before) <= u;
      picked.center =
          select(later, {light->center[0], light->center[1], light->center[2]}, picked.center);
      picked.radius = select(later, light->radius, picked.radius);
      picked.share = select(later, light->share, picked.share);
      before = select(later, light->before, before);
      picked.radiance =
          select(narrow(later), {light->radiance[0], light->radiance[1], light->radiance[2]},
                 picked.radiance);
    }
  }
  picked.u = rescale<Wide>(u, {before, picked.share});
  return picked;
}

/// Light from directions that were chosen with a known density.
struct LightSamples {
  Vec3<Wide> direction;
  Wide density;
  Vec3<Real> radiance;
  Real tmax;  ///< of the shadow rays
};

BOULE_INLINE LightSamples sample_spheres(const PathStep& step, const Vec3<Wide>& org, const Wide& u,
                                         const Wide& v) {
  const Wide sphere_share = 1 - step.environment_share;
  const Wide rest =
      0 < step.environment_share ? (u - Wide(step.environment_share)) / sphere_share : u;
  const PickedSpheres picked = pick_spheres(step, rest);
  const LightConeOf<Wide> cone(org, picked.center, picked.radius);
  const Vec3<Wide> direction = cone.direction({picked.u, v});
  return {direction, sphere_share * picked.share * cone.density(), picked.radiance,
          narrow(cone.free_distance(direction))};
}

BOULE_INLINE LightSamples sample_lights(const PathStep& step, const Vec3<Wide>& org,
                                        std::size_t first) {
  const Wide u = load(step.light.u + first), v = load(step.light.v + first);
  LightSamples samples{};
  if (step.light_count > 0) samples = sample_spheres(step, org, u, v);
  if (step.given.given == nullptr) return samples;
  const WideMask given = load_set(step.given.given + first);
  const RealMask narrow_given = narrow(given);
  return {select(given, load(step.given.direction, first), samples.direction),
          select(given, load(step.given.density + first), samples.density),
          select(narrow_given, load(step.given.radiance, first), samples.radiance),
          select(narrow_given, Real(std::numeric_limits<float>::infinity()), samples.tmax)};
}

/// a b scale, in double, because a product of two of them could overflow or underflow in float.
BOULE_INLINE Vec3<Real> multiply(const Vec3<Real>& a, const Vec3<Real>& b, const Wide& scale) {
  const auto product = [&scale](const Real& x, const Real& y) {
    return narrow(widen(x) * widen(y) * scale);
  };
  return {product(a.x, b.x), product(a.y, b.y), product(a.z, b.z)};
}

/// Whether rays leave on the inside of a sphere. `side`: LobePoints::side.
BOULE_INLINE RealMask is_inside(const Bits& side) {
  return (side & Bits(side_inside)) == Bits(side_inside);
}

/// Appends the shadow rays that decide whether sampled light arrives, except those of weight 0.
template <LobeKind kind>
BOULE_INLINE void add_shadow_rays(const LobePoints& points, std::size_t first, unsigned live,
                                  const LobesOf<Wide, kind>& lobes, const Vec3<Wide>& normal,
                                  const PathStep& step, SampledLights& shadows) {
  const Vec3<Wide> org = load(points.org, first);
  const LightSamples light = sample_lights(step, org, first);
  const Wide cosine = dot(normal, light.direction);
  const unsigned chosen =
      live & bits((Wide(0.0) < cosine) & (Wide(0.0) < light.density) & lobes.shine());
  if (chosen == 0) return;
  const auto response = lobes.respond(cosine, light.direction);
  const Wide weight = step.weighs ? power_heuristic(light.density, response.density) : Wide(1.0);
  const Vec3<Real> arriving =
      multiply(response.reflected, light.radiance, weight / (Wide(elementary::pi) * light.density));
  const std::size_t at = shadows.size;
  shadows.size = store_leaving(shadows.rays, at,
                               {org, light.direction, load_integers(points.id + first),
                                is_inside(load_integers(points.side + first)), chosen});
  store_chosen(shadows.rays.tmax + at, light.tmax, chosen);
  store_chosen(shadows.radiance, at, arriving, chosen);
  store_chosen(shadows.ray + at, load_integers(points.ray + first) + Bits(step.first_ray), chosen);
}

/// Russian roulette: a path survives with some probability, and its weight is divided by it.
BOULE_INLINE RealMask play_roulette(const Vec3<Real>& throughput, const Wide& u,
                                    Vec3<Real>& weight) {
  const Vec3<Real> left = product(throughput, weight);
  Real largest = select(left.x < left.y, left.y, left.x);
  largest = select(largest < left.z, left.z, largest);
  const Real survival = select(Real(largest_survival) < largest, Real(largest_survival), largest);
  weight = weight * (Real(1.0F) / survival);
  return narrow(u < widen(survival));
}

/// Appends the rays that continue paths, except those that the roulette ends.
template <LobeKind kind>
BOULE_INLINE void add_rays(const LobePoints& points, std::size_t first, unsigned live,
                           const LobesOf<Wide, kind>& lobes, const Vec3<Wide>& normal,
                           const PathStep& step, GoingOn& spawned) {
  BounceOf<Wide> bounce = lobes.bounce({load(step.bounce.u + first), load(step.bounce.v + first)});
  const Vec3<Real> before = load(points.throughput, first);
  unsigned chosen = live & bits(lobes.shine());
  if (step.survival != nullptr)
    chosen &= bits(play_roulette(before, load(step.survival + first), bounce.weight));
  const Vec3<Real> throughput = light_product(before, bounce.weight);
  chosen &= bits(~is_black_in<Wide>(throughput));
  if (chosen == 0) return;
  Vec3<Wide> org = load(points.org, first);
  Bits side = load_integers(points.side + first);
  if constexpr (kind != LobeKind::matte) {
    const Vec3<Wide> beyond =
        move_off(load(points.point, first), normal * Wide(-1.0), load(points.reach + first));
    org = select(bounce.beyond, beyond, org);
    side = select(narrow(bounce.beyond), side >> 1, side);
  }
  add_going_on({org, bounce.direction, load_integers(points.id + first), is_inside(side), chosen},
               throughput, load_integers(points.sample + first), narrow(bounce.density), spawned);
}

template <LobeKind kind>
BOULE_INLINE void continue_points(const LobePoints& points, const PathStep& step,
                                  SampledLights& shadows, GoingOn& spawned) {
  for (std::size_t first = 0; first < points.size; first += width) {
    const unsigned lanes = first_lanes(points.size - first);
    std::uint32_t ray[width];
    pick_live(points.ray + first, lanes, ray);
    const FlatMaterial* of_lane[width];
    for (std::size_t lane = 0; lane < width; ++lane) of_lane[lane] = step.material[ray[lane]];
    const CoefficientsOf<Wide> material = load_materials<kind>(of_lane);
    const IncidenceOf<Wide> met = load_incidence<kind>(points, first);
    const LobesOf<Wide, kind> lobes(material, met);
    if constexpr (kind != LobeKind::clear) {
      if (step.samples_lights)
        add_shadow_rays(points, first, lanes, lobes, met.normal, step, shadows);
    }
    if (step.goes_on) add_rays(points, first, lanes, lobes, met.normal, step, spawned);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
