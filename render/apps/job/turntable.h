#pragma once

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "render/apps/job/render_job.h"

namespace boule {

/// The cameras before which a scene turns once around what is upward.
class Turntable {
 public:
  /// The scene's camera, which turns around the point that it looks at, or else one that is fitted
  /// to all spheres as they turn, around the middle of their box: no outline leaves the picture. An
  /// error if the spheres are packed and the scene has no camera, or if there is nothing to fit one
  /// to. Throws std::bad_alloc.
  static Result<Turntable> of(const Scene& scene, const Size& size,
                              const ParallelFor& parallel_for = serial_for);

  /// The camera that sees the scene turned by so many degrees, counter-clockwise from above.
  [[nodiscard]] Camera at(double degrees) const;

 private:
  Turntable(Camera camera, const Vec3d& point, const Vec3d& axis)
      : camera_(std::move(camera)), point_(point), axis_(axis) {}

  Camera camera_;
  Vec3d point_, axis_;  ///< of unit length
};

}  // namespace boule
