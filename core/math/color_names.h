#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/math/srgb.h"

namespace boule {

/// A colour as people write it: "#rrggbb", or a name of CSS (Color Module Level 4, 6.1) in any
/// case: "crimson". None for other text. Throws std::bad_alloc.
std::optional<SrgbColor> parse_color(std::string_view text);

/// The names, in order.
std::vector<std::string_view> color_names();

}  // namespace boule
