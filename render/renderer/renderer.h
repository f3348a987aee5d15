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

/// What rendering has cost, over all passes so far.
struct RenderStatistics : RunStatistics {
  RayCounts rays{};
  SampleFaults faults{};
  double render_seconds = 0;
};

/// Renders a scene. The bits of a picture do not depend on ISA, threads, order, tile size or crop.
/// Every failure is a Diagnostic, also an exception of options.progress; only what options.update
/// throws reaches the caller. Once a renderer was moved away, its rendering functions return an
/// error, and scene(), notes() and statistics() must not be called.
class Renderer {
 public:
  /// Prepares the scene, which is not needed any more afterwards. Takes any values; an error if the
  /// scene or the options are invalid (validate()), if this computer does not have the ISA, or if
  /// there is not enough memory.
  static Result<Renderer> create(const Scene& scene, const RenderOptions& options);
  /// The same without a copy of the spheres and planes.
  static Result<Renderer> create(Scene&& scene, const RenderOptions& options);

  /// Of a scene that was prepared for `options`: their size, method and transparency. Several
  /// renderers can share it. Precondition, not checked: that it was.
  static Result<Renderer> create(std::shared_ptr<const PreparedScene> scene,
                                 const RenderOptions& options);

  /// Renders the whole picture, or its crop, in one pass. The picture is the same as that of a film
  /// after render_pass(), without the memory of a film.
  Result<Image> render();

  /// The same with the noise and the number of samples of each pixel, and without the outline, into
  /// a picture without samples. An error if it was cancelled; the picture keeps the pixels that
  /// were finished. `preview`, if there is one, gets a sample of every pixel first, so that there
  /// is something to be seen. Preconditions: options().noise > 0; both are of rect().
  Status render_measured(MeasuredPicture& picture, Film* preview = nullptr);

  /// Renders the same picture in bands of rows from the top, so that only some of them are in
  /// memory (Bands::most_bytes). Calls take(band) for each of them in order, on the threads that
  /// render, one call at a time, while the others go on with the next ones. A Diagnostic of `take`
  /// ends the rendering and is returned. statistics() leaves out the time that `take` cost.
  Status render_bands(const std::function<Status(const Image& band)>& take);

  /// Renders until every pixel of the film has at least `until` samples, 1 .. spp. Call it again
  /// with the same film and a greater `until` to refine the picture; the result is the same as that
  /// of a single pass. An error if it was cancelled or failed; the film keeps what was done, and
  /// the next call goes on from there.
  Status render_pass(Film& film, int until);

  /// Renders all samples in the passes of options.order (LivePasses), and calls options.update
  /// after each of them, to show the picture as it grows. An error if it was cancelled; the film
  /// can be shown all the same.
  Status render_live(Film& film);

  /// render_live() in steps: goes on with `position` and moves it on, and ends after about `limit`.
  /// options.update is not called. An error if it was cancelled; then the film has whole samples,
  /// but it can only begin anew.
  Status render_step(Film& film, LivePosition& position, const StepLimit& limit);
  [[nodiscard]] bool done(const LivePosition& position) const;
  /// Where to begin with an empty film, so that the pixels that have waited longest come first.
  [[nodiscard]] LivePosition restarted(const LivePosition& position) const;
  /// The share of all samples that are done.
  [[nodiscard]] double share_done(const LivePosition& position) const;

  /// The AOVs that options.aovs selects and that need rays of their own (the others are
  /// measured_channels()), as extra channels for write_image(). They are those of the
  /// rays through the pixels' centres, without a filter. These rays count as primary rays. An error
  /// if it was cancelled.
  Result<std::vector<ImageChannel>> render_aovs();

  /// The rays of the recursion through the centre of pixel (x, y), and of the lens: Whitted's,
  /// whatever the method. Returns the weight that the camera gives the sample: the picture with one
  /// sample has the record's total times it. 0: there is no ray, and nothing is recorded. An error
  /// if there are too many rays, or not enough memory. Preconditions: the pixel lies in the frame;
  /// the scene was prepared for Method::whitted.
  Result<float> record_pixel(int x, int y, RayRecord& record) const;

  /// The lines that options.outline asks for. render() draws them itself; onto a picture of a film
  /// they are drawn by Outline::draw(). Their rays count as primary rays. An error if it was
  /// cancelled.
  Result<Outline> render_outline();

  /// For those who choose the blocks themselves: calls task(tools) once on each thread, at the same
  /// time, and waits for all. What a thread renders with its tools has the bits of render(). An
  /// error if a task throws; whether all was rendered, the tasks know. It adds to statistics().
  Status work(const std::function<void(BlockTools&)>& task);

  [[nodiscard]] const RenderOptions& options() const { return options_; }
  /// The pixels that a film for this renderer has.
  [[nodiscard]] PixelRect rect() const { return rendered_rect(options_); }
  /// The prepared scene, with the default camera if it had none.
  [[nodiscard]] const PreparedScene& scene() const { return *scene_; }
  /// What was decided for the user, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return scene_->notes; }
  [[nodiscard]] RenderStatistics statistics() const;

 private:
  template <class AnyScene>
  static Result<Renderer> create_from(AnyScene&& scene, const RenderOptions& options);
  Renderer(const RenderOptions& options, std::shared_ptr<const PreparedScene> scene,
           const KernelTable& kernels);
  static Diagnostic moved_away();
  std::unique_ptr<BlockWorker> make_worker() const;
  [[nodiscard]] IntegratorSettings integrator_settings() const;
  [[nodiscard]] RayCounts count_rays() const;
  [[nodiscard]] SampleFaults count_faults() const;
  /// Renders a block. False if it was cancelled.
  using BlockTask = std::function<bool(BlockWorker&, const PixelRect& block)>;
  BlockWorker& worker(unsigned index);
  Status check_film(const Film& film) const;
  [[nodiscard]] LiveProgress::PassSpan pass_from(double begin) const;
  Status run_slice(Film& film, const LivePass& pass, LivePosition& position,
                   const BlockRange& range);
  Status run_blocks(const BlockTask& task, const LiveProgress::PassSpan& span);
  /// The same for blocks that the task knows by their index, and for worker(index).
  using IndexedTask = std::function<bool(unsigned index, std::size_t block)>;
  Status run_indexed(std::size_t count, const IndexedTask& task,
                     const LiveProgress::PassSpan& span);
  Status run_bands(const Bands& bands, BandQueue& queue);
  Result<float> record_ray(int x, int y, RayRecord& record) const;
  Status run_task(const std::function<void(BlockTools&)>& task);
  Status find_aovs(AovChannels& channels);
  Status find_lines(Outline& outline);
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
