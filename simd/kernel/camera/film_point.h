#pragma once

#include <cstddef>

#include "simd/abi/camera.h"
#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

namespace boule::BOULE_KERNEL_ISA {

/// Places on the film, each coordinate about -1 .. 1, y upward.
struct FilmPoint {
  Wide x, y;
};

/// A pixel's place in a row or column of a map, and how far behind its centre a point lies: outside
/// 0 .. 1 beyond the first and the last one.
struct MapCell {
  int first;
  double beyond;
};

BOULE_INLINE MapCell map_cell(double place, int count) {
  const int last = count - 2;
  const int first = place < 0 ? 0 : place < last ? static_cast<int>(place) : last;
  return {first, place - first};
}

/// W numbers at the four pixels around a point: [row][column].
struct MapCorners {
  double at[2][2][width];

  /// Between them.
  [[nodiscard]] BOULE_INLINE Wide blend(Wide x, Wide y) const {
    const Wide top = load(at[0][0]) + (load(at[0][1]) - load(at[0][0])) * x;
    const Wide bottom = load(at[1][0]) + (load(at[1][1]) - load(at[1][0])) * x;
    return top + (bottom - top) * y;
  }
};

/// Moves W raster points to where the camera's ST map says.
BOULE_INLINE void distort(const CameraView& camera, Wide& raster_x, Wide& raster_y) {
  alignas(64) double x[width], y[width];
  alignas(64) MapCorners s, t;
  store(x, raster_x / Wide(camera.extent_x) * Wide(camera.map_width) - Wide(0.5));
  store(y, raster_y / Wide(camera.extent_y) * Wide(camera.map_height) - Wide(0.5));
  for (int lane = 0; lane < width; ++lane) {
    const MapCell column = map_cell(x[lane], camera.map_width);
    const MapCell row = map_cell(y[lane], camera.map_height);
    for (int corner = 0; corner < 4; ++corner) {
      const int down = corner / 2, right = corner % 2;
      const std::size_t pixel =
          static_cast<std::size_t>(row.first + down) * static_cast<std::size_t>(camera.map_width) +
          static_cast<std::size_t>(column.first + right);
      s.at[down][right][lane] = static_cast<double>(camera.map[2 * pixel]);
      t.at[down][right][lane] = static_cast<double>(camera.map[2 * pixel + 1]);
    }
    x[lane] = column.beyond;
    y[lane] = row.beyond;
  }
  raster_x = s.blend(load(x), load(y)) * Wide(camera.extent_x);
  raster_y = (Wide(1.0) - t.blend(load(x), load(y))) * Wide(camera.extent_y);
}

/// Where W samples, from `first` on, lie on the film.
BOULE_INLINE FilmPoint film_point(const CameraView& camera, const SampleStream& samples,
                                  std::size_t first) {
  Wide raster_x = load(samples.raster_x + first), raster_y = load(samples.raster_y + first);
  if (camera.map != nullptr) distort(camera, raster_x, raster_y);
  return {(raster_x * Wide(camera.scale_x) + Wide(camera.offset_x)) / Wide(camera.extent_x),
          (raster_y * Wide(camera.scale_y) + Wide(camera.offset_y)) / Wide(camera.extent_y)};
}

}  // namespace boule::BOULE_KERNEL_ISA
