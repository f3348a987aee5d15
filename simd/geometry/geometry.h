#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "simd/abi/geometry.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/parts.h"
#include "simd/geometry/slot_materials.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// How spheres are found: each is tested (scan), or a tree leads to them. The hits are the same;
/// automatic scans up to tuning::most_scanned.
enum class Structure { automatic, scan, bvh };

/// Spheres and planes laid out for the kernels, with the numbers the conservative reject needs.
/// Immutable once built. Takes any floats: what is NaN, infinite or without a normal is missed by
/// every ray, a negative radius counts as its size. Precondition: max_primitives spheres and planes
/// in all at most, which validate() checks. Throws std::bad_alloc, and what `parallel_for` throws.
class Geometry {
 public:
  Geometry(const std::vector<Sphere>& spheres, const std::vector<Plane>& planes,
           Structure structure = Structure::automatic,
           const ParallelFor& parallel_for = serial_for);
  /// The same, in the place of the spheres, whose memory is given back while it is built
  /// (build_bvh()).
  Geometry(std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
           Structure structure = Structure::automatic,
           const ParallelFor& parallel_for = serial_for);

  /// Of several parts, whose ids and slots count on from part to part, and planes. Any hit is, bit
  /// for bit, that of a geometry of all their spheres. Preconditions: those of GeometryParts.
  static Geometry of_parts(std::vector<GeometryPart> parts, const std::vector<Plane>& planes);
  /// Of spheres that are in a tree already. Slots of the tree may name any ids and materials: a hit
  /// whose id is no plane's is one of a sphere, which lies in its slot.
  Geometry(std::shared_ptr<const Bvh> tree, std::size_t spheres, const std::vector<Plane>& planes);

  /// What the kernels see; valid as long as this object, and not of one that was moved away.
  [[nodiscard]] GeometryView view() const;

  /// How many spheres it was built of; planes have the ids from here on.
  [[nodiscard]] std::size_t sphere_count() const { return sphere_count_; }
  /// Whether a hit is one of a plane. Precondition: it is no miss.
  [[nodiscard]] bool is_plane(const Hit& hit) const {
    return static_cast<std::uint32_t>(hit.id) - sphere_count_ < plane_count_;
  }
  /// What the spheres are made of, by slot. Precondition: it is not made of parts.
  [[nodiscard]] const SlotMaterials& materials() const { return bvh_.materials; }
  /// What the sphere in a slot is made of. Precondition: there is one.
  [[nodiscard]] MaterialRef material(std::uint32_t slot) const {
    return parts_ ? parts_->material(slot) : bvh_.materials[slot];
  }
  /// The sphere in a slot. Precondition: there is one, as in that of a hit.
  [[nodiscard]] Sphere sphere(std::uint32_t slot) const;

 private:
  Geometry(std::size_t count, std::vector<Sphere>&& spheres, const std::vector<Plane>& planes,
           Structure structure, const ParallelFor& parallel_for);
  Geometry(Bvh bvh, std::size_t spheres, const std::vector<Plane>& planes);
  void set_scanned(std::size_t slot);
  void set_plane(std::size_t i, const Plane& plane);

  std::shared_ptr<const Bvh> tree_;  ///< that bvh_ is a view of; null: it is no view
  Bvh bvh_;
  std::shared_ptr<const GeometryParts> parts_;  ///< null: bvh_ has the spheres
  float extent_;
  std::size_t sphere_count_, plane_count_;
  AlignedArray<float> center_x_, center_y_, center_z_, radius_, reject_squared_, reject_radius_;
  AlignedArray<float> point_x_, point_y_, point_z_, normal_x_, normal_y_, normal_z_;
};

}  // namespace boule
