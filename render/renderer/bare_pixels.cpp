#include "render/renderer/bare_pixels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "core/math/geometry.h"
#include "render/renderer/visit_primitives.h"

namespace boule {
namespace {

/// A range of raster or film coordinates.
struct Extent {
  double low, high;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Extent everywhere{-infinity, infinity};

/// One axis of the film of a pinhole or an orthographic camera.
class FilmAxis {
 public:
  /// `half`: CameraView::right or up. The picture has the raster coordinates low .. high.
  FilmAxis(const RasterToFilm& map, const Vec3d& half, double low, double high)
      : map_(map), unit_(normalize(half)), half_(length(half)) {
    const double a = film_of(low), b = film_of(high);
    seen_ = {std::min(a, b), std::max(a, b)};
  }

  /// The raster coordinates of a ball, whose middle is this way from the eye, by parallel rays.
  [[nodiscard]] Extent of_parallels(const Vec3d& way, double radius) const {
    const double along = dot(way, unit_);
    return raster_of(along - radius, along + radius);
  }

  /// The same by rays from the eye; none where the ball is certainly not in the picture. In the
  /// plane of this axis and the view, it is between two tangents of a disc.
  [[nodiscard]] std::optional<Extent> of_rays(const Vec3d& way, double depth, double radius) const {
    if (depth <= -radius) return std::nullopt;  // behind the eye
    const double along = dot(way, unit_);
    constexpr double clearly = 1.001;
    if (depth > clearly * radius) {
      const double squares = along * along + depth * depth;
      const double tangent = std::sqrt(squares - radius * radius);
      return raster_of((along * tangent - depth * radius) / (depth * tangent + along * radius),
                       (along * tangent + depth * radius) / (depth * tangent - along * radius));
    }
    const auto is_beyond = [&](double slope, double side) {
      return side * (along - slope * depth) > radius * std::sqrt(1 + slope * slope);
    };
    if (is_beyond(seen_.low, -1) || is_beyond(seen_.high, 1)) return std::nullopt;
    return everywhere;
  }

 private:
  [[nodiscard]] double film_of(double raster) const {
    return (raster * map_.scale + map_.offset) / map_.extent * half_;
  }
  [[nodiscard]] Extent raster_of(double low, double high) const {
    const auto raster = [this](double film) {
      return (film / half_ * map_.extent - map_.offset) / map_.scale;
    };
    const double a = raster(low), b = raster(high);
    return {std::min(a, b), std::max(a, b)};
  }

  RasterToFilm map_;
  Vec3d unit_;
  double half_;
  Extent seen_{};
};

/// What the camera's rays see where they miss everything, if that is one colour.
std::optional<Color> color_of_misses(const PreparedScene& scene) {
  if (scene.backdrop) return scene.backdrop;
  const auto* constant = std::get_if<ConstantBackground>(&scene.background);
  return constant != nullptr ? std::optional(constant->color) : std::nullopt;
}

/// Whether FilmAxis has the formulas of a camera.
bool is_plain(const CameraView& camera) {
  return (camera.kind == CameraKind::pinhole || camera.kind == CameraKind::orthographic) &&
         !camera.weighs && camera.distortion.st == nullptr;
}

/// So far from a pixel's middle samples lie, and a little for rounding.
constexpr double reach = 2;

/// The error of a ray's direction, which floats round, and of a primitive's place.
constexpr double error = 0x1p-21;

/// More cells are not worth their memory.
constexpr std::int64_t most_cells = std::int64_t{1} << 22;

}  // namespace

/// Counts the corners of rectangles, on several threads at once: the sums of these counts over all
/// cells before a cell are the numbers of rectangles that cover it.
class BarePixels::Counter {
 public:
  Counter(BarePixels& to, const CameraView& camera)
      : to_(to),
        camera_(camera),
        x_(camera.film_x, camera.right, to.rect_.x0 - reach, to.rect_.x1 + reach),
        y_(camera.film_y, camera.up, to.rect_.y0 - reach, to.rect_.y1 + reach) {}

