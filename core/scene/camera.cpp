#include "core/scene/camera.h"

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

/// Half the film's width and height: at distance 1 from the eye, in world units, in radians.
struct HalfExtent {
  double width, height;
};

double half_fov(float fov) { return double{fov} * (elementary::pi / 360); }

/// Of square pixels whose film measures `half` from its middle to the end of `axis`.
HalfExtent spread(double half, FovAxis axis, double width, double height) {
  const bool spans_width = axis == FovAxis::x || (axis == FovAxis::max && width >= height);
  if (spans_width) return {half, half * height / width};
  return {half * width / height, half};
}

HalfExtent half_extent(const PinholeCamera& camera, double width, double height) {
  return spread(elementary::tan_acute(half_fov(camera.fov)), camera.fov_axis, width, height);
}

HalfExtent half_extent(const ThinLensCamera& camera, double width, double height) {
  return spread(elementary::tan_acute(half_fov(camera.fov)), camera.fov_axis, width, height);
}

HalfExtent half_extent(const FisheyeCamera& camera, double width, double height) {
  return spread(half_fov(camera.fov), camera.fov_axis, width, height);
}

HalfExtent half_extent(const OrthographicCamera& camera, double width, double height) {
  const double half_height = double{camera.height} / 2;
  return {half_height * width / height, half_height};
}

/// Its film has sizes of its own: LensOptics.
HalfExtent half_extent(const LensCamera&, double, double) { return {1, 1}; }

CameraKind kind_of(const PinholeCamera&) { return CameraKind::perspective; }
CameraKind kind_of(const OrthographicCamera&) { return CameraKind::parallel; }
CameraKind kind_of(const FisheyeCamera&) { return CameraKind::equidistant; }
/// A lens without extent is a pinhole, bit for bit.
CameraKind kind_of(const ThinLensCamera& camera) {
  return camera.aperture == 0 ? CameraKind::perspective : CameraKind::thin_lens;
}

CameraKind kind_of(const LensCamera&) { return CameraKind::lens; }

Vec3d view_direction(const CameraPose& pose) {
  return normalize(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
}

}  // namespace

double depth_of(const CameraPose& pose, const Vec3f& point) {
  return dot(vec_cast<double>(point) - vec_cast<double>(pose.eye), view_direction(pose));
}

double focus_of(const CameraPose& pose, const std::optional<float>& focus) {
  return focus ? double{*focus} : depth_of(pose, pose.look_at);
}

CameraBasis camera_basis(const Camera& camera, int width, int height) {
  return std::visit(
      [&](const auto& any) {
        CameraBasis basis{};
        basis.eye = vec_cast<double>(any.pose.eye);
        basis.forward = view_direction(any.pose);
        const Vec3d u = normalize(cross(basis.forward, vec_cast<double>(any.pose.up)));
        const Vec3d v = cross(u, basis.forward);
        const HalfExtent half = half_extent(any, width, height);
        basis.right = u * half.width;
        basis.up = v * half.height;
        basis.kind = kind_of(any);
        basis.film_x = raster_to_film_x(width);
        basis.film_y = raster_to_film_y(height);
        if (const auto* lens = std::get_if<ThinLensCamera>(&camera)) {
          basis.lens_right = u * double{lens->aperture};
          basis.lens_up = v * double{lens->aperture};
          basis.inverse_focus = 1 / focus_of(lens->pose, lens->focus);
        }
        return basis;
      },
      camera);
}

}  // namespace boule
