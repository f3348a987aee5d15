#include "render/cli/scene_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scene/instances.h"
#include "render/cli/camera_option.h"
#include "render/cli/particle_scene.h"
#include "render/cli/run_report.h"
#include "render/particle_file/particle_file.h"
#include "render/prepare/default_camera.h"
#include "render/scene_file/frame_name.h"

namespace boule::cli {
namespace {

/// The frames of a series that the camera is fitted to: all of them, or every so many if that
/// would be too much to read; the last in any case.
std::vector<int> fitted_frames(const FrameRange& range, std::uint64_t spheres) {
  constexpr std::uint64_t most_spheres = 50'000'000;  // read in about ten seconds
  constexpr std::size_t most_frames = 1000;
  const std::size_t most =
      std::clamp(static_cast<std::size_t>(most_spheres / std::max<std::uint64_t>(spheres, 1)),
                 std::size_t{2}, most_frames);
  const auto count = static_cast<std::size_t>(range.count());
  const std::size_t every = (count + most - 2) / (most - 1);
  std::vector<int> frames;
  for (std::size_t i = 0; i + 1 < count; i += count <= most ? 1 : every) {
    frames.push_back(range.first + static_cast<int>(i) * range.step);
  }
  frames.push_back(range.first + static_cast<int>(count - 1) * range.step);
  return frames;
}

/// False if there are particles, and all of them stay away.
bool shows_particles(const LoadedScene& loaded) {
  return loaded.particles.empty() ||
         std::any_of(loaded.particles.begin(), loaded.particles.end(),
                     [](const ParticleFacts& one) { return one.spheres > 0; });
}

/// Fits one camera, and one floor, to several scenes. The first one that has spheres says from
/// where they are seen.
class SeriesFitter {
 public:
  /// `size`: of the pictures, if the scenes do not say it.
  explicit SeriesFitter(const std::optional<Size>& size) : size_(size) {}

  void add(const LoadedScene& loaded, const std::optional<LookFloor>& floor) {
    const Scene& scene = loaded.scene;
    if (count_primitives(scene).spheres == 0) return;
    if (!fitter_) {
      fitter_.emplace(scene.fit, view_of(scene), size_ ? size_->width : scene.image.width,
                      size_ ? size_->height : scene.image.height);
    }
    add_spheres(scene, *fitter_);
    if (floor) lowest_ = std::min(lowest_, *lowest_along(floor->up, loaded));
  }

  /// None if there are no spheres, or if it would be wrong: the frames by themselves tell why.
  [[nodiscard]] std::optional<Camera> camera() const {
    if (!fitter_) return std::nullopt;
    Camera camera = fitter_->camera();
    return find_problem(camera) ? std::nullopt : std::optional(std::move(camera));
  }
  /// Of all spheres, along the floor's `up`.
  [[nodiscard]] double lowest() const { return lowest_; }

