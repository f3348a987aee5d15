#include "render/apps/job/particle_look.h"

#include <fmt/format.h>

#include <cstddef>

#include "render/apps/job/options/look_values.h"
#include "render/apps/job/options/option_values.h"
#include "render/files/particles/colors/color_map.h"

namespace boule {
namespace {

/// What a look adds to the particles. The figures are chosen by eye.
constexpr const char* paper = R"(
[background]
color = [0.45, 0.45, 0.45]    # light from everywhere
ambient = [0.3, 0.3, 0.3]     # what stands for it by method whitted
backdrop = "#ffffff"          # what is seen where nothing is

[[light]]                     # a soft one at the camera's upper left
type = "sphere"
relative_to = "camera"
center = [-0.7, 0.8, 0.0]
radius = 0.25
radiance = [20.0, 20.0, 20.0]

[image]
size = [1200, 900]
spp = 64
outline = 1

[render]
method = "path"
max_depth = 3
)";

constexpr const char* plain = R"(
[background]
backdrop = "#ffffff"          # what is seen where nothing is
ambient = [0.2, 0.2, 0.2]

[[light]]                     # at the camera's upper left
type = "directional"
relative_to = "camera"
direction = [0.5, -0.55, -0.7]
intensity = [0.5, 0.5, 0.5]

[[light]]                     # along the view
type = "directional"
relative_to = "camera"
direction = [0.0, 0.0, -1.0]
intensity = [0.2, 0.2, 0.2]

[image]
size = [1200, 900]
spp = 16
outline = 1

[render]
method = "whitted"
max_depth = 0
)";

constexpr const char* dark = R"(
[background]
color = [0.18, 0.19, 0.2]     # light from everywhere
ambient = [0.2, 0.2, 0.2]     # what stands for it by method whitted
backdrop = "#14161a"          # what is seen where nothing is

[[light]]                     # a soft one at the camera's upper left
type = "sphere"
relative_to = "camera"
center = [-0.7, 0.8, 0.0]
radius = 0.25
radiance = [29.0, 29.0, 29.0]

[image]
size = [1200, 900]
spp = 64

[render]
method = "path"
max_depth = 3
)";

constexpr const char* quick = R"(
[background]
backdrop = "#ffffff"          # what is seen where nothing is

[[light]]                     # in the eye, which sees no shadow of it
type = "point"
relative_to = "camera"

[image]
size = [1200, 900]
spp = 4

[render]
method = "whitted"
max_depth = 0
)";

const char* surroundings(const LookOptions& options) {
  if (options.quick) return quick;
  return options.look == Look::paper ? paper : options.look == Look::plain ? plain : dark;
}

/// A string of TOML, in quotes. Precondition: the text is UTF-8.
std::string toml_string(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      all += '\\';
      all += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      all += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      all += c;
    }
  }
  return all + "\"";
}

/// The shortest number that reads back as the same double.
std::string number(double value) { return fmt::format("{}", value); }

std::string vector(const Vec3d& v) {
  return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

void add_line(std::string& text, const char* key, const std::string& value) {
  text += std::string(key) + " = " + value + "\n";
}

/// A list of strings.
std::string list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + toml_string(text);
  return "[" + list + "]";
}

/// A map of colours: a name, or a list of colours, which have commas between them.
std::string map_text(const std::string& map) {
  return named_color_map(map) ? toml_string(map) : list(split(map, ','));
}

/// The keys that say which colours particles have. The table of a map comes last: what follows a
/// table's header belongs to it.
void add_color(std::string& text, const LookOptions& options) {
  const std::string& color = options.color;
  if (color.empty()) return;
  // What a column by itself is, numbers, names or colours, shows when it is read.
  if (options.map.empty() && !options.range) return add_line(text, "color", toml_string(color));
  text += "[particles.color]\n";
  add_line(text, "by", toml_string(color));
  if (!options.map.empty()) add_line(text, "map", map_text(options.map));
  if (options.range) {
    const auto& [least, largest] = *options.range;
    add_line(text, "range", "[" + number(least) + ", " + number(largest) + "]");
  }
}

/// A table in one line, { "O" = "crimson" }. Numbers stand as they are.
std::string inline_table(const std::vector<KindText>& kinds, bool are_numbers) {
  std::string table;
  for (const auto& [kind, value] : kinds) {
    table += table.empty() ? "{ " : ", ";
    table += toml_string(kind) + " = " + (are_numbers ? value : toml_string(value));
  }
  return table + " }";
}

