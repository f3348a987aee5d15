#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/ray.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule::test {

using Vec3l = Vec3<long double>;

inline long double length(const Vec3l& v) { return std::sqrt(dot(v, v)); }
inline Vec3l unit(const Vec3l& v) { return v * (1 / length(v)); }

/// The first thing that a ray meets; by default nothing.
struct LongHit {
  std::int32_t id = no_primitive;
  long double distance = std::numeric_limits<long double>::infinity();  ///< Euclidean
  Vec3l point, normal;     ///< unit length, turned towards the viewer
  bool inner = false;      ///< met on a sphere's inside, or on a plane's back
  long double cosine = 0;  ///< between the normal and the way back
};

/// Whether light arrives. unsure: the shadow ray passes an occluder's rim more closely than its
/// direction, rounded to float, can tell.
enum class Lit { no, yes, unsure };

/// An answer to check pictures by: every primitive against every ray in long double, distances
/// along unit directions from the closest approach. Shares no formula with core/reference or the
/// kernels. The scene's floats are exact.
class LongDoubleTracer {
 public:
  /// `scene` must outlive it.
  explicit LongDoubleTracer(const Scene& scene) : scene_(scene) {}

  /// What a ray from the camera meets first; equal distances: the lower id.
  [[nodiscard]] LongHit closest_hit(const Ray& ray) const {
    const Vec3l org = vec_cast<long double>(ray.org), h = unit(vec_cast<long double>(ray.dir));
    LongHit hit;
    std::int32_t id = 0;
    for (const Sphere& sphere : scene_.spheres) {
      const Chord chord = chord_of(org, h, sphere, 0);
      offer(hit, id++, chord.near > 0 ? chord.near : chord.far);
    }
    for (const Plane& plane : scene_.planes) offer(hit, id++, distance_to(org, h, plane));
    if (hit.id != no_primitive) locate(hit, org, h);
    return hit;
  }

  /// Whether a point light at `light` reaches a hit's visible side.
  [[nodiscard]] Lit lit(const LongHit& hit, const Vec3f& light) const {
    const Segment way = segment_to(hit, vec_cast<long double>(light));
    const long double cosine = dot(hit.normal, way.h);
    if (!(std::fabs(cosine) > least_cosine)) return Lit::unsure;
    if (cosine < 0) return Lit::no;
    Lit answer = Lit::yes;
    std::int32_t id = 0;
    const auto take = [&](Lit one) {
      if (answer == Lit::no || one == Lit::no) answer = Lit::no;
      if (answer == Lit::yes) answer = one;
      ++id;
    };
    for (const Sphere& sphere : scene_.spheres)
      take(id == hit.id ? passes_own(hit, way, sphere) : passes(way, sphere));
    for (const Plane& plane : scene_.planes) take(id == hit.id ? Lit::yes : passes(way, plane));
    return answer;
  }

 private:
  /// The rounding of a direction to float: u, and the other roundings.
  static constexpr long double direction_doubt = 0x1.04p-24L;
  /// That of a hit in double, relative to the distances that made it, with a margin.
  static constexpr long double point_doubt = 0x1p-46L;
  static constexpr long double least_cosine = 1e-7L;
  static constexpr long double nothing = std::numeric_limits<long double>::quiet_NaN();
  /// Shadow rays end here (1 = the light).
  static constexpr long double shadow_end = 1 - 4 * 0x1p-24L;

  /// Where a line enters and leaves a sphere; NaN: it does not.
  struct Chord {
    long double near, far;
  };

  /// A segment towards a light; occluders beyond `end` do not count.
  struct Segment {
    Vec3l from, h;
    long double end, doubt;  ///< of its start

    /// How far from this way the traced one may be, `along` it.
    [[nodiscard]] long double doubt_at(long double along) const {
      return doubt + direction_doubt * std::clamp(along, 0.0L, end);
    }
    [[nodiscard]] bool holds(long double s) const { return s > 0 && s < end; }
  };

