#include "render/renderer/renderer.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <new>
#include <utility>

#include "core/base/float_environment.h"
#include "render/frame/progress.h"
#include "render/frame/stopwatch.h"
#include "render/integrators/path.h"
#include "render/integrators/whitted.h"
#include "render/memory/scene_memory.h"
#include "render/renderer/aov_worker.h"
#include "render/renderer/block_tools.h"
#include "render/renderer/preparation.h"

namespace boule {
namespace {

/// The most rays of a stream: as many as suit the scene, but not more than a block has samples.
/// Among few spheres shadow rays gain little from long streams, and all else is faster in caches.
std::size_t largest_stream(const RenderOptions& options, std::size_t spheres) {
  constexpr std::size_t few = 16384, suits_few = 2048;
  const std::size_t fitting = spheres <= few ? suits_few : fitting_stream_size(spheres);
  if (is_measured(options)) return fitting;
  const auto tile = static_cast<std::size_t>(options.tile);
  return std::min(fitting, tile * tile * static_cast<std::size_t>(options.spp));
}

/// Whether finding bare pixels costs less than the rays that they may save.
bool bare_pixels_pay(const RenderOptions& options, const PreparedScene& scene) {
  constexpr double most_primitives_a_sample = 1 / 16.0;
  const double samples = options.aa > 0 ? 1 : options.noise > 0 ? options.min_spp : options.spp;
  const std::size_t primitives = scene.geometry.sphere_count() + scene.of_capsules.size();
  return primitives < most_primitives_a_sample * samples * rendered_rect(options).area();
}

}  // namespace

Diagnostic Renderer::moved_away() { return Diagnostic::of("the renderer was moved away"); }

Renderer::Renderer(const RenderOptions& options, std::shared_ptr<const PreparedScene> scene,
                   const KernelTable& kernels, SmallSpheres small_spheres, BarePixels bare_pixels)
    : options_(options),
      scene_(std::move(scene)),
      setup_(std::make_unique<const BlockSetup>(BlockSetup{
          *scene_, kernels, Sampler(options.spp, options.seed, options.filter),
          block_pixels(options.tile), largest_stream(options, scene_->geometry.sphere_count()),
          alpha_of(options), PixelRect{0, 0, options.width, options.height}, noise_target(options),
          edge_target(options), std::move(small_spheres), std::move(bare_pixels), options.live})),
      blocks_(rendered_rect(options), options.tile, options.order),
      scheduler_(options.threads),
      workers_(scheduler_.workers()) {}

Result<Renderer> Renderer::create(const Scene& scene, const RenderOptions& options) {
  return create_from(scene, options);
}

Result<Renderer> Renderer::create(Scene&& scene, const RenderOptions& options) {
  return create_from(std::move(scene), options);
}

/// A copy of the scene is made within the guard.
template <class AnyScene>
Result<Renderer> Renderer::create_from(AnyScene&& scene, const RenderOptions& options) {
  const Stopwatch watch;
  return guard_preparation([&]() -> Result<Renderer> {
    if (auto done = check_scene_memory(scene); !done) return done.error();
    if (options.solver == Solver::reference) {
      if (auto done = check_reference_memory(scene); !done) return done.error();
    }
    if (auto done = validate(options); !done) return done.error();
    if (const auto kernels = kernels_for(options.isa, options.solver); !kernels)
      return kernels.error();
    Scheduler scheduler(options.threads);
    Scene own = std::forward<AnyScene>(scene);
    own.image.fog = options.fog;
    Result<PreparedScene> prepared = prepare(std::move(own), options.width, options.height,
                                             scheduler.parallel_for(), options.method);
    if (!prepared) return prepared.error();
    if (options.transparent) prepared.value().backdrop = Color{};
    auto renderer =
        create(std::make_shared<const PreparedScene>(std::move(prepared).value()), options);
    if (renderer) renderer.value().prepare_seconds_ = watch.seconds();
    return renderer;
  });
}

Result<Renderer> Renderer::create(std::shared_ptr<const PreparedScene> scene,
                                  const RenderOptions& options) {
  return guard_preparation([&]() -> Result<Renderer> {
    if (auto done = validate(options); !done) return done.error();
    const auto kernels = kernels_for(options.isa, options.solver);
    if (!kernels) return kernels.error();
    RenderOptions fitted = options;
    Scheduler scheduler(options.threads);
    fitted.tile = fitting_tile(options, scheduler.workers(), scene->geometry.sphere_count());
    SmallSpheres small_spheres;
    if (options.aa > 0) {
      if (has_lens(scene->camera_view.kind)) {
        return Diagnostic::about("render.aa",
                                 "is for cameras without a lens: where it blurs, ask for noise");
      }
      small_spheres =
          SmallSpheres(*scene, options.width, rendered_rect(options), scheduler.parallel_for());
    }
    BarePixels bare_pixels;
    if (bare_pixels_pay(options, *scene)) {
      bare_pixels = BarePixels(*scene, rendered_rect(options), scheduler.parallel_for());
    }
    return Renderer(fitted, std::move(scene), *kernels.value(), std::move(small_spheres),
                    std::move(bare_pixels));
  });
}

Result<Image> Renderer::render() {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  try {
    const PixelRect whole = rect();
    Image image(whole.width(), whole.height(), alpha_of(options_));
    const auto task = [&](BlockWorker& worker, const PixelRect& block) {
      return worker.render(block, options_.spp, image, whole);
    };
    if (auto done = run_blocks(std::cref(task), pass_from(0)); !done) return done.error();
    if (!(options_.outline > 0)) return image;
    const auto lines = render_outline();
    if (!lines) return lines.error();
    lines.value().draw(image);
    return image;
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the picture");
  }
}

Status Renderer::render_measured(MeasuredPicture& picture, Film* preview) {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  // The fraction of one sample among the samples of a pixel: of few that are soon enough, or of
  // thousands.
  const double share_of_preview = preview != nullptr ? 0.02 : 0;
  if (preview != nullptr) {
    const auto one = [&](BlockWorker& worker, const PixelRect& block) {
      return worker.render(block, 1, *preview);
    };
    if (auto done = check_film(*preview); !done) return done;
    if (auto done = run_blocks(std::cref(one), {.end = share_of_preview}); !done) return done;
  }
  const auto task = [&](BlockWorker& worker, const PixelRect& block) {
    return worker.measure(block, picture);
  };
  return run_blocks(std::cref(task), pass_from(share_of_preview));
}

/// The pass that renders the rest, from a fraction of all work on.
LiveProgress::PassSpan Renderer::pass_from(double begin) const {
  const bool measures = options_.live != nullptr && is_measured(options_);
  return {.begin = begin,
          .rays = begin > 0 ? count_rays().total() : 0,
          .pixels = measures ? static_cast<std::uint64_t>(rect().area()) : 0};
}

Status Renderer::check_film(const Film& film) const {
  if (!scene_) return moved_away();
  if (!(film.rect() == rect())) return Diagnostic::of("the film is not of the rendered pixels");
  return {};
}

Status Renderer::render_pass(Film& film, int until) {
  const FloatEnvironment environment;
  if (auto done = check_film(film); !done) return done;
  if (until < 1 || until > options_.spp) {
    return Diagnostic::of("a pass ends at 1 to " + std::to_string(options_.spp) +
                          " samples, not at " + std::to_string(until));
  }
  const auto task = [&](BlockWorker& worker, const PixelRect& block) {
    return worker.render(block, until, film);
  };
  return run_blocks(std::cref(task), {});
}

Status Renderer::render_live(Film& film) {
  const FloatEnvironment environment;
  if (auto done = check_film(film); !done) return done;
  const std::uint64_t rays_before = count_rays().total();
  const LivePasses passes(options_.order, rect(), options_.spp);
  double share = 0;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const LivePass pass = passes[i];
    const auto task = [&](BlockWorker& worker, const PixelRect& block) {
      return worker.render(block, pass, film);
    };
    const std::uint64_t rays = count_rays().total() - rays_before;
    if (auto done = run_blocks(std::cref(task), {share, pass.share, rays}); !done) return done;
    share = pass.share;
    if (options_.update) options_.update(film);
  }
  return {};
}

