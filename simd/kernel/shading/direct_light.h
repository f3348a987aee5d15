#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/reflectance.h"
#include "simd/abi/whitted.h"
#include "simd/kernel/shading/lane_materials.h"
#include "simd/kernel/vectors.h"

/// The direct light of one lamp on many points, W at a time.
namespace boule::BOULE_KERNEL_ISA {

/// The coefficients that direct light needs.
BOULE_INLINE CoefficientsOf<Wide> light_coefficients(const FlatMaterial* const* of_lane) {
  CoefficientsOf<Wide> loaded{};
  if (are_one(of_lane)) {
    loaded.diffuse = in_all_lanes(of_lane[0]->diffuse);
    loaded.highlight = of_lane[0]->highlight;
    loaded.shininess = of_lane[0]->shininess;
    loaded.common_exponent = as_whole_exponent(of_lane[0]->shininess);
    return loaded;
  }
  const float* diffuse[width];
  alignas(64) double numbers[2][width];
  for (std::size_t lane = 0; lane < width; ++lane) {
    diffuse[lane] = &of_lane[lane]->diffuse.r;
    numbers[0][lane] = of_lane[lane]->highlight;
    numbers[1][lane] = of_lane[lane]->shininess;
  }
  const Columns columns = load_rows(diffuse);
  loaded.diffuse = {columns.x, columns.y, columns.z};
  loaded.highlight = load(numbers[0]);
  loaded.shininess = load(numbers[1]);
  loaded.common_exponent = common_exponent(of_lane);
  return loaded;
}

/// The data of W shadow rays that are found by the ray of their point. Lanes beyond the live ones
/// hold a ray that exists.
class LitLanes {
 public:
  BOULE_INLINE LitLanes(const ShadowedPoints& shadows, std::size_t first, unsigned live)
      : shadows_(shadows), first_(first), live_(live) {
    const std::uint32_t* const rays = shadows.ray + first;
    pick_live(rays, live, ray_);
    in_a_row_ =
        shadows.size - first >= width && all(load_integers(rays) == count_from(shadows.ray[first]));
  }

  [[nodiscard]] BOULE_INLINE Vec3<Wide> pick(const VectorStream& by_ray) const {
    if (in_a_row_) {
      const std::size_t at = ray_in_lane_0();
      return {load_anywhere(by_ray.x + at), load_anywhere(by_ray.y + at),
              load_anywhere(by_ray.z + at)};
    }
    alignas(64) double picked[3][width];
    for (std::size_t lane = 0; lane < width; ++lane) {
      picked[0][lane] = by_ray.x[ray_[lane]];
      picked[1][lane] = by_ray.y[ray_[lane]];
      picked[2][lane] = by_ray.z[ray_[lane]];
    }
    return {load(picked[0]), load(picked[1]), load(picked[2])};
  }

  BOULE_INLINE void pick_materials(const FlatMaterial** of_lane) const {
    for (std::size_t lane = 0; lane < width; ++lane) of_lane[lane] = shadows_.material[ray_[lane]];
  }

  BOULE_INLINE void add(const Vec3<Real>& light, const ColorStream& radiance) const {
    if (in_a_row_) {
      add_in_a_row(light.x, radiance.r);
      add_in_a_row(light.y, radiance.g);
      add_in_a_row(light.z, radiance.b);
      return;
    }
    alignas(64) float sent[3][width];
    store(sent[0], light.x);
    store(sent[1], light.y);
    store(sent[2], light.z);
    for (unsigned left = live_; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
      radiance.r[ray_[lane]] += sent[0][lane];
      radiance.g[ray_[lane]] += sent[1][lane];
      radiance.b[ray_[lane]] += sent[2][lane];
    }
  }

 private:
  /// Precondition: all lanes are in a row.
  [[nodiscard]] BOULE_INLINE std::size_t ray_in_lane_0() const {
    const auto live = static_cast<std::size_t>(__builtin_ctz(live_));
    return ray_[live] - live;
  }
  BOULE_INLINE void add_in_a_row(const Real& light, float* radiance) const {
    float* const sums = radiance + ray_in_lane_0();
    const Real before = load_anywhere(sums);
    const RealMask blocked = narrow(load_set(shadows_.blocked + first_));
    store_anywhere(sums, select(blocked, before, before + light));
  }

  const ShadowedPoints& shadows_;
  const std::size_t first_;
  const unsigned live_;
  bool in_a_row_;  ///< lane k has the ray that follows lane k - 1's
  std::uint32_t ray_[width];
};

/// The lanes whose highlight is multiplied by n.l.
BOULE_INLINE WideMask cosine_highlights(const FlatMaterial* const* of_lane) {
  std::uint8_t set[width];
  for (std::size_t lane = 0; lane < width; ++lane)
    set[lane] = of_lane[lane]->cosine_highlight ? 1 : 0;
  return load_set(set);
}

BOULE_INLINE Vec3<Real> intensity_at(const LightIntensity& light, const LitLanes& lanes,
                                     const VectorStream& point) {
  Vec3<Real> all{light.intensity[0], light.intensity[1], light.intensity[2]};
  if (!light.falls_off) return all;
  const Vec3<Wide> position{light.position[0], light.position[1], light.position[2]};
  const Vec3<Wide> way = position - lanes.pick(point);
  return all * narrow(Wide(light.strength) / dot(way, way));
}

BOULE_INLINE void add_direct_light(const LightIntensity& light, const ShadowedPoints& shadows,
                                   const ColorStream& radiance) {
  for (std::size_t first = 0; first < shadows.size; first += width) {
    const unsigned live =
        first_lanes(shadows.size - first) & ~bits(load_set(shadows.blocked + first));
    if (live == 0) continue;
    const LitLanes lanes(shadows, first, live);
    const FlatMaterial* of_lane[width];
    lanes.pick_materials(of_lane);
    const CoefficientsOf<Wide> material = light_coefficients(of_lane);
    const Wide cosine = load(shadows.cosine + first);
    Wide power(0.0);
    Real share(1.0F);
    if (any(Wide(0.0) < material.highlight)) {
      power =
          highlight_power(material, lanes.pick(shadows.mirrored), load(shadows.to_light, first));
      share = select(narrow(cosine_highlights(of_lane)), narrow(cosine), share);
    }
    lanes.add(
        reflected_light(material, cosine, power, share, intensity_at(light, lanes, shadows.point)),
        radiance);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
