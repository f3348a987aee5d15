#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/prepare/prepared_scene.h"

namespace boule {

/// Finds the materials of the hits of one stream of rays, in the form of an integrator: AnyMaterial
/// is made of a FlatMaterial. Materials in a colour of their own are made at their first hit, some
/// again where there are many colours, and stay valid until the next stream.
template <class AnyMaterial>
class MaterialFinder {
 public:
  /// `scene` must outlive it.
  explicit MaterialFinder(const PreparedScene& scene)
      : scene_(scene), materials_(scene.materials.begin(), scene.materials.end()) {}

  /// Begins a stream of `rays` rays.
  void start(std::size_t rays) {
    made_.clear();
    last_ = {};
    if (!scene_.has_own_colors) return;
    made_.reserve(rays);  // so that every material keeps its address
    last_made_.fill({});
  }

  /// The material of the primitive that was hit. Precondition: it is called at most once for each
  /// ray.
  const AnyMaterial& find(const Hit& hit) {
    // Neighbouring rays often meet the same primitive; the ids of files may repeat.
    if (last_.material == nullptr || hit.id != last_.id || hit.slot != last_.slot)
      last_ = {hit.id, hit.slot, &find(scene_.material_ref(hit))};
    return *last_.material;
  }

 private:
  struct Made {
    MaterialRef ref;
    const AnyMaterial* material = nullptr;
  };
  struct Met {
    std::int32_t id = no_primitive;
    std::uint32_t slot = 0;
    const AnyMaterial* material = nullptr;
  };
  static constexpr unsigned slot_bits = 6;

  const AnyMaterial& find(MaterialRef ref) {
    if (!ref.has_color()) return materials_[ref.index()];
    Made& last = last_made_[slot_of(ref)];
    if (last.material == nullptr || !(last.ref == ref))
      last = {ref, &made_.emplace_back(scene_.colored_material(ref))};
    return *last.material;
  }

  /// Spreads colours evenly (Knuth's multiplicative hashing).
  static std::size_t slot_of(MaterialRef ref) {
    return ref.bits() * std::uint32_t{0x9e3779b9} >> (32 - slot_bits);
  }

  const PreparedScene& scene_;
  std::vector<AnyMaterial> materials_, made_;
  Met last_;
  std::array<Made, 1U << slot_bits> last_made_{};  ///< by slot_of()
};

}  // namespace boule
