#pragma once

#include <cstddef>

#include "core/math/number.h"
#include "core/optics/camera_view.h"

namespace boule {

/// A point of the raster: (0, 0) is the top left corner, pixel (i, j) has its centre at
/// (i + 0.5, j + 0.5).
template <class T>
struct RasterPointOf {
  T x, y;
};

/// A point of the film, each coordinate about -1 .. 1, y upward.
template <class T>
struct FilmPointOf {
  T x, y;
};

/// For look_up(): the four pixels of an ST map around a point. Input: x and y of the point, in
/// pixels from the first pixel's centre. Output: the distance of the point to the right of the
/// pixels on its left, and below those above it, in pixels (outside 0 .. 1 beyond the map's rim);
/// then the four s and then the four t, row by row.
struct MapCorners {
  const DistortionView& map;

  BOULE_INLINE void operator()(SpacedNumbers point, SpacedNumbers found) const {
    const int column = first_of_two(point[0], map.width), row = first_of_two(point[1], map.height);
    found[0] = point[0] - column;
    found[1] = point[1] - row;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t pixel =
          (static_cast<std::size_t>(row) + corner / 2) * static_cast<std::size_t>(map.width) +
          static_cast<std::size_t>(column) + corner % 2;
      found[2 + corner] = static_cast<double>(map.st[2 * pixel]);
      found[6 + corner] = static_cast<double>(map.st[2 * pixel + 1]);
    }
  }

  /// The first of the two pixels, of `count` in a row, between whose centres x lies; beyond the
  /// first and the last pixel the two nearest.
  BOULE_INLINE static int first_of_two(double x, int count) {
    const int last = count - 2;
    return x < 0 ? 0 : x < last ? static_cast<int>(x) : last;
  }
};

/// Bilinear between four corners, given row by row.
template <class T>
BOULE_INLINE T blend(const T* corners, const T& right, const T& down) {
  const T top = corners[0] + (corners[1] - corners[0]) * right;
  const T bottom = corners[2] + (corners[3] - corners[2]) * right;
  return top + (bottom - top) * down;
}

/// The point to which the camera's ST map moves a raster point: (s extent_x, (1 - t) extent_y).
template <class T>
BOULE_INLINE RasterPointOf<T> distort(const CameraView& camera, const RasterPointOf<T>& raster) {
  const DistortionView& map = camera.distortion;
  const T width(camera.film_x.extent), height(camera.film_y.extent);
  const Numbers<T, 2> in_map{{raster.x / width * T(static_cast<double>(map.width)) - T(0.5),
                              raster.y / height * T(static_cast<double>(map.height)) - T(0.5)}};
  const Numbers<T, 10> found = look_up<10>(in_map, MapCorners{map});
  const T& right = found.at[0];
  const T& down = found.at[1];
  return {blend(found.at + 2, right, down) * width,
          (T(1.0) - blend(found.at + 6, right, down)) * height};
}

template <class T>
BOULE_INLINE T film_coordinate(const RasterToFilm& map, const T& raster) {
  return (raster * T(map.scale) + T(map.offset)) / T(map.extent);
}

/// The point of the film for a raster point.
template <class T>
BOULE_INLINE FilmPointOf<T> film_point(const CameraView& camera, const RasterPointOf<T>& asked) {
  const RasterPointOf<T> raster = camera.distortion.st != nullptr ? distort(camera, asked) : asked;
  return {film_coordinate(camera.film_x, raster.x), film_coordinate(camera.film_y, raster.y)};
}

}  // namespace boule
