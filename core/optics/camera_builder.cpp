#include "core/optics/camera_builder.h"

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

/// Half the film's width and height: at distance 1 from the eye, in world units, in radians.
struct HalfExtent {
  double width, height;
};

double half_fov(float fov) { return double{fov} * (elementary::pi / 360); }

/// Half the extent of a film of square pixels that measures `half` from its middle to the end of
/// `axis`.
HalfExtent spread(double half, FovAxis axis, double width, double height) {
  const bool spans_width = axis == FovAxis::x || (axis == FovAxis::max && width >= height);
  if (spans_width) return {half, half * height / width};
  return {half * width / height, half};
}

// fit() sets the special numbers of a kind of camera in its view, and returns the film's extent.

HalfExtent fit(const PinholeCamera& camera, CameraView& view, double width, double height) {
  view.kind = CameraKind::pinhole;
  return spread(elementary::tan_acute(half_fov(camera.fov)), camera.fov_axis, width, height);
}

HalfExtent fit(const OrthographicCamera& camera, CameraView& view, double width, double height) {
  view.kind = CameraKind::orthographic;
  const double half_height = double{camera.height} / 2;
  return {half_height * width / height, half_height};
}

HalfExtent fit(const FisheyeCamera& camera, CameraView& view, double width, double height) {
  view.kind = CameraKind::fisheye;
  return spread(half_fov(camera.fov), camera.fov_axis, width, height);
}

/// A lens without extent is a pinhole, bit for bit.
HalfExtent fit(const ThinLensCamera& camera, CameraView& view, double width, double height) {
  view.kind = camera.aperture == 0 ? CameraKind::pinhole : CameraKind::thin_lens;
  view.inverse_focus = 1 / focus_of(camera.pose, camera.focus);
  return spread(elementary::tan_acute(half_fov(camera.fov)), camera.fov_axis, width, height);
}

/// Its film has sizes of its own: LensOptics.
HalfExtent fit(const LensCamera&, CameraView& view, double, double) {
  view.kind = CameraKind::lens;
  return {1, 1};
}

/// The radius of the disc over which a camera's lens samples are spread.
double lens_radius(const Camera& camera) {
  const auto* lens = std::get_if<ThinLensCamera>(&camera);
  return lens != nullptr ? double{lens->aperture} : 0;
}

// Raster (0, 0) is the top left corner of the picture; the film runs from -1 to 1 and its y grows
// upward. This is the only flip of the picture (lecture "The image is upside down").
RasterToFilm raster_to_film_x(int width) { return {2.0, -1.0 * width, 1.0 * width}; }
RasterToFilm raster_to_film_y(int height) { return {-2.0, 1.0 * height, 1.0 * height}; }

/// Whether the corners of a fisheye's film are more than 180 degrees from `forward`, where there
/// are no rays, or so close to that angle that rounding may decide.
bool has_dark_corners(const CameraView& view) {
  constexpr double almost_pi = elementary::pi * (1 - 1e-9);
  // Filters reach beyond the frame by less than a pixel.
  const double x = 1 + 2 / view.film_x.extent, y = 1 + 2 / view.film_y.extent;
  return !(length(view.right * x + view.up * y) < almost_pi);
}

/// Whether some samples of a camera have a smaller weight than others. An ST map may lead anywhere.
bool weighs(const CameraView& view) {
  const bool mapped = view.distortion.st != nullptr;
  return view.kind == CameraKind::lens ||
         (view.kind == CameraKind::fisheye && (mapped || has_dark_corners(view)));
}

/// The exit pupil without a lens: it lets no light through.
constexpr PupilRing dark{};

LensView lens_view(const LensOptics* lens) {
  LensView view = lens != nullptr ? lens->view() : LensView{};
  if (view.ring_count < 1) view.pupil = &dark, view.ring_count = 1;
  return view;
}

}  // namespace

LensOptics build_lens(const Camera& camera, int width, int height) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  return lens != nullptr ? make_optics(*lens, width, height) : LensOptics{};
}

CameraView build_camera(const Camera& camera, int width, int height, const DistortionMap* map,
                        const LensOptics* lens) {
  const CameraPose& pose = *std::visit([](const auto& any) { return &any.pose; }, camera);
  CameraView view{};
  view.eye = vec_cast<double>(pose.eye);
  view.forward = view_direction(pose);
  const Vec3d u = normalize(cross(view.forward, vec_cast<double>(pose.up)));
  const Vec3d v = cross(u, view.forward);
  const HalfExtent half =
      std::visit([&](const auto& any) { return fit(any, view, width, height); }, camera);
  view.right = u * half.width;
  view.up = v * half.height;
  view.film_x = raster_to_film_x(width);
  view.film_y = raster_to_film_y(height);
  view.lens_right = u * lens_radius(camera);
  view.lens_up = v * lens_radius(camera);
  view.lens = lens_view(lens);
  if (map != nullptr) view.distortion = {map->st.data(), map->width, map->height};
  view.weighs = weighs(view);
  return view;
}

}  // namespace boule
