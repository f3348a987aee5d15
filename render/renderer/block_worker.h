#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/frame/film.h"
#include "render/frame/live_passes.h"
#include "render/frame/pixel_order.h"
#include "render/frame/progress.h"
#include "render/frame/sampler.h"
#include "render/integrators/integrator.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/bare_pixels.h"
#include "render/renderer/edge_block.h"
#include "render/renderer/noise_block.h"
#include "render/renderer/sample_rays.h"
#include "render/renderer/small_spheres.h"
#include "simd/abi/kernel_table.h"

namespace boule {

/// The immutable data that all workers of a renderer share.
struct BlockSetup {
  const PreparedScene& scene;
  const KernelTable& kernels;
  Sampler sampler;
  std::vector<PixelOffset> block_pixels;  ///< of a whole block, in order
  std::size_t stream_size;                ///< largest number of camera rays in a stream, >= 1
  Alpha alpha;                            ///< whether films record which samples are covered
  PixelRect frame{};                      ///< of the picture, for noise
  NoiseTarget noise{};
  EdgeTarget edges{};
  SmallSpheres small_spheres{};  ///< with edges
  BarePixels bare_pixels{};      ///< they need no ray
  LiveProgress* live = nullptr;  ///< counts pixels whose noise was measured; null: off
};

/// Renders blocks on one thread. Preconditions: blocks lie in the film or picture, and are at most
/// as large as `block_pixels`.
class BlockWorker {
 public:
  /// `setup` must outlive it.
  BlockWorker(const BlockSetup& setup, std::unique_ptr<Integrator> integrator);

  /// Renders a block until every pixel has `until` samples. Returns false after a cancellation;
  /// then the film lacks some samples, but those it has are whole.
  bool render(const PixelRect& block, int until, Film& film);

  /// The same for the pixels that a pass picks, and for the samples of that pass.
  bool render(const PixelRect& block, const LivePass& pass, Film& film);

  /// Renders all samples of a block, or those that noise or edges ask for, and writes their means
  /// into `image`, a picture of the frame's pixels in `rect`. The samples are in a film of this
  /// block alone, which stays in the cache.
  bool render(const PixelRect& block, int until, Image& image, const PixelRect& rect);

  /// Gives the pixels of a block samples until they are as `setup.noise` or `setup.edges` asks.
  /// Returns false after a cancellation; then pixels without samples must be rendered again.
  bool measure(const PixelRect& block, MeasuredPicture& picture);

  /// All rays that this worker traced.
  [[nodiscard]] RayCounts counts() const { return integrator_->counts(); }

  /// The faults of its samples before they entered a film.
  [[nodiscard]] SampleFaults faults() const {
    SampleFaults all = integrator_->faults();
    return all += weighing_;
  }

 private:
  template <class Wanted>
  bool render_wanted(const PixelRect& block, int until, Film& film, const Wanted& wanted);
  template <class Part>
  bool measure_parts(const PixelRect& block, Part& part, MeasuredPicture& picture);
  template <class Part>
  bool measure_part(const PixelRect& rect, Part& part, MeasuredPicture& picture);
  template <class Target>
  bool add_bare(Target& target, int x, int y, int first, int end) const;
  template <class Target>
  bool trace(Target& target, std::size_t count);
  [[nodiscard]] CameraRays camera_rays(const SampleId* samples);
  [[nodiscard]] std::uint8_t covered(std::size_t ray) const {
    return covered_.empty() ? whole_coverage : covered_[ray];
  }
  template <class Target>
  bool trace_all(Target& target, std::span<const SampleId> ids);
  template <class Target>
  bool trace_weighted(Target& target, std::span<const SampleId> ids);

  const BlockSetup& setup_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<SampleId> ids_;   ///< room for the samples of a stream
  std::vector<SampleId> live_;  ///< the samples with a ray, if the camera weighs samples
  SampleRays found_;            ///< of these samples
  std::vector<Color> radiance_;
  std::vector<std::uint8_t> covered_;  ///< by ray; empty without alpha
  SampleFaults weighing_;              ///< of samples that were finite before their weighting
  Film block_film_{PixelRect{0, 0, 1, 1}};
  std::optional<NoiseBlock> noise_;
  std::optional<EdgeBlock> edges_;
};

}  // namespace boule
