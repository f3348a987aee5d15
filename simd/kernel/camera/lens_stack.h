#pragma once

#include <cstddef>

#include "core/math/vec.h"
#include "simd/abi/camera.h"
#include "simd/lanes/lanes.h"

/// Rays through the elements of a lens, W at a time, in double.
namespace boule::BOULE_KERNEL_ISA {

/// W rays of unit direction in the lens' space.
struct LensRays {
  Vec3<Wide> org, dir;
};

/// Sends rays from the film through one surface; `passed` loses those that are stopped: by a rim,
/// beside a sphere (NaN passes no comparison) or by total reflection.
BOULE_INLINE void pass_element(const LensElementView& element, LensRays& rays, WideMask& passed) {
  const Wide radius = element.radius, place = element.place, eta = element.eta;
  Wide t = (place - rays.org.z) / rays.dir.z;
  const Vec3<Wide> center{0.0, 0.0, place};
  if (element.radius != 0) {
    const Vec3<Wide> f = center - rays.org;
    const Wide b = dot(f, rays.dir);
    const Vec3<Wide> l = f - rays.dir * b;
    const Wide root = sqrt(radius * radius - dot(l, l));
    t = element.radius > 0 ? b + root : b - root;
  }
  rays.org = rays.org + rays.dir * t;
  const Wide height2 = rays.org.x * rays.org.x + rays.org.y * rays.org.y;
  Vec3<Wide> normal{0.0, 0.0, -1.0};
  if (element.radius != 0) normal = (rays.org - center) * (Wide(1.0) / radius);
  const Wide cosine = dot(rays.dir, normal);
  const Wide cosine2 = Wide(1.0) - eta * eta * (Wide(1.0) - cosine * cosine);
  passed = passed & (height2 <= Wide(element.aperture2)) & (Wide(0.0) <= cosine2);
  rays.dir = rays.dir * eta + normal * (sqrt(cosine2) - eta * cosine);
}

/// The boxes of the exit pupil for W film points at these distances from the axis.
struct PupilBoxes {
  Wide x0, x1, y;
};

/// Linear between those of their rings' inner and outer points; beyond the last ring the last one.
BOULE_INLINE PupilBoxes pupil_boxes(const LensView& lens, Wide distance) {
  alignas(64) double place[width], share[width];
  alignas(64) double x0[2][width], x1[2][width], y[2][width];
  store(place, distance * Wide(lens.rings_per_length));
  const int count = lens.ring_count;
  for (int lane = 0; lane < width; ++lane) {
    const bool on_film = place[lane] < count;
    const int index = on_film ? static_cast<int>(place[lane]) : count - 1;
    share[lane] = on_film ? place[lane] - index : 1;
    const PupilRingView& ring = lens.pupil[index];
    for (int end = 0; end < 2; ++end) {
      const PupilBoxView& box = end == 0 ? ring.inner : ring.outer;
      x0[end][lane] = box.x0;
      x1[end][lane] = box.x1;
      y[end][lane] = box.y;
    }
  }
  const Wide at = load(share);
  const auto between = [at](const double* from, const double* to) {
    return load(from) + (load(to) - load(from)) * at;
  };
  return {between(x0[0], x0[1]), between(x1[0], x1[1]), between(y[0], y[1])};
}

/// The rays of W film points (x, y) through the places (a, b) of their pupil boxes, 0 .. 1 each,
/// and what they weigh: cos^4 of their angle with the axis times the box' area, in units of what
/// arrives in the film's middle; 0 where a ray is stopped.
BOULE_INLINE Wide lens_rays(const LensView& lens, Wide x, Wide y, Wide a, Wide b, LensRays& rays) {
  const Wide distance = sqrt(x * x + y * y);
  const WideMask middle = distance == Wide(0.0);
  const Wide across = select(middle, Wide(1.0), distance);
  const Wide cosine = select(middle, Wide(1.0), x / across), sine = y / across;
  const PupilBoxes box = pupil_boxes(lens, distance);
  const Wide along = box.x0 + (box.x1 - box.x0) * a;
  const Wide aside = box.y * (b * Wide(2.0) - Wide(1.0));
  rays.org = {x, y, Wide(lens.film)};
  const Vec3<Wide> in_pupil{cosine * along - sine * aside, sine * along + cosine * aside,
                            Wide(lens.rear)};
  const Vec3<Wide> way = in_pupil - rays.org;
  rays.dir = way * (Wide(1.0) / sqrt(dot(way, way)));
  const Wide cosine2 = rays.dir.z * rays.dir.z;
  const Wide area = (box.x1 - box.x0) * (box.y * Wide(2.0));
  const Wide weight = cosine2 * cosine2 * (area * Wide(lens.exposure));
  WideMask passed = Wide(0.0) < weight;
  for (int i = 0; i < lens.element_count; ++i) pass_element(lens.elements[i], rays, passed);
  return select(passed, weight, Wide(0.0));
}

}  // namespace boule::BOULE_KERNEL_ISA
