#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "render/image/write_image.h"

namespace boule::cli {

/// The camera as picture files have it, for row vectors: (x, y, z, 1) M, as OpenEXR and RenderMan.
/// Camera space: origin at the eye, x right, y up, z along the view (left-handed).
/// Screen space: the film's x and y, -1 .. 1 from edge to edge of the whole frame, y up, after
/// division by the fourth component; its third is 1/z for a perspective camera and for a thin lens,
/// whose matrix is that of the rays through its centre, z for a parallel one. There is none where
/// straight lines become curves.
struct CameraMatrices {
  MetadataMatrix world_to_camera;
  std::optional<MetadataMatrix> world_to_screen;
};

/// Of a valid camera without distortion for a frame of `width` x `height` pixels; computed in
/// double, rounded once.
CameraMatrices camera_matrices(const Camera& camera, int width, int height);

}  // namespace boule::cli
