#include "render/files/scene_file/toml/lens_file.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/problem_finder.h"
#include "render/files/file/float32.h"
#include "render/files/file/input_file.h"

namespace boule {
namespace {

constexpr std::string_view blanks = " \t\r";

/// The next word of a line, which loses it; empty at the end.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

std::optional<float> number_of(std::string_view word) {
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return to_float32(number);
}

/// The surface of a line, which has the fields in the order of their list; nothing if it has
/// others.
std::optional<LensSurface> surface_of(std::string_view line) {
  LensSurface surface;
  bool has_numbers = true;
  each_field(surface, [&](const auto&, float& out) {
    const auto number = number_of(take_word(line));
    has_numbers = has_numbers && number;
    out = number.value_or(0);
  });
  surface.index = air_if_none(surface.index);
  return has_numbers && take_word(line).empty() ? std::optional(surface) : std::nullopt;
}

/// What is wrong with a surface, beside the last one.
std::optional<std::string> fault_of(const LensSurface& surface, const LensSurface& last) {
  if (const auto bad = first_problem(surface)) return bad->field + " " + bad->message;
  const bool narrow = double{surface.aperture} < least_width * double{last.aperture};
  return narrow ? std::optional<std::string>("aperture is less than a 500th of the last one's")
                : std::nullopt;
}

}  // namespace

Result<std::vector<LensSurface>> read_lens(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return text.error();
  std::vector<LensSurface> surfaces;
  std::vector<int> lines;
  std::string_view rest = text.value();
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(blanks) == std::string_view::npos) continue;
    const auto surface = surface_of(line);
    if (!surface) {
      return Diagnostic{.message = "expected four numbers: radius, thickness, index, diameter",
                        .file = path,
                        .line = number};
    }
    surfaces.push_back(*surface);
    lines.push_back(number);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (const auto fault = fault_of(surfaces[i], surfaces.back())) {
      return Diagnostic{.message = "surface " + std::to_string(i + 1) + ": its " + *fault,
                        .file = path,
                        .line = lines[i]};
    }
  }
  return surfaces;
}

}  // namespace boule
