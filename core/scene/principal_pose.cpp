#include "core/scene/principal_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/chunks.h"
#include "core/base/float_environment.h"
#include "core/math/geometry.h"
#include "core/scene/capsule_ends.h"
#include "core/scene/group.h"
#include "core/scene/instances.h"

namespace boule {
namespace {

/// The box of points.
struct CenterBox {
  static constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3d low{inf, inf, inf}, high{-inf, -inf, -inf};

  void add(const Vec3d& p) { add({p, p}); }
  void add(const CenterBox& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y),
            std::max(high.z, box.high.z)};
  }
  [[nodiscard]] Vec3d middle() const { return low * 0.5 + high * 0.5; }
  [[nodiscard]] double half_side() const {
    const Vec3d side = high * 0.5 - low * 0.5;
    return std::max({side.x, side.y, side.z});
  }
};

/// A symmetric matrix, as its six numbers: xx, yy, zz, xy, xz, yz.
template <class Number>
using Symmetric = std::array<Number, 6>;

/// Sums of points, and of the products of their coordinates, which are whole numbers here: steps of
/// a box whose half is `steps` long. The sums of 2^32 points fit into 64 bits.
class Moments {
 public:
  Moments(const Vec3d& middle, double half) : middle_(middle), half_(half) {}

  void add(const Vec3d& point) {
    const Vec3d at = (point - middle_) * (1 / half_);
    const std::int64_t x = whole(at.x), y = whole(at.y), z = whole(at.z);
    const std::array<std::int64_t, 3> first{x, y, z};
    const Symmetric<std::int64_t> second{x * x, y * y, z * z, x * y, x * z, y * z};
    ++count_;
    for (std::size_t i = 0; i < 3; ++i) first_[i] += first[i];
    for (std::size_t i = 0; i < 6; ++i) second_[i] += second[i];
  }
  void add(const Moments& other) {
    count_ += other.count_;
    for (std::size_t i = 0; i < 3; ++i) first_[i] += other.first_[i];
    for (std::size_t i = 0; i < 6; ++i) second_[i] += other.second_[i];
  }
  [[nodiscard]] Symmetric<double> covariance() const {
    const auto count = static_cast<double>(count_);
    const auto mean = [count](std::int64_t sum) { return static_cast<double>(sum) / count; };
    const double x = mean(first_[0]), y = mean(first_[1]), z = mean(first_[2]);
    const Symmetric<double> of_means{x * x, y * y, z * z, x * y, x * z, y * z};
    Symmetric<double> all{};
    for (std::size_t i = 0; i < 6; ++i) all[i] = mean(second_[i]) - of_means[i];
    return all;
  }

 private:
  static constexpr double steps = 1 << 14;

  static std::int64_t whole(double share) {
    return static_cast<std::int64_t>(std::floor(share * steps + 0.5));
  }

  Vec3d middle_;
  double half_;
  std::int64_t count_ = 0;
  std::array<std::int64_t, 3> first_{};
  Symmetric<std::int64_t> second_{};
};

/// Adds all centres, and all ends of capsules, to what begins as `start`.
template <class Part>
Part fold_centers(const Scene& scene, const ParallelFor& parallel_for, const Part& start) {
  const std::vector<Sphere>& own = scene.spheres;
  std::vector<Part> parts(chunks_of(own.size()), start);
  in_chunks(parallel_for, own.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Part part = start;
    for (std::size_t i = begin; i < end; ++i) part.add(vec_cast<double>(own[i].center));
    parts[chunk] = part;
  });
  Part all = start;
  for (const Part& part : parts) all.add(part);
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    for (const Sphere& sphere : scene.groups[shown.group].spheres) {
      all.add(vec_cast<double>(transformed(sphere, shown.transform, shown.material).center));
    }
  });
  visit_end_spheres(scene, [&all](SphereRun ends) {
    for (const Sphere& end : ends) all.add(vec_cast<double>(end.center));
  });
  return all;
}

