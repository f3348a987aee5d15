// Core and kernels alone, without the renderer.
#include <cstdio>

#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

int main() {
  const boule::Geometry geometry({{{0, 1, 0}, 1}}, {{{0, 0, 0}, {0, 1, 0}}});
  boule::RayBuffer rays(2);
  boule::HitBuffer hits(rays.size());
  rays.set(0, {{0, 1, 6}, {0, 0, -1}});
  rays.set(1, {{3, 2, 0}, {0, -4, 0}});
  const auto kernels = boule::select_kernels("auto");
  kernels.value()->closest_hit(geometry.view(), rays.view(), boule::Query{}, hits.view());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    std::printf("ray %zu: primitive %d at t = %g\n", i, hits.get(i).id, hits.get(i).t);
  }
}
