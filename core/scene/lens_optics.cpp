#include "core/scene/lens_optics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/scene/exit_pupil.h"

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

/// The elements of a lens that has some, and where its film is.
void focus_elements(const LensCamera& camera, LensOptics& optics) {
  optics.elements = elements_of(camera.surfaces, optics.rear);
  optics.scale = camera.scale;
  const double focus = focus_of(camera.pose, camera.focus);
  optics.film = optics.rear + image_distance(camera.surfaces, focus / optics.scale);
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

double gathered_light(const LensCamera& camera) {
  if (camera.surfaces.empty()) return 0;
  LensOptics optics{};
  focus_elements(camera, optics);
  return light_in_the_middle(optics);
}

LensOptics make_optics(const LensCamera& camera, int width, int height, int rings) {
  LensOptics optics{};
  if (camera.surfaces.empty()) {
    optics.pupil.push_back({});
    return optics;
  }
  focus_elements(camera, optics);
  optics.half_width = double{camera.film_width} / 2;
  optics.half_height = optics.half_width * height / width;
  find_pupil(optics, rings);
  return optics;
}

}  // namespace boule
