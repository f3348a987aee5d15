#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/scene.h"
#include "tests/support/long_double_tracer.h"
#include "tests/support/test_scenes.h"

/// Scenes that planes cut, rays through them, and what the rays meet: in long double, by formulas
/// that share nothing with core.
namespace boule::test::clips {

/// Spheres and capsules that overlap and contain each other, cut by so many planes.
inline Scene cut_scene(std::uint64_t seed, int clips) {
  CaseRandom random(seed);
  const auto point = [&random](double size) {
    const double x = random.uniform(-size, size);
    const double y = random.uniform(-size, size);
    const double z = random.uniform(-size, size);
    return Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  const int spheres = 3 + 40 * random.below(3);
  for (int i = 0; i < spheres; ++i) {
    const Vec3f center = point(2);
    scene.spheres.push_back({center, static_cast<float>(random.uniform(0.05, 1.2)), 0});
  }
  scene.spheres.push_back({scene.spheres[0].center, 1.5F * scene.spheres[0].radius, 0});  // nested
  for (int i = 0; i < 6; ++i) {
    const Vec3f a = point(2);
    scene.capsules.push_back({a, point(2), static_cast<float>(random.uniform(0.02, 0.5)), 0});
  }
  scene.planes.push_back({{0, -2.5F, 0}, {0, 1, 0}, 0});
  for (int i = 0; i < clips; ++i) {
    const Vec3f at = point(0.8);
    scene.clips.push_back({at, vec_cast<float>(random.direction() * random.uniform(0.1, 9))});
  }
  return scene;
}

/// Rays from everywhere to everywhere: many start within something, or where it is cut off.
inline std::vector<Ray> rays_through(std::uint64_t seed, std::size_t count) {
  CaseRandom random(seed, 1);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const Vec3d from = random.direction() * random.uniform(0, 6);
    const Vec3d to = random.direction() * random.uniform(0, 2);
    const double scale = random.uniform(0.1, 3);
    rays.push_back({from, vec_cast<float>((to - from) * scale)});
    if (random.chance(0.2)) rays.back().tmax = random.uniform(0.1, 1);
  }
  return rays;
}

/// Where a line is within a primitive, in units of length; NaN: nowhere. A capsule is two balls and
/// a tube.
struct ChordL {
  long double enter, leave;
};
inline ChordL chord_of(const Vec3l& from, const Vec3l& h, const Vec3l& center, long double r) {
  const Vec3l f = center - from;
  const long double along = dot(f, h), miss = length(f - h * along);
  if (miss > r) return {NAN, NAN};
  const long double half = std::sqrt((r - miss) * (r + miss));
  return {along - half, along + half};
}
inline ChordL united(const ChordL& a, const ChordL& b) {
  if (std::isnan(a.enter)) return b;
  if (std::isnan(b.enter)) return a;
  return {std::min(a.enter, b.enter), std::max(a.leave, b.leave)};
}
inline ChordL chord_of(const Vec3l& from, const Vec3l& h, const Capsule& capsule) {
  const Vec3l a = vec_cast<long double>(capsule.a), b = vec_cast<long double>(capsule.b);
  const auto r = static_cast<long double>(capsule.radius);
  const ChordL balls = united(chord_of(from, h, a, r), chord_of(from, h, b, r));
  const Vec3l axis = unit(b - a), f = a - from;
  const Vec3l across = h - axis * dot(h, axis), off = f - axis * dot(f, axis);
  const long double aa = dot(across, across), along = dot(off, across) / aa;
  const long double miss = length(off - across * along);
  if (miss > r) return balls;
  const long double half = std::sqrt((r - miss) * (r + miss) / aa), rise = dot(h, axis);
  const long double low = dot(f, axis) / rise, high = (dot(f, axis) + length(b - a)) / rise;
  const ChordL tube{std::max(along - half, std::min(low, high)),
                    std::min(along + half, std::max(low, high))};
  return tube.enter < tube.leave ? united(balls, tube) : balls;
}

/// What a ray meets first of the scene that is cut, and how far the next event is from it or from
/// the decision, so that rounding cannot make another of it.
struct Judged {
  std::int32_t id = no_primitive;
  long double distance = std::numeric_limits<long double>::infinity(), doubt = distance;
  Vec3l normal;
};

/// Every primitive against a ray, in long double.
class CutJudge {
 public:
  CutJudge(const Scene& scene, const Ray& ray)
      : from_(vec_cast<long double>(ray.org)),
        h_(unit(vec_cast<long double>(ray.dir))),
        far_(static_cast<long double>(ray.tmax) * length(vec_cast<long double>(ray.dir))),
        end_(far_) {
    for (const Clip& clip : scene.clips) cut_by(clip);
    closer(end_ - begin_);
    for (const Sphere& sphere : scene.spheres) {
      const Vec3l center = vec_cast<long double>(sphere.center);
      const auto r = static_cast<long double>(sphere.radius);
      meet(chord_of(from_, h_, center, r), r, [&](const Vec3l& p) { return p - center; });
    }
    for (const Plane& plane : scene.planes) meet(plane);
    for (const Capsule& capsule : scene.capsules) {
      const Vec3l a = vec_cast<long double>(capsule.a), u = vec_cast<long double>(capsule.b) - a;
      meet(chord_of(from_, h_, capsule), static_cast<long double>(capsule.radius),
           [&](const Vec3l& p) {
             return p - (a + u * std::clamp(dot(p - a, u) / dot(u, u), 0.0L, 1.0L));
           });
    }
  }

