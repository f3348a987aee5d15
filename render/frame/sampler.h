#pragma once

#include <cstdint>

#include "core/math/sobol.h"
#include "core/scene/scene.h"

namespace boule {

/// A place on the image plane, in raster coordinates: pixel (i, j) covers [i, i+1) x [j, j+1).
struct RasterPoint {
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
  /// spp: samples per pixel in all; 1: one at the centre. Nothing here throws or checks: any
  /// numbers will do.
  Sampler(int spp, std::uint64_t seed, PixelFilter filter = PixelFilter::box)
      : single_(spp == 1), keys_(seed), filter_(filter) {}

  /// One sample a pixel: it needs no numbers.
  [[nodiscard]] bool single() const { return single_; }

  /// What the numbers of pixel (x, y) depend on.
  [[nodiscard]] std::uint64_t key(int x, int y) const { return keys_.of(x, y); }

  /// The place in pixel (x, y) of a sample of several, by its numbers: those of RandomSet::film.
  [[nodiscard]] RasterPoint place(int x, int y, const UnitPair& numbers) const;

  /// The place of sample 0 <= sample < spp of pixel (x, y); others have places too.
  [[nodiscard]] RasterPoint position(int x, int y, int sample) const;

 private:
  bool single_;
  PixelKeys keys_;
  PixelFilter filter_;
};

}  // namespace boule
