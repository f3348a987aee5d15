#include "render/renderer/small_spheres.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/chunks.h"
#include "core/optics/camera_view.h"
#include "render/prepare/projection.h"
#include "simd/geometry/part_placement.h"

namespace boule {
namespace {

constexpr double largest_radius = 0.75;  // pixels

/// The pixel of a raster coordinate, low .. high; low for NaN.
int pixel_at(double raster, int low, int high) {
  if (!(raster > low)) return low;
  return raster < high ? static_cast<int>(raster) : high;
}

/// Calls visit(sphere) for each sphere, in parallel.
template <class Visit>
void visit_spheres(const GeometryView& view, const ParallelFor& parallel_for, const Visit& visit) {
  const auto visit_part = [&](const PartView& part, std::size_t slots) {
    in_chunks(parallel_for, slots, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        if (part.id[slot] >= 0) visit(sphere_of(part, slot));
      }
    });
  };
  PartView whole{};
  whole.blocks = view.spheres.blocks;
  whole.id = view.spheres.id;
  visit_part(whole, view.spheres.block_count * bvh_leaf_size);
  for (std::size_t i = 0; i < view.parts.size; ++i)
    visit_part(view.parts.parts[i], view.parts.parts[i].slots);
}

}  // namespace

SmallSpheres::SmallSpheres(const Geometry& geometry, const CameraView& camera, int width,
                           const PixelRect& rect, const ParallelFor& parallel_for)
    : rect_(rect), marks_(static_cast<std::size_t>(rect.area())) {
  const Projection projection(camera, width);
  std::atomic<bool> any = false;
  visit_spheres(geometry.view(), parallel_for, [&](const Sphere& sphere) {
    const auto disc = projection.of(sphere);
    if (!disc || !(disc->radius <= largest_radius)) return;
    const int x1 = pixel_at(disc->x + disc->reach + 1, rect.x0, rect.x1),
              y1 = pixel_at(disc->y + disc->reach + 1, rect.y0, rect.y1);
    for (int y = pixel_at(disc->y - disc->reach, rect.y0, rect.y1); y < y1; ++y) {
      for (int x = pixel_at(disc->x - disc->reach, rect.x0, rect.x1); x < x1; ++x) {
        any.store(true, std::memory_order_relaxed);
        std::atomic_ref(marks_[rect.index(x, y)]).store(1, std::memory_order_relaxed);
      }
    }
  });
  if (camera.distortion.st != nullptr) everywhere_ = any;
  if (!any || everywhere_) marks_ = {};
}

}  // namespace boule
