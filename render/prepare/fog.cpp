#include "render/prepare/fog.h"

#include <algorithm>
#include <cmath>

#include "core/math/geometry.h"

namespace boule {

float Fog::share(double depth) const {
  if (!(depth > from)) return 0;
  if (!(depth < to)) return strength;
  return static_cast<float>(static_cast<double>(strength) * ((depth - from) / (to - from)));
}

double depth_of(const CameraView& camera, const Vec3d& point) {
  const Vec3d way = point - camera.eye;
  return camera.kind == CameraKind::fisheye ? length(way) : dot(way, camera.forward);
}

Fog fog_of(const ImageSettings& image, const std::optional<SphereBounds>& box,
           const CameraView& camera) {
  Fog fog{image.fog};
  if (box && box->low.x <= box->high.x) {
    const Vec3d middle = box->low * 0.5 + box->high * 0.5, half = box->high * 0.5 - box->low * 0.5;
    const double depth = depth_of(camera, middle);
    const Vec3d& view = camera.kind == CameraKind::fisheye && depth > 0
                            ? normalize(middle - camera.eye)
                            : camera.forward;
    const double reach = length(Vec3d{view.x * half.x, view.y * half.y, view.z * half.z});
    fog.from = std::max(depth - reach, 0.0);
    fog.to = std::max(depth + reach, 0.0);
  }
  if (image.fog_from) fog.from = static_cast<double>(*image.fog_from);
  if (image.fog_to) fog.to = static_cast<double>(*image.fog_to);
  return fog;
}

}  // namespace boule