  static Chord chord_of(const Vec3l& from, const Vec3l& h, const Sphere& sphere,
                        long double growth) {
    const Vec3l f = vec_cast<long double>(sphere.center) - from;
    const long double r = static_cast<long double>(sphere.radius) + growth;
    const long double along = dot(f, h), miss = length(f - h * along);
    if (miss > r) return {nothing, nothing};
    const long double half = std::sqrt((r - miss) * (r + miss));
    return {along - half, along + half};
  }

  /// NaN or infinite where the ray runs along the plane.
  static long double distance_to(const Vec3l& from, const Vec3l& h, const Plane& plane) {
    const Vec3l n = vec_cast<long double>(plane.normal);
    return dot(vec_cast<long double>(plane.point) - from, n) / dot(h, n);
  }

  static void offer(LongHit& hit, std::int32_t id, long double distance) {
    if (distance > 0 && distance < hit.distance) hit.id = id, hit.distance = distance;
  }

  void locate(LongHit& hit, const Vec3l& org, const Vec3l& h) const {
    const auto i = static_cast<std::size_t>(hit.id);
    const bool sphere = i < scene_.spheres.size();
    hit.point = org + h * hit.distance;
    hit.normal =
        unit(sphere ? hit.point - vec_cast<long double>(scene_.spheres[i].center)
                    : vec_cast<long double>(scene_.planes[i - scene_.spheres.size()].normal));
    hit.inner = dot(hit.normal, h) > 0;
    if (hit.inner) hit.normal = -hit.normal;
    hit.cosine = -dot(hit.normal, h);
  }

  [[nodiscard]] Segment segment_to(const LongHit& hit, const Vec3l& light) const {
    const Vec3l way = light - hit.point;
    const auto i = static_cast<std::size_t>(hit.id);
    const long double r =
        i < scene_.spheres.size() ? static_cast<long double>(scene_.spheres[i].radius) : 0;
    const long double reach = hit.distance + r + length(hit.point);
    const long double doubt = point_doubt * reach / std::max(hit.cosine, 0x1p-20L);
    return {hit.point, unit(way), length(way) * shadow_end, doubt};
  }

  static Lit both(bool small_blocks, bool large_blocks) {
    if (small_blocks != large_blocks) return Lit::unsure;
    return small_blocks ? Lit::no : Lit::yes;
  }

  /// Past a sphere that the segment does not start on, by a slightly larger and a smaller one.
  static Lit passes(const Segment& way, const Sphere& sphere) {
    const Vec3l f = vec_cast<long double>(sphere.center) - way.from;
    const long double doubt = way.doubt_at(dot(f, way.h));
    const auto blocks = [&](long double growth) {
      const Chord chord = chord_of(way.from, way.h, sphere, growth);
      return way.holds(chord.near) || way.holds(chord.far);
    };
    return both(blocks(-doubt), blocks(doubt));
  }

  /// Past the sphere it starts on: unoccluded from outside, from inside up to the chord's end.
  static Lit passes_own(const LongHit& hit, const Segment& way, const Sphere& sphere) {
    if (!hit.inner) return Lit::yes;
    const Vec3l f = vec_cast<long double>(sphere.center) - way.from;
    const long double across = 2 * dot(f, way.h);
    const long double doubt = 2 * (way.doubt + direction_doubt * length(f));
    return both(across + doubt < way.end, across - doubt < way.end);
  }

  /// Past a plane it does not start on: `a` and `b` are the heights of its ends.
  static Lit passes(const Segment& way, const Plane& plane) {
    const Vec3l n = unit(vec_cast<long double>(plane.normal));
    const long double a = dot(way.from - vec_cast<long double>(plane.point), n);
    const long double b = a + way.end * dot(way.h, n);
    if (std::fabs(a) <= way.doubt || std::fabs(b) <= way.doubt_at(way.end)) return Lit::unsure;
    return (a > 0) == (b > 0) ? Lit::yes : Lit::no;
  }

  const Scene& scene_;
};

}  // namespace boule::test
