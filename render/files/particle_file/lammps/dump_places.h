#pragma once

#include <cstddef>
#include <cstdint>

#include "render/files/particle_file/text/frame_places.h"

namespace boule {

/// Where a frame of a yaml or binary dump begins.
struct DumpPlace {
  std::size_t begin = 0;   ///< its first byte
  std::uint64_t line = 0;  ///< the line of that byte; 0: it has no lines
};

/// All frames of such a dump.
struct DumpPlaces : FramePlaces<DumpPlace> {
  double length_in_angstrom = 1;  ///< the unit that the first frame with a unit names
};

}  // namespace boule
