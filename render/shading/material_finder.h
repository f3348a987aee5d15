#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/prepare/prepared_scene.h"

namespace boule {

/// Finds the materials of the hits of one stream of rays, as an integrator reads them: AnyMaterial
/// is made of a FlatMaterial. Those in a colour of their own are made when they are met, and stay
/// valid until the next stream.
template <class AnyMaterial>
class MaterialFinder {
 public:
  /// `scene` must outlive it.
  explicit MaterialFinder(const PreparedScene& scene)
      : scene_(scene), materials_(scene.materials.begin(), scene.materials.end()) {}

  /// Begins a stream of so many rays.
  void start(std::size_t rays) {
    made_.clear();
    if (scene_.has_own_colors) made_.reserve(rays);  // so that no material moves
  }

  /// The material of what was hit. Precondition: it is called at most once for each ray.
  const AnyMaterial& find(const Hit& hit) {
    const MaterialRef ref = scene_.material_ref(hit);
    if (!ref.has_color()) return materials_[ref.index()];
    // Rays beside each other often meet the same primitive, or others of its colour.
    if (!made_.empty() && ref == last_) return made_.back();
    last_ = ref;
    return made_.emplace_back(scene_.colored_material(ref));
  }

 private:
  const PreparedScene& scene_;
  std::vector<AnyMaterial> materials_, made_;
  MaterialRef last_;
};

}  // namespace boule