struct Axis {
  double spread;  ///< the variance along it
  Vec3d way;      ///< of unit length
};

/// The principal axes of a covariance, the longest first: Jacobi's method, whose every step is one
/// of +, -, *, / and sqrt.
std::array<Axis, 3> axes_of(const Symmetric<double>& c) {
  double a[3][3] = {{c[0], c[3], c[4]}, {c[3], c[1], c[5]}, {c[4], c[5], c[2]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int most_sweeps = 32;  // six suffice
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double root = std::fabs(theta) + std::sqrt(theta * theta + 1);
      const double t = (theta < 0 ? -1 : 1) / root;
      const double cosine = 1 / std::sqrt(t * t + 1), sine = t * cosine;
      for (auto& row : a) {
        const double at_p = row[p], at_q = row[q];
        row[p] = cosine * at_p - sine * at_q;
        row[q] = sine * at_p + cosine * at_q;
      }
      for (int k = 0; k < 3; ++k) {
        const double at_p = a[p][k], at_q = a[q][k];
        a[p][k] = cosine * at_p - sine * at_q;
        a[q][k] = sine * at_p + cosine * at_q;
        const double v_p = v[k][p], v_q = v[k][q];
        v[k][p] = cosine * v_p - sine * v_q;
        v[k][q] = sine * v_p + cosine * v_q;
      }
      a[p][q] = a[q][p] = 0;
    }
  }
  std::array<Axis, 3> axes{};
  for (std::size_t i = 0; i < 3; ++i)
    axes[i] = {a[i][i], normalize(Vec3d{v[0][i], v[1][i], v[2][i]})};
  std::stable_sort(axes.begin(), axes.end(),
                   [](const Axis& one, const Axis& other) { return one.spread > other.spread; });
  return axes;
}

/// The axis or its opposite: the largest component is positive.
Vec3d with_sign(const Vec3d& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  const double largest = x >= y && x >= z ? v.x : y >= z ? v.y : v.z;
  return largest < 0 ? v * -1.0 : v;
}

/// The direction across `axis` that is nearest to y; nearest to z for an axis near y.
Vec3d most_upright(const Vec3d& axis) {
  constexpr double near = 0.9;
  const Vec3d wanted = std::fabs(axis.y) < near ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  return normalize(wanted - axis * dot(wanted, axis));
}

}  // namespace

std::optional<PrincipalPose> principal_pose(const Scene& scene, const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  const CenterBox box = fold_centers(scene, parallel_for, CenterBox{});
  const double half = box.half_side();
  if (!(half > 0) || !std::isfinite(1 / half)) return std::nullopt;
  const Moments moments = fold_centers(scene, parallel_for, Moments(box.middle(), half));
  const auto [longest, middle, shortest] = axes_of(moments.covariance());
  const auto are_equal = [](const Axis& one, const Axis& smaller) {
    constexpr double about = 0.9;  // of the variance
    return smaller.spread >= about * one.spread;
  };
  if (are_equal(longest, shortest)) return std::nullopt;
  Vec3d up = with_sign(middle.way), forward = shortest.way;
  if (are_equal(middle, shortest)) {
    up = most_upright(longest.way);  // a rod, which looks alike from all sides
    forward = cross(up, longest.way);
  } else if (are_equal(longest, middle)) {
    up = most_upright(shortest.way);  // a disc
  }
  const Vec3d right = with_sign(normalize(cross(forward, up)));
  return PrincipalPose{vec_cast<float>(normalize(cross(up, right))), vec_cast<float>(up)};
}

CameraFit settled_fit(const Scene& scene, const ParallelFor& parallel_for) {
  CameraFit fit = scene.fit;
  fit.pose.reset();
  if (scene.fit.pose != FittedPose::principal || scene.packed) return fit;
  const auto pose = principal_pose(scene, parallel_for);
  if (!pose) return fit;
  fit.direction = pose->direction;
  fit.up = pose->up;
  return fit;
}

}  // namespace boule
