// Packets and single rays against all primitives.
#include "simd/kernel/search/packet/lone_ray.h"
#include "simd/kernel/search/packet/packet_hits.h"
#include "simd/kernel/search/packet/packet_stream.h"
#include "simd/kernel/search/packet/short_search.h"
#include "simd/kernel/search/packet/traverse.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

/// Whether the next ray is traced alone. `remaining`: the number of rays from it to the end of the
/// stream.
BOULE_INLINE bool goes_single(Form form, std::size_t remaining) {
  if (form == Form::automatic) return remaining <= tuning::most_single_rays;
  return form == Form::single;
}

/// Calls packet(rays, first, live) for packets, in which `live` lanes are rays of the stream, and
/// single(rays, index) for single rays. Together the calls cover rays begin .. end - 1 once.
/// `begin` is a multiple of W.
template <class Packet, class Single>
BOULE_INLINE void for_each_group(const PaddedStream& stream, std::size_t begin, std::size_t end,
                                 Form form, const Packet& packet, const Single& single) {
  RayLanes rays;
  std::size_t first = begin;
  while (first < end) {
    if (goes_single(form, end - first)) {
      load_single(stream.rays(), first, rays);
      single(rays, first);
      ++first;
    } else {
      load_ahead(stream, first, rays);
      packet(rays, first, stream.live(first));
      first += width;
    }
  }
}

/// The hit of one ray: the nearest over the lanes; at equal t, the lower id.
BOULE_INLINE Hit single_hit(const ClosestHit& best) {
  alignas(64) double t[width];
  alignas(64) std::int32_t id[width];
  alignas(64) std::uint32_t slot[width];
  store(t, best.t);
  store(id, best.id);
  store(slot, best.slot);
  std::size_t nearest = 0;
  for (std::size_t lane = 1; lane < width; ++lane) {
    const bool tie = t[lane] == t[nearest] && is_lower(id[lane], id[nearest]);
    if (t[lane] < t[nearest] || tie) nearest = lane;
  }
  return {t[nearest], id[nearest], slot[nearest]};
}
BOULE_INLINE void put(const HitStream& hits, std::size_t index, const Hit& hit) {
  hits.t[index] = hit.t;
  hits.id[index] = hit.id;
  hits.slot[index] = hit.slot;
}
BOULE_INLINE void put(std::uint8_t* met, std::size_t index, bool is_met) {
  met[index] = is_met ? 1 : 0;
}
BOULE_INLINE void store_single(const ClosestHit& best, const HitStream& hits, std::size_t index) {
  put(hits, index, single_hit(best));
}

/// Stores the answer of one ray: all lanes hold the same ray.
BOULE_INLINE void store_single(const AnyHit<true>& best, std::uint8_t* occluded,
                               std::size_t index) {
  occluded[index] = best.hit != 0 ? 1 : 0;
}

/// The searches of packets and of single rays for one kind of answer.
template <class Answers>
struct BestOf {
  using Packet = ClosestHit;
  using Single = ClosestHit;
  using One = Hit;
};
template <>
struct BestOf<std::uint8_t*> {
  using Packet = AnyHit<false>;
  using Single = AnyHit<true>;
  using One = bool;
};

/// Traces pairs of packets while there are any. Returns the number of nodes and leaves visited, and
/// advances `begin`.
BOULE_INLINE std::size_t trace_pairs(const GeometryView& geometry, const PaddedStream& stream,
                                     std::size_t& begin, std::size_t end, Solver solver,
                                     std::uint8_t* occluded) {
  std::size_t visits = 0;
  TwoPackets packets;
  for (; begin + 2 * width <= end; begin += 2 * width) {
    load_ahead(stream, begin, packets.rays[0]);
    load_ahead(stream, begin + width, packets.rays[1]);
    AnyHit<false> best[2] = {AnyHit<false>(packets.rays[0]), AnyHit<false>(packets.rays[1])};
    visits += search_two(packets, solver, geometry, best);
    for (std::size_t p = 0; p < 2; ++p) store_packet(best[p], occluded, begin + p * width, width);
  }
  return visits;
}
/// Nearest hits and parts are traced without pairs.
template <class Geometry, class Answers>
BOULE_INLINE std::size_t trace_pairs(const Geometry&, const PaddedStream&, std::size_t&,
                                     std::size_t, Solver, const Answers&) {
  return 0;
}

