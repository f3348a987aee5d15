#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/error.h"
#include "render/files/particle_file/text/frame_places.h"

namespace boule {

/// A section of a LAMMPS dump: "ITEM: ..." and the lines below it.
struct DumpSection {
  std::size_t header = 0;  ///< first byte of the line "ITEM: ..."
  std::size_t begin = 0;   ///< of the lines below it,
  std::size_t end = 0;     ///< which end before this byte
  std::uint64_t line = 0;  ///< of the first line below; 0: the frame has no such section
  std::uint64_t rows = 0;  ///< lines below
  [[nodiscard]] bool exists() const { return line != 0; }
  [[nodiscard]] std::uint64_t end_line() const { return line + rows; }  ///< the one behind it
};

/// Where a frame's sections are.
struct DumpFramePlace {
  DumpSection box, time, atoms;
};

struct DumpFrames : FramePlaces<DumpFramePlace> {
  double length_in_angstrom = 1;  ///< the unit that UNITS names
};

/// Finds all frames of a LAMMPS dump. Sections of a frame stand in any order; one that a frame has
/// already begins the next frame.
Result<DumpFrames> find_dump_frames(std::string_view text);

}  // namespace boule
