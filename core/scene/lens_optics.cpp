#include "core/scene/lens_optics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"

namespace boule {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A ray close to the axis: its height, and its slope times the index of refraction.
struct ParaxialRay {
  double height, slope;
};

/// Through all surfaces, up to the last one: at each the ray bends by its height times the power
/// (n' - n) / R (Smith, "Modern Lens Design", 1992, "y-nu ray trace").
ParaxialRay trace_paraxial(std::span<const LensSurface> surfaces, ParaxialRay ray) {
  double index = 1;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const LensSurface& surface = surfaces[i];
    const double next = surface.index, radius = surface.radius;
    if (radius != 0) ray.slope -= ray.height * (next - index) / radius;
    index = next;
    if (i + 1 < surfaces.size()) ray.height += ray.slope / index * double{surface.thickness};
  }
  return ray;
}

std::vector<LensElement> elements_of(const std::vector<LensSurface>& surfaces, double& rear) {
  std::vector<LensElement> elements;
  double place = 0, index = 1;
  for (const LensSurface& surface : surfaces) {
    const double radius = surface.radius, half = double{surface.aperture} / 2;
    elements.push_back({radius, place + radius, half * half, double{surface.index} / index});
    rear = place;
    place += double{surface.thickness};
    index = surface.index;
  }
  std::reverse(elements.begin(), elements.end());
  return elements;
}

constexpr int ring_count = 64;

/// Of a box on the plane through the rear vertex, the middles of `cells` x `cells` / 2 cells that a
/// film point at the distance r from the axis sees the scene through: `found(x, y, cos^4)`. Only
/// y > 0, the others mirror them.
template <class Found>
void scan_pupil(const LensOptics& optics, const PupilBox& box, int cells, double r, Found found) {
  const double step_x = (box.x1 - box.x0) / cells, step_y = 2 * box.y / cells;
  for (int j = 0; j < cells / 2; ++j) {
    for (int i = 0; i < cells; ++i) {
      const double x = box.x0 + (i + 0.5) * step_x, y = (j + 0.5) * step_y;
      Vec3d org{r, 0, optics.film};
      Vec3d dir = normalize(Vec3d{x, y, optics.rear} - org);
      const double cosine2 = dir.z * dir.z;
      if (trace_lens(optics.elements, org, dir)) found(x, y, cosine2 * cosine2);
    }
  }
}

bool is_empty(const PupilBox& box) { return !(box.x0 < box.x1); }

/// What of a box a film point sees through, as a box that is a cell wider.
PupilBox seen_through(const LensOptics& optics, const PupilBox& box, double r) {
  constexpr int cells = 64;
  PupilBox seen{box.x1, box.x0, 0};
  scan_pupil(optics, box, cells, r, [&](double x, double y, double) {
    seen = {std::min(seen.x0, x), std::max(seen.x1, x), std::max(seen.y, y)};
  });
  if (seen.x1 < seen.x0) return {0, 0, 0};
  const double step_x = (box.x1 - box.x0) / cells, step_y = 2 * box.y / cells;
  return {seen.x0 - step_x, seen.x1 + step_x, seen.y + step_y};
}

/// The exit pupil of a film point, first in a wide square and then in what is seen of it. A narrow
/// stop would fall between the cells: it is approached by wider ones, each an eighth of the one
/// before, through which all is seen that is seen through it.
PupilBox pupil_of(const LensOptics& optics, double square, double r) {
  LensOptics wider = optics;
  PupilBox box{-square, square, square};
  bool narrow = true;
  for (double least = square / 16; narrow && !is_empty(box); least /= 8) {
    narrow = false;
    for (std::size_t i = 0; i < optics.elements.size(); ++i) {
      const double aperture2 = optics.elements[i].aperture2;
      wider.elements[i].aperture2 = std::max(aperture2, least * least);
      narrow = narrow || aperture2 < least * least;
    }
    box = seen_through(wider, box, r);
  }
  return is_empty(box) ? box : seen_through(optics, box, r);
}

PupilBox join(const PupilBox& a, const PupilBox& b) {
  if (is_empty(a) || is_empty(b)) return is_empty(a) ? b : a;
  return {std::min(a.x0, b.x0), std::max(a.x1, b.x1), std::max(a.y, b.y)};
}