 private:
  std::optional<Size> size_;
  std::optional<CameraFitter> fitter_;
  double lowest_ = std::numeric_limits<double>::infinity();
};

}  // namespace

SceneLoader::SceneLoader(const RenderCommand& command)
    : path_(command.scene),
      look_(command.look),
      camera_keys_(command.camera),
      frames_(command.frames && command.frames->count() > 1 ? command.frames : std::nullopt),
      size_(command.size),
      scheduler_(command.threads) {
  options_.polygons = command.polygons;
  options_.trust = command.trust;
  options_.parallel_for = scheduler_.parallel_for();
  if (frames_) options_.particle_files = &files_;
}

Result<LoadedScene> SceneLoader::load(std::optional<int> frame) {
  if (is_first_ && frames_ && frame != frames_->first) {
    auto first = load(frames_->first);
    if (!first) return first;
  }
  auto loaded = read(frame);
  if (!loaded) return loaded;
  if (std::exchange(is_first_, false)) {
    if (frames_) {
      loaded = choose_for_series(std::move(loaded).value());
      if (!loaded) return loaded;
    } else {
      keep_choices(loaded.value());
    }
  }
  use_choices(loaded.value());
  return loaded;
}

/// Makes the choices of a series, and returns its first frame as it is with them. If that shows no
/// particles, the first one that does says where points are counted from.
Result<LoadedScene> SceneLoader::choose_for_series(LoadedScene first) {
  std::uint64_t spheres = count_primitives(first.scene).spheres;
  if (!shows_particles(first)) {
    for (const int number : fitted_frames(*frames_, spheres)) {
      const auto other = read(number);
      if (!other) break;  // the error is told when its picture is made
      if (!shows_particles(other.value())) continue;
      options_.origin = other.value().origin;
      spheres = std::max(spheres, count_primitives(other.value().scene).spheres);
      auto again = read(frames_->first);
      if (!again) return again;
      first = std::move(again).value();
      break;
    }
  }
  keep_choices(first);
  if (needs_others(first)) look_at_others(first, fitted_frames(*frames_, spheres));
  return first;
}

/// A scene as it is by itself, but for the command line's camera, and the choices that are made
/// already.
Result<LoadedScene> SceneLoader::read(std::optional<int> frame) {
  auto loaded = read_file(frame);
  if (!loaded) return loaded;
  if (auto bad = use_camera(camera_keys_, frame, loaded.value())) return *bad;
  return loaded;
}

Result<LoadedScene> SceneLoader::read_file(std::optional<int> frame) {
  options_.frame = frame;
  const std::string path = frame ? frame_name(path_, *frame) : path_;
  if (!is_particle_input(path, look_)) return load_known(path, look_, options_);
  is_made_ = true;
  auto made = load_particle_scene(path_, look_, options_, floor_);
  if (!made) return made.error();
  if (frames_ && !floor_) floor_ = made.value().floor;
  return std::move(made).value().loaded;
}

/// Keeps what a frame has chosen and those before it have not.
void SceneLoader::keep_choices(const LoadedScene& loaded) {
  if (!options_.origin) options_.origin = loaded.origin;
  KindColors& kinds = options_.kind_colors;
  colors_.resize(std::max(colors_.size(), loaded.particles.size()));
  for (std::size_t i = 0; i < loaded.particles.size(); ++i) {
    const ParticleFacts& facts = loaded.particles[i];
    if (!kinds.contains(facts.table)) colors_[i] = facts.colors;
  }
  keep_colors(loaded.particles, options_.color_ranges, kinds);
  for (std::size_t i = 0; i < loaded.particles.size(); ++i) {
    const auto known = kinds.find(loaded.particles[i].table);
    if (known != kinds.end()) colors_[i].species = known->second;
  }
}

/// Whether other frames may bring what is to be chosen once for all of them.
bool SceneLoader::needs_others(const LoadedScene& first) const {
  if (first.scene.packed) return false;
  if (!first.scene.camera || look_.floor) return true;
  return std::any_of(first.particles.begin(), first.particles.end(), [](const ParticleFacts& one) {
    return one.spheres == 0 || !one.colors.species.empty();
  });
}

/// Reads other frames of the series: fits the camera, and the height of the floor, to them, and
/// gives colours to what is not in the first. A frame that cannot be read ends that: its error is
/// told when its picture is made.
void SceneLoader::look_at_others(LoadedScene& first, const std::vector<int>& frames) {
  SeriesFitter fitter(size_);
  fitter.add(first, floor_);
  std::size_t read_frames = 1;
  for (const int number : frames) {
    if (number == frames_->first) continue;
    const auto other = read(number);
    if (!other) break;
    ++read_frames;
    keep_choices(other.value());
    fitter.add(other.value(), floor_);
  }
  if (floor_ && std::isfinite(fitter.lowest())) {
    floor_ = floor_at(fitter.lowest(), floor_->up, first.origin);
    first.scene.planes.clear();
    add_floor(*floor_, first);
  }
  if (first.scene.camera) return;
  camera_ = fitter.camera();
  if (!camera_ || read_frames < frames.size()) return;
  const auto count = static_cast<std::size_t>(frames_->count());
  first.notes.push_back(
      read_frames == count
          ? fmt::format("the camera is fitted to all {} frames", count)
          : fmt::format("the camera is fitted to {} of the {} frames", read_frames, count));
}

void SceneLoader::use_choices(LoadedScene& loaded) const {
  if (camera_ && !loaded.scene.camera) loaded.scene.camera = camera_;
}

ExitCode code_of_loading(const Diagnostic& error) {
  return error.key.starts_with("--") ? wrong_usage : invalid_input;
}

}  // namespace boule::cli
