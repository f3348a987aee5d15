#pragma once

#include <cstdint>

#include "core/math/sobol.h"
#include "core/scene/scene.h"

namespace boule {

/// A place on the image plane, in raster coordinates: pixel (i, j) covers [i, i+1) x [j, j+1).
struct RasterPoint {
  double x, y;
};

/// A place on a lens, 0 .. 1 each; (0.5, 0.5) is its centre.
struct LensPoint {
  double x, y;
};

/// Where a pixel is sampled (lecture "Sampling"): one sample at the centre, or any number of them
/// spread evenly, as sobol_pair() says, whenever one stops. The filter shapes where they lie, not
/// what they count, so a sample is of one pixel only (Ernst, Stamminger, Greiner, "Filter
/// importance sampling", 2006): box: all over the pixel; tent: up to a pixel's width from its
/// centre, the less likely the further. Depends on pixel, sample, seed and filter only, but for a
/// single sample.
class Sampler {
 public:
  /// spp: samples per pixel in all, >= 1.
  Sampler(int spp, std::uint64_t seed, PixelFilter filter = PixelFilter::box)
      : single_(spp == 1), keys_(seed), filter_(filter) {}

  /// The place of sample 0 <= sample < spp of pixel (x, y).
  [[nodiscard]] RasterPoint position(int x, int y, int sample) const;

  /// The place on the lens of the same sample; a single one passes through its centre.
  [[nodiscard]] LensPoint lens_position(int x, int y, int sample) const;

 private:
  bool single_;
  PixelKeys keys_;
  PixelFilter filter_;
};

}  // namespace boule