  void add(const Sphere& sphere) {
    if (const auto place = place_of(sphere.center, sphere.radius)) count(*place);
  }
  /// In the picture it is between the balls around its ends.
  void add(const Capsule& capsule) {
    const auto a = place_of(capsule.a, capsule.radius), b = place_of(capsule.b, capsule.radius);
    count(a && b ? Place{around(a->x, b->x), around(a->y, b->y)} : Place{everywhere, everywhere});
  }

 private:
  /// The rectangle around a ball in the picture.
  struct Place {
    Extent x, y;
  };

  static Extent around(const Extent& a, const Extent& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
  }

  [[nodiscard]] std::optional<Place> place_of(const Vec3f& at, float size) const {
    const Vec3d center = vec_cast<double>(at), way = center - camera_.eye;
    const double radius = std::fabs(double{size}) + error * (length(way) + length(center));
    if (camera_.kind == CameraKind::orthographic)
      return Place{x_.of_parallels(way, radius), y_.of_parallels(way, radius)};
    const double depth = dot(way, camera_.forward);
    const auto x = x_.of_rays(way, depth, radius), y = y_.of_rays(way, depth, radius);
    return x && y ? std::optional(Place{*x, *y}) : std::nullopt;
  }

  void count(const Place& place) {
    const int x0 = cell(place.x.low - reach - to_.rect_.x0, to_.columns_),
              x1 = cell(place.x.high + reach - to_.rect_.x0, to_.columns_ - 1) + 1,
              y0 = cell(place.y.low - reach - to_.rect_.y0, to_.rows_),
              y1 = cell(place.y.high + reach - to_.rect_.y0, to_.rows_ - 1) + 1;
    add_at(x0, y0, 1);
    add_at(x1, y0, -1);
    add_at(x0, y1, -1);
    add_at(x1, y1, 1);
  }

  /// The cell of a raster coordinate less that of the first pixel, 0 .. `last`.
  [[nodiscard]] int cell(double raster, int last) const {
    const double cells = raster / (1 << to_.halvings_);
    if (!(cells > 0)) return 0;
    return cells < last ? static_cast<int>(cells) : last;
  }

  void add_at(int column, int row, std::int32_t count) {
    std::atomic_ref(to_.counts_[to_.index(column, row)])
        .fetch_add(count, std::memory_order_relaxed);
  }

  BarePixels& to_;
  const CameraView& camera_;
  FilmAxis x_, y_;
};

BarePixels::BarePixels(const PreparedScene& scene, const PixelRect& rect,
                       const ParallelFor& parallel_for)
    : rect_(rect) {
  const auto color = color_of_misses(scene);
  const bool has_planes = scene.planes.size() > scene.clips;
  if (!color || has_planes || !is_plain(scene.camera_view) || rect.empty()) return;
  color_ = *color;
  while (rect.area() >> (2 * halvings_) > most_cells) ++halvings_;
  const int side = 1 << halvings_;
  columns_ = (rect.width() + side - 1) / side;
  rows_ = (rect.height() + side - 1) / side;
  counts_.assign((static_cast<std::size_t>(columns_) + 1) * (static_cast<std::size_t>(rows_) + 1),
                 0);
  Counter counter(*this, scene.camera_view);
  visit_primitives(scene, parallel_for,
                   [&counter](const auto& primitive) { counter.add(primitive); });
  sum_up();
}

/// Turns counts at corners into counts of rectangles.
void BarePixels::sum_up() {
  for (int row = 0; row < rows_; ++row) {
    std::int32_t in_row = 0;
    for (int column = 0; column < columns_; ++column) {
      std::int32_t& here = counts_[index(column, row)];
      in_row += here;
      here = in_row + (row > 0 ? counts_[index(column, row - 1)] : 0);
    }
  }
}

}  // namespace boule
