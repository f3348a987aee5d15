#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/color.h"
#include "core/math/ray.h"
#include "render/integrators/depth_sums.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/path_buffers.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Rays of one depth, each with the sample to which it belongs and the weight of its radiance
/// there.
struct PathStream {
  RayBuffer* rays = nullptr;
  ColorStream throughput{};
  const std::uint32_t* sample = nullptr;
  const float* density = nullptr;  ///< density of choosing each direction; 0: of a mirror or camera
  int depth = 0;                   ///< number of bounces since the camera
};

/// The recursion of ray tracing as a loop over streams (lecture "Recursion"). An integrator takes a
/// stream, adds the radiance that its rays found, spawns the rays that continue, and takes the next
/// stream. The order is depth first, stream by stream, so memory grows with the depth and is
/// independent of the number of rays. The rays of each depth come in the order of their parents, so
/// every sum is the same for any size of the streams.
class Wavefront {
 public:
  /// Streams of spawned rays hold at most `stream_size` rays, which is >= 1, or `most_together`, if
  /// that is more: this many at most are spawned at once. Rays are left out whose weights add up to
  /// at most `left_out` for each sample and depth. `kernels` must outlive it.
  Wavefront(const KernelTable& kernels, std::size_t stream_size, std::size_t most_together,
            RaysPerDepth rays, float left_out = 0)
      : kernels_(kernels),
        stream_size_(stream_size),
        room_(std::max(stream_size, most_together)),
        left_out_(left_out),
        depth_sums_(rays) {}

  /// Begins with the camera's rays, one per sample. The caller keeps them alive.
  void start(RayBuffer& camera_rays);

  /// The next stream, or null at the end. Ends the life of the stream before.
  const PathStream* next();

  /// Adds the radiance that each ray of the current stream found.
  void add(const ColorStream& radiance);

  /// For records: adds a ray that continues from ray `parent` of the current stream, unless its
  /// weight in the sample is black. Its PathStream::density is 0. Precondition: parents come in
  /// order.
  void spawn(std::size_t parent, const Ray& ray, const Color& weight);

  /// Room for `most` more rays, behind others, that continue from the current stream: kernels add
  /// them, parents in order or one to a sample. Then end_spawning() takes them.
  GoingOn begin_spawning(std::size_t most);
  void end_spawning(const GoingOn& rays);

  /// Writes the radiance of every sample. Precondition: next() returned null.
  void finish(Color* radiance) { depth_sums_.finish(radiance); }

  /// The faults in all samples that were written so far.
  [[nodiscard]] const SampleFaults& faults() const { return depth_sums_.faults(); }

  /// The number of all rays that were spawned so far.
  [[nodiscard]] std::uint64_t spawned() const { return spawned_; }

 private:
  /// The memory behind a PathStream. The first `size` entries are in use.
  struct Stream {
    GoingOnBuffer rays;
    std::size_t size = 0;
    int depth = 0;
  };
  using StreamPtr = std::unique_ptr<Stream>;

  StreamPtr take_stream();
  Stream& open_stream(std::size_t rays);
  void recycle(std::vector<StreamPtr>& streams);
  void use(PathStream stream);
  void count_spawned(Stream& stream, std::size_t first);
  void leave_out_faint(Stream& stream, std::size_t first);

  const KernelTable& kernels_;
  std::size_t stream_size_;
  std::size_t room_;                           ///< of each stream
  float left_out_;                             ///< largest weight left out, per sample and depth
  std::size_t most_samples_ = 0;               ///< of a camera's rays so far
  ColorBuffer camera_throughput_;              ///< all 1
  AlignedArray<std::uint32_t> camera_sample_;  ///< 0, 1, 2 ...
  AlignedArray<float> camera_density_;         ///< all 0
  DepthSums depth_sums_;
  PathStream current_;
  ColorSum* sums_ = nullptr;         ///< of the current depth
  bool started_ = false;             ///< next() has returned the camera's rays
  StreamPtr running_;                ///< the memory of current_, unless that is the camera's rays
  std::vector<StreamPtr> waiting_;   ///< a stack, in which depths never fall towards the top
  std::vector<StreamPtr> children_;  ///< of the current stream, in order
  std::vector<StreamPtr> spare_;
  std::uint64_t spawned_ = 0;
};

}  // namespace boule
