#include "render/files/particles/particle_choices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/number_text.h"
#include "render/files/particles/colors/species_palette.h"

namespace boule {
namespace {

/// Doubles are whole numbers that can be told apart up to here.
constexpr double largest_whole = 0x1p53;

bool is_whole(double number) {
  return std::fabs(number) <= largest_whole && number == std::nearbyint(number);
}

bool is_named_for_kinds(const std::string& column) {
  const std::string name = ascii_lower(std::string_view(column));
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  return has("type") || has("mol") || has("cluster");
}

/// Adds a number to a list in order, unless it is there.
void insert(double number, std::vector<double>& numbers) {
  const auto place = std::lower_bound(numbers.begin(), numbers.end(), number);
  if (place == numbers.end() || *place != number) numbers.insert(place, number);
}

/// The smallest box around two boxes.
std::array<Vec3d, 2> joined(const std::array<Vec3d, 2>& a, const std::array<Vec3d, 2>& b) {
  return {Vec3d{std::min(a[0].x, b[0].x), std::min(a[0].y, b[0].y), std::min(a[0].z, b[0].z)},
          Vec3d{std::max(a[1].x, b[1].x), std::max(a[1].y, b[1].y), std::max(a[1].z, b[1].z)}};
}

void add_names(const std::vector<std::string>& more, std::vector<std::string>& names) {
  for (const std::string& name : more) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
}

/// Those that are new come last; what was not shown before has the count of the frame that shows
/// it.
void add_kinds(const std::vector<ParticleColors::Species>& more,
               std::vector<ParticleColors::Species>& kinds) {
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < kinds.size(); ++i) places.emplace(kinds[i].name, i);
  for (const ParticleColors::Species& one : more) {
    const auto [known, is_new] = places.try_emplace(one.name, kinds.size());
    if (is_new) {
      kinds.push_back(one);
    } else if (kinds[known->second].count == 0) {
      kinds[known->second].count = one.count;
    }
  }
}

}  // namespace

void ParticleChoices::add(const ParticleChoices& frame) {
  if (frame.particles > 0 || frame.distance) {
    const bool is_first = particles == 0 && !distance;
    const bool same = frame.distance == distance &&
                      frame.most_are_elements() == most_are_elements() &&
                      frame.are_ionic == are_ionic && frame.starts_bonded == starts_bonded &&
                      frame.smallest_radius == smallest_radius;
    radii_differ = radii_differ || (!is_first && !same);
  }
  elements += frame.elements;
  particles += frame.particles;
  if (frame.distance) distance = std::min(distance.value_or(*frame.distance), *frame.distance);
  if (frame.are_ionic) are_ionic = are_ionic.value_or(true) && *frame.are_ionic;
  if (frame.starts_bonded) {
    starts_bonded = starts_bonded.value_or(true) && *frame.starts_bonded;
  }
  if (frame.smallest_radius) {
    smallest_radius =
        std::min(smallest_radius.value_or(*frame.smallest_radius), *frame.smallest_radius);
  }
  if (frame.axes_box) {
    axes_box = axes_box ? joined(*axes_box, *frame.axes_box) : *frame.axes_box;
  }
  add_names(frame.unlisted, unlisted);
  if (frame.range) {
    const auto& [low, high] = *frame.range;
    const auto known = range.value_or(*frame.range);
    range = {std::min(known[0], low), std::max(known[1], high)};
  }
  if (!frame.column.empty()) {
    if (column.empty()) {
      kind_numbers = frame.kind_numbers;
    } else if (kind_numbers && frame.kind_numbers) {
      for (const double number : *frame.kind_numbers) insert(number, *kind_numbers);
    } else {
      kind_numbers.reset();
    }
    column = frame.column;
  }
  are_species = are_species || frame.are_species;
  given = frame.given;
  nan_color = frame.nan_color;
  all = frame.all;
  add_kinds(frame.kinds, kinds);
}

void ParticleChoices::finish(const std::string& frames) {
  of_frames = frames;
  if (numbers_are_kinds()) {
    std::vector<ParticleColors::Species> of_numbers;
    for (const double number : *kind_numbers) of_numbers.push_back({kind_text(number), {}, 1});
    add_kinds(of_numbers, kinds);
  }
  std::vector<std::string> names;
  names.reserve(kinds.size());
  for (const ParticleColors::Species& kind : kinds) names.push_back(kind.name);
  auto colors = are_species ? species_colors(names) : palette_colors(names);
  if (all) colors.assign(names.size(), *all);
  use_given(given, nan_color, names, are_species, colors);
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i].color = colors[i];
}

bool ParticleChoices::numbers_are_kinds() const {
  const std::size_t least = is_named_for_kinds(column) ? 1 : 2;
  return kind_numbers && kind_numbers->size() >= least &&
         kind_numbers->size() <= most_kinds(column);
}

std::size_t most_kinds(const std::string& column) {
  constexpr std::size_t by_name = 256;
  return is_named_for_kinds(column) ? by_name : palette_size;
}

std::optional<std::vector<double>> find_kinds(const std::vector<double>& numbers,
                                              std::size_t most) {
  std::vector<double> kinds;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const double number : numbers) {
    if (number == last) continue;
    if (!is_whole(number)) return std::nullopt;
    insert(number, kinds);
    if (kinds.size() > most) return std::nullopt;
    last = number;
  }
  return kinds;
}

std::string kind_text(double kind) { return std::to_string(static_cast<long long>(kind)); }

std::array<double, 2> map_range(const std::array<double, 2>& ends) {
  if (ends[0] < ends[1]) return ends;
  const double half = std::max(std::fabs(ends[0]), 1.0) / 2;
  constexpr double most = std::numeric_limits<double>::max();
  return {std::max(ends[0] - half, -most), std::min(ends[0] + half, most)};
}

std::string range_note(const std::string& by, const std::array<double, 2>& ends,
                       const std::string& of_frames) {
  const std::string name = "the colours of " + quote(by);
  if (!(ends[0] < ends[1])) return name + " are those of one number, " + number_text(ends[0]);
  const std::string span =
      name + " go from " + number_text(ends[0]) + " to " + number_text(ends[1]);
  if (of_frames.empty()) return span + ", the 1st and 99th percentile";
  return span + ", the lowest 1st and the highest 99th percentile of " + of_frames;
}

}  // namespace boule
