#include "render/apps/job/picture/camera_matrices.h"

#include <algorithm>
#include <limits>

#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"

namespace boule {
namespace {

/// One column of a matrix for row vectors. It gives one coordinate of the product.
struct Column {
  Vec3d linear;
  double constant;
};

/// The distance of a point from the eye along `axis`, times `scale`.
Column along(const CameraView& view, const Vec3d& axis, double scale) {
  const Vec3d scaled = axis * scale;
  return {scaled, -dot(view.eye, scaled)};
}

float finite_float(double x) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::clamp(x, -largest, largest));
}

MetadataMatrix matrix_of(const Column (&columns)[4]) {
  MetadataMatrix matrix{};
  for (std::size_t c = 0; c < 4; ++c) {
    matrix[c] = finite_float(columns[c].linear.x);
    matrix[4 + c] = finite_float(columns[c].linear.y);
    matrix[8 + c] = finite_float(columns[c].linear.z);
    matrix[12 + c] = finite_float(columns[c].constant);
  }
  return matrix;
}

}  // namespace

CameraMatrices camera_matrices(const Camera& camera, int width, int height) {
  const CameraView view = build_camera(camera, width, height);
  const double half_width = length(view.right), half_height = length(view.up);
  const Vec3d u = view.right * (1 / half_width), v = view.up * (1 / half_height);
  const Column z = along(view, view.forward, 1), one = {{}, 1};
  const Column film_x = along(view, u, 1 / half_width), film_y = along(view, v, 1 / half_height);
  CameraMatrices matrices{matrix_of({along(view, u, 1), along(view, v, 1), z, one}), {}};
  if (view.kind == CameraKind::orthographic) {
    matrices.world_to_screen = matrix_of({film_x, film_y, z, one});
  } else if (view.kind == CameraKind::pinhole || view.kind == CameraKind::thin_lens) {
    matrices.world_to_screen = matrix_of({film_x, film_y, one, z});
  }
  return matrices;
}

}  // namespace boule
