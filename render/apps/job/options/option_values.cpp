#include "render/apps/job/options/option_values.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "core/math/color_names.h"
#include "core/scene/scene.h"
#include "render/files/file/nearest_name.h"

namespace boule {
namespace {

/// The switch that an AOV's name stands for, or null.
bool* find_aov(AovSelection& aovs, const std::string& name) {
  for (const AovName& aov : aov_names) {
    if (name == aov.name) return &(aovs.*aov.wanted);
  }
  return nullptr;
}

struct Unit {
  std::string_view name;
  double size;
};

/// A number with one of these units behind it: above 0, `most` at most.
std::optional<double> parse_measure(const std::string& text, std::initializer_list<Unit> units,
                                    double most) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = parse_number(text.substr(0, digits), 0.0, 1e9);
  const auto* const unit = std::find_if(
      units.begin(), units.end(), [&](const Unit& one) { return text.substr(digits) == one.name; });
  if (!number || unit == units.end()) return std::nullopt;
  const double measure = *number * unit->size;
  return measure > 0 && measure <= most ? std::optional(measure) : std::nullopt;
}

}  // namespace

std::optional<std::vector<int>> split_numbers(const std::string& text, char separator,
                                              std::size_t count, int low, int high) {
  std::vector<int> numbers;
  for (const std::string& part : split(text, separator)) {
    const auto number = parse_number(part, low, high);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<FrameRange> parse_frames(const std::string& text) {
  constexpr int last_frame = 999'999'999;
  if (const auto one = parse_number(text, 0, last_frame)) return FrameRange{*one, *one};
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto ends = split_numbers(text.substr(0, colon), '-', 2, 0, last_frame);
  if (!ends || (*ends)[0] > (*ends)[1]) return std::nullopt;
  if (colon == text.size()) return FrameRange{(*ends)[0], (*ends)[1]};
  const auto step = parse_number(text.substr(colon + 1), 1, last_frame);
  if (!step) return std::nullopt;
  return FrameRange{(*ends)[0], (*ends)[1], *step};
}

std::optional<Size> parse_size(const std::string& text) {
  const char cross = text.find('X') == std::string::npos ? 'x' : 'X';
  const auto sides = split_numbers(text, cross, 2, 1, max_image_side);
  if (!sides) return std::nullopt;
  return Size{(*sides)[0], (*sides)[1]};
}

std::optional<double> parse_length(const std::string& text) {
  return parse_measure(text, {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}}, 1e5);
}

std::optional<OutlineWidth> parse_outline(const std::string& text) {
  const bool in_points = text.ends_with("pt");
  const auto width = parse_number(text.substr(0, text.size() - (in_points ? 2 : 0)), 0.0F, 100.0F);
  return width ? std::optional(OutlineWidth{*width, in_points}) : std::nullopt;
}

std::optional<PixelRect> parse_crop(const std::string& text) {
  const auto corners = split_numbers(text, ',', 4, 0, max_image_side);
  if (!corners) return std::nullopt;
  const PixelRect rect{(*corners)[0], (*corners)[1], (*corners)[2], (*corners)[3]};
  return rect.empty() ? std::nullopt : std::optional(rect);
}

std::optional<AovSelection> parse_aovs(const std::string& text) {
  AovSelection aovs;
  for (const std::string& name : split(text, ',')) {
    bool* const aov = find_aov(aovs, name);
    if (aov == nullptr || *aov) return std::nullopt;
    *aov = true;
  }
  return aovs;
}

std::string list_aovs() {
  std::vector<std::string_view> names;
  for (const AovName& aov : aov_names) names.emplace_back(aov.name);
  return joined(names, ",");
}

std::optional<double> parse_duration(const std::string& text) {
  return parse_measure(text, {{"", 1}, {"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}}, 1e9);
}

std::optional<BackgroundChoice> parse_background(const std::string& text) {
  if (text == "transparent") return BackgroundChoice{};
  const auto color = parse_color(text);
  return color ? std::optional(BackgroundChoice{color}) : std::nullopt;
}

std::string hint_background(const std::string& text) {
  std::vector<std::string_view> known = color_names();
  known.emplace_back("transparent");
  return did_you_mean(ascii_lower(text), known);
}

std::optional<std::uint64_t> parse_bytes(const std::string& text) {
  constexpr std::uint64_t least = std::uint64_t{16} << 20, most = std::uint64_t{1} << 50;
  const std::string units = "KMGT";
  const std::size_t unit = text.empty() ? std::string::npos : units.find(text.back());
  const bool has_unit = unit != std::string::npos;
  const int shift = has_unit ? 10 * (static_cast<int>(unit) + 1) : 0;
  const auto number = parse_number<std::uint64_t>(text.substr(0, text.size() - (has_unit ? 1 : 0)),
                                                  1, most >> shift);
  if (!number || *number << shift < least) return std::nullopt;
  return *number << shift;
}

std::optional<std::uint64_t> parse_seed(const std::string& text) {
  return parse_number(text, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
}

std::optional<float> parse_shadow_epsilon(const std::string& text) {
  if (text == "none") return 0.0F;
  return parse_number(text, 0.0F, std::numeric_limits<float>::max());
}

}  // namespace boule