/// The integral of cos^4 over the exit pupil in the film's middle.
double light_in_the_middle(const LensOptics& optics, const PupilBox& box) {
  constexpr int fine = 256;
  double sum = 0;
  scan_pupil(optics, box, fine, 0, [&](double, double, double cosine4) { sum += 2 * cosine4; });
  return sum * (box.x1 - box.x0) * (2 * box.y) / (fine * fine);
}

/// By rings, of each the inner, middle and outer points.
void find_pupil(LensOptics& optics, const std::vector<LensSurface>& surfaces) {
  // A curved rear surface is met beyond its vertex' plane: the pupil may be wider there than it.
  const double square = 0.75 * double{surfaces.back().aperture};
  const double corner =
      std::sqrt(optics.half_width * optics.half_width + optics.half_height * optics.half_height);
  PupilBox inner = pupil_of(optics, square, 0);
  optics.exposure = 1 / light_in_the_middle(optics, inner);
  for (int ring = 0; ring < ring_count; ++ring) {
    const PupilBox middle = pupil_of(optics, square, corner * (ring + 0.5) / ring_count);
    const PupilBox outer = pupil_of(optics, square, corner * (ring + 1) / ring_count);
    optics.pupil.push_back(join(join(inner, middle), outer));
    inner = outer;
  }
  optics.rings_per_length = ring_count / corner;
}

}  // namespace

double focal_length(const std::vector<LensSurface>& surfaces) {
  return -1 / trace_paraxial(surfaces, {1, 0}).slope;
}

double image_distance(const std::vector<LensSurface>& surfaces, double distance) {
  if (surfaces.empty()) return nan;
  const ParaxialRay out = trace_paraxial(surfaces, {1, 1 / distance});
  return -out.height / out.slope * double{surfaces.back().index};
}

std::optional<std::size_t> find_stop(const std::vector<LensSurface>& surfaces) {
  std::optional<std::size_t> stop;
  float index = 1;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const bool bends = surfaces[i].radius != 0 || surfaces[i].index != index;
    index = surfaces[i].index;
    if (bends) continue;
    if (stop) return std::nullopt;
    stop = i;
  }
  return stop;
}

double stop_diameter(const std::vector<LensSurface>& surfaces, std::size_t stop, double f_number) {
  if (stop >= surfaces.size()) return nan;
  const std::span<const LensSurface> before(surfaces.data(), stop + 1);
  return std::fabs(trace_paraxial(before, {1, 0}).height) * focal_length(surfaces) / f_number;
}

bool trace_lens(std::span<const LensElement> elements, Vec3d& org, Vec3d& dir) {
  for (const LensElement& element : elements) {
    double t = (element.place - org.z) / dir.z;
    if (element.radius != 0) {
      // Of the two points of the sphere the one on the surface's side: behind the centre as seen
      // from the film if that is on the film's side.
      const Vec3d f = Vec3d{0, 0, element.place} - org;
      const double b = dot(f, dir);
      const Vec3d l = f - dir * b;
      const double root = std::sqrt(element.radius * element.radius - dot(l, l));
      t = element.radius > 0 ? b + root : b - root;
    }
    org = org + dir * t;
    const double height2 = org.x * org.x + org.y * org.y;
    if (!(height2 <= element.aperture2)) return false;  // beside the sphere it is NaN
    Vec3d normal{0, 0, -1};
    if (element.radius != 0) {
      normal = (org - Vec3d{0, 0, element.place}) * (1 / element.radius);
    }
    // Snell's law with the normal along the ray.
    const double cosine = dot(dir, normal);
    const double cosine2 = 1 - element.eta * element.eta * (1 - cosine * cosine);
    if (!(cosine2 >= 0)) return false;  // total reflection
    dir = dir * element.eta + normal * (std::sqrt(cosine2) - element.eta * cosine);
  }
  return true;
}

LensOptics make_optics(const LensCamera& camera, int width, int height) {
  LensOptics optics{};
  optics.pupil.reserve(ring_count);
  if (camera.surfaces.empty()) {
    optics.pupil.push_back({});
    return optics;
  }
  optics.elements = elements_of(camera.surfaces, optics.rear);
  optics.scale = camera.scale;
  optics.half_width = double{camera.film_width} / 2;
  optics.half_height = optics.half_width * height / width;
  const double focus = focus_of(camera.pose, camera.focus);
  optics.film = optics.rear + image_distance(camera.surfaces, focus / optics.scale);
  find_pupil(optics, camera.surfaces);
  return optics;
}

}  // namespace boule
