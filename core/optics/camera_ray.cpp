#include "core/optics/camera_ray.h"

namespace boule {

CameraRay camera_ray(const CameraView& camera, const CameraSample& sample) {
  return visit_camera(camera.kind, [&](auto formula) {
    const auto [org, dir, weight] = formula.of(camera, sample);
    return CameraRay{Ray{org, vec_cast<float>(dir)}, static_cast<float>(weight)};
  });
}

}  // namespace boule
