#include "render/files/scene_file/toml/toml_particle_style.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/scene/number_text.h"
#include "render/files/file/nearest_name.h"
#include "render/files/scene_file/toml/toml_color_map.h"

namespace boule {
namespace {

/// The number under `key`, which must be above 0 and finite.
double read_positive(TomlTable& table, std::string_view key, double otherwise) {
  double number = otherwise;
  table.read(key, number);
  if (!std::isfinite(number) || !(number > 0)) {
    table.report(key, "must be finite and above 0, is " + number_text(number));
  }
  return number;
}

RadiusRule read_radius(TomlTable& table) {
  if (!table.has("radius")) return {};
  if (!table.has_text("radius")) return read_positive(table, "radius", 1);
  std::string text;
  table.read("radius", text);
  if (text.empty()) {
    table.report("radius", "expected a number, a column, \"vdw\", \"covalent\" or \"ionic\"");
  }
  const auto& tables = names<RadiusTable>;
  const auto found = std::find(tables.begin(), tables.end(), ascii_lower(text));
  if (found == tables.end()) return RadiusColumn{std::move(text)};
  return static_cast<RadiusTable>(found - tables.begin());
}

/// What a table has for kinds, each by its name: `read_one(table of kinds, name)` reads it.
template <class Value, class Read>
std::vector<OfKind<Value>> read_kinds(TomlTable& table, std::string_view key,
                                      const Read& read_one) {
  std::vector<OfKind<Value>> all;
  auto kinds = table.table(key);
  if (!kinds) return all;
  for (const std::string& kind : kinds->keys()) {
    kinds->has(kind);
    all.push_back({kind, read_one(*kinds, kind)});
  }
  return all;
}

/// The value of an enum by its name; `also` is what else the message says is expected.
template <class Enum>
Enum read_name(TomlTable& table, std::string_view key, const std::string& also = {}) {
  std::string text;
  table.read(key, text);
  const std::vector<std::string_view> known(names<Enum>.begin(), names<Enum>.end());
  const auto found = std::find(known.begin(), known.end(), text);
  if (found != known.end()) return static_cast<Enum>(found - known.begin());
  table.report(key, "unknown " + std::string(key) + " " + quote(text) + ", expected " + also +
                        list_names(known) + did_you_mean(text, known));
  return {};
}

BondChoice read_bonds(TomlTable& table) {
  if (!table.has("bonds")) return {};
  if (!table.has_text("bonds")) return read_positive(table, "bonds", 1);
  return read_name<BondRule>(table, "bonds", "a number, ");
}

/// What outlines go around: a rule by its name, or a column.
OutlineChoice read_outline(TomlTable& table) {
  if (!table.has("outline_by")) return {};
  std::string text;
  table.read("outline_by", text);
  const auto& rules = names<OutlineRule>;
  const auto found = std::find(rules.begin(), rules.end(), text);
  if (found != rules.end()) return static_cast<OutlineRule>(found - rules.begin());
  if (text.empty()) {
    table.report("outline_by", "expected a column or " + list_names({rules.begin(), rules.end()}));
  }
  return text;
}

/// The names of columns: one, or an array of some.
std::vector<std::string> read_columns(TomlTable& table, std::string_view key) {
  std::vector<std::string> names;
  if (table.has_text(key)) {
    table.read(key, names.emplace_back());
  } else {
    table.read(key, names);
  }
  return names;
}

LabelRule read_labels(TomlTable& table) {
  LabelRule labels;
  table.read("labels", labels.select);
  labels.text = read_columns(table, "label_text");
  if (labels.select.empty() && !labels.text.empty())
    table.report("label_text", "needs the particles of labels");
  return labels;
}

/// The vectors: three columns, or the one name that they have before x, y, z.
ArrowColumns read_arrows(TomlTable& table) {
  ArrowColumns arrows{read_columns(table, "arrows")};
  if ((arrows.names.size() != 1 && arrows.names.size() != 3) || arrows.names.front().empty()) {
    table.report("arrows", "expected three columns, or the name that they have before x, y, z");
    arrows.names = {"v"};
  }
  arrows.scale = read_positive(table, "arrow_scale", arrows.scale);
  return arrows;
}

/// The keys of what is drawn besides spheres.
void read_bond_keys(TomlTable& table, ParticleStyle& style) {
  if (table.has("style")) style.shape = read_name<ParticleShape>(table, "style");
  style.bonds = read_bonds(table);
  if (table.has("bond_radius")) style.bond_radius = read_positive(table, "bond_radius", 1);
  if (table.has("bond_color")) style.bond_color = read_color_codes(table, "bond_color");
  style.outline_by = read_outline(table);
  table.read("cell_edges", style.cell_edges);
  table.read("axes", style.axes);
  if (table.has("arrows")) {
    style.arrows = read_arrows(table);
  } else if (table.has("arrow_scale")) {
    table.report("arrow_scale", "needs the vectors of arrows");
  }
}

ColorRule read_color_text(TomlTable& table) {
  std::string text;
  table.read("color", text);
  if (text.starts_with('#')) return read_color_codes(table, "color");
  if (text == "element" || text == "species") return SpeciesColors{};
  const auto words = words_of(text);
  if (words.empty()) {
    table.report("color", quote(text) +
                              " is no colour, expected \"#rrggbb\", \"element\", a column or three "
                              "columns: \"red green blue\"");
    return {};
  }
  // The name of a column may have blanks.
  return ColorColumns{{words.size() == 1 ? std::string(words.front()) : std::move(text)}};
}

MappedColors read_mapped_colors(TomlTable table) {
  MappedColors colors;
  table.read("by", colors.by);
  ColorMapKeys keys = read_color_map(table);
  table.finish({"by"});
  if (colors.by.empty()) table.report("by", "expected the name of a column, or \"|v|\"");
  colors.map = std::move(keys.map);
  colors.range = keys.range;
  return colors;
}

ColorRule read_color(TomlTable& table) {
  if (!table.has("color")) return {};
  if (table.has_table("color")) return read_mapped_colors(*table.table("color"));
  if (table.has_text("color")) return read_color_text(table);
  return read_color_codes(table, "color");
}

}  // namespace

std::optional<Ghost> read_ghost(TomlTable& table, const Material& of) {
  if (!table.has("ghost")) {
    if (table.has("opacity")) table.report("opacity", "needs the particles of ghost");
    return std::nullopt;
  }
  Ghost ghost{color_of(of)};
  if (table.has("opacity")) table.read("opacity", ghost.opacity);
  table.check(find_problem(Material(ghost)));
  return ghost;
}

ParticleStyle read_particle_style(TomlTable& table) {
  ParticleStyle style;
  style.radius = read_radius(table);
  style.scale = read_positive(table, "scale", style.scale);
  style.radii = read_kinds<double>(table, "radii", [](TomlTable& kinds, std::string_view kind) {
    return read_positive(kinds, kind, 1);
  });
  style.color = read_color(table);
  style.colors = read_kinds<SrgbColor>(table, "colors", read_color_codes);
  if (table.has("nan_color")) style.nan_color = read_color_codes(table, "nan_color");
  read_bond_keys(table, style);
  table.read("select", style.select);
  style.labels = read_labels(table);
  table.read("ghost", style.ghost);
  table.read("wrap", style.wrap);
  table.read("unwrap", style.unwrap);
  table.read("boundary", style.boundary);
  table.read("replicate", style.replicate);
  for (const int images : style.replicate) {
    if (images >= 1) continue;
    table.report("replicate", "must be 1 or above, is " + std::to_string(images));
  }
  return style;
}

}  // namespace boule
