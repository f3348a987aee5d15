#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "simd/abi/geometry.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/capsules.h"
#include "simd/geometry/parts.h"
#include "simd/geometry/slot_materials.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// The search structure: scan tests each sphere, bvh traverses a tree. The hits are the same;
/// automatic scans up to tuning::most_scanned spheres.
enum class Structure { automatic, scan, bvh };

/// Spheres, planes and capsules laid out for the kernels, with the numbers of the conservative
/// reject. Immutable once built, but for refit(). Takes any floats: rays miss a primitive that has
/// NaN, infinity or no normal, and a negative radius counts by its absolute value. Precondition: at
/// most max_primitives spheres and planes in all, which validate() checks. Throws std::bad_alloc,
/// and the exceptions of `parallel_for`.
class Geometry {
 public:
  Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes,
           Structure structure = Structure::automatic,
           const ParallelFor& parallel_for = serial_for);
  /// The same, built in place of the spheres, whose memory is given back during the build
  /// (build_bvh()).
  Geometry(std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
           Structure structure = Structure::automatic,
           const ParallelFor& parallel_for = serial_for);

  /// A geometry of several parts, whose ids and slots count on from part to part, and planes. Every
  /// hit is, bit for bit, that of a geometry of all their spheres. Preconditions: those of
  /// GeometryParts.
  static Geometry of_parts(std::vector<GeometryPart> parts, const std::vector<Plane>& planes);
  /// A geometry over an existing tree. Slots of the tree may name any ids and materials: every hit
  /// without a plane's id is a hit of the sphere in its slot.
  Geometry(std::shared_ptr<const Bvh> tree, std::size_t spheres, const std::vector<Plane>& planes);

  /// Adds capsules, whose ids follow those of the planes. Call it at most once. Precondition: at
  /// most max_primitives in all. Throws std::bad_alloc, and the exceptions of `parallel_for`.
  void add_capsules(const std::vector<Capsule>& capsules,
                    const ParallelFor& parallel_for = serial_for);

  /// Moves the spheres in place: that with the id k becomes spheres[k], except for its material.
  /// Every hit is then that of a new geometry, but rays may take longer. Returns false, with the
  /// geometry unchanged, if it takes a new one: if it has no tree, or if its tree is borrowed, in
  /// parts, or one that refit() of a tree refuses. Precondition: there are as many spheres.
  bool refit(std::span<const Sphere> spheres, const ParallelFor& parallel_for = serial_for);
  /// A new geometry of other spheres and of the same planes and capsules. Precondition: there are
  /// as many spheres.
  [[nodiscard]] Geometry with_spheres(std::vector<Sphere> spheres,
                                      const ParallelFor& parallel_for = serial_for) const;
  /// Whether the spheres are its own, in one list.
  [[nodiscard]] bool owns_spheres() const { return !parts_ && !tree_; }
  /// tree_cost() of its tree; 0 without one.
  [[nodiscard]] double cost() const;
  /// The spheres by id. Precondition: owns_spheres().
  [[nodiscard]] std::vector<Sphere> spheres() const;

  /// The view for the kernels; valid until this object, or the one that it is moved to, changes.
  [[nodiscard]] GeometryView view() const;

  /// The number of spheres it was built of; planes have the ids from there on.
  [[nodiscard]] std::size_t sphere_count() const { return sphere_count_; }
  [[nodiscard]] const std::vector<SphereCopy>& copies() const { return bvh_.copies; }
  [[nodiscard]] std::size_t plane_count() const { return plane_count_; }
  /// Whether a hit is that of a plane. Precondition: it is not a miss.
  [[nodiscard]] bool is_plane(const Hit& hit) const {
    return static_cast<std::uint32_t>(hit.id) - sphere_count_ < plane_count_;
  }
  [[nodiscard]] std::size_t capsule_count() const { return capsules_ ? capsules_->size() : 0; }
  /// Whether a hit is that of a capsule, which is then in its slot: ids may be wrong where a packed
  /// file supplies the slots of spheres. Precondition: it is not a miss.
  [[nodiscard]] bool is_capsule(const Hit& hit) const {
    return static_cast<std::uint32_t>(hit.id) - sphere_count_ - plane_count_ < capsule_count() &&
           hit.slot < capsules_->slots();
  }
  /// The capsule in a slot of a hit, in the default material. Precondition: is_capsule().
  [[nodiscard]] Capsule capsule(std::uint32_t slot) const { return capsules_->capsule(slot); }
  /// The materials of the spheres, by slot. Precondition: the geometry was built without parts.
  [[nodiscard]] const SlotMaterials& materials() const { return bvh_.materials; }
  /// The material of the sphere in a slot. Precondition: there is one.
  [[nodiscard]] MaterialRef material(std::uint32_t slot) const {
    return parts_ ? parts_->material(slot) : bvh_.materials[slot];
  }
  /// The sphere in a slot. Precondition: there is one, as in the slot of a hit.
  [[nodiscard]] Sphere sphere(std::uint32_t slot) const;
  /// The plane with this id, in the default material. Precondition: there is one.
  [[nodiscard]] Plane plane(std::int32_t id) const;
  /// Whether copies of spheres were left out (build_bvh()).
  [[nodiscard]] bool lacks_copies() const { return !bvh_.copies.empty(); }
  /// The copies that were left out of which the sphere with this id is the first that was kept.
  [[nodiscard]] std::span<const SphereCopy> copies_of(std::int32_t id) const;

 private:
  Geometry(std::size_t count, std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
           Structure structure, const ParallelFor& parallel_for);
  Geometry(Bvh bvh, std::size_t spheres, const std::vector<Plane>& planes);
  void set_scanned(std::size_t slot);
  void set_plane(std::size_t i, const Plane& plane);

  std::shared_ptr<const Bvh> tree_;  ///< the tree behind the view bvh_; null: bvh_ owns its arrays
  Bvh bvh_;
  std::shared_ptr<const GeometryParts> parts_;   ///< null: bvh_ has the spheres
  std::shared_ptr<const CapsuleTree> capsules_;  ///< null: none
  float extent_;
  std::size_t sphere_count_, plane_count_;
  AlignedArray<float> center_x_, center_y_, center_z_, radius_, reject_squared_, reject_radius_;
  AlignedArray<float> point_x_, point_y_, point_z_, normal_x_, normal_y_, normal_z_;
};

}  // namespace boule
