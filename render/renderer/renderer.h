#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/frame/film.h"
#include "render/frame/live_passes.h"
#include "render/frame/measured_picture.h"
#include "render/frame/scheduler.h"
#include "render/image/image.h"
#include "render/integrators/integrator.h"
#include "render/integrators/ray_record.h"
#include "render/renderer/block_worker.h"
#include "render/renderer/live_position.h"
#include "render/renderer/outline.h"
#include "render/renderer/render_options.h"
#include "render/renderer/run_statistics.h"

namespace boule {

class BandQueue;
class BlockTools;

/// The cost of rendering, over all passes so far.
struct RenderStatistics : RunStatistics {
  RayCounts rays{};
  SampleFaults faults{};
  double render_seconds = 0;
};

/// Renders a scene. The bits of a picture are the same for any ISA, threads, order, tile size and
/// crop. Every failure is a Diagnostic, an exception of options.progress included; only exceptions
/// of options.update propagate to the caller. After a renderer was moved from, its rendering
/// functions return an error, and scene(), notes() and statistics() must not be called.
class Renderer {
 public:
  /// Prepares the scene, which may be destroyed afterwards. Takes any values. An error if the scene
  /// or the options are invalid (validate()), if this computer lacks the ISA, or if there is too
  /// little memory.
  static Result<Renderer> create(const Scene& scene, const RenderOptions& options);
  /// The same without a copy of the primitives.
  static Result<Renderer> create(Scene&& scene, const RenderOptions& options);

  /// A renderer of a scene that was prepared for `options`: their size, method and transparency.
  /// Several renderers can share the scene. This precondition is unchecked.
  static Result<Renderer> create(std::shared_ptr<const PreparedScene> scene,
                                 const RenderOptions& options);

  /// Renders the whole picture, or its crop, in one pass. The picture equals that of a film after
  /// render_pass(), and takes less memory than a film.
  Result<Image> render();

  /// The same with the noise and the number of samples of each pixel, and without the outline, into
  /// a picture without samples. An error after a cancellation; the picture keeps the finished
  /// pixels. If there is a `preview`, it first gets a sample of every pixel, so that you can show
  /// it early. Preconditions: is_measured(options()); both have the pixels of rect().
  Status render_measured(MeasuredPicture& picture, Film* preview = nullptr);

  /// Renders the same picture in bands of rows from the top, so that only some of them are in
  /// memory (Bands::most_bytes). Calls take(band) for each of them in order, on the threads that
  /// render, one call at a time, while the other threads work on the next bands. A Diagnostic of
  /// `take` ends the rendering and is returned. statistics() leaves out the time of `take`.
  Status render_bands(const std::function<Status(const Image& band)>& take);

  /// Renders until every pixel of the film has at least `until` samples, 1 .. spp. To refine the
  /// picture, call it again with the same film and a greater `until`; the result equals that of a
  /// single pass. An error after a cancellation or failure; the film keeps its samples, and the
  /// next call continues from there.
  Status render_pass(Film& film, int until);

  /// Renders all samples in the passes of options.order (LivePasses), and calls options.update
  /// after each of them, so that you can show the picture as it grows. An error after a
  /// cancellation; the film can still be shown.
  Status render_live(Film& film);

  /// render_live() in steps: continues from `position`, advances it, and ends after about `limit`.
  /// options.update is not called. An error after a cancellation; then the film has whole samples,
  /// but it must start again.
  Status render_step(Film& film, LivePosition& position, const StepLimit& limit);
  [[nodiscard]] bool done(const LivePosition& position) const;
  /// The position at which to begin with an empty film, so that the pixels that have waited longest
  /// come first.
  [[nodiscard]] LivePosition restarted(const LivePosition& position) const;
  /// The fraction of all samples that are done.
  [[nodiscard]] double share_done(const LivePosition& position) const;

  /// The AOVs that options.aovs selects and that need rays of their own, as extra channels for
  /// write_image(). (The others are measured_channels().) Their rays go through the pixels'
  /// centres, without a filter, and count as primary rays. An error after a cancellation.
  Result<std::vector<ImageChannel>> render_aovs();

