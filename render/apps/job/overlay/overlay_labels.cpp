#include "render/apps/job/overlay/overlay_labels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>

#include "core/math/geometry.h"
#include "render/renderer/block_tools.h"

namespace boule {
namespace {

/// Inside groups, points are those of the group.
bool is_of_scene(const ParticleFacts& facts) { return facts.table.starts_with("particles"); }

double raster_of(const RasterToFilm& map, double film) {
  return (film * map.extent - map.offset) / map.scale;
}

/// Where a camera shows particles.
class LabelPlaces {
 public:
  LabelPlaces(const CameraView& view, const PixelRect& rect) : view_(view), rect_(rect) {}

  [[nodiscard]] bool are_known() const {
    return view_.distortion.st == nullptr &&
           (view_.kind == CameraKind::pinhole || view_.kind == CameraKind::thin_lens ||
            view_.kind == CameraKind::orthographic);
  }

  /// Where a label is; none outside of the picture.
  [[nodiscard]] std::optional<OverlayLabel> of(const ParticleLabel& label,
                                               const Vec3d& origin) const {
    const Vec3d to = label.position - origin - view_.eye;
    const double depth = dot(to, view_.forward);
    const double size = view_.kind == CameraKind::orthographic ? 1 : depth;
    if (!(depth > 0)) return std::nullopt;
    const auto film = [&](const Vec3d& side) { return dot(to, side) / dot(side, side) / size; };
    const double x = raster_of(view_.film_x, film(view_.right)) - rect_.x0;
    const double y = raster_of(view_.film_y, film(view_.up)) - rect_.y0;
    if (!(x >= 0 && x < rect_.width() && y >= 0 && y < rect_.height())) return std::nullopt;
    const double right = raster_of(view_.film_x, 1 / length(view_.right) / size);
    const double pixels = std::fabs(right - raster_of(view_.film_x, 0));
    return OverlayLabel{x, y, label.radius * pixels, depth, label.radius, label.text};
  }

 private:
  const CameraView& view_;
  PixelRect rect_;
};

/// Whether something hides a label's particle at its middle. A bond of its own does not: it reaches
/// there, as thick as the ball of sticks is.
bool is_hidden(const OverlayLabel& label, const Renderer& renderer, BlockTools& tools) {
  constexpr double rounding = 1.001, of_bond = 3;  // radii
  const int x = renderer.rect().x0 + static_cast<int>(label.x);
  const int y = renderer.rect().y0 + static_cast<int>(label.y);
  const PixelRect pixel{x, y, x + 1, y + 1};
  AovChannels found({.id = true, .z = true}, pixel);
  tools.find_aovs(pixel, found);
  const auto channels = found.release();
  const auto id = std::get<std::vector<std::uint32_t>>(channels[0].samples).front();
  const auto z = double{std::get<std::vector<float>>(channels[1].samples).front()};
  const Geometry& geometry = renderer.scene().geometry;
  const bool is_capsule = id >= geometry.sphere_count() + geometry.plane_count();
  return z < label.depth - (is_capsule ? of_bond : rounding) * label.sphere;
}

}  // namespace

Result<std::vector<OverlayLabel>> seen_labels(const std::vector<ParticleFacts>& particles,
                                              const Vec3d& origin, Renderer& renderer) {
  std::vector<OverlayLabel> labels;
  const PixelRect rect = renderer.rect();
  const LabelPlaces places(renderer.scene().camera_view, rect);
  if (!has_labels(particles) || !places.are_known()) return labels;
  for (const ParticleFacts& facts : particles) {
    if (!is_of_scene(facts)) continue;
    for (const ParticleLabel& one : facts.labels) {
      if (auto place = places.of(one, origin)) labels.push_back(*std::move(place));
    }
  }
  std::atomic<bool> is_taken = false;
  const Status done = renderer.work([&](BlockTools& tools) {
    if (is_taken.exchange(true)) return;
    std::erase_if(labels, [&](const OverlayLabel& one) { return is_hidden(one, renderer, tools); });
  });
  if (!done) return done.error();
  std::stable_sort(labels.begin(), labels.end(),
                   [](const OverlayLabel& a, const OverlayLabel& b) { return a.depth < b.depth; });
  return labels;
}

bool has_labels(const std::vector<ParticleFacts>& particles) {
  return std::any_of(particles.begin(), particles.end(), [](const ParticleFacts& one) {
    return is_of_scene(one) && !one.labels.empty();
  });
}

}  // namespace boule
