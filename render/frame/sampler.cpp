#include "render/frame/sampler.h"

#include <cmath>

namespace boule {
namespace {

/// The inverse of the tent's cumulative distribution over -1 .. 1.
double tent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

}  // namespace

RasterPoint Sampler::position(int x, int y, int sample) const {
  if (single_) return {x + 0.5, y + 0.5};
  const auto [u, v] =
      sobol_pair(keys_.of(x, y), RandomSet::film, static_cast<std::uint32_t>(sample));
  if (filter_ == PixelFilter::box) return {x + u, y + v};
  return {x + 0.5 + tent(u), y + 0.5 + tent(v)};
}

LensPoint Sampler::lens_position(int x, int y, int sample) const {
  if (single_) return {0.5, 0.5};
  const auto [u, v] =
      sobol_pair(keys_.of(x, y), RandomSet::lens, static_cast<std::uint32_t>(sample));
  return {u, v};
}

}  // namespace boule
