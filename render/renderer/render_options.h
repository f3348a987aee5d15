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
#include "simd/abi/isa.h"

namespace boule {

/// How a scene is rendered. The picture depends on the options from `width` to `crop` only, and on
/// `solver` only where that is fast, or where there is a `shadow_epsilon`.
struct RenderOptions {
  int width = 1280;  ///< pixels of the whole frame, 1 .. 65535
  int height = 720;  ///< likewise
  int spp = 1;       ///< samples per pixel, >= 1; with `noise` the most of them
  /// Pixels get min_spp to spp samples until their noise is this (NoiseTarget), 0 .. 1; 0: all get
  /// spp. Of films, which Renderer::render_pass() and its like render, all pixels get spp.
  float noise = 0;
  int min_spp = 32;          ///< >= 16
  float exposure_stops = 0;  ///< at which noise is seen, -126 .. 126
  PixelFilter filter = PixelFilter::box;
  std::uint64_t seed = 0;  ///< of all random numbers
  Method method = Method::whitted;
  int max_depth = 5;  ///< bounces after the primary hit, >= 0
  /// Samples whose camera ray hits nothing are black, and pictures have alpha: the share of a
  /// pixel's samples that hit something.
  bool transparent = false;
  Solver solver = Solver::robust;
  /// For teaching: shadow rays start by the lecture's epsilon, in units of length, 0 (no remedy
  /// against false shadows) or more; none: they know which surface they leave.
  std::optional<float> shadow_epsilon{};
  float outline = 0;                ///< width of dark lines (Outline) in pixels, 0 .. 100; 0: none
  std::optional<PixelRect> crop{};  ///< the pixels of the frame to render; all if there is none
  AovSelection aovs{};              ///< which AOVs render_aovs() finds
  bool in_bands = false;            ///< what is rendered needs memory for render_bands() only
  PixelOrder order = PixelOrder::tiles;  ///< of all but render_bands()
  int tile = 0;              ///< side of a block in pixels, 1 .. 1024; 0: fitting_tile()
  unsigned threads = 0;      ///< 1024 at most; 0: as many as the hardware runs at once
  std::string isa = "auto";  ///< a name that select_kernels() knows
  const std::atomic<bool>* cancel = nullptr;  ///< true stops rendering; must outlive the renderer
  std::function<void(const Progress&)> progress{};  ///< called often, on the thread that renders
  LiveProgress* live = nullptr;                     ///< kept up to date; must outlive the renderer
  /// Called by render_live() after each pass, on the thread that renders. partial_picture() makes a
  /// picture of the film. What this throws reaches the caller.
  std::function<void(const Film&)> update{};
};

/// The options that a scene asks for. Takes any scene.
RenderOptions options_of(const Scene& scene);

/// Whether pictures with these options have alpha.
inline Alpha alpha_of(const RenderOptions& options) {
  return options.transparent ? Alpha::coverage : Alpha::none;
}

/// The noise that these options ask for.
NoiseTarget noise_target(const RenderOptions& options);

/// The most samples of a pixel where noise is asked for and nobody says how many.
inline constexpr int usual_max_spp = 4096;

/// Sets what somebody wishes beside the scene: each of the two sets the scene's other one aside.
void choose_samples(std::optional<int> spp, std::optional<float> noise, RenderOptions& options);

/// The part of the frame that is rendered: the crop, or all.
PixelRect rendered_rect(const RenderOptions& options);

/// The bands of render_bands(). Precondition: validate() passes the options, with a tile that is
/// not 0.
Bands bands_of(const RenderOptions& options, unsigned workers);

/// The side of a block in pixels: options.tile or, if that is 0, a side that suits the picture, the
/// number of workers and the number of the scene's spheres. In a large block many rays are traced
/// together, above all shadow rays; but every worker needs several blocks. Precondition: validate()
/// passes the options.
int fitting_tile(const RenderOptions& options, unsigned workers, std::size_t spheres);

/// An error for the first option that is out of range, or if the picture needs more memory than
/// there is. Its key is that of the scene file ("image.size", "render.max_depth"), or else the name
/// in RenderOptions. Takes any values.
Status validate(const RenderOptions& options);

}  // namespace boule
