#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// Numbers that one name of Properties stands for: "pos:R:3".
struct XyzProperty {
  std::string name;
  char type = 'R';  ///< R(eal), I(nteger), S(tring), L(ogical)
  std::size_t count = 1;
};

/// What the second line of an extended XYZ frame says. A plain comment says nothing.
struct XyzComment {
  std::vector<XyzProperty> properties;  ///< empty: those of plain XYZ
  std::optional<ParticleCell> cell;
  std::optional<double> time;
};

/// Parses the line: KEY=VALUE, values bare or in "", '', {} or []. Errors have a column and a key.
Result<XyzComment> parse_xyz_comment(std::string_view line);

}  // namespace boule
