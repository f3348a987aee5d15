#pragma once

#include "core/optics/lobes.h"
#include "render/prepare/flat_material.h"

namespace boule {

/// The kind of a material of flatten_for_paths(), by which its points are sorted.
inline LobeKind lobe_kind(const FlatMaterial& m) {
  if (!takes_direct_light(m)) return scatters(m) ? LobeKind::clear : LobeKind::none;
  return scatters(m) || m.highlight > 0 ? LobeKind::glossy : LobeKind::matte;
}

/// A material for Whitted's method.
struct WhittedMaterial {
  FlatMaterial flat;
  bool takes_light, sends_on;  ///< takes_direct_light(), scatters()

  explicit WhittedMaterial(const FlatMaterial& m)
      : flat(m), takes_light(takes_direct_light(m)), sends_on(scatters(m)) {}
};

/// A material for path tracing.
struct PathMaterial {
  FlatMaterial flat;
  LobeKind kind;
  bool emits;        ///< the constant is above black; then it reflects nothing
  bool takes_light;  ///< takes_direct_light(), unless it emits

  /// From a material of flatten_for_paths().
  explicit PathMaterial(const FlatMaterial& m)
      : flat(m),
        kind(is_black(m.constant) ? lobe_kind(m) : LobeKind::none),
        emits(!is_black(m.constant)),
        takes_light(!emits && takes_direct_light(m)) {}
};

}  // namespace boule
