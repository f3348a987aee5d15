#include <fmt/format.h>

#include "render/cli/commands.h"
#include "render/cli/interrupt.h"
#include "render/cli/messages.h"
#include "render/cli/picture_header.h"
#include "render/cli/source_date.h"
#include "render/cli/stats.h"
#include "render/image/image_format.h"
#include "render/renderer/renderer.h"
#include "render/renderer/scene_hash.h"
#include "simd/dispatch/dispatch.h"

namespace boule::cli {
namespace {

Diagnostic usage(const std::string& message, const char* key) { return {message, key, {}, 0, 0}; }

/// What can be told wrong without reading the scene.
Status check(const RenderCommand& command) {
  const ImageFormat* const format = find_image_format(command.output);
  if (format == nullptr) {
    return usage("no picture format has the extension of " + quote(command.output) +
                     ", expected one of " + known_image_extensions(),
                 "--output");
  }
  if (command.views.any() && !format->channels) {
    return usage(std::string("a .") + format->extension +
                     " file has no room for extra channels, expected --output to be an .exr file",
                 "--aov");
  }
  if (command.stats.file == command.output) {
    return usage("statistics would replace the picture, expected another file", "--stats");
  }
  const auto date = source_date();
  if (!date) return date.error();
  const auto kernels = select_kernels(command.isa);
  if (!kernels) return kernels.error();
  return std::nullopt;
}

RenderOptions combine(const Scene& scene, const RenderCommand& command) {
  RenderOptions options = options_of(scene);
  if (command.size) {
    options.width = command.size->width;
    options.height = command.size->height;
  }
  options.spp = command.spp.value_or(options.spp);
  options.max_depth = command.max_depth.value_or(options.max_depth);
  options.crop = command.crop;
  options.views = command.views;
  options.seed = command.seed;
  options.tile = command.tile;
  options.order = command.order;
  options.threads = command.threads;
  options.isa = command.isa;
  options.solver = command.solver;
  return options;
}

/// A size that the scene asks for is the scene's fault, one from the command line the caller's.
ExitCode report_refusal(Diagnostic error, const RenderCommand& command) {
  const bool of_scene = error.key == "image.size" && !command.size;
  if (of_scene) error.file = command.scene;
  const bool of_usage = !of_scene && !error.key.empty();
  return report(error, of_scene ? invalid_input : of_usage ? wrong_usage : failed);
}

/// One run of `boule render`, step by step; each step that fails leaves its exit code.
class Rendering {
 public:
  explicit Rendering(const RenderCommand& command) : command_(command) {}

  ExitCode run();

 private:
  ExitCode render(Renderer& renderer);
  ExitCode write(const Image& image, const ImageFileOptions& options);
  ExitCode finish(const Renderer& renderer, const Image& image);
  [[nodiscard]] ImageFileOptions file_options(const Renderer& renderer) const;

  void note(const std::string& text) const {
    if (command_.verbosity != Verbosity::quiet) print_note(text);
  }
  void detail(const std::string& text) const {
    if (command_.verbosity == Verbosity::verbose) print_note("boule: note: " + text);
  }

  const RenderCommand& command_;
  Stopwatch watch_;
  std::optional<ProgressBar> bar_;  ///< while rendering
  Stats stats_;
  std::uint64_t scene_hash_ = 0;
};

ExitCode Rendering::run() {
  if (auto bad = check(command_)) return report(*bad, wrong_usage);
  const auto loaded = load_scene(command_.scene, {command_.polygons});
  if (!loaded) return report(loaded.error(), invalid_input);
  const Scene& scene = loaded.value().scene;
  stats_.load_seconds = watch_.seconds();
  for (const std::string& warning : loaded.value().warnings) note(warning);
  detail(fmt::format("{}: {}, {}, {}, {}, read in {:.3f} s", command_.scene,
                     counted(scene.spheres.size(), "sphere"), counted(scene.planes.size(), "plane"),
                     counted(scene.lights.size(), "light"),
                     counted(scene.materials.size(), "material"), stats_.load_seconds));
  scene_hash_ = scene_hash(scene);

  RenderOptions options = combine(scene, command_);
  options.progress = [this](const Progress& progress) {
    if (bar_) bar_->update(progress);
  };
  auto renderer = Renderer::create(scene, options);
  if (!renderer) return report_refusal(renderer.error(), command_);
  for (const std::string& text : renderer.value().notes()) note("boule: note: " + text);
  return render(renderer.value());
}

ExitCode Rendering::render(Renderer& renderer) {
  const RenderStatistics prepared = renderer.statistics();
  detail(fmt::format("prepared in {:.3f} s for {} ({}), solver {}", prepared.prepare_seconds,
                     prepared.isa, counted(static_cast<std::size_t>(prepared.width), "lane"),
                     solver_name(prepared.solver)));
  const bool quiet = command_.verbosity == Verbosity::quiet;
  bar_.emplace(quiet ? ProgressStyle::none : command_.progress);
  const auto image = renderer.render();
  bar_.reset();
  if (!image) return report(image.error(), failed);
  ImageFileOptions options = file_options(renderer);
  if (command_.views.any()) {
    auto views = renderer.render_views();
    if (!views) return report(views.error(), failed);
    options.channels = std::move(views).value();
  }
  const ExitCode written = write(image.value(), options);
  return written == done ? finish(renderer, image.value()) : written;
}

ImageFileOptions Rendering::file_options(const Renderer& renderer) const {
  const RenderOptions& options = renderer.options();
  ImageFileOptions file;
  file.compression = command_.compression;
  file.exposure_stops = command_.exposure_stops;
  if (options.crop) {
    file.crop = {options.width, options.height, options.crop->x0, options.crop->y0};
  }
  file.date_time = source_date().value();  // check() has seen it
  file.metadata = picture_header(renderer, scene_hash_);
  file.threads = static_cast<int>(renderer.statistics().threads);
  file.stop = [] { return WriteGuard::interrupted(); };
  return file;
}

ExitCode Rendering::write(const Image& image, const ImageFileOptions& options) {
  const Stopwatch watch;
  Status status;
  {
    const WriteGuard guard;
    status = write_image(image, command_.output, options);
    if (!status) set_picture_written();
  }
  exit_if_interrupted();
  stats_.write_seconds = watch.seconds();
  return status ? report(*status, failed) : done;
}

/// After the picture: the line that says so, and the statistics.
ExitCode Rendering::finish(const Renderer& renderer, const Image& image) {
  stats_.rendering = renderer.statistics();
  stats_.size = {image.width, image.height};
  stats_.spp = renderer.options().spp;
  stats_.total_seconds = watch_.seconds();
  const RenderStatistics& r = stats_.rendering;
  detail(fmt::format("written in {:.3f} s", stats_.write_seconds));
  note(fmt::format("boule: {}: {} x {} pixels, {} spp, {:.2f} s, {:.1f} Mray/s ({}, {})",
                   command_.output, image.width, image.height, stats_.spp, r.render_seconds,
                   mrays_per_s(r), r.isa, counted(r.threads, "thread")));
  Status status;
  {
    const WriteGuard guard;
    status = write_stats(stats_, command_.stats);
  }
  exit_if_interrupted();
  return status ? report(*status, failed) : done;
}

}  // namespace

ExitCode run(const RenderCommand& command) { return Rendering(command).run(); }

}  // namespace boule::cli
