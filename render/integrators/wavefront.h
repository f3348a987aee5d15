#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/color.h"
#include "core/math/ray.h"
#include "render/integrators/depth_sums.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Live rays of one depth, each with the sample it works for and what its radiance counts there.
struct PathStream {
  RayBuffer* rays = nullptr;
  const Color* throughput = nullptr;
  const std::uint32_t* sample = nullptr;
  const float* density = nullptr;  ///< with which its direction was chosen, as spawn() was told
  int depth = 0;                   ///< bounces since the camera
};

/// The recursion of ray tracing as a loop over streams (lecture "Recursion"): whoever shades takes
/// a stream, adds radiance, spawns rays, and takes the next. Depth first, stream by stream, so
/// memory grows with the depth but not with the number of rays. Each depth's rays come in the
/// order of their parents whatever the stream size: it never shows in a sum.
class Wavefront {
 public:
  /// Streams of spawned rays hold up to `stream_size` rays, >= 1.
  explicit Wavefront(std::size_t stream_size) : stream_size_(stream_size) {}

  /// Begins with the camera's rays, one per sample, throughput 1. They stay the caller's.
  void start(RayBuffer& camera_rays);

  /// The next stream, or null when none is left. The last one must not be used any more.
  const PathStream* next();

  /// Adds radiance that a ray of the current stream found. Rays in order.
  void add(std::size_t ray, const Color& radiance) {
    const std::uint32_t sample = current_.sample[ray];
    sums_[sample] = sums_[sample] + light_product(current_.throughput[ray], radiance);
  }

  /// Sends a ray on from ray `parent` of the current stream, unless nothing of it would count.
  /// Parents in order. `density` is kept for who asks.
  void spawn(std::size_t parent, const Ray& ray, const Color& weight, float density = 0);

  /// Writes the radiance of every sample, after next() returned null.
  void finish(Color* radiance) { depth_sums_.finish(radiance); }

  /// What was wrong with the samples written so far, over all starts.
  [[nodiscard]] const SampleFaults& faults() const { return depth_sums_.faults(); }

  /// Rays spawned so far, over all starts.
  [[nodiscard]] std::uint64_t spawned() const { return spawned_; }

 private:
  /// A PathStream with its memory, filled from the front.
  struct Stream {
    RayBuffer rays;
    std::vector<Color> throughput;
    std::vector<std::uint32_t> sample;
    std::vector<float> density;
    std::size_t size = 0;
    int depth = 0;
  };
  using StreamPtr = std::unique_ptr<Stream>;

  StreamPtr take_stream();
  void recycle(std::vector<StreamPtr>& streams);
  void use(PathStream stream);

  std::size_t stream_size_;
  std::vector<Color> camera_throughput_;      ///< all 1
  std::vector<std::uint32_t> camera_sample_;  ///< 0, 1, 2 ...
  std::vector<float> camera_density_;         ///< all 0
  DepthSums depth_sums_;
  PathStream current_;
  Color* sums_ = nullptr;            ///< of the current depth
  bool started_ = false;             ///< the camera's rays were handed out
  StreamPtr running_;                ///< what current_ shows, unless that is the camera's rays
  std::vector<StreamPtr> waiting_;   ///< a stack: depths never fall towards its top
  std::vector<StreamPtr> children_;  ///< of the current stream, in order
  std::vector<StreamPtr> spare_;
  std::uint64_t spawned_ = 0;
};

}  // namespace boule
