#include "render/apps/job/options/look_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/math/color_names.h"
#include "core/math/geometry.h"
#include "render/apps/job/options/option_values.h"
#include "render/files/file/nearest_name.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/particles/colors/color_map.h"
#include "render/files/particles/particle_style.h"

namespace boule {
namespace {

constexpr double largest_number = std::numeric_limits<double>::max();

/// The `count` finite numbers, with commas between them, that the text consists of.
std::optional<std::vector<double>> parse_numbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto number = parse_number(part, -largest_number, largest_number);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

/// "KIND=VALUE" at the last "="; both empty where there is none.
KindText split_kind(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) return {};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// The kinds of a list, if all of its values are good.
template <class IsGood>
std::optional<std::vector<KindText>> parse_kinds(const std::string& text, const IsGood& is_good) {
  std::vector<KindText> kinds;
  for (const std::string& part : split(text, ',')) {
    KindText one = split_kind(part);
    const bool is_known = std::any_of(
        kinds.begin(), kinds.end(), [&](const KindText& other) { return other.kind == one.kind; });
    if (one.kind.empty() || is_known || !is_good(one.value)) return std::nullopt;
    kinds.push_back(std::move(one));
  }
  return kinds;
}

/// Of the first of these texts that is no colour.
std::string first_hint(const std::vector<std::string>& colors) {
  const auto wrong = std::find_if_not(colors.begin(), colors.end(),
                                      [](const std::string& one) { return parse_color(one); });
  return wrong == colors.end() ? std::string() : did_you_mean_color(*wrong);
}

/// "x<5" or "1,1,0>=2": a direction, < or >, and how far along it; the plane that leaves that.
std::optional<ClipChoice> parse_one_clip(std::string text) {
  std::erase(text, ' ');
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos) return std::nullopt;
  const std::size_t end = sign + (text.substr(sign + 1).starts_with('=') ? 2 : 1);
  const auto direction = parse_direction(text.substr(0, sign));
  const auto height = parse_number(text.substr(end), -largest_number, largest_number);
  if (!direction || !height) return std::nullopt;
  const Vec3d point = *direction * (*height / dot(*direction, *direction));
  return ClipChoice{point, text[sign] == '<' ? *direction : *direction * -1.0};
}

}  // namespace

std::optional<double> parse_above_0(const std::string& text) {
  return parse_number(text, std::numeric_limits<double>::min(), largest_number);
}

std::optional<std::string> parse_particle_format(const std::string& text) {
  const auto formats = particle_formats();
  const bool known = std::find(formats.begin(), formats.end(), text) != formats.end();
  return known ? std::optional(text) : std::nullopt;
}

std::string list_outline_rules() {
  return list_names({names<OutlineRule>.begin(), names<OutlineRule>.end()});
}

std::string list_particle_formats() { return list_names(particle_formats()); }

std::optional<std::string> parse_words(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::string> parse_svg_name(const std::string& text) {
  return text.ends_with(".svg") ? std::optional(text) : std::nullopt;
}

std::optional<std::vector<std::string>> parse_names(const std::string& text) {
  const std::vector<std::string> names = split(text, ',');
  const bool any_empty =
      std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); });
  return any_empty ? std::nullopt : std::optional(names);
}

std::optional<std::string> parse_radius(const std::string& text) {
  const bool is_number = parse_number(text, -HUGE_VAL, HUGE_VAL).has_value();
  return text.empty() || (is_number && !parse_above_0(text)) ? std::nullopt : std::optional(text);
}

std::optional<std::string> parse_bonds(const std::string& text) {
  const auto& rules = names<BondRule>;
  const bool is_rule = std::find(rules.begin(), rules.end(), text) != rules.end();
  return is_rule || parse_above_0(text) ? std::optional(text) : std::nullopt;
}

std::string list_bond_rules() { return joined(names<BondRule>, ", "); }

std::optional<std::vector<std::string>> parse_arrows(const std::string& text) {
  auto names = parse_names(text);
  return names && (names->size() == 1 || names->size() == 3) ? names : std::nullopt;
}

std::optional<std::string> parse_particle_color(const std::string& text) {
  const bool is_broken = text.starts_with('#') && !parse_hex_color(text);
  return text.empty() || is_broken ? std::nullopt : std::optional(text);
}

