#include "render/particles/species_palette.h"

#include <array>

#include "render/particles/elements.h"

namespace boule {

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

std::vector<SrgbColor> species_colors(const std::vector<std::string>& species) {
  std::vector<SrgbColor> colors;
  std::size_t unknown = 0;
  for (const std::string& text : species) {
    const Element* const element = find_element(text);
    colors.push_back(element != nullptr ? element->color : palette_color(unknown++));
  }
  return colors;
}

std::vector<SrgbColor> palette_colors(std::size_t count) {
  std::vector<SrgbColor> colors;
  for (std::size_t i = 0; i < count; ++i) colors.push_back(palette_color(i));
  return colors;
}

}  // namespace boule
