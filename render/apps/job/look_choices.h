#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "render/apps/job/choice.h"
#include "render/apps/job/look_values.h"
#include "render/apps/job/particle_look.h"

namespace boule {

namespace heading {

/// What is read of a file of particles, how its picture looks, which particles are spheres and how
/// large, and their colours.
inline constexpr const char* particle_file = "file";
inline constexpr const char* look = "look";
inline constexpr const char* spheres = "spheres";
inline constexpr const char* colors = "colors";

}  // namespace heading

/// The options of LookOptions, in the order of the help.
inline auto look_choices() {
  using L = LookOptions;
  using detail::choice;
  constexpr const char* directions = "x, -x, y, -y, z, -z or three numbers X,Y,Z";
  constexpr const char* above_0 = "a number above 0";
  constexpr WholeRule any_frame{.low = std::numeric_limits<int>::min(),
                                .high = std::numeric_limits<int>::max()};
  using namespace heading;
  return std::tuple{
      choice<L>(particle_file, "frame", &L::frame, any_frame, "N",
                "Frame of the file, from 0; -1 is the last (-1)"),
      choice<L>(particle_file, "input_format", &L::format,
                TextRule{parse_particle_format, "one of " + list_particle_formats()}, "NAME",
                "Format of the file (by its ending, else its content)"),
      choice<L>(particle_file, "columns", &L::columns,
                TextRule{parse_names, "names such as id,type,x,y,z"}, "NAMES",
                "Names for the columns: id,type,x,y,z; - is one to skip (the file's)"),
      choice<L>(particle_file, "water", &L::water, FlagRule{}, "",
                "PDB and mmCIF: with the molecules of water"),
      choice<L>(look, "look", &L::look, NameRule{}, "", "Light and background (paper)"),
      choice<L>(look, "quick", &L::quick, FlagRule{}, "",
                "A sketch in place of a look: a headlight, 4 samples"),
      choice<L>(look, "floor", &L::floor, FlagRule{}, "", "A floor below the particles"),
      choice<L>(look, "view", &L::view, TextRule{parse_direction, directions}, "DIR",
                "The way the camera looks: x, -x ... or X,Y,Z (what shows the most)"),
      choice<L>(look, "up", &L::up, TextRule{parse_direction, directions}, "DIR",
                "What is upward (z where the file has a cell, else y)"),
      choice<L>(spheres, "radius", &L::radius,
                TextRule{parse_radius, "a number above 0, vdw, covalent or a column"}, "R",
                "Radii: a number, vdw, covalent or a column (the file's, else vdw)"),
      choice<L>(spheres, "scale", &L::scale, TextRule{parse_above_0, above_0}, "S",
                "Times all radii (1)"),
      choice<L>(spheres, "select", &L::select,
                TextRule{parse_words, "such as \"type == 1 && x > 0\""}, "EXPR",
                "Which particles are shown, such as \"type == 1 && x > 0\" (all)"),
      choice<L>(
          colors, "color", &L::color,
          TextRule{parse_particle_color, "element, #rrggbb or a column"}, "C",
          "Colours: element, #rrggbb, a column or |v| of vx vy vz (the file's, else element)"),
      choice<L>(colors, "map", &L::map,
                TextRule{parse_map,
                         "one of " + list_color_maps() + " or colours such as #000000,#ffffff"},
                "MAP", "Map of --color COLUMN: a name, or #rrggbb,#rrggbb (viridis)"),
      choice<L>(colors, "range", &L::range, TextRule{parse_range, "A,B with A < B"}, "A,B",
                "What the map's ends stand for (1st to 99th percentile)"),
  };
}

}  // namespace boule
