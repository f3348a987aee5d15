#include "render/frame/sampler.h"

#include <cmath>

namespace boule {
namespace {

/// The inverse of the tent's cumulative distribution over -1 .. 1.
double tent(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

}  // namespace

RasterPoint Sampler::position(int x, int y, const UnitPair& numbers) const {
  const auto [u, v] = numbers;
  if (filter_ == PixelFilter::box) return {x + u, y + v};
  return {x + 0.5 + tent(u), y + 0.5 + tent(v)};
}

RasterPoint Sampler::position(const SampleId& id) const {
  const auto& [x, y, sample] = id;
  if (single_) return {x + 0.5, y + 0.5};
  return position(x, y,
                  sobol_pair(keys_.of(x, y), RandomSet::film, static_cast<std::uint32_t>(sample)));
}

}  // namespace boule
