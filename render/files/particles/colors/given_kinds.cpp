#include "render/files/particles/colors/given_kinds.h"

#include <algorithm>

#include "render/files/file/nearest_name.h"
#include "render/files/particles/elements.h"

namespace boule {

bool are_one_element(std::string_view a, std::string_view b) {
  const Element* const element = find_element(a);
  return element != nullptr && element == find_element(b);
}

void use_given(const std::vector<KindColor>& given, const SrgbColor& nan_color,
               const std::vector<std::string>& kinds, bool are_species,
               std::vector<SrgbColor>& colors) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i].empty()) colors[i] = nan_color;
    const SrgbColor* const color = find_given(given, kinds[i], are_species);
    if (color != nullptr) colors[i] = *color;
  }
}

Status check_kind(std::string_view name, const std::vector<std::string>& kinds, bool are_species,
                  const std::string& key) {
  if (std::find(kinds.begin(), kinds.end(), name) != kinds.end()) return {};
  if (are_species && find_element(name) != nullptr) return {};
  constexpr std::size_t most_told = 10;
  std::vector<std::string_view> known(kinds.begin(), kinds.end());
  const std::string hint = did_you_mean(name, known);
  const bool too_many = known.size() > most_told;
  if (too_many) known.resize(most_told);
  return Diagnostic::about(key, "no particle is of the kind " + quote(name) + ", expected " +
                                    list_names(known) + (too_many ? ", and more" : "") + hint);
}

}  // namespace boule
