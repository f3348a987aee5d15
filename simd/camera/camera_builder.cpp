#include "simd/camera/camera_builder.h"

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

void store(const Vec3d& v, double (&out)[3]) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

/// Whether the corners of the film are more than 180 degrees from the view, where there is nothing;
/// or so close to it that rounding may decide.
bool has_dark_corners(const CameraBasis& basis) {
  constexpr double almost_pi = elementary::pi * (1 - 1e-9);
  // Filters reach beyond the frame by less than a pixel.
  const double x = 1 + 2 / basis.film_x.extent, y = 1 + 2 / basis.film_y.extent;
  return basis.kind == CameraKind::equidistant &&
         !(length(basis.right * x + basis.up * y) < almost_pi);
}

/// What a lens is seen through that is not there.
constexpr PupilRingView dark{};

}  // namespace

LensStack::LensStack(const LensOptics& optics) {
  for (const LensElement& e : optics.elements) {
    elements.push_back({e.radius, e.place, e.aperture2, e.eta});
  }
  const auto plain = [](const PupilBox& box) { return PupilBoxView{box.x0, box.x1, box.y}; };
  for (const auto& [inner, outer] : optics.pupil) pupil.push_back({plain(inner), plain(outer)});
  view = {elements.data(),
          static_cast<int>(elements.size()),
          pupil.data(),
          static_cast<int>(pupil.size()),
          optics.rings_per_length,
          optics.rear,
          optics.film,
          optics.half_width,
          optics.half_height,
          optics.scale,
          optics.exposure};
}

LensStack build_lens(const Camera& camera, int width, int height) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  return lens != nullptr ? LensStack(make_optics(*lens, width, height)) : LensStack();
}

CameraView build_camera(const Camera& camera, int width, int height, const DistortionMap* map,
                        const LensStack* lens) {
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
  store(basis.lens_right, view.lens_right);
  store(basis.lens_up, view.lens_up);
  view.inverse_focus = basis.inverse_focus;
  view.kind = basis.kind;
  view.weighs = has_dark_corners(basis) || basis.kind == CameraKind::lens;
  if (lens != nullptr) view.lens = lens->view;
  if (view.lens.ring_count < 1) view.lens.pupil = &dark, view.lens.ring_count = 1;
  if (map != nullptr) {
    view.map = map->st.data();
    view.map_width = map->width;
    view.map_height = map->height;
    view.weighs = view.weighs || basis.kind == CameraKind::equidistant;  // it leads anywhere
  }
  return view;
}

}  // namespace boule
