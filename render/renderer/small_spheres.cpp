#include "render/renderer/small_spheres.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "render/prepare/prepared_scene.h"
#include "render/prepare/projection.h"
#include "render/renderer/visit_primitives.h"

namespace boule {
namespace {

constexpr double largest_radius = 0.75;  // pixels

/// The pixel of a raster coordinate, low .. high; low for NaN.
int pixel_at(double raster, int low, int high) {
  if (!(raster > low)) return low;
  return raster < high ? static_cast<int>(raster) : high;
}

}  // namespace

/// Marks pixels, on several threads at once.
class SmallSpheres::Marker {
 public:
  Marker(SmallSpheres& to, const CameraView& camera, int width)
      : to_(to), projection_(camera, width), rect_(to.rect_) {}

  void add(const Sphere& sphere) {
    const auto disc = projection_.of(sphere);
    if (disc && is_small(*disc)) mark(*disc, 0);
  }
  void add(const Capsule& capsule) {
    constexpr int most_halvings = 40;
    add_part(vec_cast<double>(capsule.a), vec_cast<double>(capsule.b), capsule.radius,
             most_halvings);
  }
  [[nodiscard]] bool any() const { return any_; }

 private:
  static bool is_small(const Disc& disc) { return disc.radius <= largest_radius; }

  /// A part of a capsule, between two points of its segment. It is halved until the discs around
  /// them are near each other, or no disc between them is small or in the picture.
  void add_part(const Vec3d& a, const Vec3d& b, float radius, int halvings) {
    constexpr double near = 0.5, between = 0.36;  // so far are pixels from a disc, at most
    const auto disc_at = [&](const Vec3d& point) {
      return projection_.of({vec_cast<float>(point), radius, {}});
    };
    const auto first = disc_at(a), last = disc_at(b);
    if (!first && !last) return;
    // Nothing between two points is farther away than both.
    if (first && last && !is_small(*first) && !is_small(*last)) return;
    if (first && last && projection_.keeps_lines() && are_beside(*first, *last)) return;
    const bool are_near = first && last && std::fabs(first->x - last->x) <= near &&
                          std::fabs(first->y - last->y) <= near;
    if (are_near || halvings == 0) {
      for (const auto& disc : {first, last}) {
        if (disc && is_small(*disc)) mark(*disc, between);
      }
      return;
    }
    const Vec3d middle = a * 0.5 + b * 0.5;
    add_part(a, middle, radius, halvings - 1);
    add_part(middle, b, radius, halvings - 1);
  }

  /// Whether the line between two discs is outside the picture, on one side of it.
  [[nodiscard]] bool are_beside(const Disc& one, const Disc& other) const {
    const double most = 2 + std::max(one.reach, other.reach);
    const auto are_out = [most](double p, double q, int low, int high) {
      return std::max(p, q) < low - most || std::min(p, q) > high + most;
    };
    return are_out(one.x, other.x, rect_.x0, rect_.x1) ||
           are_out(one.y, other.y, rect_.y0, rect_.y1);
  }

  /// The pixels that a disc touches, or comes so near to.
  void mark(const Disc& disc, double distance) {
    const double reach = disc.reach + distance;
    const int x1 = pixel_at(disc.x + reach + 1, rect_.x0, rect_.x1),
              y1 = pixel_at(disc.y + reach + 1, rect_.y0, rect_.y1);
    for (int y = pixel_at(disc.y - reach, rect_.y0, rect_.y1); y < y1; ++y) {
      for (int x = pixel_at(disc.x - reach, rect_.x0, rect_.x1); x < x1; ++x) {
        any_.store(true, std::memory_order_relaxed);
        std::atomic_ref(to_.marks_[rect_.index(x, y)]).store(1, std::memory_order_relaxed);
      }
    }
  }

  SmallSpheres& to_;
  Projection projection_;
  PixelRect rect_;
  std::atomic<bool> any_ = false;
};

SmallSpheres::SmallSpheres(const PreparedScene& scene, int width, const PixelRect& rect,
                           const ParallelFor& parallel_for)
    : rect_(rect), marks_(static_cast<std::size_t>(rect.area())) {
  const CameraView& camera = scene.camera_view;
  Marker marker(*this, camera, width);
  const auto add = [&marker](const auto& primitive) { marker.add(primitive); };
  visit_primitives(scene, parallel_for, add);
  if (camera.distortion.st != nullptr) everywhere_ = marker.any();
  if (!marker.any() || everywhere_) marks_ = {};
}

}  // namespace boule
