#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "render/apps/job/options/choice.h"
#include "render/apps/job/options/look_values.h"
#include "render/apps/job/particle_look.h"

namespace boule {

namespace heading {

/// What is read of a file of particles, how its picture looks, which particles are spheres and how
/// large, their colours, and what is drawn besides them.
inline constexpr const char* particle_file = "file";
inline constexpr const char* look = "look";
inline constexpr const char* spheres = "spheres";
inline constexpr const char* colors = "colors";
inline constexpr const char* bonds = "bonds";

}  // namespace heading

namespace detail {

inline auto file_and_view_choices() {
  using L = LookOptions;
  constexpr const char* directions = "x, -x, y, -y, z, -z, iso or three numbers X,Y,Z";
  constexpr WholeRule any_frame{.low = std::numeric_limits<int>::min(),
                                .high = std::numeric_limits<int>::max()};
  using namespace heading;
  return std::tuple{
      choice<L>(particle_file, "frame", &L::frame, any_frame, "N",
                "Frame of the file, from 0; -1 is the last (-1)"),
      choice<L>(
          particle_file, "input_format", &L::format,
          TextRule{parse_particle_format, "one of " + list_particle_formats(), ',', hint_format},
          "NAME", "Format of the file (by its ending, else its content)"),
      choice<L>(particle_file, "columns", &L::columns,
                TextRule{parse_names, "names such as id,type,x,y,z"}, "NAMES",
                "Names for the columns: id,type,x,y,z; - is one to skip (the file's)"),
      choice<L>(particle_file, "water", &L::water, FlagRule{}, "",
                "PDB and mmCIF: with the molecules of water"),
      choice<L>(particle_file, "topology", &L::topology,
                TextRule{parse_words, "the name of a file"}, "FILE",
                "A file that tells what the particles are, such as a PSF for a DCD"),
      choice<L>(look, "look", &L::look, NameRule{}, "", "Light and background (paper)"),
      choice<L>(look, "quick", &L::quick, FlagRule{}, "",
                "A sketch in place of a look: a headlight, 4 samples"),
      choice<L>(look, "floor", &L::floor, FlagRule{}, "", "A floor below the particles"),
      choice<L>(
          look, "clip", &L::clip,
          TextRule{parse_clip,
                   "what is kept, such as x<5, z>=-2 or 1,1,0<3, with ; between several", ';'},
          "WHERE",
          "Cut particles and bonds by planes, with flat caps, such as \"x<5\", which keeps "
          "that, or \"x<5;1,1,0>2\""),
      choice<L>(
          look, "view", &L::view,
          TextRule{parse_view, std::string("principal, upright, ") + directions, ',', hint_view},
          "DIR",
          "The way the camera looks: x, -x ... iso, X,Y,Z; by principal axes; or upright, which "
          "shows the most (principal for molecules without a lattice, else upright)"),
      choice<L>(look, "up", &L::up, TextRule{parse_direction, directions}, "DIR",
                "What is upward (z where the file has a cell, else y)"),
      choice<L>(look, "roll", &L::roll, rule::from_to(-360, 360), "DEG",
                "Turn the picture counter-clockwise (0)"),
      choice<L>(look, "ortho", &L::ortho, FlagRule{}, "",
                "An orthographic camera, whose parallels stay parallel"),
      choice<L>(look, "fov", &L::fov, rule::acute_view, "DEG",
                "Field of view along the shorter side (20)"),
      choice<L>(look, "margin", &L::margin, rule::margin, "X",
                "Left free at each edge, as a share of the picture's side (0.05)"),
  };
}

inline auto sphere_choices() {
  using L = LookOptions;
  using namespace heading;
  constexpr const char* above_0 = "a number above 0";
  return std::tuple{
      choice<L>(spheres, "radius", &L::radius,
                TextRule{parse_radius, "a number above 0, vdw, covalent, ionic or a column"}, "R",
                "Radii: a number, vdw, covalent, ionic or a column (the file's, else vdw)"),
      choice<L>(spheres, "radii", &L::radii,
                TextRule{parse_kind_radii, "KIND=RADIUS,... with radii above 0, each kind once"},
                "LIST", "Radii of species, such as Na=1.02,Cl=1.81 (those of --radius)"),
      choice<L>(spheres, "scale", &L::scale, TextRule{parse_above_0, above_0}, "S",
                "Times all radii (1)"),
      choice<L>(spheres, "select", &L::select,
                TextRule{parse_words, "such as \"type == 1 && x > 0\""}, "EXPR",
                "Which particles are shown, such as \"type == 1 && x > 0\" (all)"),
      choice<L>(
          spheres, "ghost", &L::ghost, TextRule{parse_words, "such as \"chain != 'L'\""}, "EXPR",
          "Which particles are ghosts, which you see through, such as \"chain != 'L'\" (none)"),
      choice<L>(spheres, "opacity", &L::opacity, rule::from_to(0, 1), "X",
                "How much ghosts hide, 0 to 1 (0.2)"),
      choice<L>(spheres, "labels", &L::labels, TextRule{parse_words, "such as \"name == 'CA'\""},
                "EXPR",
                "Which particles have a text on the picture, such as \"name == 'CA'\" (none)"),
      choice<L>(spheres, "label_text", &L::label_text,
                TextRule{parse_names, "names of columns such as resname,resid"}, "NAMES",
                "Columns of that text, such as resname,resid (name, else species, else a number)"),
      choice<L>(spheres, "wrap", &L::wrap, FlagRule{}, "",
                "Move particles into the cell, along its periodic edges"),
      choice<L>(spheres, "unwrap", &L::unwrap, FlagRule{}, "",
                "Whole molecules: move what is bonded through a face of the cell together"),
      choice<L>(spheres, "boundary", &L::boundary, FlagRule{}, "",
                "Repeat particles on the faces of the cell on the opposite faces"),
      choice<L>(spheres, "replicate", &L::replicate,
                TextRule{parse_replicate, "AxBxC, whole numbers from 1 on, such as 2x2x1", 'x'},
                "AxBxC", "Periodic images along the edges of the cell (1x1x1)"),
  };
}

inline auto color_choices() {
  using L = LookOptions;
  using namespace heading;
  return std::tuple{
      choice<L>(
          colors, "color", &L::color,
          TextRule{parse_particle_color, "element, a colour or a column"}, "C",
          "Colours: element, one such as #rrggbb or teal, a column, |v| of vx vy vz (the file's, "
          "else element)"),
      choice<L>(
          colors, "colors", &L::colors,
          TextRule{parse_kind_colors, "KIND=COLOR,... with #rrggbb or names of CSS, each kind once",
                   ',', hint_kind_colors},
          "LIST", "Colours of kinds, such as O=crimson,7=#336699 (those of --color)"),
      choice<L>(colors, "map", &L::map,
                TextRule{parse_map,
                         "one of " + list_color_maps() +
                             " or colours such as #000000,white; _r behind a name reverses it",
                         ',', hint_map},
                "MAP",
                "Map of --color COLUMN: a name, NAME_r for its reverse, or colours such as "
                "navy,#ffffff (viridis)"),
      choice<L>(colors, "range", &L::range, TextRule{parse_range, "A,B with A < B"}, "A,B",
                "What the map's ends stand for (1st to 99th percentile)"),
      choice<L>(colors, "nan_color", &L::nan_color,
                TextRule{parse_one_color, "a colour such as #ffffff or silver", ',', hint_color},
                "COLOR", "Colour of particles whose number or text is missing (#a0a0a0)"),
  };
}

inline auto bond_choices() {
  using L = LookOptions;
  using namespace heading;
  constexpr const char* above_0 = "a number above 0";
  return std::tuple{
      choice<L>(bonds, "style", &L::style, NameRule{}, "",
                "Spheres that fill space, balls and sticks, or sticks (by the file)"),
      choice<L>(
          bonds, "bonds", &L::bonds,
          TextRule{parse_bonds, "a number above 0 or one of " + list_bond_rules(), ',', hint_bonds},
          "RULE",
          "Bonds: auto, of the file, by distance, contacts, none, or a number: all that are "
          "nearer (auto with sticks, else none)"),
      choice<L>(bonds, "bond_radius", &L::bond_radius, TextRule{parse_above_0, above_0}, "R",
                "Radius of bonds and arrows (by the style)"),
      choice<L>(bonds, "cell_edges", &L::cell_edges, FlagRule{}, "", "With the edges of the cell"),
      choice<L>(bonds, "axes", &L::axes, FlagRule{}, "",
                "With lines along x, y and z, red, green and blue"),
      choice<L>(bonds, "arrows", &L::arrows,
                TextRule{parse_arrows, "three columns such as fx,fy,fz, or f for them"}, "COLUMNS",
                "An arrow at each particle: three columns such as fx,fy,fz, or f for them"),
      choice<L>(bonds, "arrow_scale", &L::arrow_scale, TextRule{parse_above_0, above_0}, "S",
                "Times the vectors of --arrows (1)"),
      choice<L>(bonds, "outline_by", &L::outline_by,
                TextRule{parse_words, "one of " + list_outline_rules() + ", or a column"}, "RULE",
                "Outlines around each object, molecule, chain, residue, kind or group of a column, "
                "and where the depth jumps; depth: there only (depth with sticks, else object)"),
      choice<L>(bonds, "bond_color", &L::bond_color,
                TextRule{parse_one_color, "a colour such as #ffffff or silver", ',', hint_color},
                "COLOR", "Colour of all bonds (half bonds have their particles')"),
  };
}

}  // namespace detail

/// The options of LookOptions, in the order of the help.
inline auto look_choices() {
  return std::tuple_cat(detail::file_and_view_choices(), detail::sphere_choices(),
                        detail::color_choices(), detail::bond_choices());
}

}  // namespace boule
