#include "render/files/scene_file/loaded/scene_origin.h"

#include <algorithm>
#include <array>

#include "core/math/geometry.h"
#include "core/scene/number_text.h"
#include "render/files/file/float32.h"

namespace boule {
namespace {

/// The largest rounding of a centre that goes unseen, as a share of the radius.
constexpr double unseen = 0x1p-16;
/// The largest error of rounding to float, as a share of the number.
constexpr double float_error = 0x1p-24;
/// So many radii away from the origin, rounding goes unseen.
constexpr double near_enough = unseen / float_error;
/// How much an origin must lessen the rounding.
constexpr double least_gain = 8;
/// The largest step between points that round_point() tries.
constexpr double largest_step = 1e22;
/// Positions that are rounded by this share of the smallest radius are told.
constexpr double told = 1e-3;

constexpr std::array<double Vec3d::*, 3> axes{&Vec3d::x, &Vec3d::y, &Vec3d::z};

double largest_component(const Vec3d& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

Vec3d as_floats(const Vec3d& v) {
  return {float32_or_inf(v.x), float32_or_inf(v.y), float32_or_inf(v.z)};
}

/// The largest component of a centre that is counted from `origin`.
double reach(const SphereExtent& part, const Vec3d& origin) {
  return std::max(largest_component(part.low - origin), largest_component(part.high - origin));
}

/// Where origins may be.
struct OriginBox {
  Vec3d low, high;

  [[nodiscard]] bool contains(const Vec3d& p) const {
    return std::all_of(axes.begin(), axes.end(), [&](double Vec3d::*axis) {
      return low.*axis <= p.*axis && p.*axis <= high.*axis;
    });
  }
  [[nodiscard]] Vec3d middle() const { return low * 0.5 + high * 0.5; }
  [[nodiscard]] bool is_empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  /// Along the axis where it has the least; at least what doubles know out there.
  [[nodiscard]] double width() const {
    const double least = std::max(largest_component(low), largest_component(high)) * 0x1p-50;
    return std::max(std::min({high.x - low.x, high.y - low.y, high.z - low.z}), least);
  }
};

Vec3d to_multiple(const Vec3d& point, double step) {
  const auto nearest = [step](double x) { return std::nearbyint(x / step) * step + 0.0; };
  return {nearest(point.x), nearest(point.y), nearest(point.z)};
}

/// The point with the fewest binary digits that is almost in the middle of a box; if there is none,
/// one that is near it.
Vec3d near_point(const OriginBox& box) {
  constexpr double almost = 0.125;
  constexpr int finest = 12, usual = 3;
  const Vec3d middle = box.middle();
  const int largest = std::ilogb(box.width() / 2);
  for (int power = largest; power >= largest - finest; --power) {
    const double step = std::ldexp(1, power);
    const Vec3d point = to_multiple(middle, step);
    if (largest_component(point - middle) <= step * almost) return point;
  }
  return to_multiple(middle, std::ldexp(1, largest - usual));
}

/// The search for the origin of some spheres.
class OriginSearch {
 public:
  explicit OriginSearch(const SceneExtents& spheres) {
    for (const SphereExtent& part : spheres) {
      if (!part.is_empty()) parts_.push_back(part);
    }
  }

  [[nodiscard]] Vec3d run() const;
  /// How far positions are rounded that are counted from `origin`, in radii of the smallest sphere.
  [[nodiscard]] double rounding(const Vec3d& origin) const;

 private:
  [[nodiscard]] OriginBox within(double radii) const;
  [[nodiscard]] double least_radii() const;
  [[nodiscard]] double farthest(const Vec3d& origin) const;
  [[nodiscard]] bool gains(const Vec3d& origin) const {
    return is_finite(origin) && farthest(origin) * least_gain <= farthest({});
  }
  [[nodiscard]] std::optional<Vec3d> round_point(const OriginBox& box) const;

  SceneExtents parts_;  ///< none is empty
};

/// The origins that no centre is farther from, along an axis, than so many radii of its sphere.
OriginBox OriginSearch::within(double radii) const {
  constexpr double inf = SphereExtent::infinity;
  OriginBox box{{-inf, -inf, -inf}, {inf, inf, inf}};
  for (const SphereExtent& part : parts_) {
    const double most = radii * part.radius;
    for (double Vec3d::*const axis : axes) {
      box.low.*axis = std::max(box.low.*axis, part.high.*axis - most);
      box.high.*axis = std::min(box.high.*axis, part.low.*axis + most);
    }
  }
  return box;
}

/// The fewest radii, almost, that leave an origin.
double OriginSearch::least_radii() const {
  double few = 0, many = 1;
  for (; within(many).is_empty(); many *= 2) few = many;
  constexpr int halvings = 30;
  for (int i = 0; i < halvings; ++i) {
    const double between = few + (many - few) / 2;
    (within(between).is_empty() ? few : many) = between;
  }
  return many;
}

double OriginSearch::farthest(const Vec3d& origin) const {
  double radii = 0;
  for (const SphereExtent& part : parts_)
    radii = std::max(radii, reach(part, origin) / part.radius);
  return radii;
}

double OriginSearch::rounding(const Vec3d& origin) const {
  double moved = 0, smallest = SphereExtent::infinity;
  for (const SphereExtent& part : parts_) {
    smallest = std::min(smallest, part.radius);
    double most = reach(part, origin) * float_error;
    if (part.low == part.high) {
      const Vec3d center = part.low - origin;
      most = largest_component(center - as_floats(center));
    } else if (origin == Vec3d{}) {
      most = std::min(most, part.rounding);
    }
    moved = std::max(moved, most);
  }
  return moved / smallest;
}

/// The point of a box with the fewest decimal digits, such as [1000000, 0, 0], if points with so
/// few are so rare that it is hardly there by chance.
std::optional<Vec3d> OriginSearch::round_point(const OriginBox& box) const {
  constexpr double rare = 4;
  for (double step = largest_step; step > rare * box.width(); step /= 10) {
    const Vec3d point = to_multiple(box.middle(), step);
    if (box.contains(point) && gains(point)) return point;
  }
  return std::nullopt;
}

Vec3d OriginSearch::run() const {
  const bool fit = std::all_of(parts_.begin(), parts_.end(), [](const SphereExtent& part) {
    return fits_float32(reach(part, {}));  // those that do not are refused
  });
  const OriginBox near = within(near_enough);  // all of space without spheres
  if (!fit || near.contains({})) return {};
  if (!near.is_empty()) {
    if (const auto origin = round_point(near)) return *origin;
  }
  constexpr double around = 2.5;  // where the scene is, and its corners
  const OriginBox close = within(std::max(around * least_radii(), 1.0));
  if (const auto origin = round_point(close)) return *origin;
  const Vec3d origin = near_point(close);
  return gains(origin) ? origin : Vec3d{};
}

std::string point_text(const Vec3d& point) {
  std::string text = "[";
  for (const double x : {point.x, point.y, point.z}) {
    text += (text.size() > 1 ? ", " : "") + number_text(x, 12);
  }
  return text + "]";
}

}  // namespace

void SphereExtent::add(const Vec3d& center, double r) {
  if (!is_finite(center) || !std::isfinite(r) || !(r > 0)) return;
  add({center, center, r, largest_component(center - as_floats(center))});
}

void SphereExtent::add(const SphereExtent& other) {
  for (double Vec3d::*const axis : axes) {
    low.*axis = std::min(low.*axis, other.low.*axis);
    high.*axis = std::max(high.*axis, other.high.*axis);
  }
  radius = std::min(radius, other.radius);
  rounding = std::max(rounding, other.rounding);
}

Vec3d choose_origin(const SceneExtents& spheres) { return OriginSearch(spheres).run(); }

Vec3d choose_origin(const SceneExtents& spheres, const std::optional<Vec3d>& series,
                    std::vector<std::string>& notes) {
  if (series) return *series;
  const OriginSearch search(spheres);
  const Vec3d origin = search.run();
  const double radii = search.rounding(origin);
  std::string note;
  if (!(origin == Vec3d{})) {
    note = "points are counted from " + point_text(origin) +
           ": so far from 0, rounding to float would move the spheres visibly "
           "(origin = [0, 0, 0] in a scene file leaves them)";
  }
  if (radii > told) {
    note += (note.empty() ? "" : "; even so, ") + std::string("positions are rounded by up to ") +
            number_text(radii, 2) +
            " radii of the smallest sphere: the spheres reach too far for 32-bit floats";
  }
  if (!note.empty()) notes.push_back(std::move(note));
  return origin;
}

}  // namespace boule
