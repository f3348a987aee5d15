#include "core/scene/lens.h"

#include <cmath>
#include <limits>
#include <span>

namespace boule {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A ray close to the axis: its height, and its slope times the index of refraction.
struct ParaxialRay {
  double height, slope;
};

/// Follows a ray through all surfaces, up to the last one. At each surface it bends by its height
/// times the power (n' - n) / R (Smith, "Modern Lens Design", 1992, "y-nu ray trace").
ParaxialRay trace_paraxial(std::span<const LensSurface> surfaces, ParaxialRay ray) {
  double index = 1;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const LensSurface& surface = surfaces[i];
    const double next = surface.index, radius = surface.radius;
    if (radius != 0) ray.slope -= ray.height * (next - index) / radius;
    index = next;
    if (i + 1 < surfaces.size()) ray.height += ray.slope / index * double{surface.thickness};
  }
  return ray;
}

}  // namespace

double focal_length(const std::vector<LensSurface>& surfaces) {
  return -1 / trace_paraxial(surfaces, {1, 0}).slope;
}

double image_distance(const std::vector<LensSurface>& surfaces, double distance) {
  if (surfaces.empty()) return nan;
  const ParaxialRay out = trace_paraxial(surfaces, {1, 1 / distance});
  return -out.height / out.slope * double{surfaces.back().index};
}

std::optional<std::size_t> find_stop(const std::vector<LensSurface>& surfaces) {
  std::optional<std::size_t> stop;
  float index = 1;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const bool bends = surfaces[i].radius != 0 || surfaces[i].index != index;
    index = surfaces[i].index;
    if (bends) continue;
    if (stop) return std::nullopt;
    stop = i;
  }
  return stop;
}

double stop_diameter(const std::vector<LensSurface>& surfaces, std::size_t stop, double f_number) {
  if (stop >= surfaces.size()) return nan;
  const std::span<const LensSurface> before(surfaces.data(), stop + 1);
  return std::fabs(trace_paraxial(before, {1, 0}).height) * focal_length(surfaces) / f_number;
}

}  // namespace boule
