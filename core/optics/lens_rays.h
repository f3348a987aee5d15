#pragma once

#include <cstddef>

#include "core/math/geometry.h"
#include "core/math/number.h"
#include "core/optics/lens_view.h"

namespace boule {

/// A ray of unit direction in the lens' space.
template <class T>
struct LensRayOf {
  Vec3<T> org, dir;
};
using LensRay = LensRayOf<double>;

/// Sends a ray from the film through one surface. `passed` becomes false if the ray is stopped: by
/// the rim, beside the sphere (NaN fails every comparison) or by total reflection.
template <class T>
BOULE_INLINE void pass_element(const LensElement& element, LensRayOf<T>& ray, Mask<T>& passed) {
  const T radius(element.radius), z(element.z), eta(element.eta);
  const Vec3<T> center{T(0.0), T(0.0), z};
  T t = (z - ray.org.z) / ray.dir.z;
  if (element.radius != 0) {
    // The point of the sphere, among two, on the surface's side: behind the centre as seen from the
    // film if the centre is on the film's side.
    const Vec3<T> f = center - ray.org;
    const T b = dot(f, ray.dir);
    const Vec3<T> l = f - ray.dir * b;
    const T root = sqrt(radius * radius - dot(l, l));
    t = element.radius > 0 ? b + root : b - root;
  }
  ray.org = ray.org + ray.dir * t;
  const T height2 = ray.org.x * ray.org.x + ray.org.y * ray.org.y;
  Vec3<T> normal{T(0.0), T(0.0), T(-1.0)};  // along the ray
  if (element.radius != 0) normal = (ray.org - center) * (T(1.0) / radius);
  // Snell's law.
  const T cosine = dot(ray.dir, normal);
  const T cosine2 = T(1.0) - eta * eta * (T(1.0) - cosine * cosine);
  passed = passed & (height2 <= T(element.aperture2)) & (T(0.0) <= cosine2);
  ray.dir = ray.dir * eta + normal * (sqrt(cosine2) - eta * cosine);
}

/// For look_up(): the boxes of the exit pupil around the box of a film point. Input: the distance
/// of the point from the film's middle, in rings. Output: the position of its box between the inner
/// and the outer one, 0 .. 1; then x0, x1 and y, of the inner and of the outer one each. Beyond the
/// last ring it is that ring's outer box.
struct PupilBoxes {
  const LensView& lens;

  BOULE_INLINE void operator()(SpacedNumbers rings, SpacedNumbers found) const {
    const bool on_film = rings[0] < lens.ring_count;
    const int index = on_film ? static_cast<int>(rings[0]) : lens.ring_count - 1;
    found[0] = on_film ? rings[0] - index : 1;
    const PupilRing& ring = lens.pupil[index];
    for (std::size_t end = 0; end < 2; ++end) {
      const PupilBox& box = end == 0 ? ring.inner : ring.outer;
      found[1 + end] = box.x0;
      found[3 + end] = box.x1;
      found[5 + end] = box.y;
    }
  }
};

/// As PupilBox.
template <class T>
struct PupilBoxOf {
  T x0, x1, y;
};

/// The box of the exit pupil at this distance from the film's middle: linear between those of its
/// ring's inner and outer points.
template <class T>
BOULE_INLINE PupilBoxOf<T> pupil_box(const LensView& lens, const T& distance) {
  const Numbers<T, 1> rings{{distance * T(lens.rings_per_length)}};
  const Numbers<T, 7> found = look_up<7>(rings, PupilBoxes{lens});
  const auto between = [&found](std::size_t k) {
    return found.at[k] + (found.at[k + 1] - found.at[k]) * found.at[0];
  };
  return {between(1), between(3), between(5)};
}

/// The ray of the film point (x, y) through the point (a, b) of its pupil box, 0 .. 1 each (Kolb,
/// Mitchell, Hanrahan, "A realistic camera model for computer graphics", SIGGRAPH 1995). Returns
/// its weight: cos^4 of its angle with the axis times the area of the box, relative to the light
/// that arrives in the film's middle; 0 if it is stopped.
template <class T>
BOULE_INLINE T send_through(const LensView& lens, const T& x, const T& y, const T& a, const T& b,
                            LensRayOf<T>& ray) {
  const T distance = sqrt(x * x + y * y);
  const Mask<T> middle = distance == T(0.0);
  const T across = select(middle, T(1.0), distance);
  const T cosine = select(middle, T(1.0), x / across), sine = y / across;
  const PupilBoxOf<T> box = pupil_box(lens, distance);
  const T along = box.x0 + (box.x1 - box.x0) * a;
  const T aside = box.y * (b * T(2.0) - T(1.0));
  ray.org = {x, y, T(lens.film)};
  const Vec3<T> in_pupil{cosine * along - sine * aside, sine * along + cosine * aside,
                         T(lens.rear)};
  ray.dir = normalize(in_pupil - ray.org);
  const T cosine2 = ray.dir.z * ray.dir.z;
  const T area = (box.x1 - box.x0) * (box.y * T(2.0));
  const T weight = cosine2 * cosine2 * (area * T(lens.exposure));
  Mask<T> passed = T(0.0) < weight;
  for (int i = 0; i < lens.element_count; ++i) pass_element(lens.elements[i], ray, passed);
  return select(passed, weight, T(0.0));
}

}  // namespace boule
