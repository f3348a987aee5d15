#include "core/scene/camera.h"

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

/// Half the film's width and height, at distance 1 from the eye.
struct HalfExtent {
  double width, height;
};

HalfExtent half_extent(const PinholeCamera& camera, double width, double height) {
  const double half_fov = double{camera.fov} * (elementary::pi / 360);
  const double tangent = elementary::tan_acute(half_fov);
  const bool spans_width =
      camera.fov_axis == FovAxis::x || (camera.fov_axis == FovAxis::max && width >= height);
  if (spans_width) return {tangent, tangent * height / width};
  return {tangent * width / height, tangent};
}

HalfExtent half_extent(const OrthographicCamera& camera, double width, double height) {
  const double half_height = double{camera.height} / 2;
  return {half_height * width / height, half_height};
}

}  // namespace

CameraBasis camera_basis(const Camera& camera, int width, int height) {
  return std::visit(
      [&](const auto& any) {
        const Vec3d eye = vec_cast<double>(any.pose.eye);
        const Vec3d forward = normalize(vec_cast<double>(any.pose.look_at) - eye);
        const Vec3d u = normalize(cross(forward, vec_cast<double>(any.pose.up)));
        const Vec3d v = cross(u, forward);
        const HalfExtent half = half_extent(any, width, height);
        return CameraBasis{eye,
                           forward,
                           u * half.width,
                           v * half.height,
                           std::holds_alternative<OrthographicCamera>(camera),
                           raster_to_film_x(width),
                           raster_to_film_y(height)};
      },
      camera);
}

}  // namespace boule
