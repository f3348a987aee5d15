#include "render/cli/view_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "render/cli/camera_option.h"
#include "render/cli/look_values.h"
#include "render/cli/particle_scene.h"
#include "render/packed/packed_file.h"
#include "render/particle_file/particle_file.h"
#include "render/scene_file/frame_name.h"

namespace boule::cli {
namespace {

const char* kind_of(const std::string& path, bool particles) {
  if (particles) return "particles";
  if (path.ends_with(".nff")) return "nff";
  if (is_packed_name(path)) return "packed";
  return path.ends_with(".npy") ? "spheres" : "toml";
}

std::string shell_word(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

std::string vector_text(const Vec3d& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

/// The options of particles that the page does not change.
std::string fixed_options(const LookOptions& look) {
  std::string text;
  if (look.look != Look::paper) text += " --look " + std::string(name_of(look.look));
  if (look.quick) text += " --quick";
  if (look.floor) text += " --floor";
  if (look.water) text += " --water";
  if (!look.format.empty()) text += " --input-format " + look.format;
  if (!look.columns.empty())
    text += " --columns " + shell_word(fmt::format("{}", fmt::join(look.columns, ",")));
  if (!look.radius.empty()) text += " --radius " + shell_word(look.radius);
  if (look.scale) text += fmt::format(" --scale {}", *look.scale);
  if (!look.select.empty()) text += " --select " + shell_word(look.select);
  if (look.up) text += " --up " + vector_text(*look.up);
  return text;
}

}  // namespace

ViewSource::ViewSource(const RenderCommand& command)
    : command_(command), scheduler_(command.threads) {
  options_.polygons = command.polygons;
  options_.trust = command.trust;
  options_.parallel_for = scheduler_.parallel_for();
  options_.particle_files = &files_;
  facts_.path = command.scene;
}

Status ViewSource::open() {
  const FrameRange range = command_.frames.value_or(FrameRange{0, 0, 1});
  if (command_.frames) facts_.frames = {range.first, range.last, range.step};
  facts_.numbered = command_.frames.has_value();
  facts_.first_frame = range.first;
  const std::string path =
      command_.frames ? frame_name(command_.scene, range.first) : command_.scene;
  const bool particles = is_particle_input(path, command_.look);
  if (!particles && !command_.look.first.empty()) return not_particles(path, command_.look.first);
  facts_.kind = kind_of(path, particles);
  facts_.look = {command_.look.color, command_.look.map, command_.look.range};
  if (particles) facts_.shared_options = fixed_options(command_.look);
  return particles && !command_.frames ? find_frames() : std::nullopt;
}

/// A trajectory becomes a series of all its frames, which begins with the one that was asked for.
Status ViewSource::find_frames() {
  auto made = load_particle_scene(command_.scene, command_.look, options_);
  if (!made) return made.error();
  const ParticleFacts& facts = made.value().loaded.particles.front();
  if (facts.frames < 2) return std::nullopt;
  facts_.frames = {0, static_cast<int>(facts.frames) - 1, 1};
  facts_.first_frame = static_cast<int>(facts.frame);
  return std::nullopt;
}

Result<LookOptions> ViewSource::look_with(const view::ParticleLook& look) const {
  LookOptions options = command_.look;
  if (!look.color.empty() && !parse_particle_color(look.color))
    return Diagnostic::about("color", "expected element, #rrggbb or a column");
  if (!look.map.empty() && !parse_map(look.map))
    return Diagnostic::about("map", "expected one of " + list_color_maps() + ", or colours");
  options.color = look.color;
  options.map = look.map;
  options.range = look.range;
  if (has_color_map(options.color)) return options;
  options.map.clear();  // what has no map needs none
  options.range.reset();
  return options;
}

Result<LoadedScene> ViewSource::load(const view::ParticleLook& look, int frame) {
  auto options = look_with(look);
  if (!options) return options.error();
  const ColorRanges before = options_.color_ranges;
  if (last_look_ && !(*last_look_ == look)) options_.color_ranges.clear();
  auto loaded = read(options.value(), frame);
  if (!loaded) {
    options_.color_ranges = before;
    return loaded;
  }
  if (!options_.origin) options_.origin = loaded.value().origin;
  if (options_.color_ranges.empty()) {
    KindColors ignored;  // a command for one frame could not tell them
    keep_colors(loaded.value().particles, options_.color_ranges, ignored);
  }
  last_look_ = look;
  if (auto bad = use_camera(command_.camera, options_.frame, loaded.value())) return *bad;
  return loaded;
}

Result<LoadedScene> ViewSource::read(const LookOptions& look, int frame) {
  const bool is_series = facts_.frames.has_value();
  const std::string path = command_.frames ? frame_name(command_.scene, frame) : command_.scene;
  options_.frame = is_series ? std::optional(frame) : std::nullopt;
  if (facts_.kind != "particles") return load_scene(path, options_);
  auto made = load_particle_scene(command_.frames ? command_.scene : path, look, options_);
  if (!made) return made.error();
  particles_ = made.value().loaded.particles.front();
  return std::move(made).value().loaded;
}

/// Read once: a picture needs few of the columns, and another frame has the same ones.
std::vector<view::NumberRange> ViewSource::columns() {
  if (columns_ || !particles_) return columns_.value_or(std::vector<view::NumberRange>{});
  columns_.emplace();
  const auto frame = read_all_columns(command_.look, *particles_, options_.parallel_for);
  if (!frame) return {};
  for (const NumberColumn& column : frame.value().numbers) {
    const ColumnExtent extent = extent_of(column);
    if (extent.least <= extent.largest)
      columns_->push_back({column.name, extent.least, extent.largest});
  }
  return *columns_;
}

std::string ViewSource::options_of(const view::ParticleLook& look, int frame) const {
  std::string text;
  if (command_.frames) {
    text += fmt::format(" --frames {}-{}", frame, frame);
  } else if (facts_.frames) {
    text += fmt::format(" --frame {}", frame);
  }
  if (facts_.kind != "particles") return text;
  if (!look.color.empty()) text += " --color " + shell_word(look.color);
  if (!has_color_map(look.color)) return text;
  if (!look.map.empty()) text += " --map " + shell_word(look.map);
  if (look.range) return text + fmt::format(" --range {},{}", (*look.range)[0], (*look.range)[1]);
  for (const auto& [table, range] : options_.color_ranges)
    return text + fmt::format(" --range {},{}", range[0], range[1]);
  return text;
}

}  // namespace boule::cli
