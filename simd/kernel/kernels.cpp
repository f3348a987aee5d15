// Compiled once per instruction set (simd/isa.cmake), each time into a namespace of its own.
#include "simd/abi/kernel_table.h"
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

/// The last packet of a stream, its dead lanes filled with copies of the last live ray: they can
/// neither change nor slow down the others.
struct TailPacket {
  alignas(64) double org_x[lanes], org_y[lanes], org_z[lanes];
  alignas(64) float dir_x[lanes], dir_y[lanes], dir_z[lanes], tmin[lanes], tmax[lanes];
  alignas(64) std::int32_t source[lanes];
  alignas(64) std::uint8_t inside[lanes];

  TailPacket(const RayStream& rays, std::size_t first) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t i = first + lane < rays.size ? first + lane : rays.size - 1;
      org_x[lane] = rays.org_x[i];
      org_y[lane] = rays.org_y[i];
      org_z[lane] = rays.org_z[i];
      dir_x[lane] = rays.dir_x[i];
      dir_y[lane] = rays.dir_y[i];
      dir_z[lane] = rays.dir_z[i];
      tmin[lane] = rays.tmin[i];
      tmax[lane] = rays.tmax[i];
      source[lane] = rays.source[i];
      inside[lane] = rays.inside[i];
    }
  }
  RayStream view() {
    return {org_x, org_y, org_z, dir_x, dir_y, dir_z, tmin, tmax, source, inside, lanes};
  }
};

/// Calls packet(rays, first, live lanes) and single(rays, index) so as to cover the stream.
template <class Packet, class Single>
void for_each_group(const RayStream& rays, Form form, const Packet& packet, const Single& single) {
  std::size_t first = 0;
  while (first < rays.size) {
    const std::size_t remaining = rays.size - first;
    if (goes_single(form, remaining)) {
      single(load_single(rays, first), first);
      ++first;
    } else if (remaining >= lanes) {
      packet(load_packet(rays, first), first, lanes);
      first += lanes;
    } else {
      TailPacket tail(rays, first);
      packet(load_packet(tail.view(), 0), first, remaining);
      first += remaining;
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
void closest_hit_with(const GeometryView& geometry, const RayStream& rays, Form form,
                      const HitStream& hits) {
  for_each_group(
      rays, form,
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
void any_hit_with(const GeometryView& geometry, const RayStream& rays, Form form,
                  std::uint8_t* occluded) {
  for_each_group(
      rays, form,
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

void closest_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                 const HitStream& hits) {
  if (query.solver == Solver::fast) {
    closest_hit_with<Solver::fast>(geometry, rays, query.form, hits);
  } else {
    closest_hit_with<Solver::robust>(geometry, rays, query.form, hits);
  }
}

void any_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
             std::uint8_t* occluded) {
  if (query.solver == Solver::fast) {
    any_hit_with<Solver::fast>(geometry, rays, query.form, occluded);
  } else {
    any_hit_with<Solver::robust>(geometry, rays, query.form, occluded);
  }
}

void camera_rays(const CameraView& camera, const SampleStream& samples, const RayStream& rays) {
  primary_rays(camera, samples, rays);
}

}  // namespace

extern const KernelTable kernel_table;
const KernelTable kernel_table = {Isa::BOULE_KERNEL_ISA, width, camera_rays, closest_hit, any_hit};

}  // namespace boule::BOULE_KERNEL_ISA
