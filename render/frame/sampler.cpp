#include "render/frame/sampler.h"

#include <cmath>
#include <numeric>

#include "core/math/random.h"

namespace boule {
namespace {

/// About 0.618 n and coprime to n: multiples of it modulo n visit everything, evenly early on, so
/// a picture stopped half way is not sampled in the upper halves of its pixels only.
std::uint64_t golden_stride(std::uint64_t n) {
  auto stride = static_cast<std::uint64_t>(static_cast<double>(n) * 0.6180339887498949);
  if (stride == 0) stride = 1;
  while (std::gcd(stride, n) != 1) ++stride;
  return stride;
}

}  // namespace

Sampler::Sampler(int spp, std::uint64_t seed)
    : seed_(seed),
      spp_(static_cast<std::uint64_t>(spp)),
      rows_(static_cast<std::uint64_t>(std::sqrt(static_cast<double>(spp)) + 0.5)),
      stride_(golden_stride(spp_)) {}

RasterPoint Sampler::position(int x, int y, int sample) const {
  if (spp_ == 1) return {x + 0.5, y + 0.5};
  const auto s = static_cast<std::uint64_t>(sample);
  const std::uint64_t stratum = s * stride_ % spp_;
  // Row k holds the strata floor(nk/m) .. floor(n(k+1)/m) - 1.
  const std::uint64_t row = ((stratum + 1) * rows_ - 1) / spp_;
  const std::uint64_t first = spp_ * row / rows_, end = spp_ * (row + 1) / rows_;
  const auto in_row = static_cast<double>(end - first);
  const auto jitter = random4(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                              static_cast<std::uint32_t>(sample), 0, seed_);
  const double across = (static_cast<double>(stratum - first) + jitter[0]) / in_row;
  const double down = (static_cast<double>(first) + in_row * jitter[1]) / static_cast<double>(spp_);
  return {x + across, y + down};
}

}  // namespace boule
