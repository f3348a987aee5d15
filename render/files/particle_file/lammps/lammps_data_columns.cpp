#include "render/files/particle_file/lammps/lammps_data_columns.h"

#include <algorithm>
#include <array>

#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

/// A style of atoms (docs.lammps.org/read_data.html).
struct AtomStyle {
  std::string_view name;
  std::vector<std::string> columns;
};

const std::vector<AtomStyle>& atom_styles() {
  static const std::vector<std::string> bonded{"id", "molecule", "type", "x", "y", "z"};
  static const std::vector<AtomStyle> styles{
      {"atomic", {"id", "type", "x", "y", "z"}},
      {"charge", {"id", "type", "q", "x", "y", "z"}},
      {"bond", bonded},
      {"angle", bonded},
      {"molecular", bonded},
      {"full", {"id", "molecule", "type", "q", "x", "y", "z"}},
      {"sphere", {"id", "type", "diameter", "density", "x", "y", "z"}},
  };
  return styles;
}

const AtomStyle* find_style(std::string_view name) {
  const auto& styles = atom_styles();
  const auto found = std::find_if(styles.begin(), styles.end(),
                                  [&](const AtomStyle& style) { return style.name == name; });
  return found == styles.end() ? nullptr : &*found;
}

bool is_integer(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return count_in(word).has_value();
}

/// True if a row of `count` columns ends with the three whole numbers of an image of the box.
bool has_images(const std::vector<std::string_view>& words, std::size_t count) {
  return words.size() == count + 3 && std::all_of(words.end() - 3, words.end(), is_integer);
}

/// True if a row can be of molecular or full: the third column is a type.
bool has_molecules(const std::vector<std::string_view>& words, std::uint64_t types) {
  const auto type = count_in(words[2]);
  return type && *type >= 1 && *type <= types;
}

/// What a row looks like. Where two styles are possible, their positions are in the same columns.
const AtomStyle* guess_style(const std::vector<std::string_view>& words, std::uint64_t types) {
  for (const std::size_t count : {5, 6, 7}) {
    if (words.size() != count && !has_images(words, count)) continue;
    if (count == 5) return find_style("atomic");
    const bool molecules = has_molecules(words, types);
    if (count == 6) return find_style(molecules ? "molecular" : "charge");
    return find_style(molecules ? "full" : "sphere");
  }
  return nullptr;
}

/// By the style behind "Atoms #", else by the first row.
Result<DataColumns> columns_of_style(const DataSections& sections,
                                     const std::vector<std::string_view>& words) {
  const std::string& name = sections.atom_rows.style;
  const AtomStyle* const style =
      name.empty() ? guess_style(words, sections.types) : find_style(name);
  if (style == nullptr) {
    const std::string what = name.empty()
                                 ? "the style of its atoms is not told, as in Atoms # full"
                                 : "the style of its atoms, " + quote(name) + ", is unknown";
    return error_at_line(sections.atom_rows.line,
                         what + "; name the columns (--columns id,type,x,y,z)", "Atoms");
  }
  DataColumns found{style->columns, {}};
  if (name.empty()) {
    found.note = "the style of its atoms is not told, taken as " + std::string(style->name) +
                 " by the first row";
  }
  return found;
}

}  // namespace

Result<DataColumns> columns_of_atoms(const DataSections& sections, std::string_view first_row,
                                     const std::vector<std::string>& given) {
  const auto words = words_of(first_row.substr(0, first_row.find('#')));
  auto found = given.empty() ? columns_of_style(sections, words) : DataColumns{given, {}};
  if (!found) return found;
  std::vector<std::string>& names = found.value().names;
  if (has_images(words, names.size())) names.insert(names.end(), 3, "-");
  return found;
}

}  // namespace boule
