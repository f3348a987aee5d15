#pragma once

#include <cstddef>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/ray.h"
#include "core/scene/scene.h"
#include "render/renderer/render_options.h"

namespace boule {

/// Where the camera's rays of a picture are written: those of pixel (x, y) of its crop at
/// y * width + x.
struct PictureRays {
  Vec3d* org = nullptr;
  Vec3f* dir = nullptr;
};

/// Finds the rays that a Renderer with these options traces for one sample of each pixel, to the
/// bit. `sample`: 0 .. options.spp - 1. Where the camera has no ray, the direction is 0. An error
/// if the scene or the options are invalid, or if there is too little memory. Passes on exceptions
/// of `parallel_for`. Preconditions: both arrays have room for the pixels of
/// rendered_rect(options).
Status find_picture_rays(Scene scene, const RenderOptions& options, int sample,
                         const PictureRays& to, const ParallelFor& parallel_for = serial_for);

}  // namespace boule
