#include "core/scene/camera_pose.h"

#include "core/math/geometry.h"

namespace boule {

Vec3d view_direction(const CameraPose& pose) {
  return normalize(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
}

double depth_of(const CameraPose& pose, const Vec3f& point) {
  return dot(vec_cast<double>(point) - vec_cast<double>(pose.eye), view_direction(pose));
}

double focus_of(const CameraPose& pose, const std::optional<float>& focus) {
  return focus ? double{*focus} : depth_of(pose, pose.look_at);
}

}  // namespace boule
