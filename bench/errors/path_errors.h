#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/frame/sampler.h"
#include "render/integrators/path.h"
#include "render/integrators/random_numbers.h"

namespace boule::bench {

/// A scene ready to be path-traced as a PathPicture.
struct PathScene {
  PreparedScene prepared;
  int max_depth;
};

/// Reads a scene file; its camera must be a pinhole or orthographic.
Result<PathScene> load_path_scene(const std::string& file);

/// How samples of a pixel belong together: as one sequence, or not at all, as random numbers do.
enum class Samples { sequence, random };

/// A path-traced picture on one thread: pixels' means of more and more samples.
class PathPicture {
 public:
  static constexpr int width = 128, height = 72;

  /// `scene` and `kernels` must outlive it.
  PathPicture(const PathScene& scene, const KernelTable& kernels, std::uint64_t seed);

  /// Adds one sample to each pixel. A random one is the first of a sequence of its own, that of a
  /// pixel far away: it costs the same.
  void add(int sample, Samples samples);

  /// Root of the mean square of all differences.
  [[nodiscard]] double distance_to(const PathPicture& other) const;

  [[nodiscard]] RayCounts counts() const { return path_.counts(); }

 private:
  const PreparedScene& scene_;
  const KernelTable& kernels_;
  Sampler sampler_;
  Path path_;
  std::vector<Vec3d> sums_;
  int count_ = 0;
  RandomNumbers numbers_;
  SampleBuffer places_;
  RayBuffer rays_;
  std::vector<SampleId> ids_;
  std::vector<Color> radiance_;
};

/// A picture of so many samples a pixel: processor seconds, and its RMS distance from the
/// reference.
struct PathError {
  int samples;
  double seconds, error;
};

/// Errors at 1, 2, 4 ... samples, of both kinds, which take turns.
struct PathErrors {
  std::vector<PathError> sequence, random;
};

/// Against a sequence of `reference` samples of another seed, up to an eighth of that; one thread.
PathErrors measure_path_errors(const PathScene& scene, const KernelTable& kernels, int reference);

}  // namespace boule::bench