  /// The rays of the recursion through the centre of pixel (x, y), and of the lens: Whitted's,
  /// whatever the method, without ghosts and fog. Returns the weight that the camera gives the
  /// sample: the picture with one sample has the record's total times this weight. 0: there is no
  /// ray, and the record is empty. An error if there are too many rays, or not enough memory.
  /// Preconditions: the pixel lies in the frame; the scene was prepared for Method::whitted.
  Result<float> record_pixel(int x, int y, RayRecord& record) const;

  /// The lines that options.outline asks for. render() draws them itself; for a picture of a film,
  /// call Outline::draw(). Their rays count as primary rays. An error after a cancellation.
  Result<Outline> render_outline();

  /// Lets you choose the blocks yourself: calls task(tools) once on each thread, in parallel, and
  /// waits for all. A thread's tools render the bits of render(). An error if a task throws; the
  /// tasks themselves know whether all blocks are rendered. Adds to statistics().
  Status work(const std::function<void(BlockTools&)>& task);

  [[nodiscard]] const RenderOptions& options() const { return options_; }
  /// The pixels of a film for this renderer.
  [[nodiscard]] PixelRect rect() const { return rendered_rect(options_); }
  /// The prepared scene, with the default camera if it had none.
  [[nodiscard]] const PreparedScene& scene() const { return *scene_; }
  /// Automatic choices, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return scene_->notes; }
  [[nodiscard]] RenderStatistics statistics() const;

 private:
  template <class AnyScene>
  static Result<Renderer> create_from(AnyScene&& scene, const RenderOptions& options);
  Renderer(const RenderOptions& options, std::shared_ptr<const PreparedScene> scene,
           const KernelTable& kernels, SmallSpheres small_spheres, BarePixels bare_pixels);
  static Diagnostic moved_away();
  std::unique_ptr<BlockWorker> make_worker() const;
  [[nodiscard]] IntegratorSettings integrator_settings() const;
  [[nodiscard]] RayCounts count_rays() const;
  [[nodiscard]] SampleFaults count_faults() const;
  /// Renders a block. Returns false after a cancellation.
  using BlockTask = std::function<bool(BlockWorker&, const PixelRect& block)>;
  BlockWorker& worker(unsigned index);
  Status check_film(const Film& film) const;
  [[nodiscard]] LiveProgress::PassSpan pass_from(double begin) const;
  Status run_slice(Film& film, const LivePass& pass, LivePosition& position,
                   const BlockRange& range);
  Status run_blocks(const BlockTask& task, const LiveProgress::PassSpan& span);
  /// The same for blocks that the task identifies by their index, and for worker(index).
  using IndexedTask = std::function<bool(unsigned index, std::size_t block)>;
  Status run_indexed(std::size_t count, const IndexedTask& task,
                     const LiveProgress::PassSpan& span);
  Status run_bands(const Bands& bands, BandQueue& queue);
  Result<float> record_ray(int x, int y, RayRecord& record) const;
  Status run_task(const std::function<void(BlockTools&)>& task);
  Status find_aovs(AovChannels& channels);
  Status find_lines(Outline& outline);
  [[nodiscard]] Fog fog() const;
  [[nodiscard]] OutlineWorker::Lines outline_lines() const;
  template <class Worker, class Make, class Task>
  Status run_extra(const BlockOrder& blocks, const Make& make, const Task& task);

  RenderOptions options_;
  std::shared_ptr<const PreparedScene> scene_;  ///< on the heap, because workers refer to it
  std::unique_ptr<const BlockSetup> setup_;     ///< likewise
  BlockOrder blocks_;
  Scheduler scheduler_;
  std::vector<std::unique_ptr<BlockWorker>> workers_;
  RayCounts extra_rays_;  ///< of AOVs and outlines
  double prepare_seconds_ = 0;
  double render_seconds_ = 0;
};

}  // namespace boule
