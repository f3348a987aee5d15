#include "render/renderer/queries/trace_worker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/surface.h"

namespace boule {
namespace {

bool is_nearer_to_enter(double t, const reference::Chord& chord) {
  return t - chord.enter <= chord.leave - t;
}

/// Whether a ray from elsewhere enters the sphere that it surely hits at t. A tangent enters. The
/// ray enters before the middle of its chord, and leaves behind it: only of a chord so short that
/// rounding may decide are both ends needed.
bool enters(const Sphere& sphere, const Ray& ray, double t) {
  constexpr double shortest = 1e-9;  // half chord, in distances of the centre
  const Vec3d d = vec_cast<double>(ray.dir), f = vec_cast<double>(sphere.center) - ray.org;
  const double a = dot(d, d), behind = t * a - dot(f, d);
  if (behind * behind > shortest * shortest * (dot(f, f) * a)) return behind < 0;
  return is_nearer_to_enter(t, reference::find_chord(ray, sphere, false));
}

/// Whether a ray enters the sphere that it hits. Where the solver fast finds a hit of a line that
/// misses, it does not.
bool enters(const TraceTarget& target, const Sphere& sphere, const Ray& ray, const Hit& hit) {
  const bool leaves = hit.id == ray.source;
  if (!leaves && target.solver != Solver::fast) return enters(sphere, ray, hit.t);
  return is_nearer_to_enter(hit.t, reference::find_chord(ray, sphere, leaves));
}
bool enters(const TraceTarget&, const Plane& plane, const Ray& ray, const Hit& hit) {
  return is_nearer_to_enter(hit.t, reference::find_chord(ray, plane, hit.id == ray.source));
}
bool enters(const TraceTarget&, const Capsule& capsule, const Ray& ray, const Hit& hit) {
  return is_nearer_to_enter(hit.t, reference::find_chord(ray, capsule, hit.id == ray.source));
}

/// Calls visit(primitive) with the one that was hit.
template <class Visit>
auto visit_primitive(const Geometry& geometry, const Hit& hit, const Visit& visit) {
  if (geometry.is_plane(hit)) return visit(geometry.plane(hit.id));
  if (geometry.is_capsule(hit)) return visit(geometry.capsule(hit.slot));
  return visit(geometry.sphere(hit.slot));
}

/// Whether a ray by itself may go without a stream.
bool is_alone(const TraceTarget& target) { return target.solver == Solver::robust; }

/// Whether a stream has this end of a ray as it is.
bool is_float(double end) {
  constexpr double largest{std::numeric_limits<float>::max()};
  return std::fabs(end) <= largest ? double{static_cast<float>(end)} == end : std::isinf(end);
}

void put(const HitStream& hits, std::size_t k, const Hit& hit) {
  hits.t[k] = hit.t;
  hits.id[k] = hit.id;
  hits.slot[k] = hit.slot;
}

}  // namespace

void TraceWorker::start(std::size_t count) {
  if (count != size()) {  // without memory the rays, last, keep their size
    ends_.resize(count);
    rays_.resize(count);
  }
  rounded_.clear();
}

void TraceWorker::set(std::size_t k, const Ray& ray) {
  rays_.set(k, ray);
  ends_[k] = {ray.tmin, ray.tmax};
  constexpr double inf = std::numeric_limits<double>::infinity();
  const bool is_usual = ray.tmin == 0 && ray.tmax == inf;  // tells most rays at once
  if (!is_usual && !(is_float(ray.tmin) && is_float(ray.tmax))) rounded_.push_back(k);
}

void TraceWorker::meet_closest(const TraceTarget& target) {
  if (hits_.size() != size()) hits_.resize(size());
  Query query{.solver = target.solver, .experience = &closest_};
  if (size() == 1) query.form = Form::single;
  target.kernels.closest_hit(target.view, rays_.view(), query, hits_.view());
  settle_ends(target);
}

/// A hit beyond tmax is none, for there is none before it. If there is one up to tmin, the next one
/// is found among all of them.
void TraceWorker::settle_ends(const TraceTarget& target) {
  const HitStream hits = hits_.view();
  again_.clear();
  for (const std::size_t k : rounded_) {
    const Hit hit = hits_.get(k);
    if (hit.id == no_primitive || ends_[k].holds(hit.t)) continue;
    put(hits, k, {});
    if (!(hit.t > ends_[k].tmax)) again_.push_back(k);
  }
  if (again_.empty()) return;
  again_rays_.resize(again_.size());
  for (std::size_t i = 0; i < again_.size(); ++i) again_rays_.set(i, rays_.get(again_[i]));
  visit_chords(target, again_rays_, [&](std::size_t i, std::span<const RayChord> chords) {
    put(hits, again_[i], first_hit(chords, ends_[again_[i]]));
  });
}

std::size_t TraceWorker::find_surfaces(const TraceTarget& target, std::size_t first) {
  const std::size_t count = std::min(surface_block, size() - first);
  target.kernels.find_surfaces(target.view, part(rays_.view(), first, count),
                               part(hits_.view(), first, count), surfaces_.stream());
  return count;
}

TracedHit TraceWorker::traced(const TraceTarget& target, std::size_t k, std::size_t surface) {
  const Hit hit = hits_.get(k);
  if (hit.id == no_primitive) return {};
  return {hit.t, hit.id, vec_cast<float>(surfaces_.normal.get(surface)),
          visit_primitive(target.geometry, hit, [&](const auto& primitive) {
            return enters(target, primitive, rays_.get(k), hit);
          })};
}

TracedHit TraceWorker::find_closest(const TraceTarget& target, const Ray& ray) {
  Hit hit;
  if (!is_alone(target) || !target.kernels.closest_of_ray(target.view, ray, hit)) {
    start(1);
    set(0, ray);
    meet_closest(target);
    hit = hits_.get(0);
  }
  if (hit.id == no_primitive) return {};
  Ray met = ray;
  met.tmin = double{float_below(ray.tmin)};  // as in streams
  return visit_primitive(target.geometry, hit, [&](const auto& primitive) {
    return TracedHit{hit.t, hit.id, vec_cast<float>(find_normal(primitive, met, hit)),
                     enters(target, primitive, met, hit)};
  });
}

bool TraceWorker::find_any(const TraceTarget& target, const Ray& ray) {
  bool met = false;
  if (is_alone(target) && target.kernels.any_of_ray(target.view, ray, met)) return met;
  start(1);
  set(0, ray);
  return find_any(target)[0] != 0;
}

/// Where the ends of a ray are no floats, a hit is certain if the ray meets something between the
/// next floats inward, too. The few others need the nearest hit.
const std::uint8_t* TraceWorker::find_any(const TraceTarget& target) {
  met_.resize(size());
  Query query{.solver = target.solver, .experience = &any_};
  if (size() == 1) query.form = Form::single;
  target.kernels.any_hit(target.view, rays_.view(), query, met_.data());
  std::vector<std::size_t>& unsure = again_;
  unsure.clear();
  for (const std::size_t k : rounded_) {
    if (met_[k] != 0) unsure.push_back(k);
  }
  if (unsure.empty()) return met_.data();
  again_rays_.resize(unsure.size());
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    Ray ray = rays_.get(unsure[i]);
    ray.tmin = double{float_above(ends_[unsure[i]].tmin)};
    ray.tmax = double{float_below(ends_[unsure[i]].tmax)};
    again_rays_.set(i, ray);
  }
  again_met_.resize(unsure.size());
  target.kernels.any_hit(target.view, again_rays_.view(), query, again_met_.data());
  std::size_t left = 0;
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    if (again_met_[i] == 0) unsure[left++] = unsure[i];
  }
  unsure.resize(left);
  again_rays_.resize(left);
  for (std::size_t i = 0; i < left; ++i) again_rays_.set(i, rays_.get(unsure[i]));
  visit_chords(target, again_rays_, [&](std::size_t i, std::span<const RayChord> chords) {
    met_[unsure[i]] = first_hit(chords, ends_[unsure[i]]).id == no_primitive ? 0 : 1;
  });
  return met_.data();
}

