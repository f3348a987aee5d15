#include "render/apps/job/series_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/scene/instances.h"
#include "render/apps/job/particle_scene.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/outlying_spheres.h"

namespace boule {

std::vector<int> surveyed_frames(const FrameRange& range, std::uint64_t spheres,
                                 std::uint64_t most_spheres) {
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

bool shows_particles(const LoadedScene& loaded) {
  return loaded.particles.empty() ||
         std::any_of(loaded.particles.begin(), loaded.particles.end(),
                     [](const ParticleFacts& one) { return one.spheres > 0; });
}

void SeriesSurvey::add(int frame, const LoadedScene& loaded,
                       const std::optional<LookFloor>& floor) {
  ++frames_;
  for (const ParticleFacts& facts : loaded.particles) choices_[facts.table].add(facts.own);
  if (!first_shown_ && shows_particles(loaded)) first_shown_ = frame;
  const Scene& scene = loaded.scene;
  if (count_primitives(scene).finite() == 0) return;
  if (!fitter_) {
    pixels_ = size_.of(scene.image);
    fitter_.emplace(scene.fit, view_of(scene), pixels_.width, pixels_.height);
  }
  add_spheres(scene, *fitter_);
  add_near(scene);
  add_bounds(bounds_without_outliers(scene));
  if (!floor) return;
  const double lowest = *lowest_along(floor->up, loaded);
  lowest_ = std::min(lowest_.value_or(lowest), lowest);
}

/// Adds a frame to what is seen if those far from all others do not matter, once they make the rest
/// too small.
void SeriesSurvey::add_near(const Scene& scene) {
  const auto [width, height] = pixels_;
  std::optional<Scene> rest;
  if (may_be_specks(scene, fitter_->camera(), width, height)) {
    const auto median = median_sphere(scene);
    if (!median_) median_ = median;
    if (median) rest = without_outliers(scene, *median);
  }
  has_outliers_ = has_outliers_ || rest;
  const Scene& shown = rest ? *rest : scene;
  if (!near_) near_.emplace(shown.fit, view_of(shown), width, height);
  add_spheres(shown, *near_);
}

void SeriesSurvey::add_bounds(const SphereBounds& more) {
  const auto [low, high] = bounds_.value_or(more);
  const Vec3d &l = more.low, &h = more.high;
  bounds_ = {{std::min(low.x, l.x), std::min(low.y, l.y), std::min(low.z, l.z)},
             {std::max(high.x, h.x), std::max(high.y, h.y), std::max(high.z, h.z)}};
}

SeriesChoices SeriesSurvey::choices(std::size_t count) const {
  SeriesChoices all = choices_;
  for (auto& [table, one] : all) one.finish(text(count));
  return all;
}

bool SeriesSurvey::radii_differ() const {
  return std::any_of(choices_.begin(), choices_.end(),
                     [](const auto& one) { return one.second.radii_differ; });
}

std::optional<Camera> SeriesSurvey::camera() const {
  if (!fitter_) return std::nullopt;
  Camera camera = leaves_out() ? near_->camera() : fitter_->camera();
  return find_problem(camera) ? std::nullopt : std::optional(std::move(camera));
}

bool SeriesSurvey::leaves_out() const {
  return has_outliers_ && is_better_without(*median_, fitter_->camera(), near_->camera(),
                                            pixels_.width, pixels_.height);
}

std::string SeriesSurvey::text(std::size_t count) const {
  return frames_ == count ? fmt::format("all {} frames", count)
                          : fmt::format("{} of the {} frames", frames_, count);
}

}  // namespace boule