BlockWorker& Renderer::worker(unsigned index) {
  if (!workers_[index]) workers_[index] = make_worker();
  return *workers_[index];
}

Status Renderer::run_blocks(const BlockTask& task, const LiveProgress::PassSpan& span) {
  const auto of_index = [&](unsigned index, std::size_t block) {
    return task(worker(index), blocks_[block]);
  };
  return run_indexed(blocks_.size(), std::cref(of_index), span);
}

/// Closures are passed by reference, here and above: a copy takes memory, and can throw.
Status Renderer::run_indexed(std::size_t count, const IndexedTask& task,
                             const LiveProgress::PassSpan& span) {
  const Stopwatch watch;
  LiveProgress own;
  LiveProgress& live = options_.live != nullptr ? *options_.live : own;
  live.begin_pass(count, span);
  const auto report = [&] {
    if (options_.progress) options_.progress(live.read());
  };
  const auto body = [&](unsigned worker, std::size_t block) {
    const auto& mine = workers_[worker];
    const std::uint64_t before = mine ? mine->counts().total() : 0;
    live.begin_block();
    if (!task(worker, block)) return live.drop_block();
    live.end_block(mine->counts().total() - before);
    if (worker == 0) report();
  };
  Status status = scheduler_.run(count, std::cref(body), options_.cancel);
  render_seconds_ += watch.seconds();
  if (!status) return status;
  if (live.ended() != count) return Diagnostic::of("rendering was cancelled");
  return diagnose(std::cref(report));  // by reference: a copy of it takes memory
}

