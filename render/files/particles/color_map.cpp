#include "render/files/particles/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "render/files/particles/color_map_samples.h"

namespace boule {
namespace {

std::uint8_t between(double a, double b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * part));
}

}  // namespace

ColorMap::ColorMap(NamedColorMap name) {
  for (const std::uint32_t rgb : samples_of(name)) {
    colors_.push_back({static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
                       static_cast<std::uint8_t>(rgb)});
  }
}

ColorMap::ColorMap(std::vector<SrgbColor> colors) : colors_(std::move(colors)) {}

SrgbColor ColorMap::color(double at) const {
  const std::size_t steps = colors_.size() - 1;
  const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(steps);
  const auto below = static_cast<std::size_t>(place);
  if (below >= steps) return colors_.back();
  const SrgbColor &a = colors_[below], &b = colors_[below + 1];
  const double part = place - static_cast<double>(below);
  return {between(a.r, b.r, part), between(a.g, b.g, part), between(a.b, b.b, part)};
}

}  // namespace boule
