#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/math/similarity.h"
#include "core/scene/primitive.h"
#include "simd/abi/geometry.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {

class Geometry;

/// A tree of spheres at some place in a scene.
struct GeometryPart {
  std::shared_ptr<const Geometry> tree{};   ///< without planes and parts; parts may share it
  std::optional<Similarity> transform{};    ///< none: the spheres keep their places
  std::optional<std::uint32_t> material{};  ///< replaces all materials, with their colours
};

/// Several parts laid out for the kernels, and a tree over their boxes. Throws std::bad_alloc, and
/// std::length_error if they have 2^32 slots or more in total. Preconditions: there is a part; each
/// has a sphere; all coordinates and radii, moved or not, are within the range of the filters
/// (most_shared_coordinate of core/scene/instances.h ensures it); at most max_shown_primitives in
/// total.
class GeometryParts {
 public:
  /// In all parts: a slot has 32 bits, and the highest number means none.
  static constexpr std::uint64_t most_slots = 0xffffffff;

  explicit GeometryParts(std::vector<GeometryPart> parts);

  [[nodiscard]] PartsView view() const { return {views_.data(), views_.size()}; }
  /// The tree over the parts: PartsView.
  [[nodiscard]] BvhView bvh() const { return {nodes_.data(), nodes_.size(), extent_}; }
  [[nodiscard]] std::size_t sphere_count() const { return spheres_; }
  /// The sphere in a slot, as transformed() places it. Precondition: there is one.
  [[nodiscard]] Sphere sphere(std::uint32_t slot) const;
  [[nodiscard]] MaterialRef material(std::uint32_t slot) const;
  /// The copies that the trees leave out, by their ids in the scene.
  [[nodiscard]] std::vector<SphereCopy> copies() const;

 private:
  [[nodiscard]] std::size_t part_of(std::uint32_t slot) const;

  std::vector<GeometryPart> parts_;
  std::vector<PartView> views_;
  std::vector<BvhNode> nodes_;
  float extent_ = 0;
  std::size_t spheres_ = 0;
};

}  // namespace boule
