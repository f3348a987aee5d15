#include "render/files/scene_file/toml/toml_document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "render/files/scene_file/toml/toml_syntax.h"

namespace boule {
namespace {

TextPlace place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlValue copy(const toml::node& node);

TomlMembers copy_members(const toml::table& table) {
  TomlMembers members;
  members.reserve(table.size());
  for (const auto& [key, value] : table) {
    members.push_back({std::string(key.str()), place_of(key.source()), copy(value)});
  }
  // toml++ sorts by name; errors and ids go by the order in the file.
  std::stable_sort(members.begin(), members.end(), [](const TomlMember& a, const TomlMember& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
  return members;
}

TomlArray copy_elements(const toml::array& array) {
  TomlArray elements;
  elements.reserve(array.size());
  for (const toml::node& element : array) elements.push_back(copy(element));
  return elements;
}

/// toml++'s tree as plain values in the order of the file; its readers need no toml++.
TomlValue copy(const toml::node& node) {
  TomlValue value{place_of(node.source()), TomlDate{}};
  if (const auto* table = node.as_table()) value.data = copy_members(*table);
  if (const auto* array = node.as_array()) value.data = copy_elements(*array);
  if (const auto* text = node.as_string()) value.data = text->get();
  if (const auto* integer = node.as_integer()) value.data = integer->get();
  if (const auto* number = node.as_floating_point()) value.data = number->get();
  if (const auto* boolean = node.as_boolean()) value.data = boolean->get();
  return value;
}

Diagnostic syntax_error(std::string_view text, const std::string& file,
                        const toml::parse_error& error) {
  const std::string_view description = error.description();
  const TextPlace reported = place_of(error.source());
  const TextPlace place = literal_place(text, reported, description);
  return {.message = "not valid TOML: " + without_prefix(description, "Error while parsing "),
          .key = key_on_line(text, place.line),
          .file = file,
          .line = place.line,
          .column = place.column};
}

}  // namespace

Result<TomlValue> parse_toml(std::string_view text, const std::string& file) {
  if (auto done = refuse_untrusted(text, file); !done) return done.error();
  const toml::parse_result result = toml::parse(text);
  if (!result) return syntax_error(text, file, result.error());
  return copy(result.table());
}

}  // namespace boule
