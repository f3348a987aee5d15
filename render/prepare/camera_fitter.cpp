#include "render/prepare/camera_fitter.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "render/prepare/fold_spheres.h"

namespace boule {
namespace {

/// The share of the coordinates by which spheres are taken as larger: more than the rounding of the
/// eye and of look_at to floats moves what is seen, 2^-24 each and at most four times that.
constexpr double relative_guard = 0x1p-20;

/// The least distance from the eye to look_at, as a share of the coordinates.
constexpr double least_distance = 0x1p-12;

/// tan(fov / 2) along each axis of the picture.
struct HalfTangents {
  double x, y;
};

HalfTangents half_tangents(double fov, FovAxis axis, double width, double height) {
  const double tangent = elementary::tan_acute(fov * (elementary::pi / 360));
  const double longer = std::max(width, height);
  const double side = axis == FovAxis::max ? longer : axis == FovAxis::x ? width : height;
  return {tangent * width / side, tangent * height / side};
}

FovAxis axis_of(const CameraFit& fit, int width, int height) {
  return fit.fov_axis.value_or(width <= height ? FovAxis::x : FovAxis::y);
}

}  // namespace

void CameraFitter::Side::set(double tangent) {
  sine = tangent / std::sqrt(1 + tangent * tangent);
  cosine = 1 / std::sqrt(1 + tangent * tangent);
}

CameraFitter::CameraFitter(const CameraFit& fit, const View& view, int width, int height)
    : fit_(fit), width_(width), height_(height), forward_(view.direction) {
  right_ = normalize(cross(forward_, view.up));
  up_ = cross(right_, forward_);
  if (fit_.type == FittedCamera::orthographic) return;
  const auto [x, y] = half_tangents(double{fit_.fov}, axis_of(fit_, width, height), width, height);
  const double used = 1 - 2 * double{fit_.margin}, taken = 2 * double{fit_.room};
  x_.low.set(x * used);
  x_.high.set(x * (used - taken));
  y_.low.set(y * used);
  y_.high.set(y * used);
}

void CameraFitter::add(std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  *this = fold_spheres(
      spheres, parallel_for, *this,
      [](CameraFitter& fitter, const Sphere& sphere) { fitter.add(sphere); },
      [](CameraFitter& fitter, const CameraFitter& other) { fitter.add(other); });
}

void CameraFitter::add(const Sphere& s) {
  const auto narrow = [](Sides& sides, double across, double depth, double radius) {
    const auto& [low, high] = sides;
    sides.low.narrow(depth * low.sine - radius + across * low.cosine);
    sides.high.narrow(depth * high.sine - radius - across * high.cosine);
  };
  const Vec3d center = vec_cast<double>(s.center);
  const auto radius = static_cast<double>(s.radius);
  const double depth = dot(center, forward_);
  narrow(x_, dot(center, right_), depth, radius);
  narrow(y_, dot(center, up_), depth, radius);
  nearest_ = std::min(nearest_, depth - radius);
  farthest_ = std::max(farthest_, depth + radius);
  largest_ =
      std::max({largest_, std::fabs(center.x), std::fabs(center.y), std::fabs(center.z), radius});
}

/// Adds what a fitter for the same frame was given.
void CameraFitter::add(const CameraFitter& other) {
  const auto narrow = [](Sides& sides, const Sides& others) {
    sides.low.narrow(others.low.room);
    sides.high.narrow(others.high.room);
  };
  narrow(x_, other.x_);
  narrow(y_, other.y_);
  nearest_ = std::min(nearest_, other.nearest_);
  farthest_ = std::max(farthest_, other.farthest_);
  largest_ = std::max(largest_, other.largest_);
}

std::vector<SphereMeasure> CameraFitter::measures() const {
  std::vector<SphereMeasure> all{{forward_, 1}, {forward_ * -1.0, 1}, {{0, 0, 0}, 1}};
  const auto add_sides = [&](const Sides& sides, const Vec3d& across) {
    all.push_back({forward_ * sides.low.sine + across * sides.low.cosine, 1});
    all.push_back({forward_ * sides.high.sine - across * sides.high.cosine, 1});
  };
  add_sides(x_, right_);
  add_sides(y_, up_);
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    all.push_back({axis, 0});
    all.push_back({axis * -1.0, 0});
  }
  return all;
}

Camera CameraFitter::camera() const {
  return fit_.type == FittedCamera::pinhole ? pinhole() : orthographic();
}

CameraPose CameraFitter::pose_at(double x, double y, double depth) const {
  // Far enough from what it looks at that the direction has digits when both are floats.
  const double target = std::max(middle_depth(), depth + largest_ * least_distance);
  const Vec3d across = right_ * x + up_ * y;
  return {vec_cast<float>(across + forward_ * depth), vec_cast<float>(across + forward_ * target),
          vec_cast<float>(up_)};
}

/// A sphere is inside of a side where its distance from the plane is its radius at least. With the
/// eye at (x, depth) the two sides of an axis ask for
///   depth sine + x cosine <= room of the low one and depth sine - x cosine <= room of the high
///   one.
/// Divided by the cosines, their sum gives the greatest depth of the eye, and their difference the
/// x in the middle of those that both allow, at any depth.
Camera CameraFitter::pinhole() const {
  const auto greatest_depth = [](const Sides& sides, double guard) {
    const auto& [low, high] = sides;
    return ((low.room - guard) / low.cosine + (high.room - guard) / high.cosine) /
           (low.sine / low.cosine + high.sine / high.cosine);
  };
  const auto depth_for = [&](double guard) {
    return std::min(greatest_depth(x_, guard), greatest_depth(y_, guard));
  };
  const auto middle = [](const Sides& sides, double at) {
    const auto& [low, high] = sides;
    return ((low.room - at * low.sine) / low.cosine - (high.room - at * high.sine) / high.cosine) /
           2;
  };
  const double guard = (largest_ + middle_depth() - depth_for(0)) * relative_guard;
  const double depth = std::min(depth_for(guard), middle_depth() - largest_ * least_distance);
  return PinholeCamera{pose_at(middle(x_, depth), middle(y_, depth), depth), fit_.fov,
                       axis_of(fit_, width_, height_)};
}

/// The film is as high and wide as the spheres and what is left free; the eye stands twice its
/// height before the first.
Camera CameraFitter::orthographic() const {
  const double guard = largest_ * relative_guard;
  const auto extent = [guard](const Sides& sides) {
    return 2 * guard - sides.low.room - sides.high.room;
  };
  const auto middle = [](const Sides& sides) { return (sides.low.room - sides.high.room) / 2; };
  const double aspect = static_cast<double>(width_) / height_;
  const double used = 1 - 2 * double{fit_.margin}, room{fit_.room};
  const double height = std::max(extent(y_) / used, extent(x_) / aspect / (used - room));
  const double aside = middle(x_) + height * aspect * room / 2;
  return OrthographicCamera{pose_at(aside, middle(y_), nearest_ - 2 * height),
                            static_cast<float>(height)};
}

}  // namespace boule
