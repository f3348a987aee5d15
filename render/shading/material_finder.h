#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/prepare/prepared_scene.h"

namespace boule {

/// Finds the materials of the hits of one stream of rays, in the form of an integrator: AnyMaterial
/// is made of a FlatMaterial. Materials in a colour of their own are made at their first hit, and
/// stay valid until the next stream.
template <class AnyMaterial>
class MaterialFinder {
 public:
  /// `scene` must outlive it.
  explicit MaterialFinder(const PreparedScene& scene)
      : scene_(scene), materials_(scene.materials.begin(), scene.materials.end()) {}

  /// Begins a stream of `rays` rays.
  void start(std::size_t rays) {
    made_.clear();
    if (scene_.has_own_colors) made_.reserve(rays);  // so that every material keeps its address
  }

  /// The material of the primitive that was hit. Precondition: it is called at most once for each
  /// ray.
  const AnyMaterial& find(const Hit& hit) {
    const MaterialRef ref = scene_.material_ref(hit);
    if (!ref.has_color()) return materials_[ref.index()];
    // Neighbouring rays often hit the same primitive, or others of its colour.
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
