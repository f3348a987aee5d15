#include "render/frame/live_passes.h"

#include <algorithm>

namespace boule {
namespace {

constexpr std::uint32_t random_slices = 16;

/// The number of passes until every pixel has its first sample; 0 for an order that has one pass.
std::size_t first_passes(PixelOrder order) {
  switch (order) {
    case PixelOrder::progressive:
      return LivePasses::coarse_passes;
    case PixelOrder::frameless:
      return random_slices;
    case PixelOrder::rows:
    case PixelOrder::tiles:
      break;
  }
  return 0;
}

}  // namespace

LivePasses::LivePasses(PixelOrder order, const PixelRect& rect, int spp)
    : order_(order), rect_(rect), spp_(std::max(spp, 1)) {}

std::size_t LivePasses::size() const {
  const std::size_t first = first_passes(order_);
  return first == 0 ? 1 : first + static_cast<std::size_t>(spp_) - 1;
}

LivePass LivePasses::operator[](std::size_t i) const {
  LivePass pass;
  pass.pick.x0 = rect_.x0;
  pass.pick.y0 = rect_.y0;
  const std::size_t first = first_passes(order_);
  if (first == 0) {
    pass.until = spp_;
    return pass;
  }
  if (i >= first) {
    pass.until = static_cast<int>(i - first) + 2;
    pass.share = static_cast<double>(pass.until) / spp_;
    return pass;
  }
  if (order_ == PixelOrder::progressive) {
    pass.pick.spacing = coarsest_spacing >> i;
    pass.share = 1.0 / (pass.pick.spacing * pass.pick.spacing) / spp_;
  } else {
    pass.pick.slices = random_slices;
    pass.pick.slice = static_cast<std::uint32_t>(i);
    pass.share = static_cast<double>(i + 1) / random_slices / spp_;
  }
  return pass;
}

std::size_t LivePasses::interchangeable() const {
  return order_ == PixelOrder::frameless ? random_slices : 1;
}

}  // namespace boule
