#include "render/files/particle_file/frame/element_guess.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "render/files/particle_file/text/text_interner.h"

namespace boule {
namespace {

/// All symbols by atomic number from 1, two characters each.
constexpr std::string_view symbols =
    "H HeLiBeB C N O F NeNaMgAlSiP S ClArK CaScTiV CrMnFeCoNiCuZnGaGeAsSeBrKrRbSrY "
    "ZrNbMoTcRuRhPdAgCd"
    "InSnSbTeI XeCsBaLaCePrNdPmSmEuGdTbDyHoErTmYbLuHfTaW ReOsIrPtAuHgTlPbBiPoAtRnFrRaAcThPaU "
    "NpPuAmCm"
    "BkCfEsFmMdNoLrRfDbSgBhHsMtDsRgCnNhFlMcLvTsOg";

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
char capital(char c) { return is_small(c) ? static_cast<char>(c - 'a' + 'A') : c; }

/// The symbol of these letters, in any case, or of one and ' '; empty if there is none.
std::string_view symbol_of(char first, char second) {
  if (second == ' ' && capital(first) == 'D') return "D";
  for (std::size_t i = 0; i < symbols.size(); i += 2) {
    if (symbols[i] != capital(first) || symbols[i + 1] != ascii_lower(second)) continue;
    return symbols.substr(i, second == ' ' ? 1 : 2);
  }
  return {};
}

/// The letters of a name as capitals: "CL" of "Cl-".
std::string letters_of(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (is_letter(c)) letters += capital(c);
  }
  return letters;
}

/// The element of an ion of this name; empty for others.
std::string_view ion_named(const std::string& letters) {
  struct Ion {
    std::string_view name, symbol;
  };
  constexpr std::array ions{Ion{"SOD", "Na"},  Ion{"POT", "K"},  Ion{"CLA", "Cl"},
                            Ion{"CAL", "Ca"},  Ion{"CES", "Cs"}, Ion{"LIT", "Li"},
                            Ion{"RUB", "Rb"},  Ion{"BAR", "Ba"}, Ion{"CAD", "Cd"},
                            Ion{"BROM", "Br"}, Ion{"IODI", "I"}, Ion{"FLUO", "F"}};
  for (const Ion& ion : ions) {
    if (ion.name == letters) return ion.symbol;
  }
  return letters.size() == 2 ? symbol_of(letters[0], letters[1]) : std::string_view();
}

}  // namespace

std::string_view element_of_number(std::size_t number) {
  if (number == 0) return "X";
  if (number > last_element) return {};
  const std::string_view symbol = symbols.substr(2 * (number - 1), 2);
  return symbol[1] == ' ' ? symbol.substr(0, 1) : symbol;
}

std::string_view ion_of_atom(std::string_view atom, std::string_view residue) {
  const std::string letters = letters_of(atom), of_residue = letters_of(residue);
  if (letters.empty()) return {};
  const std::string_view ion = ion_named(letters), same = ion_named(of_residue);
  if (letters == of_residue || of_residue == "ION" || letters_of(ion) == of_residue) return ion;
  return letters_of(same) == letters ? same : std::string_view();
}

std::string_view element_of_atom(std::string_view atom, std::string_view residue) {
  const auto* const begin = std::find_if(atom.begin(), atom.end(), is_letter);
  const std::string_view name = atom.substr(static_cast<std::size_t>(begin - atom.begin()));
  if (name.empty()) return atom;
  const char second = name.size() > 1 ? name[1] : ' ';
  if (is_small(second)) {
    if (const auto symbol = symbol_of(name[0], second); !symbol.empty()) return symbol;
  }
  if (const auto ion = ion_of_atom(name, residue); !ion.empty()) return ion;
  constexpr std::array<std::string_view, 7> common{"Br", "Cl", "Fe", "Mg", "Se", "Si", "Zn"};
  const std::string_view symbol = symbol_of(name[0], second);
  if (std::count(common.begin(), common.end(), symbol) > 0) return symbol;
  const std::string_view single = symbol_of(name[0], ' ');
  return single.empty() ? atom : single;
}

void guess_species(ParticleFrame& frame) {
  const TextColumn* const names = find_text_column(frame, "name");
  const TextColumn* const residues = find_text_column(frame, "resname");
  if (names == nullptr) return;
  /// By the atom's name: the last residue that had it. Each pair is looked at once as a rule.
  struct Known {
    std::uint32_t residue = UINT32_MAX, element = 0;
  };
  std::vector<Known> known(names->texts.size());
  TextInterner elements;
  TextColumn species{"element", {}, std::vector<std::uint32_t>(frame.size())};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::uint32_t atom = names->indices[i];
    const std::uint32_t residue = residues != nullptr ? residues->indices[i] : 0;
    Known& last = known[atom];
    if (last.residue != residue) {
      const std::string_view of =
          residues != nullptr ? residues->texts[residue] : std::string_view();
      last = {residue, elements.index_of(element_of_atom(names->texts[atom], of))};
    }
    species.indices[i] = last.element;
  }
  species.texts.assign(elements.texts().begin(), elements.texts().end());
  frame.species = std::move(species);
  frame.notes.emplace_back(elements_are_guessed);
}

}  // namespace boule