/// Tests the spheres outside the leaves, and the planes. Returns the best of all lanes.
template <class Best>
BOULE_INLINE Best meet_others(const GeometryView& geometry, const Ray& ray) {
  RayLanes lanes;
  load_single(ray, lanes);
  Best best(lanes);
  scan_spheres<OnePerLane>(lanes, Solver::robust, geometry.spheres, best);
  best.settle(geometry.spheres, lanes);
  scan_planes<OnePerLane>(lanes, Solver::robust, geometry.planes, best);
  return best;
}

BOULE_INLINE void go_alone(const GeometryView& geometry, const Ray& ray, LoneRay& lone, Hit& hit) {
  float reach = lone.end();
  if (LoneRay::leaves_others(geometry)) {
    const auto best = meet_others<ClosestHit>(geometry, ray);
    hit = single_hit(best);
    reach = least_lane(best.reach);
  }
  lone.find_nearest(reach, hit);
}
BOULE_INLINE void go_alone(const GeometryView& geometry, const Ray& ray, LoneRay& lone, bool& met) {
  met = (LoneRay::leaves_others(geometry) && meet_others<AnyHit<true>>(geometry, ray).done()) ||
        lone.find_any(lone.end());
}

/// Traces a ray as a LoneRay. Returns false if it cannot.
template <class Answer>
BOULE_INLINE bool try_alone(const GeometryView& geometry, const Ray& ray, Answer& answer) {
  if (!LoneRay::suits(geometry)) return false;
  LoneRay lone(geometry, ray);
  if (!lone.may()) return false;
  go_alone(geometry, ray, lone, answer);
  return true;
}
template <class Answer>
BOULE_INLINE bool try_alone(const PartsGeometry&, const Ray&, Answer&) {
  return false;
}

}  // namespace

template <class Geometry, class Answers>
void trace_alone(const Geometry& geometry, const RayStream& rays, Solver solver,
                 const Answers& answers) {
  for (std::size_t index = 0; index < rays.size; ++index) {
    typename BestOf<Answers>::One answer{};
    if (solver == Solver::robust && try_alone(geometry, get_ray(rays, index), answer)) {
      put(answers, index, answer);
      continue;
    }
    RayLanes ray;
    load_single(rays, index, ray);
    typename BestOf<Answers>::Single best(ray);
    search<OnePerLane>(ray, solver, geometry, best);
    store_single(best, answers, index);
  }
}

template <class Geometry, class Answers>
std::size_t trace_groups(const Geometry& geometry, const PaddedStream& stream, std::size_t begin,
                         std::size_t end, Solver solver, Form form, const Answers& answers) {
  std::size_t visits = 0;
  if (form != Form::single) visits += trace_pairs(geometry, stream, begin, end, solver, answers);
  for_each_group(
      stream, begin, end, form,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        typename BestOf<Answers>::Packet best(packet);
        visits += search<OneForAll>(packet, solver, geometry, best);
        store_packet(best, answers, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        typename BestOf<Answers>::Single best(ray);
        visits += search<OnePerLane>(ray, solver, geometry, best);
        store_single(best, answers, index);
      });
  return visits;
}

template <class Answer>
bool trace_ray(const GeometryView& geometry, const Ray& ray, Answer& answer) {
  return try_alone(geometry, ray, answer);
}

template bool trace_ray(const GeometryView&, const Ray&, Hit&);
template bool trace_ray(const GeometryView&, const Ray&, bool&);
template void trace_alone(const GeometryView&, const RayStream&, Solver, const HitStream&);
template void trace_alone(const GeometryView&, const RayStream&, Solver, std::uint8_t* const&);
template void trace_alone(const PartsGeometry&, const RayStream&, Solver, const HitStream&);
template void trace_alone(const PartsGeometry&, const RayStream&, Solver, std::uint8_t* const&);
template std::size_t trace_groups(const GeometryView&, const PaddedStream&, std::size_t,
                                  std::size_t, Solver, Form, const HitStream&);
template std::size_t trace_groups(const GeometryView&, const PaddedStream&, std::size_t,
                                  std::size_t, Solver, Form, std::uint8_t* const&);
template std::size_t trace_groups(const PartsGeometry&, const PaddedStream&, std::size_t,
                                  std::size_t, Solver, Form, const HitStream&);
template std::size_t trace_groups(const PartsGeometry&, const PaddedStream&, std::size_t,
                                  std::size_t, Solver, Form, std::uint8_t* const&);

}  // namespace boule::BOULE_KERNEL_ISA
