#include "render/cli/scene_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/scene/instances.h"
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

}  // namespace

SceneLoader::SceneLoader(const RenderCommand& command)
    : path_(command.scene),
      look_(command.look),
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
    keep_choices(loaded.value());
    if (frames_) fit_series(loaded.value());
  }
  use_choices(loaded.value());
  return loaded;
}

/// A scene as it is by itself, but for the choices that are made already.
Result<LoadedScene> SceneLoader::read(std::optional<int> frame) {
  options_.frame = frame;
  const std::string path = frame ? frame_name(path_, *frame) : path_;
  if (!is_particle_input(path, look_)) {
    if (!look_.first.empty()) return not_particles(path, look_.first);
    return load_known(path, options_);
  }
  is_made_ = true;
  auto made = load_particle_scene(path_, look_, options_, floor_);
  if (!made) return made.error();
  if (frames_ && !floor_) floor_ = made.value().floor;
  return std::move(made).value().loaded;
}

void SceneLoader::keep_choices(const LoadedScene& first) {
  for (const ParticleFacts& facts : first.particles) colors_.push_back(facts.colors);
  if (!frames_) return;
  options_.color_ranges = color_ranges_of(first.particles);
  options_.kind_colors = kind_colors_of(first.particles);
  options_.origin = first.origin;
}

/// Fits the camera, and the height of the floor, to the series. A frame that cannot be read ends
/// the fitting: its error is told when its picture is made.
void SceneLoader::fit_series(LoadedScene& first) {
  if (first.scene.camera && !floor_) return;
  const Scene& scene = first.scene;
  const std::uint64_t count_first = count_primitives(scene).spheres;
  if (count_first == 0) return;
  CameraFitter fitter(scene.fit, view_of(scene), size_ ? size_->width : scene.image.width,
                      size_ ? size_->height : scene.image.height);
  add_spheres(scene, fitter);
  const Vec3d up = floor_ ? floor_->up : Vec3d{};
  double lowest = floor_ ? *lowest_along(up, first) : 0;
  const std::vector<int> frames = fitted_frames(*frames_, count_first);
  std::size_t fitted = 1;
  for (const int number : frames) {
    if (number == frames_->first) continue;
    auto other = read(number);
    if (!other) break;
    ++fitted;
    if (count_primitives(other.value().scene).spheres == 0) continue;
    add_spheres(other.value().scene, fitter);
    if (floor_) lowest = std::min(lowest, *lowest_along(up, other.value()));
  }
  if (floor_) {
    floor_ = floor_at(lowest, up, first.origin);
    first.scene.planes.clear();
    add_floor(*floor_, first);
  }
  if (scene.camera) return;
  camera_ = fitter.camera();
  if (find_problem(*camera_)) camera_.reset();  // the frames by themselves tell what is wrong
  if (fitted < frames.size()) return;
  const auto count = static_cast<std::size_t>(frames_->count());
  first.notes.push_back(
      fitted == count ? fmt::format("the camera is fitted to all {} frames", count)
                      : fmt::format("the camera is fitted to {} of the {} frames", fitted, count));
}

void SceneLoader::use_choices(LoadedScene& loaded) const {
  if (camera_ && !loaded.scene.camera) loaded.scene.camera = camera_;
}

Diagnostic not_particles(const std::string& path, const std::string& option) {
  return Diagnostic::about(
      option, "is of particle files, and " + quote(path) + " is none by its name or content");
}

ExitCode code_of_loading(const Diagnostic& error) {
  return error.key.starts_with("--") ? wrong_usage : invalid_input;
}

}  // namespace boule::cli
