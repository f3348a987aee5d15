#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/camera.h"
#include "render/apps/job/particle_look.h"
#include "render/apps/job/render_job.h"
#include "render/files/scene_file/scene_file.h"
#include "render/prepare/camera_fitter.h"
#include "render/prepare/sphere_bounds.h"

namespace boule {

/// The frames of a series that its choices are made from: all of them, or every so many if that
/// would be too much to read, with so many spheres each; the last in any case.
std::vector<int> surveyed_frames(const FrameRange& range, std::uint64_t spheres,
                                 std::uint64_t most_spheres);

/// False if there are particles, and all of them stay away.
bool shows_particles(const LoadedScene& loaded);

/// What the frames of a series have together: what particles choose, what the camera and the floor
/// depend on. The first one that has spheres says from where they are seen.
class SeriesSurvey {
 public:
  /// `size`: of the pictures.
  explicit SeriesSurvey(const SizeChoice& size) : size_(size) {}

  /// Adds a frame, and where it has its floor.
  void add(int frame, const LoadedScene& loaded, const std::optional<LookFloor>& floor);

  /// How many were added.
  [[nodiscard]] std::size_t size() const { return frames_; }
  /// The first that shows particles.
  [[nodiscard]] std::optional<int> first_shown() const { return first_shown_; }
  /// What the tables choose in a series of so many frames.
  [[nodiscard]] SeriesChoices choices(std::size_t count) const;
  /// Whether frames by themselves would choose other radii.
  [[nodiscard]] bool radii_differ() const;
  /// None if there are no spheres, or if it would be wrong: the frames by themselves tell why.
  [[nodiscard]] std::optional<Camera> camera() const;
  /// Whether camera() leaves out spheres far from all others.
  [[nodiscard]] bool leaves_out() const;
  /// Where all spheres begin along the floor's `up`; none without spheres or a floor.
  [[nodiscard]] std::optional<double> lowest() const { return lowest_; }

  /// The box around all spheres and capsules.
  [[nodiscard]] const std::optional<SphereBounds>& bounds() const { return bounds_; }

  /// "all 4 frames", "3 of the 4 frames".
  [[nodiscard]] std::string text(std::size_t count) const;

 private:
  void add_bounds(const SphereBounds& more);
  void add_near(const Scene& scene);

  SizeChoice size_;
  std::size_t frames_ = 0;
  std::optional<int> first_shown_;
  SeriesChoices choices_;
  Size pixels_{};                       ///< of the pictures, once there is a fitter
  std::optional<CameraFitter> fitter_;  ///< of all spheres
  std::optional<CameraFitter> near_;    ///< without those far from all others in their frame
  std::optional<Sphere> median_;        ///< of the first frame that looks so small
  bool has_outliers_ = false;
  std::optional<double> lowest_;
  std::optional<SphereBounds> bounds_;
};

}  // namespace boule
