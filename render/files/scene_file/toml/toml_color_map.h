#pragma once

#include <array>
#include <optional>

#include "render/files/particles/colors/color_map.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// The keys `map` and `range` of a table: colours for numbers.
struct ColorMapKeys {
  ColorMap map;
  std::optional<std::array<double, 2>> range;  ///< none: by the numbers themselves
};

/// Reads them: `map` is a name or an array of colours "#rrggbb", `range` two finite numbers, the
/// first below the second. Errors are reported through the table.
ColorMapKeys read_color_map(TomlTable& table);

/// Reads the colour under `key`, "#rrggbb" or three linear numbers from 0 to 1, as codes.
/// Precondition: the key is there.
SrgbColor read_color_codes(TomlTable& table, std::string_view key);

}  // namespace boule
