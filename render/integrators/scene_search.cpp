#include "render/integrators/scene_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/reference.h"

namespace boule {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Hits have none that is larger.
constexpr double largest_t{std::numeric_limits<float>::max()};

/// Whether a point is on the side to which the normal points.
bool is_beyond(const Plane& plane, const Vec3d& point) {
  return dot(vec_cast<double>(plane.point) - point, vec_cast<double>(plane.normal)) < 0;
}

/// The largest float below t.
double float_before(double t) {
  const float below = float_below(t);
  return double{below} < t ? below : std::nextafter(below, -std::numeric_limits<float>::infinity());
}

Hit hit_at(const HitStream& hits, std::size_t k) { return {hits.t[k], hits.id[k], hits.slot[k]}; }

void put_hit(const HitStream& hits, std::size_t k, const Hit& hit) {
  hits.t[k] = hit.t;
  hits.id[k] = hit.id;
  hits.slot[k] = hit.slot;
}

}  // namespace

SceneSearch::SceneSearch(const PreparedScene& scene, const KernelTable& kernels)
    : scene_(scene),
      kernels_(kernels),
      geometry_(scene.geometry.view()),
      planes_(std::span(scene.planes).first(scene.planes.size() - scene.clips)),
      clips_(scene.clip_planes()),
      first_plane_(static_cast<std::int32_t>(scene.geometry.sphere_count())),
      first_clip_(first_plane_ + static_cast<std::int32_t>(planes_.size())) {
  if (!clips_.empty()) geometry_.planes.size = 0;
}

void SceneSearch::closest_hit(const RayStream& rays, const Query& query, const HitStream& hits) {
  if (clips_.empty()) return kernels_.closest_hit(geometry_, rays, query, hits);
  cut(rays);
  find_entered_caps(rays);
  // The rays that are cut start in many places.
  const Query each{query.solver, query.form, Coherence::none, query.experience};
  kernels_.closest_hit(geometry_, cut_rays_.view(), each, hits);
  find_again(rays, hits);
  for (std::size_t k = 0; k < rays.size; ++k) {
    if (caps_[k].id != no_primitive) put_hit(hits, k, caps_[k]);
    cap_planes_[k] = caps_[k].id != no_primitive ? kept_[k].enters : no_primitive;
  }
  find_left_caps(rays, hits);
  meet_planes(rays, hits);
}

HitStream SceneSearch::surfaces(const HitStream& hits, HitBuffer& room) const {
  if (clips_.empty()) return hits;
  room.resize(hits.size);
  const HitStream met = room.view();
  for (std::size_t k = 0; k < hits.size; ++k) {
    put_hit(met, k, hit_at(hits, k));
    if (cap_planes_[k] != no_primitive) met.id[k] = cap_planes_[k];
  }
  return met;
}

void SceneSearch::any_hit(const RayStream& rays, const Query& query, std::uint8_t* occluded) {
  if (clips_.empty()) return kernels_.any_hit(geometry_, rays, query, occluded);
  blocking_.resize(rays.size);
  const HitStream hits = blocking_.view();
  closest_hit(rays, query, hits);
  for (std::size_t k = 0; k < rays.size; ++k)
    occluded[k] = hits.id[k] == no_primitive ? std::uint8_t{0} : std::uint8_t{1};
}

SceneSearch::Kept SceneSearch::kept_part(const Ray& ray) const {
  Kept kept{ray.tmin, ray.tmax};
  std::int32_t id = first_clip_;
  for (const Plane& plane : clips_) {
    // A ray that leaves a cap starts off its plane, and never crosses it again.
    const reference::Chord behind = reference::find_chord(ray, plane, id == ray.source);
    if (std::isnan(behind.enter)) {
      if (is_beyond(plane, ray.org)) return {infinity, -infinity};
    } else {
      if (behind.enter > kept.from) kept.from = behind.enter, kept.enters = id;
      if (behind.leave < kept.to) kept.to = behind.leave, kept.leaves = id;
    }
    ++id;
  }
  if (kept.from >= largest_t) return {infinity, -infinity};
  if (kept.to > largest_t) kept.leaves = no_primitive;
  return kept;
}

void SceneSearch::cut(const RayStream& rays) {
  kept_.resize(rays.size);
  caps_.assign(rays.size, Hit{});
  cap_planes_.resize(rays.size);
  cut_rays_.resize(rays.size);
  for (std::size_t k = 0; k < rays.size; ++k) {
    Ray ray = get_ray(rays, k);
    kept_[k] = kept_part(ray);
    ray.tmin = kept_[k].from;
    ray.tmax = kept_[k].is_empty() ? -infinity : kept_[k].to;
    cut_rays_.set(k, ray);
  }
}

/// The squared distance of a point from the primitive's centre or segment, by that of its surface.
double SceneSearch::share_of_radius(const RayChord& chord, const Vec3d& point) const {
  const Hit hit{chord.enter, chord.id, chord.slot};
  if (scene_.geometry.is_capsule(hit)) {
    const Capsule capsule = scene_.geometry.capsule(hit.slot);
    const Vec3d a = vec_cast<double>(capsule.a), way = vec_cast<double>(capsule.b) - a;
    const double length2 = dot(way, way);
    const double along = length2 > 0 ? std::clamp(dot(point - a, way) / length2, 0.0, 1.0) : 0;
    const Vec3d off = point - (a + way * along);
    return dot(off, off) / (double{capsule.radius} * double{capsule.radius});
  }
  const Sphere sphere = scene_.geometry.sphere(hit.slot);
  const Vec3d off = point - vec_cast<double>(sphere.center);
  return dot(off, off) / (double{sphere.radius} * double{sphere.radius});
}

