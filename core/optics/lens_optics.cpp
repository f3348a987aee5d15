#include "core/optics/lens_optics.h"

#include <algorithm>

#include "core/optics/exit_pupil.h"
#include "core/optics/lens_rays.h"

namespace boule {
namespace {

/// The surfaces from the film to the scene; `rear` is set to the last one's vertex.
std::vector<LensElement> elements_of(const std::vector<LensSurface>& surfaces, double& rear) {
  std::vector<LensElement> elements;
  double vertex = 0, index = 1;
  for (const LensSurface& surface : surfaces) {
    const double radius = surface.radius, half = double{surface.aperture} / 2;
    elements.push_back({.radius = radius,
                        .z = vertex + radius,
                        .aperture2 = half * half,
                        .eta = double{surface.index} / index});
    rear = vertex;
    vertex += double{surface.thickness};
    index = surface.index;
  }
  std::reverse(elements.begin(), elements.end());
  return elements;
}

/// The elements of a lens with surfaces, and the place of its film.
void focus_elements(const LensCamera& camera, LensOptics& optics) {
  optics.elements = elements_of(camera.surfaces, optics.rear);
  optics.scale = camera.scale;
  const double focus = focus_of(camera.pose, camera.focus);
  optics.film = optics.rear + image_distance(camera.surfaces, focus / optics.scale);
}

}  // namespace

LensView LensOptics::view() const {
  return {.elements = elements.data(),
          .element_count = static_cast<int>(elements.size()),
          .pupil = pupil.data(),
          .ring_count = static_cast<int>(pupil.size()),
          .rings_per_length = rings_per_length,
          .rear = rear,
          .film = film,
          .half_width = half_width,
          .half_height = half_height,
          .scale = scale,
          .exposure = exposure};
}

bool trace_lens(const std::vector<LensElement>& elements, Vec3d& org, Vec3d& dir) {
  LensRay ray{org, dir};
  bool passed = true;
  for (const LensElement& element : elements) {
    pass_element(element, ray, passed);
    if (!passed) return false;
  }
  org = ray.org;
  dir = ray.dir;
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
