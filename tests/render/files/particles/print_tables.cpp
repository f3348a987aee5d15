// Prints the tables of render/files/particles for as_ase.py: elements as "SYMBOL #rrggbb VDW
// COVALENT", then the maps as "NAME" and 256 colours.

#include <cstdio>

#include "render/files/particles/colors/color_map.h"
#include "render/files/particles/elements.h"

int main() {
  using namespace boule;
  for (const Element& element : all_elements()) {
    std::printf("element %.2s %s %.17g %.17g\n", element.symbol.data(),
                hex_text(element.color).c_str(), element.vdw, element.covalent);
  }
  for (std::size_t i = 0; i < names<NamedColorMap>.size(); ++i) {
    const auto name = static_cast<NamedColorMap>(i);
    const ColorMap map(name);
    std::printf("map %s", std::string(name_of(name)).c_str());
    for (int code = 0; code < 256; ++code) {
      std::printf(" %s", hex_text(map.color(code / 255.0)).c_str());
    }
    std::printf("\n");
  }
}
