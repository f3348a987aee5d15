#include "simd/build/camera_builder.h"

namespace boule {
namespace {

void store(const Vec3d& v, double (&out)[3]) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

}  // namespace

CameraView build_camera(const Camera& camera, int width, int height) {
  const CameraBasis basis = camera_basis(camera, width, height);
  CameraView view{};
  store(basis.eye, view.eye);
  store(basis.forward, view.forward);
  store(basis.right, view.right);
  store(basis.up, view.up);
  view.scale_x = basis.film_x.scale;
  view.offset_x = basis.film_x.offset;
  view.extent_x = basis.film_x.extent;
  view.scale_y = basis.film_y.scale;
  view.offset_y = basis.film_y.offset;
  view.extent_y = basis.film_y.extent;
  view.parallel = basis.parallel;
  return view;
}

}  // namespace boule
