#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "render/prepare/extreme_spheres.h"

namespace boule {

/// The outermost of the spheres that a scene's instances show, found without going through all of
/// them: a group is looked through once for a direction, not once for each time that it is shown,
/// and only where the box around it reaches as far as what was found before.
class ShownExtremes {
 public:
  /// The scene must be valid, and must outlive it. Throws std::bad_alloc, as runs() does.
  ShownExtremes(const Scene& scene, const ParallelFor& parallel_for);

  /// Goes through all spheres of the scene itself, and through some of those that its instances
  /// show. Among them are, for each of the measures, those for which it is least once the spheres
  /// are rounded to float. A sphere may come several times. Capsules come as the spheres around
  /// their ends, all of them. This object must outlive it.
  [[nodiscard]] SphereRuns runs(std::vector<SphereMeasure> measures) const;

 private:
  struct Box {
    Vec3d low, high;  ///< of the centres
    std::size_t largest = 0;
    double largest_radius = 0;
  };
  /// The spheres of one group that are extreme, where one instance shows it.
  struct Found {
    std::uint32_t shown;
    std::vector<std::uint32_t> spheres;
  };
  class Search;

  [[nodiscard]] Box box_of(std::span<const Sphere> spheres) const;
  [[nodiscard]] std::vector<Found> largest_spheres() const;
  void visit(const std::vector<Found>& found, const std::function<void(SphereRun)>& function) const;

  const Scene& scene_;
  ParallelFor parallel_for_;
  std::vector<ShownGroup> shown_;
  std::vector<Box> boxes_;  ///< by group
  double margin_ = 0;
};

}  // namespace boule
