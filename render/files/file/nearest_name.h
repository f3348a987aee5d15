#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boule {

/// "; did you mean 'fov'?" where one of `known` is near enough to `name` to be a slip of the
/// keyboard (edit distance with swaps, at most a third of the name, at least 1), else "".
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& known);

/// The same for the names of colours (color_names()), in any case.
std::string did_you_mean_color(std::string_view name);

/// "'red1' is no colour, expected '#rrggbb' or a name of CSS; did you mean 'red'?".
std::string no_color(std::string_view text);

/// "'a', 'b' or 'c'".
std::string list_names(const std::vector<std::string_view>& names);

/// A user's name made safe for a dotted key path: control bytes escaped, cut to 40 characters.
std::string safe_name(std::string_view name);

}  // namespace boule