/// The cap where these chords are cut at t.
Hit SceneSearch::nearest_cap(const Ray& ray, std::span<const RayChord> chords, double t) const {
  const Vec3d point = ray.org + vec_cast<double>(ray.dir) * t;
  Hit cap;
  double nearest = infinity;
  for (const RayChord& chord : chords) {
    if (!(chord.enter <= t && t < chord.leave)) continue;
    const double share = share_of_radius(chord, point);
    const bool is_first = cap.id == no_primitive || share < nearest;
    if (!is_first && !(share == nearest && comes_before(t, chord.id, cap))) continue;
    cap = {t, chord.id, chord.slot};
    nearest = share;
  }
  return cap;
}

/// The chords that the wanted rays have at an end of what is kept.
void SceneSearch::want_chords_at(const RayStream& rays, double Kept::*end) {
  chord_rays_.resize(wanted_.size());
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    Ray ray = get_ray(rays, wanted_[i]);
    ray.tmax = kept_[wanted_[i]].*end;
    ray.tmin = float_before(ray.tmax);
    chord_rays_.set(i, ray);
  }
}

/// Finds the caps of rays that come from beyond a clip plane. These rays need no other hit.
void SceneSearch::find_entered_caps(const RayStream& rays) {
  wanted_.clear();
  for (std::size_t k = 0; k < rays.size; ++k) {
    if (kept_[k].enters != no_primitive && !kept_[k].is_empty()) wanted_.push_back(k);
  }
  want_chords_at(rays, &Kept::from);
  visit_chords([&](std::size_t i, std::span<const RayChord> chords) {
    const std::size_t k = wanted_[i];
    caps_[k] = nearest_cap(get_ray(rays, k), chords, kept_[k].from);
    if (caps_[k].id == no_primitive) return;
    Ray ray = get_ray(rays, k);
    ray.tmax = -infinity;
    cut_rays_.set(k, ray);
  });
}

/// Finds the caps that rays meet from within: of what holds the whole ray up to the plane.
void SceneSearch::find_left_caps(const RayStream& rays, const HitStream& hits) {
  wanted_.clear();
  for (std::size_t k = 0; k < rays.size; ++k) {
    const Kept& kept = kept_[k];
    if (kept.leaves != no_primitive && !kept.is_empty() && !(hits.t[k] < kept.to))
      wanted_.push_back(k);
  }
  want_chords_at(rays, &Kept::to);
  visit_chords([&](std::size_t i, std::span<const RayChord> chords) {
    const std::size_t k = wanted_[i];
    const Hit cap = nearest_cap(get_ray(rays, k), chords, kept_[k].to);
    if (cap.id == no_primitive || !comes_before(cap.t, cap.id, hit_at(hits, k))) return;
    put_hit(hits, k, cap);
    cap_planes_[k] = kept_[k].leaves;
  });
}

/// Kernels know the ends of rays as floats, rounded outward. A hit beyond the end is a miss; after
/// one before the beginning comes the next.
void SceneSearch::find_again(const RayStream& rays, const HitStream& hits) {
  wanted_.clear();
  for (std::size_t k = 0; k < rays.size; ++k) {
    if (hits.id[k] == no_primitive || kept_[k].holds(hits.t[k])) continue;
    if (!(hits.t[k] > kept_[k].to)) wanted_.push_back(k);
    put_hit(hits, k, {});
  }
  chord_rays_.resize(wanted_.size());
  for (std::size_t i = 0; i < wanted_.size(); ++i) chord_rays_.set(i, cut_rays_.get(wanted_[i]));
  visit_chords([&](std::size_t i, std::span<const RayChord> chords) {
    const std::size_t k = wanted_[i];
    put_hit(hits, k, first_hit(chords, kept_[k]));
  });
}

/// The scene's planes, which are left whole.
void SceneSearch::meet_planes(const RayStream& rays, const HitStream& hits) {
  if (planes_.empty()) return;
  for (std::size_t k = 0; k < rays.size; ++k) {
    const Ray ray = get_ray(rays, k);
    Hit nearest = hit_at(hits, k);
    std::int32_t id = first_plane_;
    for (const Plane& plane : planes_) {
      const double t = reference::intersect(ray, plane, id == ray.source);
      if (t < infinity && comes_before(t, id, nearest)) nearest = {t, id, 0};
      ++id;
    }
    if (nearest.id == hits.id[k]) continue;
    put_hit(hits, k, nearest);
    cap_planes_[k] = no_primitive;
  }
}

/// Calls visit(i, chords) with the chords of each of chord_rays_, in any order.
template <class Visit>
void SceneSearch::visit_chords(const Visit& visit) {
  // Of exact copies the tree has two: one of them is met whatever the ray leaves.
  lists_.visit(kernels_, geometry_, chord_rays_.view(), visit, [](std::size_t, std::size_t) {});
}

}  // namespace boule