bool may_have_color_map(const std::string& color) {
  const bool is_kind = color == "element" || color == "species";
  return !color.empty() && !is_kind && !color.starts_with('#');
}

bool has_color_map(const std::string& color) {
  return may_have_color_map(color) && three_names(color).empty();
}

std::optional<std::string> parse_map(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  const bool are_colors = std::all_of(parts.begin(), parts.end(), [](const std::string& part) {
    return parse_color(part).has_value();
  });
  return named_color_map(text) || are_colors ? std::optional(text) : std::nullopt;
}

std::optional<std::string> parse_one_color(const std::string& text) {
  return parse_color(text) ? std::optional(text) : std::nullopt;
}

std::optional<std::vector<KindText>> parse_kind_colors(const std::string& text) {
  return parse_kinds(text, [](const std::string& value) { return parse_color(value).has_value(); });
}

std::optional<std::vector<KindText>> parse_kind_radii(const std::string& text) {
  return parse_kinds(text,
                     [](const std::string& value) { return parse_above_0(value).has_value(); });
}

std::optional<std::array<int, 3>> parse_replicate(const std::string& text) {
  const auto counts = split_numbers(text, 'x', 3, 1, std::numeric_limits<int>::max());
  if (!counts) return std::nullopt;
  return std::array{(*counts)[0], (*counts)[1], (*counts)[2]};
}

std::optional<std::vector<ClipChoice>> parse_clip(const std::string& text) {
  std::vector<ClipChoice> clips;
  for (const std::string& one : split(text, ';')) {
    const auto clip = parse_one_clip(one);
    if (!clip) return std::nullopt;
    clips.push_back(*clip);
  }
  return clips;
}

std::string hint_format(const std::string& text) { return did_you_mean(text, particle_formats()); }

std::string hint_bonds(const std::string& text) {
  return did_you_mean(text, {names<BondRule>.begin(), names<BondRule>.end()});
}

std::string hint_map(const std::string& text) {
  return text.find(',') == std::string::npos ? did_you_mean_map(text)
                                             : first_hint(split(text, ','));
}

std::string hint_color(const std::string& text) { return did_you_mean_color(text); }

std::string hint_kind_colors(const std::string& text) {
  std::vector<std::string> colors;
  for (const std::string& part : split(text, ',')) colors.push_back(split_kind(part).value);
  return first_hint(colors);
}

std::string list_color_maps() { return joined(names<NamedColorMap>, ", "); }

std::optional<std::array<double, 2>> parse_range(const std::string& text) {
  const auto ends = parse_numbers(text, 2);
  if (!ends || !((*ends)[0] < (*ends)[1])) return std::nullopt;
  return std::array{(*ends)[0], (*ends)[1]};
}

std::optional<Vec3d> parse_direction(const std::string& text) {
  const bool is_negative = text.starts_with('-');
  const std::string axis = text.substr(is_negative ? 1 : 0);
  const double sign = is_negative ? -1 : 1;
  if (axis == "x") return Vec3d{sign, 0, 0};
  if (axis == "y") return Vec3d{0, sign, 0};
  if (axis == "z") return Vec3d{0, 0, sign};
  if (text == "iso") return Vec3d{-1, -1, -1};
  const auto numbers = parse_numbers(text, 3);
  if (!numbers) return std::nullopt;
  const Vec3d v{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  // Cameras take vectors of floats: of those that are too long or too short, only the way counts.
  const double longest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(longest > 0)) return std::nullopt;
  const bool is_extreme = longest > 1e18 || longest < 1e-18;
  return is_extreme ? Vec3d{v.x / longest, v.y / longest, v.z / longest} : v;
}

std::optional<ViewChoice> parse_view(const std::string& text) {
  const auto& poses = names<FittedPose>;
  const auto pose = std::find(poses.begin(), poses.end(), text);
  if (pose != poses.end()) return ViewChoice{{}, static_cast<FittedPose>(pose - poses.begin())};
  const auto direction = parse_direction(text);
  return direction ? std::optional(ViewChoice{direction}) : std::nullopt;
}

std::string hint_view(const std::string& text) {
  std::vector<std::string_view> known(names<FittedPose>.begin(), names<FittedPose>.end());
  known.emplace_back("iso");
  return did_you_mean(text, known);
}

}  // namespace boule
