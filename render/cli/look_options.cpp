#include "render/cli/look_options.h"

#include <algorithm>
#include <limits>
#include <string>

#include "render/cli/look_values.h"
#include "render/cli/option_kinds.h"
#include "render/file/nearest_name.h"
#include "render/particle_file/particle_file.h"

namespace boule::cli {
namespace {

/// Which particles are spheres, and how large.
void add_spheres(CLI::App& app, LookOptions& look) {
  add_parsed(app, "--radius", look.radius, parse_radius,
             "a number above 0, vdw, covalent or a column", "R",
             "Radii: a number, vdw, covalent or a column (the file's, else vdw)");
  add_parsed(app, "--scale", look.scale, parse_above_0, "a number above 0", "S",
             "Times all radii (1)");
  add_parsed(app, "--select", look.select, parse_words, "such as \"type == 1 && x > 0\"", "EXPR",
             "Which particles are shown, such as \"type == 1 && x > 0\" (all)");
}

void add_colors(CLI::App& app, LookOptions& look) {
  add_parsed(app, "--color", look.color, parse_particle_color, "element, #rrggbb or a column", "C",
             "Colours: element, #rrggbb, a column or |v| of vx vy vz (the file's, else element)");
  add_parsed(app, "--map", look.map, parse_map,
             "one of " + list_color_maps() + " or colours such as #000000,#ffffff", "MAP",
             "Map of --color COLUMN: a name, or #rrggbb,#rrggbb (viridis)");
  add_parsed(app, "--range", look.range, parse_range, "A,B with A < B", "A,B",
             "What the map's ends stand for (1st to 99th percentile)");
}

void add_picture(CLI::App& app, LookOptions& look) {
  add_choice(app, "--look", look.look, choices<Look>(), "Light and background (paper)");
  app.add_flag("--quick", look.quick, "A sketch in place of a look: a headlight, 4 samples")
      ->excludes("--look");
  app.add_flag("--floor", look.floor, "A floor below the particles");
  const std::string directions = "x, -x, y, -y, z, -z or three numbers X,Y,Z";
  add_parsed(app, "--view", look.view, parse_direction, directions, "DIR",
             "The way the camera looks: x, -x ... or X,Y,Z (what shows the most)");
  add_parsed(app, "--up", look.up, parse_direction, directions, "DIR",
             "What is upward (z where the file has a cell, else y)");
}

}  // namespace

void add_file_options(CLI::App& app, LookOptions& look) {
  add_whole(app, "--frame", look.frame, std::numeric_limits<int>::min(),
            std::numeric_limits<int>::max(), "Frame of the file, from 0; -1 is the last (-1)");
  const auto formats = particle_formats();
  const auto parse_format = [formats](const std::string& text) {
    const bool known = std::find(formats.begin(), formats.end(), text) != formats.end();
    return known ? std::optional(text) : std::nullopt;
  };
  add_parsed(app, "--input-format", look.format, parse_format, "one of " + list_names(formats),
             "NAME", "Format of the file (by its ending, else its content)");
  add_parsed(app, "--columns", look.columns, parse_names, "names such as id,type,x,y,z", "NAMES",
             "Names for the columns: id,type,x,y,z; - is one to skip (the file's)");
  app.add_flag("--water", look.water, "PDB and mmCIF: with the molecules of water");
}

void add_look_options(CLI::App& app, LookOptions& look) {
  start_group(app, look_heading);
  add_file_options(app, look);
  add_picture(app, look);
  add_spheres(app, look);
  add_colors(app, look);
}

void add_shape_options(CLI::App& app, LookOptions& look) {
  start_group(app, look_heading);
  add_file_options(app, look);
  add_spheres(app, look);
}

std::optional<UsageError> check_look_options(const CLI::App& app, LookOptions& look) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() != look_heading || option->count() == 0) continue;
    look.first = "--" + option->get_lnames().front();
    break;
  }
  const std::string help = "boule " + app.get_name() + " --help";
  const bool has_map = may_have_color_map(look.color);
  if (!look.map.empty() && !has_map) return UsageError{"--map needs --color COLUMN", help};
  if (look.range && !has_map) return UsageError{"--range needs --color COLUMN", help};
  return std::nullopt;
}

}  // namespace boule::cli