void add_particles(std::string& text, const std::string& file, const LookOptions& options) {
  text += "\n[[particles]]\n";
  add_line(text, "file", toml_string(file));
  if (!options.format.empty()) add_line(text, "format", toml_string(options.format));
  if (!options.columns.empty()) add_line(text, "columns", list(options.columns));
  if (options.frame) add_line(text, "frame", std::to_string(*options.frame));
  if (options.water) add_line(text, "water", "true");
  if (!options.topology.empty()) add_line(text, "topology", toml_string(options.topology));
  if (!options.radius.empty()) {
    const bool is_number = parse_above_0(options.radius).has_value();
    add_line(text, "radius", is_number ? options.radius : toml_string(options.radius));
  }
  if (!options.radii.empty()) add_line(text, "radii", inline_table(options.radii, true));
  if (options.scale) add_line(text, "scale", number(*options.scale));
  if (options.style) add_line(text, "style", toml_string(name_of(*options.style)));
  if (!options.bonds.empty()) {
    const bool is_number = parse_above_0(options.bonds).has_value();
    add_line(text, "bonds", is_number ? options.bonds : toml_string(options.bonds));
  }
  if (options.bond_radius) add_line(text, "bond_radius", number(*options.bond_radius));
  if (!options.bond_color.empty()) add_line(text, "bond_color", toml_string(options.bond_color));
  if (!options.outline_by.empty()) add_line(text, "outline_by", toml_string(options.outline_by));
  if (options.cell_edges) add_line(text, "cell_edges", "true");
  if (options.axes) add_line(text, "axes", "true");
  if (!options.arrows.empty()) {
    const bool is_one = options.arrows.size() == 1;
    add_line(text, "arrows", is_one ? toml_string(options.arrows[0]) : list(options.arrows));
  }
  if (options.arrow_scale) add_line(text, "arrow_scale", number(*options.arrow_scale));
  if (!options.select.empty()) add_line(text, "select", toml_string(options.select));
  if (!options.ghost.empty()) add_line(text, "ghost", toml_string(options.ghost));
  if (options.opacity) add_line(text, "opacity", number(*options.opacity));
  if (!options.labels.empty()) add_line(text, "labels", toml_string(options.labels));
  if (!options.label_text.empty()) add_line(text, "label_text", list(options.label_text));
  if (options.wrap) add_line(text, "wrap", "true");
  if (options.unwrap) add_line(text, "unwrap", "true");
  if (options.boundary) add_line(text, "boundary", "true");
  if (options.replicate) {
    const auto& [a, b, c] = *options.replicate;
    add_line(text, "replicate", fmt::format("[{}, {}, {}]", a, b, c));
  }
  add_line(text, "material", "\"particles\"");
  if (!options.colors.empty()) add_line(text, "colors", inline_table(options.colors, false));
  if (!options.nan_color.empty()) add_line(text, "nan_color", toml_string(options.nan_color));
  add_color(text, options);
}

void add_camera(std::string& text, const LookOptions& options) {
  text += "\n[camera]\nfit = true\n";
  if (options.ortho) add_line(text, "type", "\"orthographic\"");
  if (options.view && options.view->direction) {
    add_line(text, "direction", vector(*options.view->direction));
  } else if (options.view) {
    add_line(text, "pose", toml_string(name_of(options.view->pose)));
  } else if (options.floor) {
    add_line(text, "pose", toml_string(name_of(FittedPose::upright)));
  }
  if (options.up) add_line(text, "up", vector(*options.up));
  if (options.roll != 0) add_line(text, "roll", number(options.roll));
  if (options.fov || !options.ortho) add_line(text, "fov", number(options.fov.value_or(20)));
  if (options.margin) add_line(text, "margin", number(*options.margin));
}

/// The material of a floor: near the colour of the background.
std::string floor_text(const LookOptions& options) {
  const bool is_dark = options.look == Look::dark;
  return std::string("\n[material.floor]\ncolor = ") +
         (is_dark ? "[0.08, 0.085, 0.09]\n" : "[0.9, 0.9, 0.9]\n");
}

void add_floor(std::string& text, const LookFloor& floor) {
  text += "\n[[plane]]\n";
  add_line(text, "point", vector(floor.point));
  add_line(text, "normal", vector(floor.up));
  add_line(text, "material", toml_string(floor_material));
}

void add_clips(std::string& text, const std::vector<ClipChoice>& clips) {
  for (const ClipChoice& clip : clips) {
    text += "\n[[clip]]\n";
    add_line(text, "point", vector(clip.point));
    add_line(text, "normal", vector(clip.normal));
  }
}

}  // namespace

std::string look_scene(const std::string& file, const LookOptions& options,
                       const std::optional<LookFloor>& floor) {
  std::string text = "schema = 1\n";
  add_particles(text, file, options);
  text += "\n[material.particles]          # their colours replace its own\ntype = \"plastic\"\n";
  text += "color = \"#7f98b8\"\n";
  if (options.floor) text += floor_text(options);
  add_camera(text, options);
  text += surroundings(options);
  if (floor) add_floor(text, *floor);
  add_clips(text, options.clip);
  return text;
}

}  // namespace boule
