#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/axis_extremes.h"
#include "core/scene/scene.h"
#include "core/scene/sphere_digest.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// A sphere and its number in its chunk.
struct PackedSphere {
  Sphere sphere;
  std::uint32_t id;
};

/// Every so many spheres of many: few enough to be kept, and enough to divide all of them by.
class SphereSample {
 public:
  /// The sphere that comes next.
  void add(const Sphere& sphere) {
    if (count_++ % step_ == 0) take(sphere);
  }
  /// How many spheres there were.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }

 private:
  void take(const Sphere& sphere);

  std::vector<Sphere> spheres_;
  std::uint64_t step_ = 1, count_ = 0;
};

/// Finds, as spheres pass by in their order, what of all of them a packed scene keeps, and of each
/// chunk how it is to be built. The result does not depend on what runs the loops.
class SphereSurvey {
 public:
  /// `scene` has their materials and must outlive it.
  explicit SphereSurvey(const Scene& scene) : scene_(scene), made_of_(scene.materials.size()) {}

  /// Begins another chunk.
  void begin_chunk();
  /// Takes the next spheres, which are valid. Throws std::bad_alloc.
  void add(std::span<const Sphere> spheres, const ParallelFor& parallel_for);

  /// Of all spheres.
  [[nodiscard]] PackedSpheres facts() const;

  /// Of the chunk: how many they are, and the first one's material.
  [[nodiscard]] std::uint64_t size() const { return sample_.count(); }
  [[nodiscard]] MaterialRef material() const { return material_; }
  /// Whether all are made of that.
  [[nodiscard]] bool alike() const { return alike_; }
  [[nodiscard]] const SphereSample& sample() const { return sample_; }
  /// The ids, in order, of those that the tree had better not hold, as find_spheres_apart() does.
  [[nodiscard]] std::vector<std::uint32_t> apart() const;

 private:
  struct Piece;

  void survey(std::span<const Sphere> spheres, std::uint32_t first, Piece& piece) const;
  void add(const Piece& piece);
  void keep_large(const PackedSphere& sphere);

  const Scene& scene_;
  SphereDigest digest_;
  std::uint64_t count_ = 0;
  bool has_own_colors_ = false;
  Vec3d low_{inf, inf, inf}, high_{-inf, -inf, -inf};
  std::vector<std::uint64_t> made_of_;
  std::vector<Sphere> emissive_, first_;
  AxisExtremes extremes_;

  bool alike_ = true;
  MaterialRef material_;
  SphereSample sample_;
  std::vector<std::uint32_t> unfit_;  ///< that no filter can judge
  std::vector<PackedSphere> large_;   ///< the largest of the others
  BuildBox rest_;                     ///< around all others

  static constexpr double inf = std::numeric_limits<double>::infinity();
};

}  // namespace boule
