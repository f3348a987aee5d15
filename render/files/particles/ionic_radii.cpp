#include "render/files/particles/ionic_radii.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/files/particles/elements.h"

namespace boule {
namespace {

constexpr std::array<IonicRadius, 90> ions{{
    // clang-format off
    {"Li", 1, 0.76},
    {"Be", 2, 0.45},
    {"B", 3, 0.27},
    {"C", 4, 0.16},
    {"N", -3, 1.46},
    {"O", -2, 1.4},
    {"F", -1, 1.33},
    {"Na", 1, 1.02},
    {"Mg", 2, 0.72},
    {"Al", 3, 0.535},
    {"Si", 4, 0.4},
    {"P", 5, 0.38},
    {"S", -2, 1.84},
    {"Cl", -1, 1.81},
    {"K", 1, 1.38},
    {"Ca", 2, 1},
    {"Sc", 3, 0.745},
    {"Ti", 4, 0.605},
    {"V", 5, 0.54},
    {"Cr", 3, 0.615},
    {"Mn", 2, 0.83},
    {"Fe", 3, 0.645},
    {"Co", 2, 0.745},
    {"Ni", 2, 0.69},
    {"Cu", 2, 0.73},
    {"Zn", 2, 0.74},
    {"Ga", 3, 0.62},
    {"Ge", 4, 0.53},
    {"As", 3, 0.58},
    {"Se", -2, 1.98},
    {"Br", -1, 1.96},
    {"Rb", 1, 1.52},
    {"Sr", 2, 1.18},
    {"Y", 3, 0.9},
    {"Zr", 4, 0.72},
    {"Nb", 5, 0.64},
    {"Mo", 6, 0.59},
    {"Tc", 4, 0.645},
    {"Ru", 4, 0.62},
    {"Rh", 3, 0.665},
    {"Pd", 2, 0.86},
    {"Ag", 1, 1.15},
    {"Cd", 2, 0.95},
    {"In", 3, 0.8},
    {"Sn", 4, 0.69},
    {"Sb", 3, 0.76},
    {"Te", -2, 2.21},
    {"I", -1, 2.2},
    {"Cs", 1, 1.67},
    {"Ba", 2, 1.35},
    {"La", 3, 1.032},
    {"Ce", 3, 1.01},
    {"Pr", 3, 0.99},
    {"Nd", 3, 0.983},
    {"Pm", 3, 0.97},
    {"Sm", 3, 0.958},
    {"Eu", 3, 0.947},
    {"Gd", 3, 0.938},
    {"Tb", 3, 0.923},
    {"Dy", 3, 0.912},
    {"Ho", 3, 0.901},
    {"Er", 3, 0.89},
    {"Tm", 3, 0.88},
    {"Yb", 3, 0.868},
    {"Lu", 3, 0.861},
    {"Hf", 4, 0.71},
    {"Ta", 5, 0.64},
    {"W", 6, 0.6},
    {"Re", 7, 0.53},
    {"Os", 4, 0.63},
    {"Ir", 4, 0.625},
    {"Pt", 4, 0.625},
    {"Au", 3, 0.85},
    {"Hg", 2, 1.02},
    {"Tl", 1, 1.5},
    {"Pb", 2, 1.19},
    {"Bi", 3, 1.03},
    {"Po", 4, 0.94},
    {"At", 7, 0.62},
    {"Fr", 1, 1.8},
    {"Ac", 3, 1.12},
    {"Th", 4, 0.94},
    {"Pa", 5, 0.78},
    {"U", 6, 0.73},
    {"Np", 5, 0.75},
    {"Pu", 4, 0.86},
    {"Am", 3, 0.975},
    {"Cm", 3, 0.97},
    {"Bk", 3, 0.96},
    {"Cf", 3, 0.95},
    // clang-format on
}};

/// Null where there is none.
const IonicRadius* find_ion(std::string_view symbol) {
  const auto found = std::find_if(ions.begin(), ions.end(),
                                  [&](const IonicRadius& ion) { return ion.symbol == symbol; });
  return found == ions.end() ? nullptr : &*found;
}

}  // namespace

std::span<const IonicRadius> all_ionic_radii() { return ions; }

double ionic_radius(std::string_view symbol) {
  const IonicRadius* const ion = find_ion(symbol);
  return ion == nullptr ? 0 : ion->radius;
}

bool is_salt(const ParticleFrame& frame) {
  constexpr std::array<std::string_view, 5> anions{"O", "F", "Cl", "Br", "I"};
  constexpr double least = 0.5;  // a smaller ion is hidden among oxygens, as silicon is
  if (!frame.cell || frame.cell->periodic != std::array{true, true, true}) return false;
  if (!frame.species || frame.size() == 0) return false;
  std::vector<std::size_t> counts(frame.species->texts.size());
  for (const std::uint32_t i : frame.species->indices) ++counts[i];
  std::size_t of_anions = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const Element* const element = find_element(frame.species->texts[i]);
    const IonicRadius* const ion = element == nullptr ? nullptr : find_ion(element->symbol);
    if (ion == nullptr) return false;
    const bool is_anion = std::count(anions.begin(), anions.end(), ion->symbol) > 0;
    if (!is_anion && (ion->charge < 0 || ion->radius < least)) return false;
    if (is_anion) of_anions += counts[i];
  }
  return 10 * of_anions >= 3 * frame.size();
}

}  // namespace boule
