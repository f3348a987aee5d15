#pragma once

#include <limits>
#include <span>

#include "core/base/parallel.h"
#include "core/scene/camera.h"
#include "core/scene/camera_fit.h"
#include "core/scene/primitive.h"
#include "render/prepare/default_view.h"
#include "render/prepare/extreme_spheres.h"

namespace boule {

/// Finds the tightest camera of one direction in whose frame the outlines of all spheres lie that
/// it was given, in one frame or several. The order in which they come does not matter.
class CameraFitter {
 public:
  /// For pictures of `width` x `height` pixels. Preconditions: `fit` has no Problem, and the up of
  /// `view` does not lie along its direction.
  CameraFitter(const CameraFit& fit, const View& view, int width, int height);

  void add(std::span<const Sphere> spheres, const ParallelFor& parallel_for = serial_for);

  /// The camera depends on the spheres by these measures only, and by those for which one is least.
  [[nodiscard]] std::vector<SphereMeasure> measures() const;

  /// The camera. It looks at the middle of the spheres' depths. Its coordinates are floats: the
  /// spheres are taken as larger by 2^-20 of the largest coordinate and of the eye's distance, so
  /// that all outlines are in the frame in spite of the rounding. Spheres smaller than that are
  /// seen from far enough that the direction keeps its digits. Numbers near the end of float's
  /// range can overflow here: find_problem() of the camera tells. Precondition: a sphere was added.
  [[nodiscard]] Camera camera() const;

 private:
  /// A side of the frame is a plane: of a pinhole all meet in its eye, of an orthographic camera
  /// opposite ones are parallel.
  struct Side {
    double sine = 0, cosine = 1;  ///< of its angle with the view
    /// The least distance of a sphere's surface from it as it would lie with the eye at the origin.
    double room = std::numeric_limits<double>::infinity();

    void set(double tangent);
    void narrow(double inward) { room = inward < room ? inward : room; }
  };
  /// Two opposite ones: at the left or lower end, and at the right or upper end.
  struct Sides {
    Side low, high;
  };

  void add(const Sphere& sphere);
  void add(const CameraFitter& other);
  [[nodiscard]] Camera pinhole() const;
  [[nodiscard]] Camera orthographic() const;
  [[nodiscard]] CameraPose pose_at(double x, double y, double depth) const;
  [[nodiscard]] double middle_depth() const { return (nearest_ + farthest_) / 2; }

  CameraFit fit_;
  int width_, height_;
  Vec3d right_, up_, forward_;
  Sides x_, y_;
  double nearest_ = std::numeric_limits<double>::infinity();    ///< depth of the first sphere
  double farthest_ = -std::numeric_limits<double>::infinity();  ///< and of the last
  double largest_ = 0;  ///< of all coordinates and radii, without their signs
};

}  // namespace boule
