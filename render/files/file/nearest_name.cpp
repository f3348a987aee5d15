#include "render/files/file/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/color_names.h"

namespace boule {
namespace {

/// Longer names are not compared: they are no slips of the keyboard, and the time is quadratic.
constexpr std::size_t longest_name = 64;

/// Restricted Damerau-Levenshtein distance: insert, delete, replace, swap of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& known) {
  if (name.size() > longest_name) return "";
  std::size_t nearest = std::max<std::size_t>(1, name.size() / 3) + 1;
  std::string_view suggestion;
  for (const std::string_view candidate : known) {
    if (candidate.size() > longest_name) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= nearest || distance >= candidate.size()) continue;
    nearest = distance;
    suggestion = candidate;
  }
  if (suggestion.empty()) return "";
  return "; did you mean " + quote(suggestion) + "?";
}

std::string did_you_mean_color(std::string_view name) {
  return did_you_mean(ascii_lower(name), color_names());
}

std::string no_color(std::string_view text) {
  return quote(text) + " is no colour, expected \"#rrggbb\" or a name of CSS" +
         did_you_mean_color(text);
}

std::string list_names(const std::vector<std::string_view>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
    list += quote(names[i]);
  }
  return list;
}

std::string safe_name(std::string_view name) { return printable(name, 40); }

}  // namespace boule