/// Adds the chords of spheres that the tree leaves out, as exact copies of two others, `first` and
/// `second`. The first shows where they are; or the second, if the ray leaves the first.
void TraceWorker::add_copies(const Geometry& geometry, const RayBuffer& rays, std::size_t first,
                             std::size_t stop) {
  std::vector<std::size_t>& ends = lists_.ends();
  std::vector<RayChord> all;
  std::size_t at = 0;
  for (std::size_t k = first; k < stop; ++k) {
    const Ray ray = rays.get(k);
    const auto of_source = geometry.copies_of(ray.source);
    for (; at < ends[k]; ++at) {
      const RayChord& chord = lists_.chords()[at];
      all.push_back(chord);
      if (chord.id == ray.source) continue;
      const bool is_second = !of_source.empty() && of_source[0].second == chord.id;
      for (const SphereCopy& copy : is_second ? of_source : geometry.copies_of(chord.id)) {
        if (copy.id != ray.source) {
          all.push_back({chord.enter, chord.leave, copy.id, chord.slot});
        } else if (ray.inside) {
          const auto own = reference::find_chord(ray, geometry.sphere(chord.slot), true);
          if (own.leave > ray.tmin) all.push_back({own.enter, own.leave, copy.id, chord.slot});
        }
      }
    }
    ends[k] = all.size();
  }
  lists_.chords() = std::move(all);
}

}  // namespace boule
