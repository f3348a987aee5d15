#pragma once

#include <cstdint>

namespace boule {

/// A place on the image plane, in raster coordinates: pixel (i, j) covers [i, i+1) x [j, j+1).
struct RasterPoint {
  double x, y;
};

/// Where a pixel is sampled (lecture "Sampling"): one sample at the centre, or any number n of
/// stratified ones. The n strata lie in round(sqrt(n)) rows of as even counts as can be, each row
/// as high as its share, so that all strata have the area 1/n. Depends on pixel, sample, n and
/// seed only.
class Sampler {
 public:
  /// spp: samples per pixel in all, >= 1.
  Sampler(int spp, std::uint64_t seed);

  /// The place of sample 0 <= sample < spp of pixel (x, y).
  [[nodiscard]] RasterPoint position(int x, int y, int sample) const;

 private:
  std::uint64_t seed_;
  std::uint64_t spp_, rows_;
  std::uint64_t stride_;  ///< coprime to spp: consecutive samples land far apart
};

}  // namespace boule
