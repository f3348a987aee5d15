// Callbacks for Embree's user geometry, as fast as they can be: compiled once per ISA.
#include "bench/peers/embree/embree_callbacks.h"

#include <bit>
#include <limits>

#include "bench/peers/embree/embree_lanes.h"

namespace boule::bench::BOULE_KERNEL_ISA {
namespace {

/// The number of the array in which a field lies in Embree's structures of N rays, which consist of
/// arrays of N: twelve for the ray, then those of the hit.
enum Field { org_x, org_y, org_z, tnear, dir_x, dir_y, dir_z, tfar = 8, prim_id = 17, geom_id };

const PackedSphere& sphere_of(const void* spheres, unsigned id) {
  return static_cast<const PackedSphere*>(spheres)[id];
}

/// Roots that are live, and the lanes that have one.
template <class L>
struct Found {
  typename L::Real t;
  typename L::Mask hit;
};

/// The rays `rays` + lane, of arrays of n, against one sphere.
template <class L>
BOULE_INLINE Found<L> meet(const PackedSphere& s, const int* valid, const float* rays, unsigned n) {
  using Real = typename L::Real;
  const auto get = [&](Field field) { return L::load(rays + field * n); };
  const Real fx = L::all(s.x) - get(org_x), fy = L::all(s.y) - get(org_y);
  const Real fz = L::all(s.z) - get(org_z);
  const Real dx = get(dir_x), dy = get(dir_y), dz = get(dir_z);
  const Real b = L::fma(fz, dz, L::fma(fy, dy, fx * dx));
  const Real lx = L::fnma(b, dx, fx), ly = L::fnma(b, dy, fy), lz = L::fnma(b, dz, fz);
  const Real discriminant =
      L::fnma(lz, lz, L::fnma(ly, ly, L::fnma(lx, lx, L::all(s.radius_squared))));
  const auto met = L::both(L::valid(valid), L::at_most(L::all(0), discriminant));
  if (L::none(met)) return {b, met};
  const Real half_chord = L::root(discriminant);
  const Real first = b - half_chord, second = b + half_chord;
  const Real from = get(tnear), to = get(tfar);
  const auto first_live = L::both(L::less(from, first), L::at_most(first, to));
  const auto second_live = L::both(L::less(from, second), L::at_most(second, to));
  return {L::pick(first_live, first, second), L::both(met, L::either(first_live, second_live))};
}

/// One ray against one sphere: the live root, or NaN.
BOULE_INLINE float meet_one(const PackedSphere& s, const float* ray) {
  constexpr float miss = std::numeric_limits<float>::quiet_NaN();
  const float fx = s.x - ray[org_x], fy = s.y - ray[org_y], fz = s.z - ray[org_z];
  const float dx = ray[dir_x], dy = ray[dir_y], dz = ray[dir_z];
  const float b = __builtin_fmaf(fz, dz, __builtin_fmaf(fy, dy, fx * dx));
  const float lx = __builtin_fmaf(-b, dx, fx), ly = __builtin_fmaf(-b, dy, fy);
  const float lz = __builtin_fmaf(-b, dz, fz);
  const float discriminant =
      __builtin_fmaf(-lz, lz, __builtin_fmaf(-ly, ly, __builtin_fmaf(-lx, lx, s.radius_squared)));
  if (!(discriminant >= 0)) return miss;
  const float half_chord = __builtin_sqrtf(discriminant);
  const float first = b - half_chord, second = b + half_chord;
  if (first > ray[tnear] && first <= ray[tfar]) return first;
  return second > ray[tnear] && second <= ray[tfar] ? second : miss;
}

/// Calls group(lanes, first lane) for n rays by the widest lanes that divide what is left.
template <class Group>
BOULE_INLINE void for_each_group(unsigned n, const Group& group) {
  unsigned first = 0;
  for (; first + Widest::width <= n; first += Widest::width) group(Widest{}, first);
  for (; first + 8 <= n; first += 8) group(Lanes8{}, first);
  for (; first + 4 <= n; first += 4) group(Lanes4{}, first);
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  const PackedSphere& sphere = sphere_of(args->geometryUserPtr, args->primID);
  auto* const rays = reinterpret_cast<float*>(args->rayhit);
  const unsigned n = args->N;
  if (n == 1) {
    const float t = meet_one(sphere, rays);
    if (!(t == t) || args->valid[0] == 0) return;
    rays[tfar] = t;
    rays[prim_id] = std::bit_cast<float>(args->primID);
    rays[geom_id] = std::bit_cast<float>(args->geomID);
    return;
  }
  for_each_group(n, [&](auto lanes, unsigned first) {
    using L = decltype(lanes);
    const Found<L> found = meet<L>(sphere, args->valid + first, rays + first, n);
    if (L::none(found.hit)) return;
    L::store(rays + tfar * n + first, found.hit, found.t);
    L::store_word(rays + prim_id * n + first, found.hit, args->primID);
    L::store_word(rays + geom_id * n + first, found.hit, args->geomID);
  });
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  constexpr float blocked = -std::numeric_limits<float>::infinity();
  const PackedSphere& sphere = sphere_of(args->geometryUserPtr, args->primID);
  auto* const rays = reinterpret_cast<float*>(args->ray);
  const unsigned n = args->N;
  if (n == 1) {
    const float t = meet_one(sphere, rays);
    if (t == t && args->valid[0] != 0) rays[tfar] = blocked;
    return;
  }
  for_each_group(n, [&](auto lanes, unsigned first) {
    using L = decltype(lanes);
    const Found<L> found = meet<L>(sphere, args->valid + first, rays + first, n);
    if (!L::none(found.hit)) L::store(rays + tfar * n + first, found.hit, L::all(blocked));
  });
}

}  // namespace

extern const EmbreeCallbacks embree_callbacks = {intersect, occluded};

}  // namespace boule::bench::BOULE_KERNEL_ISA
