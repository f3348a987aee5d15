#include "render/files/particles/particle_style.h"

#include <algorithm>

#include "core/base/text.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/select/select_expression.h"

namespace boule {
namespace {

void add_radius_columns(const RadiusRule& rule, std::vector<std::string>& names) {
  if (std::holds_alternative<std::monostate>(rule)) {
    names.insert(names.end(), {"radius", "diameter"});
  } else if (const auto* const column = std::get_if<RadiusColumn>(&rule)) {
    add_column_names(column->name, names);
  }
}

void add_color_columns(const ColorRule& rule, std::vector<std::string>& names) {
  if (std::holds_alternative<std::monostate>(rule)) {
    names.insert(names.end(), {"color", "red", "green", "blue"});
  } else if (const auto* const columns = std::get_if<ColorColumns>(&rule)) {
    for (const std::string& name : columns->names) {
      add_column_names(name, names);
      for (const std::string& one : three_names(name)) add_column_names(one, names);
    }
  } else if (const auto* const mapped = std::get_if<MappedColors>(&rule)) {
    add_column_names(mapped->by, names);
  }
}

void add_arrow_columns(const std::vector<std::string>& arrows, std::vector<std::string>& names) {
  for (const std::string& name : arrows) {
    add_column_names(arrows.size() == 1 ? "|" + name + "|" : name, names);
  }
}

/// None of an expression that cannot be read: ParticleSpheres tells what is wrong.
void add_select_columns(const std::string& select, std::vector<std::string>& names) {
  if (select.empty()) return;
  const auto expression = parse_select(select, "select");
  if (!expression) return;
  for (const SelectStep& step : expression.value().steps) {
    for (const SelectValue* const value : {&step.left, &step.right}) {
      const auto* const column = std::get_if<ColumnName>(value);
      if (column != nullptr) add_column_names(column->name, names);
    }
  }
}

void add_outline_columns(const OutlineChoice& outline, std::vector<std::string>& names) {
  if (const auto* const column = std::get_if<std::string>(&outline)) {
    names.push_back(*column);
  } else if (const auto* const rule = std::get_if<OutlineRule>(&outline)) {
    for (const std::string& name : outline_columns(*rule)) names.push_back(name);
  }
}

}  // namespace

std::vector<std::string> outline_columns(OutlineRule rule) {
  switch (rule) {
    case OutlineRule::molecule:
      return {"mol"};
    case OutlineRule::chain:
      return {"chain"};
    case OutlineRule::residue:
      return {"chain", "resid", "resname"};
    default:
      return {};
  }
}

std::vector<std::string> three_names(const std::string& text) {
  const auto words = words_of(text);
  if (words.size() != 3) return {};
  return {words.begin(), words.end()};
}

std::vector<std::string> columns_of(const ParticleStyle& style) {
  std::vector<std::string> names;
  add_radius_columns(style.radius, names);
  add_color_columns(style.color, names);
  add_select_columns(style.select, names);
  add_select_columns(style.labels.select, names);
  add_select_columns(style.ghost, names);
  add_label_columns(style.labels, names);
  if (style.arrows) add_arrow_columns(style.arrows->names, names);
  add_outline_columns(style.outline_by, names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace boule
