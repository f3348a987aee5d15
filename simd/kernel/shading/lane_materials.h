#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/lobes.h"
#include "simd/abi/paths.h"
#include "simd/lanes/lanes.h"

/// The materials of W points, found by an index.
namespace boule::BOULE_KERNEL_ISA {

/// One entry per lane: picked[lane] = of_packet[lane]. Lanes beyond the live ones get the entry of
/// a live lane. Precondition: a lane is live.
template <class T>
BOULE_INLINE void pick_live(const T* of_packet, unsigned live, T* picked) {
  const auto any = static_cast<std::size_t>(__builtin_ctz(live));
  for (std::size_t lane = 0; lane < width; ++lane)
    picked[lane] = of_packet[(live >> lane & 1U) != 0 ? lane : any];
}

/// Whether all lanes have the same material, as is usual for neighbours.
BOULE_INLINE bool are_one(const FlatMaterial* const* of_lane) {
  bool one = true;
  for (std::size_t lane = 1; lane < width; ++lane) one &= of_lane[lane] == of_lane[0];
  return one;
}

BOULE_INLINE Vec3<Real> in_all_lanes(const Color& color) { return {color.r, color.g, color.b}; }

/// CoefficientsOf::common_exponent of W materials.
BOULE_INLINE int common_exponent(const FlatMaterial* const* of_lane) {
  bool same = true;
  for (std::size_t lane = 1; lane < width; ++lane)
    same &= of_lane[lane]->shininess == of_lane[0]->shininess;
  return same ? as_whole_exponent(of_lane[0]->shininess) : 0;
}

/// One material in all lanes.
template <LobeKind kind>
BOULE_INLINE CoefficientsOf<Wide> load_material(const FlatMaterial& material) {
  if constexpr (kind == LobeKind::matte) {
    return {in_all_lanes(material.diffuse), {}, {}, {}, {}, {}, {}};
  } else {
    const Vec3<Real> black{0.0F, 0.0F, 0.0F};
    return {kind == LobeKind::clear ? black : in_all_lanes(material.diffuse),
            in_all_lanes(material.mirror),
            in_all_lanes(material.transmission),
            material.highlight,
            material.shininess,
            material.ior,
            widen(uniform(material.fresnel)),
            as_whole_exponent(material.shininess)};
  }
}

/// The materials of W points.
template <LobeKind kind>
BOULE_INLINE CoefficientsOf<Wide> load_materials(const FlatMaterial* const* of_lane) {
  if (are_one(of_lane)) return load_material<kind>(*of_lane[0]);
  const float *diffuse[width], *mirror[width], *transmission[width];
  alignas(64) double numbers[3][width];
  std::uint8_t fresnel[width];
  for (std::size_t lane = 0; lane < width; ++lane) {
    const FlatMaterial& material = *of_lane[lane];
    diffuse[lane] = &material.diffuse.r;
    if constexpr (kind != LobeKind::matte) {
      mirror[lane] = &material.mirror.r;
      transmission[lane] = &material.transmission.r;
      numbers[0][lane] = material.highlight;
      numbers[1][lane] = material.shininess;
      numbers[2][lane] = material.ior;
      fresnel[lane] = material.fresnel ? 1 : 0;
    }
  }
  const auto color = [](const float* const* rows) {
    const Columns columns = load_rows(rows);
    return Vec3<Real>{columns.x, columns.y, columns.z};
  };
  if constexpr (kind == LobeKind::matte) {
    return {color(diffuse), {}, {}, {}, {}, {}, {}};
  } else {
    const Vec3<Real> black{0.0F, 0.0F, 0.0F};
    return {kind == LobeKind::clear ? black : color(diffuse),
            color(mirror),
            color(transmission),
            load(numbers[0]),
            load(numbers[1]),
            load(numbers[2]),
            load_set(fresnel),
            common_exponent(of_lane)};
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
