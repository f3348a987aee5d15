#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/textbook/book_arrays.h"
#include "core/scene/primitive.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {

/// n random spheres in the unit cube, or n random planes, and 1024 camera rays, in packets, from
/// the eye (0.5, 0.5, -1.2) across 25.61 degrees. sparse: a sphere covers 1e-4 of the picture;
/// ordinary: the spheres cover it four times over; every: each test survives the reject.
struct BenchData {
  BenchData(const std::string& kind, std::size_t n);

  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Geometry geometry;
  RayBuffer rays;
  HitBuffer hits;
  BookArrays book;  ///< the same for the solvers of textbooks
};

/// The data of one experiment, made once and kept. `kind`: sparse, ordinary, every, planes.
BenchData& bench_data(const std::string& kind, std::size_t n);

}  // namespace boule::bench
