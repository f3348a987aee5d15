#include "render/apps/job/scene_loader.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/optics/camera_builder.h"
#include "core/scene/instances.h"
#include "render/apps/job/options/camera_option.h"
#include "render/apps/job/overlay/legend_room.h"
#include "render/apps/job/particle_scene.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/fog.h"

namespace boule {
namespace {

/// Whether what frames choose for their colours is the same, whatever the map and its range are.
bool choose_the_same(const LookOptions& a, const LookOptions& b) {
  return a.color == b.color && a.map.empty() == b.map.empty() &&
         a.range.has_value() == b.range.has_value();
}

}  // namespace

SceneLoader::SceneLoader(const RenderJob& job, ParticleFileCache* files, std::uint64_t most,
                         const SceneData* data)
    : path_(job.scene),
      look_(job.look),
      camera_keys_(job.camera),
      frames_(!job.turn && job.frames && job.frames->count() > 1 ? job.frames : std::nullopt),
      interpolate_(job.interpolate),
      turn_(job.turn),
      size_(size_choice(job)),
      overlay_(job.overlay),
      most_(most),
      scheduler_(job.threads) {
  options_.polygons = job.polygons;
  options_.trust = job.trust;
  options_.data = data;
  options_.parallel_for = scheduler_.parallel_for();
  if (frames_ || turn_) options_.particle_files = files != nullptr ? files : &own_files_;
}

Result<LoadedScene> SceneLoader::load(std::optional<int> frame) {
  if (turn_) return load_turned(frame.value_or(0));
  std::optional<Result<LoadedScene>> loaded;
  if (frames_ && !choices_.are_made) {
    loaded = choose_for_series();
    if (!*loaded) {
      choices_ = {};
      return *std::move(loaded);
    }
    choices_.are_made = true;
  }
  if (!loaded || frame != frames_->first) loaded = read(frame);
  if (*loaded) use_choices(loaded->value());
  return *std::move(loaded);
}

Result<LoadedScene> SceneLoader::load_as(const LookOptions& look, std::optional<int> frame) {
  const LookOptions look_before = std::exchange(look_, look);
  const Choices before = choices_;
  if (!choose_the_same(look, look_before)) choices_ = {};
  auto loaded = load(frame);
  if (!loaded) {
    look_ = look_before;
    choices_ = before;
  }
  return loaded;
}

/// The one scene, before the camera of a step.
Result<LoadedScene> SceneLoader::load_turned(int step) {
  auto loaded = read(std::nullopt);
  if (!loaded) return loaded;
  Scene& scene = loaded.value().scene;
  if (!choices_.table) {
    keep_colors(loaded.value());
    auto table = Turntable::of(scene, size_.of(scene.image), options_.parallel_for);
    if (!table) return table.error();
    choices_.table = std::move(table).value();
  }
  scene.camera = choices_.table->at(360.0 * step / *turn_);
  return loaded;
}

/// The pictures of a series that show frames of its files.
FrameRange SceneLoader::whole_frames() const {
  FrameRange frames = *frames_;
  frames.step *= interpolate_;
  return frames;
}

/// Makes the choices of a series, and returns its first frame as it is with them.
Result<LoadedScene> SceneLoader::choose_for_series() {
  const auto count = static_cast<std::size_t>(whole_frames().count());
  std::vector<int> frames;
  SeriesSurvey survey(size_);
  {
    auto first = read(frames_->first);
    if (!first) return first;
    const std::uint64_t spheres = find_shown(first.value());
    if (!needs_others(first.value())) {
      keep_colors(first.value());
      choices_.box = bounds_without_outliers(first.value().scene);
      return first;
    }
    frames = surveyed_frames(whole_frames(), spheres, most_);
    // If it shows some, its origin is that of all.
    if (shows_particles(first.value())) survey.add(frames_->first, first.value(), choices_.floor);
  }
  survey = look_at(frames, std::move(survey));
  choices_.particles = survey.choices(count);
  if (survey.radii_differ()) survey = look_at(frames, SeriesSurvey(size_));  // with those of all
  keep_floor_and_camera(survey, frames.size());
  auto first = read(frames_->first);
  if (!first) return first;
  const int shown = survey.first_shown().value_or(frames_->first);
  if (shown == frames_->first) {
    keep_colors(first.value());
  } else if (const auto other = read(shown)) {
    keep_colors(other.value());
  }
  return first;
}

/// The first frame that shows particles says where points are counted from. Returns how many
/// spheres it has. A frame that cannot be read ends the search: its error is told when its picture
/// is made.
std::uint64_t SceneLoader::find_shown(const LoadedScene& first) {
  const std::uint64_t spheres = count_primitives(first.scene).spheres;
  choices_.origin = first.origin;
  if (shows_particles(first)) return spheres;
  choices_.origin.reset();
  for (const int number : surveyed_frames(whole_frames(), spheres, most_)) {
    const auto other = read(number);
    if (!other) break;
    if (!shows_particles(other.value())) continue;
    choices_.origin = other.value().origin;
    return std::max(spheres, count_primitives(other.value().scene).spheres);
  }
  choices_.origin = first.origin;
  return spheres;
}

/// A scene as it is by itself, but for the command line's camera, and the choices that are made
/// already.
Result<LoadedScene> SceneLoader::read(std::optional<int> frame) {
  auto loaded = read_file(frame);
  if (!loaded) return loaded;
  if (auto done = use_camera(camera_keys_, options_, loaded.value()); !done) return done.error();
  leave_legend_room(overlay_, size_, loaded.value());
  return loaded;
}

Result<LoadedScene> SceneLoader::read_file(std::optional<int> frame) {
  if (frame) {
    options_.between = static_cast<double>(*frame % interpolate_) / interpolate_;
    frame = *frame / interpolate_;
  }
  options_.frame = frame;
  options_.origin = choices_.origin;
  options_.choices = choices_.particles;
  const std::string path = frame ? frame_name(path_, *frame) : path_;
  if (!shows_particle_file(path)) return load_known(path, look_, options_);
  is_made_ = true;
  auto made = load_particle_scene(path_, look_, options_, choices_.floor);
  if (!made) return made.error();
  if (frames_ && !choices_.floor) choices_.floor = made.value().floor;
  return std::move(made).value().loaded;
}

bool SceneLoader::shows_particle_file(const std::string& path) const {
  const bool is_in_memory = options_.data != nullptr && options_.data->particles.contains(path);
  return is_in_memory || is_particle_input(path, look_);
}

/// Whether other frames may bring what is to be chosen once for all of them.
bool SceneLoader::needs_others(const LoadedScene& first) const {
  if (first.scene.packed) return false;
  if (!first.scene.camera || look_.floor) return true;
  return std::any_of(first.particles.begin(), first.particles.end(), [](const ParticleFacts& one) {
    return one.spheres == 0 || one.own.is_open();
  });
}

/// Reads those of these frames that a survey has not got yet. One that cannot be read ends that:
/// its error is told when its picture is made.
SeriesSurvey SceneLoader::look_at(const std::vector<int>& frames, SeriesSurvey survey) {
  for (std::size_t i = survey.size(); i < frames.size(); ++i) {
    const auto one = read(frames[i]);
    if (!one) break;
    survey.add(frames[i], one.value(), choices_.floor);
  }
  return survey;
}

void SceneLoader::keep_floor_and_camera(const SeriesSurvey& survey, std::size_t frames) {
  if (choices_.floor && survey.lowest()) {
    choices_.floor =
        floor_at(*survey.lowest(), choices_.floor->up, choices_.origin.value_or(Vec3d{}));
  }
  choices_.box = survey.bounds();
  choices_.camera = survey.camera();
  if (!choices_.camera || survey.size() < frames) return;
  const auto count = static_cast<std::size_t>(whole_frames().count());
  choices_.notes.push_back("the camera is fitted to " + survey.text(count) +
                           (survey.leaves_out() ? left_out_note : ""));
}

/// Keeps what colours mean in a scene that shows some, and in the rest of its series.
void SceneLoader::keep_colors(const LoadedScene& shown) {
  choices_.colors.clear();
  for (const ParticleFacts& facts : shown.particles) {
    choices_.colors.push_back(facts.colors);
    const ParticleChoices* const chosen = find_choices(choices_.particles, facts.table);
    if (chosen == nullptr || chosen->kinds.empty()) continue;
    auto& species = choices_.colors.back().species;
    species.clear();
    std::copy_if(chosen->kinds.begin(), chosen->kinds.end(), std::back_inserter(species),
                 [](const auto& kind) { return kind.count > 0; });
  }
}

/// Where fog begins and ends before the scene's camera, by the objects of all frames.
void SceneLoader::use_fog(Scene& scene) const {
  if (!choices_.box || !scene.camera) return;
  const CameraView view = build_camera(*scene.camera, scene.image.width, scene.image.height);
  const Fog fog = fog_of(scene.image, choices_.box, view);
  if (!(fog.from < fog.to)) return;
  scene.image.fog_from = static_cast<float>(fog.from);
  scene.image.fog_to = static_cast<float>(fog.to);
}

/// Gives a scene the camera, and the note of it to the first that is returned.
void SceneLoader::use_choices(LoadedScene& loaded) {
  if (!frames_) return keep_colors(loaded);
  const bool has_camera = loaded.scene.camera.has_value();
  if (!has_camera) loaded.scene.camera = choices_.camera;
  use_fog(loaded.scene);
  if (has_camera || !choices_.camera) return;
  std::move(choices_.notes.begin(), choices_.notes.end(), std::back_inserter(loaded.notes));
  choices_.notes.clear();
}

}  // namespace boule