  [[nodiscard]] const Judged& nearest() const { return nearest_; }

 private:
  void closer(long double doubt) { nearest_.doubt = std::min(nearest_.doubt, std::fabs(doubt)); }
  [[nodiscard]] Vec3l at(long double t) const { return from_ + h_ * t; }

  void cut_by(const Clip& clip) {
    const Vec3l n = unit(vec_cast<long double>(clip.normal));
    const long double rise = dot(h_, n);
    const long double t = dot(vec_cast<long double>(clip.point) - from_, n) / rise;
    if (rise < 0 && t > begin_) begin_ = t, first_ = n, entered_ = true;
    if (rise > 0 && t < end_) end_ = t, last_ = n, left_ = true;
  }

  void offer(long double t, const Vec3l& normal, long double share = 0) {
    if (t < nearest_.distance) {
      nearest_ = {id_, t, std::min(nearest_.doubt, nearest_.distance - t), normal};
      share_ = share;
    } else if (t > nearest_.distance) {
      closer(t - nearest_.distance);
    } else {  // caps of one plane are equal: the nearest centre's counts
      closer(share - share_);
      if (share < share_) nearest_.id = id_, share_ = share;
    }
  }

  template <class OffAt>
  void meet(const ChordL& chord, long double r, const OffAt& off_at) {
    if (!std::isnan(chord.enter) && begin_ < end_) {
      for (const long double t : {chord.enter, chord.leave}) closer(t - begin_), closer(t - end_);
      closer(chord.leave - chord.enter);
      if (chord.enter < end_ && chord.leave > begin_) meet_part(chord, r, off_at);
    }
    ++id_;
  }

  /// `off_at`: the way to a point from the centre, or from the segment.
  template <class OffAt>
  void meet_part(const ChordL& chord, long double r, const OffAt& off_at) {
    const auto share_at = [&](long double t) { return length(off_at(at(t))) / r; };
    if (chord.enter > begin_) return offer(chord.enter, unit(off_at(at(chord.enter))));
    if (entered_) return offer(begin_, first_, share_at(begin_));
    if (chord.leave < end_) return offer(chord.leave, unit(off_at(at(chord.leave))) * -1.0L);
    if (left_) offer(end_, last_ * -1.0L, share_at(end_));
  }

  void meet(const Plane& plane) {
    const Vec3l n = unit(vec_cast<long double>(plane.normal));
    const long double t = dot(vec_cast<long double>(plane.point) - from_, n) / dot(h_, n);
    if (t > 0 && t < far_) offer(t, dot(h_, n) > 0 ? n * -1.0L : n);
    ++id_;
  }

  Vec3l from_, h_;
  long double far_, begin_ = 0, end_;
  Vec3l first_, last_;  ///< normals of the planes at both ends
  bool entered_ = false, left_ = false;
  long double share_ = 0;  ///< of the nearest, if it is a cap
  std::int32_t id_ = 0;
  Judged nearest_;
};

}  // namespace boule::test::clips
