#include "render/files/particles/colors/species_palette.h"

#include <algorithm>
#include <array>

#include "render/files/particles/elements.h"

namespace boule {
namespace {

bool is_taken(const SrgbColor& color, const KnownKinds& known) {
  return std::any_of(known.begin(), known.end(),
                     [&](const auto& kind) { return kind.color == color; });
}

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Sorts the places of texts by their numbers if all of them are whole numbers: types have the same
/// colours whichever comes first in a file.
void sort_numbers(std::vector<std::size_t>& places, const std::vector<std::string>& texts) {
  const bool are_numbers = std::all_of(places.begin(), places.end(),
                                       [&](std::size_t i) { return is_whole_number(texts[i]); });
  if (!are_numbers) return;
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    const std::size_t digits_a = texts[a].size(), digits_b = texts[b].size();
    return digits_a != digits_b ? digits_a < digits_b : texts[a] < texts[b];
  });
}

}  // namespace

SrgbColor palette_color(std::size_t index) {
  constexpr std::array<SrgbColor, palette_size> palette{{{0xe6, 0x9f, 0x00},
                                                         {0x56, 0xb4, 0xe9},
                                                         {0x00, 0x9e, 0x73},
                                                         {0xf0, 0xe4, 0x42},
                                                         {0x00, 0x72, 0xb2},
                                                         {0xd5, 0x5e, 0x00},
                                                         {0xcc, 0x79, 0xa7},
                                                         {0x99, 0x99, 0x99}}};
  return palette[index % palette_size];
}

std::vector<SrgbColor> palette_colors(const std::vector<std::string>& texts,
                                      const KnownKinds& known) {
  std::vector<SrgbColor> colors(texts.size());
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto kind = std::find_if(known.begin(), known.end(),
                                   [&](const auto& one) { return one.name == texts[i]; });
    if (kind != known.end()) {
      colors[i] = kind->color;
    } else {
      others.push_back(i);
    }
  }
  sort_numbers(others, texts);
  std::size_t place = 0;
  for (const std::size_t other : others) {
    while (place < palette_size && is_taken(palette_color(place), known)) ++place;
    colors[other] = palette_color(place++);
  }
  return colors;
}

std::vector<SrgbColor> species_colors(const std::vector<std::string>& species,
                                      const KnownKinds& known) {
  std::vector<std::string> unknown;
  for (const std::string& text : species) {
    if (find_element(text) == nullptr) unknown.push_back(text);
  }
  const std::vector<SrgbColor> of_palette = palette_colors(unknown, known);
  std::vector<SrgbColor> colors;
  auto next = of_palette.begin();
  for (const std::string& text : species) {
    const Element* const element = find_element(text);
    colors.push_back(element != nullptr ? element->color : *next++);
  }
  return colors;
}

}  // namespace boule
