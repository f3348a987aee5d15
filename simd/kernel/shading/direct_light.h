#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/reflectance.h"
#include "simd/abi/whitted.h"
#include "simd/kernel/shading/lane_materials.h"
#include "simd/kernel/vectors.h"

/// The light of one lamp on many points, W at a time.
namespace boule::BOULE_KERNEL_ISA {

/// Of W shadow rays, what is known by the ray whose point they leave. Lanes that are not live have
/// what a live one has.
class LitLanes {
 public:
  BOULE_INLINE LitLanes(const ShadowedPoints& shadows, std::size_t first, unsigned live)
      : shadows_(shadows) {
    pick_live(shadows.ray + first, live, ray_);
  }

  [[nodiscard]] BOULE_INLINE Vec3<Wide> pick(const VectorStream& by_ray) const {
    alignas(64) double picked[3][width];
    for (std::size_t lane = 0; lane < width; ++lane) {
      picked[0][lane] = by_ray.x[ray_[lane]];
      picked[1][lane] = by_ray.y[ray_[lane]];
      picked[2][lane] = by_ray.z[ray_[lane]];
    }
    return {load(picked[0]), load(picked[1]), load(picked[2])};
  }

  /// The coefficients that direct light needs.
  [[nodiscard]] BOULE_INLINE CoefficientsOf<Wide> materials() const {
    const float* diffuse[width];
    alignas(64) double numbers[2][width];
    for (std::size_t lane = 0; lane < width; ++lane) {
      const LobeMaterial& material = *shadows_.material[ray_[lane]];
      diffuse[lane] = material.diffuse;
      numbers[0][lane] = material.highlight;
      numbers[1][lane] = material.shininess;
    }
    CoefficientsOf<Wide> loaded{};
    const Columns columns = load_rows(diffuse);
    loaded.diffuse = {columns.x, columns.y, columns.z};
    loaded.highlight = load(numbers[0]);
    loaded.shininess = load(numbers[1]);
    return loaded;
  }

  /// Those whose highlight is multiplied by n.l.
  [[nodiscard]] BOULE_INLINE WideMask cosine_highlights() const {
    std::uint8_t set[width];
    for (std::size_t lane = 0; lane < width; ++lane)
      set[lane] = shadows_.material[ray_[lane]]->cosine_highlight ? 1 : 0;
    return load_set(set);
  }

  BOULE_INLINE void add(const Vec3<Real>& light, unsigned live, const ColorStream& radiance) const {
    alignas(64) float sent[3][width];
    store(sent[0], light.x);
    store(sent[1], light.y);
    store(sent[2], light.z);
    for (; live != 0; live &= live - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(live));
      radiance.r[ray_[lane]] += sent[0][lane];
      radiance.g[ray_[lane]] += sent[1][lane];
      radiance.b[ray_[lane]] += sent[2][lane];
    }
  }

 private:
  const ShadowedPoints& shadows_;
  std::uint32_t ray_[width];
};

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
    const CoefficientsOf<Wide> material = lanes.materials();
    const Wide cosine = load(shadows.cosine + first);
    Wide power(0.0);
    Real share(1.0F);
    if (any(Wide(0.0) < material.highlight)) {
      power =
          highlight_power(material, lanes.pick(shadows.mirrored), load(shadows.to_light, first));
      share = select(narrow(lanes.cosine_highlights()), narrow(cosine), share);
    }
    lanes.add(
        reflected_light(material, cosine, power, share, intensity_at(light, lanes, shadows.point)),
        live, radiance);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
