#include "render/particle_file/element_guess.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace boule {
namespace {

/// All symbols of two letters, one after another.
constexpr std::string_view pairs =
    "HeLiBeNeNaMgAlSiClArCaScTiCrMnFeCoNiCuZnGaGeAsSeBrKrRbSrZrNbMoTcRuRhPdAgCdInSnSbTeXeCsBaLaCePr"
    "NdPmSmEuGdTbDyHoErTmYbLuHfTaReOsIrPtAuHgTlPbBiPoAtRnFrRaAcThPaNpPuAmCmBkCfEsFmMdNoLrRfDbSgBhHs"
    "MtDsRgCnNhFlMcLvTsOg";
constexpr std::string_view singles = "HBCNOFPSKVYIWUD";

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool is_small(char c) { return c >= 'a' && c <= 'z'; }
char capital(char c) { return is_small(c) ? static_cast<char>(c - 'a' + 'A') : c; }
char small(char c) { return is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c; }

/// The symbol of these two letters, in any case; empty if there is none.
std::string_view pair_of(char first, char second) {
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    if (pairs[i] == capital(first) && pairs[i + 1] == small(second)) return pairs.substr(i, 2);
  }
  return {};
}

/// The letters of a name as capitals: "CL" of "Cl-".
std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (is_capital(c) || is_small(c)) letters += capital(c);
  }
  return letters;
}

/// The element of an ion, whose atom and residue are of one name; empty for others.
std::string_view ion_of(const std::string& letters) {
  struct Ion {
    std::string_view name, symbol;
  };
  constexpr std::array ions{Ion{"SOD", "Na"}, Ion{"POT", "K"},  Ion{"CLA", "Cl"}, Ion{"CAL", "Ca"},
                            Ion{"CES", "Cs"}, Ion{"LIT", "Li"}, Ion{"RUB", "Rb"}, Ion{"BAR", "Ba"}};
  for (const Ion& ion : ions) {
    if (ion.name == letters) return ion.symbol;
  }
  return letters.size() == 2 ? pair_of(letters[0], letters[1]) : std::string_view();
}

}  // namespace

std::string_view element_of_atom(std::string_view atom, std::string_view residue) {
  const auto* const begin =
      std::find_if(atom.begin(), atom.end(), [](char c) { return is_capital(c) || is_small(c); });
  const std::string_view name = atom.substr(static_cast<std::size_t>(begin - atom.begin()));
  if (name.empty()) return atom;
  const char second = name.size() > 1 ? name[1] : ' ';
  if (is_small(second)) {
    if (const auto symbol = pair_of(name[0], second); !symbol.empty()) return symbol;
  }
  const std::string letters = letters_of(name), of_residue = letters_of(residue);
  if (letters == of_residue || of_residue == "ION") {
    if (const auto symbol = ion_of(letters); !symbol.empty()) return symbol;
  }
  constexpr std::array<std::string_view, 7> common{"Br", "Cl", "Fe", "Mg", "Se", "Si", "Zn"};
  const std::string_view symbol = pair_of(name[0], second);
  if (std::count(common.begin(), common.end(), symbol) > 0) return symbol;
  const std::size_t single = singles.find(capital(name[0]));
  return single == std::string_view::npos ? atom : singles.substr(single, 1);
}

}  // namespace boule
