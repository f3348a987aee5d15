#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/frame/bands.h"
#include "render/frame/film.h"
#include "render/frame/pixel_noise.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/frame/progress.h"
#include "render/renderer/aov_channels.h"
#include "render/renderer/edge_block.h"
#include "render/renderer/run_statistics.h"  // the names of solvers
#include "simd/abi/isa.h"

namespace boule {

/// The options of a rendering: what a scene asks for, and what only the program that renders knows.
/// In films, which Renderer::render_pass() and similar functions fill, all pixels get spp samples.
/// With `transparent`, samples whose camera ray misses are black. `aa` is for method whitted and
/// cameras without a lens. The picture depends only on the scene's settings, on `exposure_stops`
/// (noise and edges), `seed` and `crop`, and on `solver` if that is fast or if there is a
/// `shadow_epsilon`.
struct RenderOptions : ImageSettings, RenderSettings {
  float exposure_stops = 0;  ///< at which noise and edges are judged, in stops, -126 .. 126
  std::uint64_t seed = 0;    ///< of all random numbers
  Solver solver = Solver::robust;
  /// For teaching: the lecture's epsilon at which shadow rays start, in units of length, 0 (without
  /// a remedy for false shadows) or more. Without it, shadow rays know the surface that they leave.
  std::optional<float> shadow_epsilon{};
  std::optional<PixelRect> crop{};       ///< the pixels of the frame to render; empty: all
  AovSelection aovs{};                   ///< the AOVs that render_aovs() computes
  bool in_bands = false;                 ///< the rendering needs memory for render_bands() only
  PixelOrder order = PixelOrder::tiles;  ///< of all but render_bands()
  int tile = 0;              ///< side of a block in pixels, 1 .. 1024; 0: fitting_tile()
  unsigned threads = 0;      ///< at most 1024; 0: as many as the hardware runs at once
  std::string isa = "auto";  ///< a name that select_kernels() knows
  const std::atomic<bool>* cancel = nullptr;  ///< true stops rendering; must outlive the renderer
  std::function<void(const Progress&)> progress{};  ///< called often, on the thread that renders
  LiveProgress* live = nullptr;                     ///< kept up to date; must outlive the renderer
  /// Called by render_live() after each pass, on the thread that renders. partial_picture() makes a
  /// picture of the film. Exceptions propagate to the caller.
  std::function<void(const Film&)> update{};
};

/// The options that a scene asks for. Takes any scene.
RenderOptions options_of(const Scene& scene);

/// Whether pictures with these options have alpha.
inline Alpha alpha_of(const RenderOptions& options) {
  return options.transparent ? Alpha::coverage : Alpha::none;
}

/// Whether pixels get different numbers of samples, as each needs.
inline bool is_measured(const RenderOptions& options) {
  return options.noise > 0 || options.aa > 0;
}

/// The edges that these options ask for.
EdgeTarget edge_target(const RenderOptions& options);

/// The weight that the mirrored and refracted rays of a sample may lose in all: `least_weight` or,
/// if that is more, a sixteenth of the step of `aa`.
float left_out_weight(const RenderOptions& options);

/// The noise that these options ask for.
NoiseTarget noise_target(const RenderOptions& options);

/// The default limit of samples per pixel if there is a target of noise.
inline constexpr int usual_max_spp = 4096;

/// The same if there is a target of edges.
inline constexpr int usual_max_edge_spp = 64;

/// What a user chooses of the samples.
struct SampleChoice {
  std::optional<int> spp{};
  std::optional<float> noise{}, aa{};
};

/// Sets the user's choice over the scene's: each of the three replaces the scene's other ones.
void choose_samples(const SampleChoice& choice, RenderOptions& options);

/// The part of the frame that is rendered: the crop, or all.
PixelRect rendered_rect(const RenderOptions& options);

/// The bands of render_bands(). Precondition: validate() passes the options, with a tile that is
/// not 0.
Bands bands_of(const RenderOptions& options, unsigned workers);

/// The side of a block in pixels: options.tile or, if that is 0, a side that suits the picture, the
/// number of workers and the number of the scene's spheres. In a large block many rays, above all
/// shadow rays, are traced together; but every worker needs several blocks. Precondition:
/// validate() passes the options.
int fitting_tile(const RenderOptions& options, unsigned workers, std::size_t spheres);

/// An error for the first option that is out of range, or if the picture exceeds the available
/// memory. Its key is that of the scene file ("image.size", "render.max_depth"), otherwise the name
/// in RenderOptions. Takes any values.
Status validate(const RenderOptions& options);

}  // namespace boule
