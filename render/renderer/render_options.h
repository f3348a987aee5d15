#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/frame/film.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/frame/progress.h"
#include "render/renderer/aov_channels.h"
#include "simd/abi/isa.h"

namespace boule {

/// How a scene is rendered. Only the first eight, the crop and solver fast show in the picture.
struct RenderOptions {
  int width = 1280;  ///< pixels of the whole frame, 1 .. 65535
  int height = 720;  ///< likewise
  int spp = 1;       ///< samples per pixel, >= 1
  PixelFilter filter = PixelFilter::box;
  std::uint64_t seed = 0;  ///< of all random numbers
  Method method = Method::whitted;
  int max_depth = 5;  ///< bounces after the primary hit, >= 0
  Solver solver = Solver::robust;
  std::optional<PixelRect> crop;  ///< render these pixels of the frame only
  AovSelection aovs;              ///< what render_aovs() finds
  PixelOrder order = PixelOrder::tiles;
  int tile = 0;                                   ///< pixels, side of a block, 1 .. 1024; 0: fits
  unsigned threads = 0;                           ///< 0: as many as the hardware runs; at most 1024
  std::string isa = "auto";                       ///< a name that select_kernels() knows
  const std::atomic<bool>* cancel = nullptr;      ///< true: rendering stops; outlives the renderer
  std::function<void(const Progress&)> progress;  ///< called often, on the thread that renders
  LiveProgress* live = nullptr;  ///< kept up to date by all threads; outlives the renderer
  /// Called by render_live() after each of its passes, on the thread that renders: shows what there
  /// is, as partial_picture() makes it of the film. What it throws reaches the caller.
  std::function<void(const Film&)> update;
};

/// The options a scene asks for, whatever they are. Throws std::bad_alloc.
RenderOptions options_of(const Scene& scene);

/// The part of the frame that is rendered: the crop, or all.
PixelRect rendered_rect(const RenderOptions& options);

/// The side of a block, in pixels: options.tile, or, where that is 0, what suits. Large blocks
/// bring many rays together, a light's above all; but every worker needs some. `spheres`: of the
/// scene. Precondition: options that validate() passes.
int fitting_tile(const RenderOptions& options, unsigned workers, std::size_t spheres);

/// The first option out of range, its key as in the scene file ("image.size", "render.max_depth"),
/// or as in RenderOptions, or a picture that needs more memory than there is. Takes any values.
Status validate(const RenderOptions& options);

}  // namespace boule
