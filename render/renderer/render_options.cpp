#include "render/renderer/render_options.h"

#include <algorithm>

#include "render/frame/measured_picture.h"
#include "render/image/image.h"
#include "render/memory/available_memory.h"
#include "render/renderer/outline.h"
#include "simd/abi/stream.h"

namespace boule {
namespace {

// Sides of blocks in pixels. Measured pictures render the pixels around a block as well.
constexpr int smallest_fit = 16, fit_of_few = 32, usual_fit = 128, large_fit = 256;
/// Among so few spheres rays gain nothing from longer streams, and less memory is faster.
constexpr std::size_t few_spheres = 4096;

/// The largest side that suits the scene.
int largest_fit(const RenderOptions& options, std::size_t spheres) {
  if (fitting_stream_size(spheres) > usual_fit * usual_fit) return large_fit;
  return spheres <= few_spheres && !is_measured(options) ? fit_of_few : usual_fit;
}

int least_tile(const RenderOptions& options) {
  return options.tile != 0 ? options.tile : smallest_fit;
}

/// The largest number of bytes of bands and of the file's encoder.
std::uint64_t bytes_of_bands(const RenderOptions& options) {
  constexpr std::uint64_t encoder = std::uint64_t{40} << 20;
  const std::uint64_t whole = rendered_rect(options).area() * (sizeof(Color) + sizeof(float));
  return std::min(whole, Bands::most_bytes) + std::min(whole, encoder);
}

std::uint64_t bytes_of_whole(const RenderOptions& options) {
  const PixelRect rect = rendered_rect(options);
  const std::uint64_t alpha_bytes = options.transparent ? rect.area() * sizeof(float) : 0;
  const std::uint64_t line_bytes = options.outline > 0 ? Outline::bytes(rect) : 0;
  const std::uint64_t sums =
      is_measured(options) ? MeasuredPicture::bytes(rect) : Film::bytes(rect);
  return sums + rect.area() * sizeof(Color) + alpha_bytes + line_bytes +
         AovChannels::bytes(options.aovs, rect);
}

/// What scenes have as well, each field by its rule.
template <class Settings>
Status validate_settings(const Settings& settings) {
  const auto problem = find_problem(settings);
  if (!problem) return {};
  return Diagnostic::about(std::string(fields<Settings>.type) + "." + problem->field,
                           problem->message);
}

/// The edges, which limit the numbers of samples.
Status validate_edges(const RenderOptions& options) {
  if (!(options.aa > 0)) return {};
  if (options.method == Method::path) {
    return Diagnostic::about("render.aa",
                             "is for method whitted: where paths have noise, ask for noise");
  }
  if (options.noise > 0)
    return Diagnostic::about("render.aa", "cannot stand beside noise: choose one, 0 is none");
  return {};
}

Status check_picture_memory(const RenderOptions& options) {
  const PixelRect rect = rendered_rect(options);
  const std::uint64_t needed =
      (options.in_bands ? bytes_of_bands(options) : bytes_of_whole(options)) +
      BlockOrder::bytes(rect, least_tile(options));
  return check_memory(needed,
                      "a picture of " + std::to_string(rect.width()) + " x " +
                          std::to_string(rect.height()) + " pixels needs",
                      "image.size");
}

/// The noise, which limits the numbers of samples.
Status validate_noise(const RenderOptions& options) {
  if (options.noise > 0 && options.spp < options.min_spp) {
    return Diagnostic::about("image.spp", "must be at least " + std::to_string(options.min_spp) +
                                              ", the min_spp, where noise is asked for");
  }
  if (!is_measured(options) && (options.aovs.noise || options.aovs.samples)) {
    return Diagnostic::about("aov",
                             "has noise or samples, which are told where noise or aa is asked for "
                             "only");
  }
  constexpr NumberRule stops{.low = -126, .high = 126};
  if (!stops.allows(double{options.exposure_stops}))
    return Diagnostic::about("exposure_stops", "must be " + describe(stops));
  return {};
}

}  // namespace

RenderOptions options_of(const Scene& scene) {
  RenderOptions options{scene.image, scene.render};
  if (options.noise > 0 && options.spp == 1) options.spp = usual_max_spp;
  if (options.aa > 0 && options.spp == 1) options.spp = usual_max_edge_spp;
  return options;
}

void choose_samples(const SampleChoice& choice, RenderOptions& options) {
  const auto& [spp, noise, aa] = choice;
  if (noise && *noise > 0) options.spp = usual_max_spp;
  if (aa && *aa > 0) options.spp = usual_max_edge_spp;
  options.spp = spp.value_or(options.spp);
  options.noise = noise.value_or(spp || aa ? 0 : options.noise);
  options.aa = aa.value_or(spp || noise ? 0 : options.aa);
}

EdgeTarget edge_target(const RenderOptions& options) {
  return {options.aa, options.spp, options.exposure_stops, options.transparent};
}

float left_out_weight(const RenderOptions& options) {
  return std::max(options.least_weight, options.aa / (16 * 255));
}

NoiseTarget noise_target(const RenderOptions& options) {
  return {options.noise, options.min_spp, options.spp, options.exposure_stops, options.transparent};
}

PixelRect rendered_rect(const RenderOptions& options) {
  return options.crop.value_or(PixelRect{0, 0, options.width, options.height});
}

Bands bands_of(const RenderOptions& options, unsigned workers) {
  const std::size_t alpha_bytes = options.transparent ? sizeof(float) : 0;
  const std::size_t line_bytes = options.outline > 0 ? 1 : 0;
  return {rendered_rect(options), options.tile, workers, sizeof(Color) + alpha_bytes + line_bytes};
}

int fitting_tile(const RenderOptions& options, unsigned workers, std::size_t spheres) {
  if (options.tile != 0) return options.tile;
  int tile = largest_fit(options, spheres);
  const std::uint64_t blocks_per_worker = tile == large_fit ? 8 : 16;
  const std::uint64_t area = rendered_rect(options).area();
  while (tile > smallest_fit &&
         area < blocks_per_worker * workers * static_cast<std::uint64_t>(tile * tile))
    tile /= 2;
  return tile;
}

Status validate(const RenderOptions& options) {
  if (auto done = validate_settings<ImageSettings>(options); !done) return done;
  if (auto done = validate_settings<RenderSettings>(options); !done) return done;
  if (auto done = check_range("tile", options.tile, {.low = 0, .high = max_tile}); !done)
    return done;
  if (auto done = validate_noise(options); !done) return done;
  if (auto done = validate_edges(options); !done) return done;
  if (options.shadow_epsilon && !rule::not_negative.allows(double{*options.shadow_epsilon})) {
    return Diagnostic::about("shadow_epsilon", "must be " + describe(rule::not_negative));
  }
  if (options.transparent && options.spp > most_covered_samples) {
    return Diagnostic::about("image.spp", "must be at most " +
                                              std::to_string(most_covered_samples) +
                                              " before a transparent background");
  }
  const PixelRect frame{0, 0, options.width, options.height}, rect = rendered_rect(options);
  if (rect.empty() || !contains(frame, rect)) {
    return Diagnostic::about("crop", "must be at least one pixel and lie within the frame of " +
                                         std::to_string(options.width) + " x " +
                                         std::to_string(options.height));
  }
  return check_picture_memory(options);
}

}  // namespace boule
