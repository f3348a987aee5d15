#include "render/scene_file/toml_origin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/scene/number_text.h"

namespace boule {
namespace {

/// The largest rounding of a centre that goes unseen, as a share of the radius.
constexpr double unseen = 0x1p-16;
/// The largest step between points that short_point() tries.
constexpr double largest_step = 1e22;
/// The largest error of rounding to float, as a share of the number.
constexpr double float_error = 0x1p-24;
/// How much an origin must lessen the rounding.
constexpr double least_gain = 8;

double largest_component(const Vec3d& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// The box around the centres of all spheres, and the smallest of their radii.
struct ExtentOfAll : SphereExtent {
  [[nodiscard]] Vec3d middle() const { return low * 0.5 + high * 0.5; }
  [[nodiscard]] double half_width() const { return largest_component(high * 0.5 - low * 0.5); }
  /// The largest component of a centre that is counted from `origin`.
  [[nodiscard]] double reach(const Vec3d& origin) const {
    return std::max(largest_component(low - origin), largest_component(high - origin));
  }
};

std::optional<ExtentOfAll> extent_of(const ExactSpheres& spheres) {
  std::optional<ExtentOfAll> all;
  for (const SphereExtent& one : spheres.extents) {
    if (std::isinf(one.radius)) continue;
    if (!all) all = ExtentOfAll{one};
    all->low = {std::min(all->low.x, one.low.x), std::min(all->low.y, one.low.y),
                std::min(all->low.z, one.low.z)};
    all->high = {std::max(all->high.x, one.high.x), std::max(all->high.y, one.high.y),
                 std::max(all->high.z, one.high.z)};
    all->radius = std::min(all->radius, one.radius);
  }
  return all;
}

Vec3d to_multiple(const Vec3d& point, double step) {
  const auto nearest = [step](double x) { return std::nearbyint(x / step) * step; };
  return {nearest(point.x), nearest(point.y), nearest(point.z)};
}

/// True if rounding goes unseen where centres are counted from `origin`.
bool is_near_enough(const Vec3d& origin, const ExtentOfAll& extent) {
  return extent.reach(origin) * float_error <= extent.radius * unseen;
}

/// The point with the fewest digits, such as [1000000, 0, 0], that is near enough. So particles
/// that were moved by a round number are counted as if they had not been.
std::optional<Vec3d> short_point(const Vec3d& middle, const ExtentOfAll& extent) {
  for (double step = largest_step; step >= extent.radius; step /= 10) {
    const Vec3d origin = to_multiple(middle, step);
    if (is_near_enough(origin, extent)) return origin;
  }
  return std::nullopt;
}

/// The point near the middle in whole multiples of a power of 2 that is at most an eighth of the
/// extent.
Vec3d near_point(const Vec3d& middle, const ExtentOfAll& extent) {
  const double size = std::max(extent.half_width(), extent.radius);
  return to_multiple(middle, std::ldexp(1, std::ilogb(size) - 3));
}

std::string point_text(const Vec3d& point) {
  std::string text = "[";
  for (const double x : {point.x, point.y, point.z}) {
    text += (text.size() > 1 ? ", " : "") + number_text(x, 12);
  }
  return text + "]";
}

}  // namespace

Vec3d choose_origin(const ExactSpheres& spheres) {
  const auto extent = extent_of(spheres);
  if (!extent) return {};
  if (is_near_enough({}, *extent)) return {};
  const Vec3d middle = spheres.cell_middle.value_or(extent->middle());
  for (const Vec3d& from : {middle, extent->middle()}) {
    if (const auto origin = short_point(from, *extent)) return *origin;
  }
  for (const Vec3d& from : {middle, extent->middle()}) {
    const Vec3d origin = near_point(from, *extent);
    if (extent->reach(origin) * least_gain <= extent->reach({})) return origin;
  }
  return {};
}

Vec3d read_origin(TomlTable& root, const ExactSpheres& spheres, std::vector<std::string>& notes) {
  std::string text = "auto";
  Vec3d origin;
  if (!root.has("origin") || root.has_text("origin")) {
    root.read("origin", text);
    if (text != "auto") {
      root.report("origin", "expected \"auto\" or a point [x, y, z], got " + quote(text));
    }
    origin = choose_origin(spheres);
    if (origin == Vec3d{}) return origin;
    notes.push_back("points are counted from " + point_text(origin) +
                    ": so far from 0, rounding to float would move the particles visibly "
                    "(origin = [0, 0, 0] leaves them)");
    return origin;
  }
  root.read("origin", origin);
  for (const double x : {origin.x, origin.y, origin.z}) {
    if (!std::isfinite(x)) root.report("origin", "must be finite, is " + number_text(x));
  }
  return origin;
}

}  // namespace boule
