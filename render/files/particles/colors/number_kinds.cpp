#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>

#include "render/files/particles/colors/particle_colors.h"

namespace boule {
namespace {

/// The column as texts, "1" for 1. Its numbers are those of `kinds`, which are in order.
TextColumn as_texts(const NumberColumn& column, const std::vector<double>& kinds) {
  TextColumn texts{column.name, {}, {}};
  for (const double kind : kinds) texts.texts.push_back(kind_text(kind));
  texts.indices.reserve(column.values.size());
  for (const double number : column.values) {
    const auto place = std::lower_bound(kinds.begin(), kinds.end(), number);
    texts.indices.push_back(static_cast<std::uint32_t>(place - kinds.begin()));
  }
  return texts;
}

}  // namespace

void make_kinds(ParticleFrame& frame, const ParticleStyle& style, ParticleChoices& own) {
  const auto* const columns = std::get_if<ColorColumns>(&style.color);
  if (columns == nullptr || columns->names.size() != 1) return;
  const std::string& name = columns->names.front();
  const auto column = std::find_if(frame.numbers.begin(), frame.numbers.end(),
                                   [&](const NumberColumn& one) { return one.name == name; });
  if (column == frame.numbers.end()) return;
  own.column = name;
  own.kind_numbers = find_kinds(column->values, most_kinds(name));
  if (own.numbers_are_kinds()) own.range = {own.kind_numbers->front(), own.kind_numbers->back()};
  const bool of_series = style.chosen != nullptr && style.chosen->column == name;
  const ParticleChoices& chosen = of_series ? *style.chosen : own;
  if (!own.kind_numbers || !chosen.numbers_are_kinds()) return;
  frame.notes.push_back(
      "the numbers of " + quote(name) +
      " are taken as kinds, with a colour each: " + std::to_string(chosen.kind_numbers->size()) +
      (of_series ? " in " + chosen.of_frames : "") + " (a map of colours makes them a scale)");
  // Where the types are the species, these are told already.
  if (find_particle_texts(frame, name) == nullptr)
    frame.texts.push_back(as_texts(*column, *own.kind_numbers));
  frame.numbers.erase(column);
}

}  // namespace boule
