#include <fmt/format.h>

#include "render/cli/commands.h"
#include "render/cli/interrupt.h"
#include "render/cli/messages.h"
#include "render/image/image_format.h"
#include "render/renderer/renderer.h"
#include "simd/dispatch/dispatch.h"

namespace boule::cli {
namespace {

/// What can be told wrong without reading the scene.
Status check(const RenderCommand& command) {
  if (!is_image_name(command.output)) {
    return Diagnostic{"no picture format has the extension of " + quote(command.output) +
                          ", expected one of " + known_image_extensions(),
                      "--output",
                      {},
                      0,
                      0};
  }
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

ImageFileOptions image_options(const RenderCommand& command, const RenderOptions& options) {
  ImageFileOptions file;
  file.compression = command.compression;
  file.exposure_stops = command.exposure_stops;
  if (options.crop) {
    file.crop = {options.width, options.height, options.crop->x0, options.crop->y0};
  }
  file.stop = [] { return WriteGuard::interrupted(); };
  return file;
}

Status write(const Image& image, const std::string& path, const ImageFileOptions& options) {
  const WriteGuard guard;
  return write_image(image, path, options);
}

std::string summary(const RenderCommand& command, const Renderer& renderer, const Image& image) {
  const RenderStatistics statistics = renderer.statistics();
  const double seconds = statistics.render_seconds;
  const double rays = static_cast<double>(statistics.rays.total());
  return fmt::format("boule: {}: {} x {} pixels, {} spp, {:.2f} s, {:.1f} Mray/s ({}, {} threads)",
                     command.output, image.width, image.height, renderer.options().spp, seconds,
                     seconds > 0 ? rays / seconds * 1e-6 : 0, statistics.isa, statistics.threads);
}

}  // namespace

ExitCode run(const RenderCommand& command) {
  if (auto bad = check(command)) return report(*bad, wrong_usage);
  const auto loaded = load_scene(command.scene, {command.polygons});
  if (!loaded) return report(loaded.error(), invalid_input);
  const auto note = [&](const std::string& text) {
    if (!command.quiet) print_note(text);
  };
  for (const std::string& warning : loaded.value().warnings) note(warning);

  const RenderOptions options = combine(loaded.value().scene, command);
  auto renderer = Renderer::create(loaded.value().scene, options);
  if (!renderer) return report_refusal(renderer.error(), command);
  for (const std::string& text : renderer.value().notes()) note("boule: note: " + text);

  const auto image = renderer.value().render();
  if (!image) return report(image.error(), failed);
  const Status written = write(image.value(), command.output, image_options(command, options));
  exit_if_interrupted();
  if (written) return report(*written, failed);
  note(summary(command, renderer.value(), image.value()));
  return done;
}

}  // namespace boule::cli
