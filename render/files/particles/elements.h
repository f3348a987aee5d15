#pragma once

#include <span>
#include <string_view>

#include "core/math/srgb.h"

namespace boule {

/// A chemical element as pictures show it. The colours are those of Jmol
/// (jmol.sourceforge.net/jscolors). The radii are in angstrom, 0 where the table has none: van der
/// Waals (S. Alvarez, Dalton Trans. 42, 8617, 2013) and covalent (B. Cordero et al., Dalton Trans.,
/// 2832, 2008; carbon as sp3, Mn, Fe and Co with high spin).
struct Element {
  std::string_view symbol;
  SrgbColor color;
  double vdw = 0;
  double covalent = 0;
};

/// Hydrogen to meitnerium, by atomic number from 1.
std::span<const Element> all_elements();

/// The element of a symbol in any case ("Fe", "FE", "fe"), or null. "D" and "T" are hydrogen. A
/// charge behind it changes nothing: "Na+", "Fe+2", "Fe2+", "O--".
const Element* find_element(std::string_view symbol);

}  // namespace boule
