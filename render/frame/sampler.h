#pragma once

#include <cstdint>

#include "core/math/sample_id.h"
#include "core/math/sobol.h"
#include "core/scene/scene.h"

namespace boule {

/// A point of the image plane in raster coordinates: pixel (i, j) covers [i, i+1) x [j, j+1).
struct RasterPoint {
  double x, y;
};

/// The positions of samples in a pixel (lecture "Sampling"). A single sample lies at the centre;
/// several are spread evenly by sobol_pair(), after any number of them. The filter sets the density
/// of samples, and all samples count the same, so each belongs to one pixel (Ernst, Stamminger,
/// Greiner, "Filter importance sampling", 2006).
/// - box: uniform over the pixel.
/// - tent: up to a pixel's width from the centre, with a density that falls with the distance.
///
/// A position depends on pixel, sample, seed and filter, and on whether there is one sample or
/// more.
class Sampler {
 public:
  /// `spp`: number of samples per pixel. Takes any values, as do the functions below.
  Sampler(int spp, std::uint64_t seed, PixelFilter filter = PixelFilter::box)
      : single_(spp == 1), keys_(seed), filter_(filter) {}

  /// True if there is one sample per pixel, which needs no random numbers.
  [[nodiscard]] bool single() const { return single_; }

  /// The key of pixel (x, y) for its random numbers.
  [[nodiscard]] std::uint64_t key(int x, int y) const { return keys_.of(x, y); }

  /// The position of one of several samples of pixel (x, y), from its numbers of RandomSet::film.
  [[nodiscard]] RasterPoint position(int x, int y, const UnitPair& numbers) const;

  /// The position of a sample.
  [[nodiscard]] RasterPoint position(const SampleId& id) const;

 private:
  bool single_;
  PixelKeys keys_;
  PixelFilter filter_;
};

}  // namespace boule
