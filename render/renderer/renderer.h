#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/frame/film.h"
#include "render/frame/scheduler.h"
#include "render/image/image.h"
#include "render/integrators/integrator.h"
#include "render/renderer/block_worker.h"
#include "render/renderer/render_options.h"
#include "render/renderer/run_statistics.h"

namespace boule {

/// What rendering has cost so far, over all passes.
struct RenderStatistics : RunStatistics {
  RayCounts rays;
  SampleFaults faults;
  double render_seconds = 0;
};

/// A scene and how to render it: the library's public face. The bits of a picture depend on
/// neither ISA, threads, order, tile size nor crop; the caller's rounding mode, denormal flags and
/// traps do not matter and are left as they were (FloatEnvironment). Nothing here throws but what
/// options.update throws: what fails, a progress callback too, is a Diagnostic. The calling thread
/// needs 2 MiB of stack. One call at a time. Of a renderer that was moved away the calls below are
/// errors, and what only tells (scene(), notes(), statistics()) must not be called.
class Renderer {
 public:
  /// Prepares the scene, which is not needed any more afterwards. Takes any values: an error if
  /// scene or options are invalid (validate()), the ISA is not to be had, or the memory does not
  /// suffice.
  static Result<Renderer> create(const Scene& scene, const RenderOptions& options);
  /// The same without a copy of the spheres and planes.
  static Result<Renderer> create(Scene&& scene, const RenderOptions& options);

  /// The whole picture, or its crop, in one pass: what a film has after render_pass(), without the
  /// memory of one.
  Result<Image> render();

  /// One pass: brings every pixel of the film to `until` samples, 1 .. spp; those that have as many
  /// are left alone. Call it again with the same film and a greater `until` to refine a picture:
  /// the result is the same as that of one pass. Cancelled or failed, it is an error, and the film
  /// keeps what was done: calling again goes on from there.
  Status render_pass(Film& film, int until);

  /// The same while somebody watches: all the passes that the options' order has (LivePasses),
  /// options.update after each. Cancelled, it is an error, and what the film has can be shown.
  Status render_live(Film& film);

  /// The views that the options select, of the rays through the pixels' centres, unfiltered: as
  /// extra channels for write_image. Their rays count as primary ones. Cancelled, it is an error.
  Result<std::vector<ImageChannel>> render_aovs();

  [[nodiscard]] const RenderOptions& options() const { return options_; }
  /// The pixels a film for this renderer has.
  [[nodiscard]] PixelRect rect() const { return rendered_rect(options_); }
  /// The scene as rendered: its camera is there even if the scene named none.
  [[nodiscard]] const PreparedScene& scene() const { return *scene_; }
  /// What was decided for the user, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return scene_->notes; }
  [[nodiscard]] RenderStatistics statistics() const;

 private:
  template <class AnyScene>
  static Result<Renderer> create_from(AnyScene&& scene, const RenderOptions& options);
  Renderer(const RenderOptions& options, PreparedScene scene, const KernelTable& kernels);
  std::unique_ptr<BlockWorker> make_worker() const;
  [[nodiscard]] RayCounts count_rays() const;
  [[nodiscard]] SampleFaults count_faults() const;
  /// Renders a block; false if it was cancelled.
  using BlockTask = std::function<bool(BlockWorker&, const PixelRect& block)>;
  Status check_film(const Film& film) const;
  Status run_blocks(const BlockTask& task, const LiveProgress::PassSpan& span);
  Status find_aovs(AovChannels& channels);

  RenderOptions options_;
  std::unique_ptr<const PreparedScene> scene_;  ///< workers refer to it: it stays where it is
  std::unique_ptr<const BlockSetup> setup_;     ///< likewise
  BlockOrder blocks_;
  Scheduler scheduler_;
  std::vector<std::unique_ptr<BlockWorker>> workers_;
  RayCounts aov_rays_;
  double prepare_seconds_ = 0;
  double render_seconds_ = 0;
};

}  // namespace boule
