// Compiled once per instruction set (simd/isa.cmake), each time into a namespace of its own.
#include "simd/abi/kernel_table.h"
#include "simd/kernel/bundle.h"
#include "simd/kernel/padded_stream.h"
#include "simd/kernel/primary_rays.h"
#include "simd/kernel/traverse.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

constexpr auto lanes = static_cast<std::size_t>(width);

/// Rays of a stream's end that fill half a packet or less go one by one.
bool goes_single(Form form, std::size_t remaining) {
  if (form == Form::automatic) return remaining <= lanes / 2;
  return form == Form::single;
}

/// Calls packet(rays, first, live lanes) and single(rays, index) so as to cover rays begin .. end,
/// `begin` a multiple of W.
template <class Packet, class Single>
void for_each_group(const PaddedStream& stream, std::size_t begin, std::size_t end, Form form,
                    const Packet& packet, const Single& single) {
  std::size_t first = begin;
  while (first < end) {
    if (goes_single(form, end - first)) {
      single(load_single(stream.rays(), first), first);
      ++first;
    } else {
      const PacketPlace place = stream.packet(first);
      packet(load_packet(*place.rays, place.first), first, stream.live(first));
      first += lanes;
    }
  }
}

void store_packet(const ClosestHit& best, const HitStream& hits, std::size_t first,
                  std::size_t live) {
  alignas(64) double t[lanes], id[lanes];
  store(t, best.t);
  store(id, best.id);
  for (std::size_t lane = 0; lane < live; ++lane) {
    hits.t[first + lane] = t[lane];
    hits.id[first + lane] = static_cast<std::int32_t>(id[lane]);
  }
}

/// One ray's hit is the nearest over the lanes; equal t: the lower id.
void store_single(const ClosestHit& best, const HitStream& hits, std::size_t index) {
  alignas(64) double t[lanes], id[lanes];
  store(t, best.t);
  store(id, best.id);
  std::size_t nearest = 0;
  for (std::size_t lane = 1; lane < lanes; ++lane) {
    const bool tie = t[lane] == t[nearest] && id[lane] < id[nearest];
    if (t[lane] < t[nearest] || tie) nearest = lane;
  }
  hits.t[index] = t[nearest];
  hits.id[index] = static_cast<std::int32_t>(id[nearest]);
}

template <Solver solver>
void closest_hit_with(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                      std::size_t end, Form form, const HitStream& hits) {
  for_each_group(
      stream, begin, end, form,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        ClosestHit best(packet);
        search<solver, OneForAll>(packet, geometry, best);
        store_packet(best, hits, first, live);
      },
      [&](const RayLanes& ray, std::size_t index) {
        ClosestHit best(ray);
        search<solver, OnePerLane>(ray, geometry, best);
        store_single(best, hits, index);
      });
}

template <Solver solver>
void any_hit_with(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                  std::size_t end, Form form, std::uint8_t* occluded) {
  for_each_group(
      stream, begin, end, form,
      [&](const RayLanes& packet, std::size_t first, std::size_t live) {
        AnyHit<false> best(packet);
        search<solver, OneForAll>(packet, geometry, best);
        for (std::size_t lane = 0; lane < live; ++lane) {
          occluded[first + lane] = static_cast<std::uint8_t>((best.hit >> lane) & 1U);
        }
      },
      [&](const RayLanes& ray, std::size_t index) {
        AnyHit<true> best(ray);
        search<solver, OnePerLane>(ray, geometry, best);
        occluded[index] = best.hit != 0 ? 1 : 0;
      });
}

/// What does not fit into bundles goes as packets.
void trace_rest(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                std::size_t end, const HitStream& hits) {
  closest_hit_with<Solver::robust>(geometry, stream, begin, end, Form::automatic, hits);
}
void trace_rest(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                std::size_t end, std::uint8_t* occluded) {
  any_hit_with<Solver::robust>(geometry, stream, begin, end, Form::automatic, occluded);
}

/// Rays begin .. end, at most a bundle, as bundles: halved until they fit.
template <Common common, class Answers>
void trace_bundled(const GeometryView& geometry, const PaddedStream& stream, std::size_t begin,
                   std::size_t end, const Answers& answers) {
  constexpr std::size_t fewest = 32;
  const std::size_t count = end - begin;
  if (count < fewest) {
    trace_rest(geometry, stream, begin, end, answers);
  } else if (!trace_bundle<common>(geometry, stream, begin, count, answers)) {
    const std::size_t middle = begin + (count / 2 + max_width - 1) / max_width * max_width;
    trace_bundled<common>(geometry, stream, begin, middle, answers);
    trace_bundled<common>(geometry, stream, middle, end, answers);
  }
}

/// All rays, bundle by bundle.
template <Common common, class Answers>
void trace_bundled(const GeometryView& geometry, const PaddedStream& stream,
                   const Answers& answers) {
  const std::size_t size = stream.rays().size;
  for (std::size_t begin = 0; begin < size; begin += bundle_size) {
    const std::size_t end = size - begin < bundle_size ? size : begin + bundle_size;
    trace_bundled<common>(geometry, stream, begin, end, answers);
  }
}

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                 const HitStream& hits) {
  const PaddedStream stream(rays);
  const bool bundled = query.form == Form::automatic;
  if (bundled && query.coherence == Coherence::common_origin) {
    trace_bundled<Common::origin>(geometry, stream, hits);
  } else if (bundled && query.coherence == Coherence::common_direction) {
    trace_bundled<Common::direction>(geometry, stream, hits);
  } else if (query.solver == Solver::fast) {
    closest_hit_with<Solver::fast>(geometry, stream, 0, rays.size, query.form, hits);
  } else {
    closest_hit_with<Solver::robust>(geometry, stream, 0, rays.size, query.form, hits);
  }
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
             std::uint8_t* occluded) {
  const PaddedStream stream(rays);
  const bool bundled = query.form == Form::automatic;
  if (bundled && query.coherence == Coherence::common_origin) {
    trace_bundled<Common::origin>(geometry, stream, occluded);
  } else if (bundled && query.coherence == Coherence::common_direction) {
    trace_bundled<Common::direction>(geometry, stream, occluded);
  } else if (bundled && query.coherence == Coherence::common_end) {
    trace_bundled<Common::end>(geometry, stream, occluded);
  } else if (query.solver == Solver::fast) {
    any_hit_with<Solver::fast>(geometry, stream, 0, rays.size, query.form, occluded);
  } else {
    any_hit_with<Solver::robust>(geometry, stream, 0, rays.size, query.form, occluded);
  }
}

void camera_rays(const CameraView& camera, const SampleStream& samples, const RayStream& rays) {
  primary_rays(camera, samples, rays);
}

}  // namespace

extern const KernelTable kernel_table;
const KernelTable kernel_table = {Isa::BOULE_KERNEL_ISA, width, camera_rays, closest_hit, any_hit};

}  // namespace boule::BOULE_KERNEL_ISA
