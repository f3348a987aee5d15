#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "render/image/write_image.h"

namespace boule {

/// The camera's matrices as picture files have them, for row vectors: (x, y, z, 1) M, as in OpenEXR
/// and RenderMan.
/// Camera space: origin at the eye, x right, y up, z along the view (left-handed).
/// Screen space: after division by the fourth component, x and y are those of the film, -1 .. 1
/// from edge to edge of the whole frame, y up. The third component is 1/z for a pinhole and a thin
/// lens, and z for an orthographic camera. The matrix of a thin lens is that of the rays through
/// its centre. Cameras that bend straight lines have no such matrix.
struct CameraMatrices {
  MetadataMatrix world_to_camera;
  std::optional<MetadataMatrix> world_to_screen;
};

/// The matrices of a valid camera without distortion, for a frame of `width` x `height` pixels;
/// computed in double and rounded once.
CameraMatrices camera_matrices(const Camera& camera, int width, int height);

}  // namespace boule
