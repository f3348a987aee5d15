#include <cstddef>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/reference.h"
#include "core/scene/lens_optics.h"

namespace boule::reference {
namespace {

/// Raster position to film position on one axis.
double film_coordinate(const RasterToFilm& map, double raster) {
  return (raster * map.scale + map.offset) / map.extent;
}

/// The ST map at a place counted in pixels from the first one's centre: component 0 is s, 1 is t.
double map_value(const DistortionView& map, double x, double y, int component) {
  const auto cell = [](double place, int count) {
    const int first = place < 0 ? 0 : static_cast<int>(std::fmin(place, 1e9));
    return first < count - 1 ? first : count - 2;
  };
  const int column = cell(x, map.width), row = cell(y, map.height);
  const auto at = [&](int i, int j) {
    return double{map.st[2 * (static_cast<std::ptrdiff_t>(j) * map.width + i) + component]};
  };
  const double right = x - column, down = y - row;
  const double above = at(column, row) + (at(column + 1, row) - at(column, row)) * right;
  const double below =
      at(column, row + 1) + (at(column + 1, row + 1) - at(column, row + 1)) * right;
  return above + (below - above) * down;
}

/// Where an ST map moves a sample to.
CameraSample distorted(const CameraBasis& camera, CameraSample sample) {
  const DistortionView& map = camera.distortion;
  const double width = camera.film_x.extent, height = camera.film_y.extent;
  const double x = sample.raster_x / width * map.width - 0.5;
  const double y = sample.raster_y / height * map.height - 0.5;
  sample.raster_x = map_value(map, x, y, 0) * width;
  sample.raster_y = (1 - map_value(map, x, y, 1)) * height;
  return sample;
}

/// A place in the unit disc.
struct DiscPoint {
  double x, y;
};

// Shirley and Chiu: the square [-1, 1]^2 is nested squares around its middle; each becomes the
// circle that touches it, its sides a quarter of the circle each, evenly.
DiscPoint disc_point(double lens_x, double lens_y) {
  const double x = lens_x * 2 - 1, y = lens_y * 2 - 1;
  if (x == 0 && y == 0) return {0, 0};
  const bool left_or_right = std::fabs(y) < std::fabs(x);
  const double radius = left_or_right ? x : y;
  const double angle = elementary::pi / 4 * ((left_or_right ? y : x) / radius);
  const double cosine = radius * elementary::cosine(angle * angle);
  const double sine = radius * (angle * elementary::sine_ratio(angle * angle));
  return left_or_right ? DiscPoint{cosine, sine} : DiscPoint{sine, cosine};
}

// Equidistant: the film vector's length is the angle between the view and the ray. Half of it keeps
// the polynomials in their range: cos 2h = 1 - 2 sin^2 h and sin 2h = 2 sin h cos h.
CameraRay fisheye_ray(const CameraBasis& camera, const Vec3d& on_film) {
  CameraRay result;
  result.ray.org = camera.eye;
  const double angle2 = dot(on_film, on_film);
  if (!(angle2 <= elementary::pi * elementary::pi)) {
    result.weight = 0;
    return result;
  }
  const double half2 = angle2 * 0.25;
  const double ratio = elementary::sine_ratio(half2);
  const double along = 1 - 2 * (half2 * (ratio * ratio));
  const double across = ratio * elementary::cosine(half2);
  result.ray.dir = vec_cast<float>(camera.forward * along + on_film * across);
  return result;
}

// A thin lens bends all rays from one film point to where the one through its centre, which goes on
// straight, crosses the plane in focus: at forward + p, times the focal distance. Divided by that
// distance, a lens sample at the centre gives the pinhole's direction itself.
Ray thin_lens_ray(const CameraBasis& camera, const Vec3d& on_film, const DiscPoint& disc) {
  const Vec3d on_lens = camera.lens_right * disc.x + camera.lens_up * disc.y;
  Ray ray;
  ray.org = camera.eye + on_lens;
  ray.dir = vec_cast<float>(normalize((camera.forward + on_film) - on_lens * camera.inverse_focus));
  return ray;
}

/// The box of the exit pupil at that distance from the film's middle: linear between those of the
/// ring's inner and outer points, beyond the last ring the last one.
PupilBox pupil_box(const LensOptics& lens, double distance) {
  const auto rings = static_cast<double>(lens.pupil.size());
  const double place = std::fmin(distance * lens.rings_per_length, rings);
  const double ring = std::fmin(std::floor(place), rings - 1), share = place - ring;
  const auto& [inner, outer] = lens.pupil[static_cast<std::size_t>(ring)];
  const auto between = [share](double from, double to) { return from + (to - from) * share; };
  return {between(inner.x0, outer.x0), between(inner.x1, outer.x1), between(inner.y, outer.y)};
}

// A lens of real elements (Kolb, Mitchell, Hanrahan 1995): from the film, which the lens' picture
// is upside down on, through a place of the exit pupil's box, and from element to element.
CameraRay lens_ray(const CameraBasis& camera, double film_x, double film_y, double a, double b) {
  const LensOptics& lens = *camera.optics;
  const double x = film_x * -lens.half_width, y = film_y * -lens.half_height;
  const double distance = std::sqrt(x * x + y * y);
  const double cosine = distance == 0 ? 1 : x / distance;
  const double sine = distance == 0 ? 0 : y / distance;
  const PupilBox box = pupil_box(lens, distance);
  const double along = box.x0 + (box.x1 - box.x0) * a, aside = box.y * (b * 2 - 1);
  Vec3d org{x, y, lens.film};
  Vec3d dir = normalize(
      Vec3d{cosine * along - sine * aside, sine * along + cosine * aside, lens.rear} - org);
  const double cosine2 = dir.z * dir.z;
  const double area = (box.x1 - box.x0) * (box.y * 2);
  CameraRay result;
  result.weight = static_cast<float>(cosine2 * cosine2 * (area * lens.exposure));
  if (!(result.weight > 0) || !trace_lens(lens.elements, org, dir)) return {Ray{}, 0};
  const auto to_world = [&](const Vec3d& v) {
    return camera.right * v.x + camera.up * v.y - camera.forward * v.z;
  };
  result.ray.org = camera.eye + to_world(org) * lens.scale;
  result.ray.dir = vec_cast<float>(to_world(dir));
  return result;
}

}  // namespace

CameraRay camera_ray(const CameraBasis& camera, const CameraSample& asked) {
  const CameraSample sample = camera.distortion.st != nullptr ? distorted(camera, asked) : asked;
  // Lecture "Pixel centres": pixel (i, j) is sampled at (i + 0.5, j + 0.5), and the film runs from
  // -1 to 1 across the picture.
  const double x = film_coordinate(camera.film_x, sample.raster_x);
  const double y = film_coordinate(camera.film_y, sample.raster_y);
  const Vec3d on_film = camera.right * x + camera.up * y;
  switch (camera.kind) {
    case CameraKind::parallel:
      // Lecture "Orthographic camera": every ray has the view's direction and starts on the film.
      return {Ray{camera.eye + on_film, vec_cast<float>(camera.forward)}};
    case CameraKind::equidistant:
      return fisheye_ray(camera, on_film);
    case CameraKind::thin_lens:
      return {thin_lens_ray(camera, on_film, disc_point(sample.lens_x, sample.lens_y))};
    case CameraKind::lens:
      return lens_ray(camera, x, y, sample.lens_x, sample.lens_y);
    case CameraKind::perspective:
      break;
  }
  // Lecture "Pinhole camera": every ray starts at the eye and passes through the film point.
  return {Ray{camera.eye, vec_cast<float>(normalize(camera.forward + on_film))}};
}

}  // namespace boule::reference
