#include "render/files/scene_file/toml/toml_color_map.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/math/color_names.h"
#include "render/files/file/nearest_name.h"

namespace boule {
namespace {

ColorMap read_own_map(TomlTable& table) {
  std::vector<std::string> texts;
  table.read("map", texts);
  std::vector<SrgbColor> colors;
  for (const std::string& text : texts) {
    const auto color = parse_color(text);
    if (!color) table.report("map", no_color(text));
    colors.push_back(color.value_or(SrgbColor{}));
  }
  if (colors.empty()) {
    table.report("map", "expected the name of a map, or colours \"#rrggbb\"");
    return ColorMap();
  }
  return ColorMap(std::move(colors));
}

ColorMap read_named_map(TomlTable& table) {
  if (!table.has("map")) return ColorMap();
  std::string name;
  table.read("map", name);
  const auto map = named_color_map(name);
  if (!map) {
    table.report("map", "unknown " + quote(name) + ", expected " +
                            list_names({names<NamedColorMap>.begin(), names<NamedColorMap>.end()}) +
                            ", with _r for the reverse" + did_you_mean_map(name));
  }
  return map.value_or(ColorMap());
}

}  // namespace

ColorMapKeys read_color_map(TomlTable& table) {
  ColorMapKeys keys;
  keys.map = table.has_array("map") ? read_own_map(table) : read_named_map(table);
  if (!table.has("range")) return keys;
  auto& [least, largest] = keys.range.emplace();
  table.read("range", *keys.range);
  if (!std::isfinite(least) || !std::isfinite(largest)) {
    table.report("range", "must be finite");
  } else if (!(least < largest)) {
    table.report("range", "its first number must be below the second");
  }
  return keys;
}

SrgbColor read_color_codes(TomlTable& table, std::string_view key) {
  Color color;
  table.read(key, color);
  const auto [least, largest] = std::minmax({color.r, color.g, color.b});
  if (!(largest <= 1 && least >= 0)) {
    table.report(key, largest > 1 && largest <= 255
                          ? "must be from 0 to 1 in each component: colours are linear, 1 is white"
                          : "must be from 0 to 1 in each component");
  }
  return srgb_of(color);
}

}  // namespace boule
