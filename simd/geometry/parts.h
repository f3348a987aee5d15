#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/math/similarity.h"
#include "core/scene/primitive.h"
#include "simd/abi/geometry.h"

namespace boule {

class Geometry;

/// A tree of spheres somewhere in a scene.
struct GeometryPart {
  std::shared_ptr<const Geometry> tree{};   ///< without planes and parts; parts may share it
  std::optional<Similarity> transform{};    ///< none: its spheres are where they are
  std::optional<std::uint32_t> material{};  ///< replaces all others, with their colours
};

/// Several parts laid out for the kernels, and a tree over their boxes. Throws std::bad_alloc, and
/// std::length_error if together they have 2^32 slots or more. Preconditions: there is a part; each
/// has a sphere; all coordinates and radii, moved or not, are within the range of the filters
/// (most_shared_coordinate of core/scene/instances.h sees to that); max_shown_primitives in all.
class GeometryParts {
 public:
  /// In all parts: a slot is 32 bits, and the last is none.
  static constexpr std::uint64_t most_slots = 0xffffffff;

  explicit GeometryParts(std::vector<GeometryPart> parts);

  [[nodiscard]] PartsView view() const { return {views_.data(), views_.size()}; }
  /// Over the parts: PartsView.
  [[nodiscard]] BvhView bvh() const { return {nodes_.data(), nodes_.size(), extent_}; }
  [[nodiscard]] std::size_t sphere_count() const { return spheres_; }
  /// The sphere in a slot, as transformed() has it. Precondition: there is one.
  [[nodiscard]] Sphere sphere(std::uint32_t slot) const;
  [[nodiscard]] MaterialRef material(std::uint32_t slot) const;

 private:
  [[nodiscard]] std::size_t part_of(std::uint32_t slot) const;

  std::vector<GeometryPart> parts_;
  std::vector<PartView> views_;
  std::vector<BvhNode> nodes_;
  float extent_ = 0;
  std::size_t spheres_ = 0;
};

}  // namespace boule