Result<std::vector<ImageChannel>> Renderer::render_aovs() {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  const Stopwatch watch;
  try {
    AovChannels channels(options_.aovs, rect());
    const Status status = options_.aovs.any_traced() ? find_aovs(channels) : Status();
    render_seconds_ += watch.seconds();
    if (!status) return status.error();
    return channels.release();
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the AOVs");
  }
}

Status Renderer::find_aovs(AovChannels& channels) {
  return run_extra<AovWorker>(
      blocks_, [this] { return std::make_unique<AovWorker>(*setup_, options_.solver); },
      [&](AovWorker& worker, const PixelRect& block) { worker.render(block, channels); });
}

Status Renderer::work(const std::function<void(BlockTools&)>& task) {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  const Stopwatch watch;
  try {
    Status status = run_task(task);
    render_seconds_ += watch.seconds();
    return status;
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the renderer's workers");
  }
}

Status Renderer::run_task(const std::function<void(BlockTools&)>& task) {
  const OutlineWorker::Lines lines = outline_lines();
  std::vector<std::unique_ptr<BlockTools>> tools(scheduler_.workers());
  const auto body = [&](unsigned index, std::size_t) {
    BlockWorker& mine = worker(index);
    if (!tools[index]) tools[index] = std::make_unique<BlockTools>(*setup_, mine, lines);
    task(*tools[index]);
  };
  Status status = scheduler_.run(tools.size(), std::cref(body));
  for (const auto& one : tools) {
    if (one) extra_rays_ += one->extra_counts();
  }
  return status;
}

Result<Outline> Renderer::render_outline() {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  const Stopwatch watch;
  try {
    Outline outline(rect());
    const Status status = options_.outline > 0 ? find_lines(outline) : Status();
    render_seconds_ += watch.seconds();
    if (!status) return status.error();
    return outline;
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the outline");
  }
}

Status Renderer::find_lines(Outline& outline) {
  const OutlineWorker::Lines lines = outline_lines();
  return run_extra<OutlineWorker>(
      BlockOrder(rect(), OutlineWorker::block_side, PixelOrder::tiles),
      [&] { return std::make_unique<OutlineWorker>(*setup_, lines); },
      [&](OutlineWorker& worker, const PixelRect& block) { worker.find(block, outline); });
}

/// Calls task(worker, block) for each of the blocks, with workers from `make`.
template <class Worker, class Make, class Task>
Status Renderer::run_extra(const BlockOrder& blocks, const Make& make, const Task& task) {
  std::vector<std::unique_ptr<Worker>> workers(scheduler_.workers());
  std::atomic<std::size_t> done{0};
  const auto body = [&](unsigned worker, std::size_t block) {
    auto& mine = workers[worker];
    if (!mine) mine = make();
    task(*mine, blocks[block]);
    ++done;
  };
  Status status = scheduler_.run(blocks.size(), std::cref(body), options_.cancel);
  for (const auto& worker : workers) {
    if (worker) extra_rays_ += worker->counts();
  }
  if (status && done != blocks.size()) return Diagnostic::of("rendering was cancelled");
  return status;
}

Fog Renderer::fog() const {
  return options_.fog > 0 ? fog_of(options_, scene_->bounds, scene_->camera_view) : Fog{};
}

OutlineWorker::Lines Renderer::outline_lines() const {
  return {{0, 0, options_.width, options_.height}, options_.outline, options_.solver, fog()};
}

IntegratorSettings Renderer::integrator_settings() const {
  IntegratorSettings settings;
  settings.solver = options_.solver;
  settings.max_depth = options_.max_depth;
  settings.stream_size = setup_->stream_size;
  settings.cancel = options_.cancel;
  settings.seed = options_.seed;
  settings.shadow_epsilon = options_.shadow_epsilon;
  settings.least_weight = left_out_weight(options_);
  settings.fog = fog();
  return settings;
}

std::unique_ptr<BlockWorker> Renderer::make_worker() const {
  const IntegratorSettings settings = integrator_settings();
  std::unique_ptr<Integrator> integrator;
  if (options_.method == Method::path) {
    integrator = std::make_unique<Path>(*scene_, setup_->kernels, settings);
  } else {
    integrator = std::make_unique<Whitted>(*scene_, setup_->kernels, settings);
  }
  return std::make_unique<BlockWorker>(*setup_, std::move(integrator));
}

RayCounts Renderer::count_rays() const {
  RayCounts rays = extra_rays_;
  for (const auto& worker : workers_) {
    if (worker) rays += worker->counts();
  }
  return rays;
}

SampleFaults Renderer::count_faults() const {
  SampleFaults faults;
  for (const auto& worker : workers_) {
    if (worker) faults += worker->faults();
  }
  return faults;
}

RenderStatistics Renderer::statistics() const {
  const KernelTable& kernels = setup_->kernels;
  return {{prepare_seconds_, isa_name(kernels.isa), kernels.width, options_.solver,
           scheduler_.threads_used()},
          count_rays(),
          count_faults(),
          render_seconds_};
}

}  // namespace boule
