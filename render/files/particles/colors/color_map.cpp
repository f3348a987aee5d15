#include "render/files/particles/colors/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/base/text.h"
#include "render/files/file/nearest_name.h"
#include "render/files/particles/colors/color_map_samples.h"

namespace boule {
namespace {

constexpr std::string_view reverse = "_r";

std::uint8_t between(double a, double b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * part));
}

}  // namespace

ColorMap::ColorMap(NamedColorMap name) : is_diverging_(name == NamedColorMap::coolwarm) {
  for (const std::uint32_t rgb : samples_of(name)) {
    colors_.push_back({static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
                       static_cast<std::uint8_t>(rgb)});
  }
}

ColorMap::ColorMap(std::vector<SrgbColor> colors) : colors_(std::move(colors)) {}

ColorMap ColorMap::reversed() const {
  ColorMap other = *this;
  std::reverse(other.colors_.begin(), other.colors_.end());
  return other;
}

SrgbColor ColorMap::color(double at) const {
  const std::size_t steps = colors_.size() - 1;
  const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(steps);
  const auto below = static_cast<std::size_t>(place);
  if (below >= steps) return colors_.back();
  const SrgbColor &a = colors_[below], &b = colors_[below + 1];
  const double part = place - static_cast<double>(below);
  return {between(a.r, b.r, part), between(a.g, b.g, part), between(a.b, b.b, part)};
}

std::optional<ColorMap> named_color_map(std::string_view text) {
  std::string name = ascii_lower(text);
  const bool is_reversed = name.ends_with(reverse);
  if (is_reversed) name.resize(name.size() - reverse.size());
  const auto& known = names<NamedColorMap>;
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) return std::nullopt;
  const ColorMap map(static_cast<NamedColorMap>(found - known.begin()));
  return is_reversed ? map.reversed() : map;
}

std::string did_you_mean_map(std::string_view text) {
  std::vector<std::string> all(names<NamedColorMap>.begin(), names<NamedColorMap>.end());
  for (const std::string_view name : names<NamedColorMap>)
    all.push_back(std::string(name) + std::string(reverse));
  return did_you_mean(ascii_lower(text), {all.begin(), all.end()});
}

}  // namespace boule
