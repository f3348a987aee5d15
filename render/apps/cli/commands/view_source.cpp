#include "render/apps/cli/commands/view_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "render/apps/job/options/look_values.h"
#include "render/apps/job/particle_scene.h"
#include "render/files/packed/packed_file.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/loaded/frame_name.h"

namespace boule::cli {
namespace {

const char* kind_of(const std::string& path, bool particles) {
  if (particles) return "particles";
  if (path.ends_with(".nff")) return "nff";
  if (is_packed_name(path)) return "packed";
  return path.ends_with(".npy") ? "spheres" : "toml";
}

/// The options of particles that the page does not change, as they were given.
std::string fixed_options(const LookOptions& look) {
  constexpr const char* changed[] = {"color", "map",  "range", "ghost", "opacity", "outline-by",
                                     "frame", "view", "roll",  "ortho", "fov",     "margin"};
  std::string text;
  for (const auto& [name, value] : look.given) {
    if (std::find(std::begin(changed), std::end(changed), name) != std::end(changed)) continue;
    text += " --" + name;
    if (!value.empty()) text += " " + shell_word(value);
  }
  return text;
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

ViewSource::ViewSource(const RenderJob& job) : job_(job), scheduler_(job.threads) {
  facts_.path = job.scene;
}

Status ViewSource::open() {
  const FrameRange range = job_.frames.value_or(FrameRange{0, 0, 1});
  if (job_.frames) facts_.frames = {range.first, range.last, range.step};
  facts_.numbered = job_.frames.has_value();
  facts_.first_frame = range.first;
  const std::string path = job_.frames ? frame_name(job_.scene, range.first) : job_.scene;
  const bool particles = is_particle_input(path, job_.look);
  if (!particles && !job_.look.first.empty()) return not_particles(path, job_.look.first);
  facts_.kind = kind_of(path, particles);
  const LookOptions& look = job_.look;
  facts_.look = {look.color, look.map, look.range, look.ghost, look.opacity, look.outline_by};
  if (particles) facts_.shared_options = fixed_options(job_.look);
  if (auto done = particles && !job_.frames ? find_frames() : Status(); !done) return done;
  make_loader();
  return {};
}

void ViewSource::make_loader() {
  constexpr std::uint64_t most_spheres = 5'000'000;  // read in about a second
  RenderJob job = job_;
  if (facts_.frames) {
    const auto [first, last, step] = *facts_.frames;
    job.frames = FrameRange{first, last, step};
    job.look.frame.reset();  // it is shown first, and is one of them
  }
  loader_ = std::make_unique<SceneLoader>(job, &files_, most_spheres);
}

/// A trajectory becomes a series of all its frames, which begins with the one that was asked for.
Status ViewSource::find_frames() {
  SceneFileOptions options;
  options.parallel_for = scheduler_.parallel_for();
  options.particle_files = &files_;
  auto made = load_particle_scene(job_.scene, job_.look, options);
  if (!made) return made.error();
  const ParticleFacts& facts = made.value().loaded.particles.front();
  if (facts.frames < 2) return {};
  facts_.frames = {0, static_cast<int>(facts.frames) - 1, 1};
  facts_.first_frame = static_cast<int>(facts.frame);
  return {};
}

Result<LookOptions> ViewSource::look_with(const view::ParticleLook& look) const {
  LookOptions options = job_.look;
  if (facts_.frames) options.frame.reset();
  if (!look.color.empty() && !parse_particle_color(look.color))
    return Diagnostic::about("color", "expected element, #rrggbb or a column");
  if (!look.map.empty() && !parse_map(look.map))
    return Diagnostic::about("map", "expected one of " + list_color_maps() + ", or colours");
  options.color = look.color;
  options.map = look.map;
  options.range = look.range;
  options.ghost = look.ghost;
  options.opacity.reset();
  if (!look.ghost.empty()) options.opacity = look.opacity;  // it is refused without any
  options.outline_by = look.outline_by;
  if (has_color_map(options.color)) return options;
  options.map.clear();  // what has no map needs none
  options.range.reset();
  return options;
}

Result<LoadedScene> ViewSource::load(const view::ParticleLook& look, int frame) {
  auto options = look_with(look);
  if (!options) return options.error();
  auto loaded =
      loader_->load_as(options.value(), facts_.frames ? std::optional(frame) : std::nullopt);
  if (!loaded || facts_.kind != "particles") return loaded;
  particles_ = loaded.value().particles.front();
  // In a series fog has the depths of its first camera, but this one moves.
  ImageSettings& image = loaded.value().scene.image;
  image.fog_from.reset();
  image.fog_to.reset();
  return loaded;
}

/// Read once: a picture needs few of the columns, and another frame has the same ones.
std::vector<view::NumberRange> ViewSource::columns() {
  if (columns_ || !particles_) return columns_.value_or(std::vector<view::NumberRange>{});
  columns_.emplace();
  const auto frame = read_all_columns(job_.look, *particles_, scheduler_.parallel_for());
  if (!frame) return {};
  for (const NumberColumn& column : frame.value().numbers) {
    const ColumnExtent extent = column_extent(column);
    if (extent.least <= extent.largest)
      columns_->push_back({column.name, extent.least, extent.largest});
  }
  return *columns_;
}

std::string ViewSource::options_of(const view::ParticleLook& look, int frame) const {
  std::string text;
  if (job_.frames) {
    text += fmt::format(" --frames {}-{}", frame, frame);
  } else if (facts_.frames) {
    text += fmt::format(" --frame {}", frame);
  }
  if (facts_.kind != "particles") return text;
  text += radius_option();
  if (!look.ghost.empty()) {
    text += " --ghost " + shell_word(look.ghost);
    if (look.opacity) text += fmt::format(" --opacity {}", *look.opacity);
  }
  if (!look.outline_by.empty()) text += " --outline-by " + shell_word(look.outline_by);
  if (!look.color.empty()) text += " --color " + shell_word(look.color);
  if (!has_color_map(look.color)) return text;
  if (!look.map.empty()) text += " --map " + shell_word(look.map);
  if (look.range) return text + fmt::format(" --range {},{}", (*look.range)[0], (*look.range)[1]);
  const auto& colors = loader_->colors();
  if (!facts_.frames || colors.empty() || !colors.front().scale) return text;
  const auto& range = colors.front().scale->range;
  return text + fmt::format(" --range {},{}", range[0], range[1]);
}

/// The radius that a series has chosen for all particles: a frame by itself might choose another.
std::string ViewSource::radius_option() const {
  const SeriesChoices& all = loader_->particle_choices();
  if (all.empty() || !job_.look.radius.empty()) return {};
  const ParticleChoices& chosen = all.begin()->second;
  if (chosen.particles == 0 || chosen.most_are_elements()) return {};
  return fmt::format(" --radius {}", chosen.typical_radius());
}

}  // namespace boule::cli
