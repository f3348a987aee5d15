#include "render/files/particles/typical_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/chunks.h"

namespace boule {
namespace {

constexpr int no_child = std::numeric_limits<int>::max();

double Vec3d::*const coordinates[] = {&Vec3d::x, &Vec3d::y, &Vec3d::z};

/// Regions of space with about as many points each: some leaves of a k-d tree over a sample. Those
/// between them are left out, so that most points are dropped after a few steps.
class Regions {
 public:
  static constexpr std::size_t most = 16;

  explicit Regions(const std::vector<Vec3d>& points) {
    constexpr std::size_t points_of_region = 16384, sample_size = 16384;
    int depth = 0;
    while (points.size() >> depth > points_of_region && depth < 11) ++depth;
    leaves_ = std::size_t{1} << depth;
    std::vector<Vec3d> sample;
    const std::size_t step = points.size() / sample_size + 1;
    for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
    nodes_.reserve(2 * leaves_);
    root_ = split(sample.data(), sample.data() + sample.size(), 0, leaves_);
  }

  [[nodiscard]] std::size_t size() const { return std::min(leaves_, most); }

  /// The region of a point, or `no_child`.
  [[nodiscard]] int find(const Vec3d& point) const {
    int at = root_;
    while (at >= 0 && at != no_child) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      at = node.children[point.*node.axis < node.split ? 0 : 1];
    }
    return at == no_child ? no_child : -1 - at;
  }

 private:
  /// A child is a node, `no_child`, or -1 - R for the region R.
  struct Node {
    double Vec3d::*axis = &Vec3d::x;
    double split = 0;
    std::array<int, 2> children{no_child, no_child};
  };

  /// Splits the sample into leaves first .. first + leaves - 1 and returns the child to be.
  int split(Vec3d* begin, Vec3d* end, std::size_t first, std::size_t leaves) {
    const std::size_t stride = leaves_ / size();
    if (leaves == 1) return first % stride == 0 ? -1 - static_cast<int>(first / stride) : no_child;
    if (leaves < stride && first % stride != 0) return no_child;
    Node node;
    node.axis = longest_axis(begin, end);
    Vec3d* const middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end,
                     [&](const Vec3d& a, const Vec3d& b) { return a.*node.axis < b.*node.axis; });
    node.split = middle->*node.axis;
    const auto index = nodes_.size();
    nodes_.push_back(node);
    const int below = split(begin, middle, first, leaves / 2);
    const int above = split(middle, end, first + leaves / 2, leaves / 2);
    nodes_[index].children = {below, above};
    return static_cast<int>(index);
  }

  static double Vec3d::*longest_axis(const Vec3d* begin, const Vec3d* end) {
    double Vec3d::*longest = coordinates[0];
    double most_length = -1;
    for (double Vec3d::*const axis : coordinates) {
      const auto [least, largest] = std::minmax_element(
          begin, end, [&](const Vec3d& a, const Vec3d& b) { return a.*axis < b.*axis; });
      const double length = largest->*axis - least->*axis;
      if (length > most_length) {
        most_length = length;
        longest = axis;
      }
    }
    return longest;
  }

  std::size_t leaves_ = 1;
  std::vector<Node> nodes_;
  int root_ = no_child;
};

using PointsOfRegions = std::array<std::vector<Vec3d>, Regions::most>;

PointsOfRegions points_of(const Regions& regions, const std::vector<Vec3d>& points,
                          const ParallelFor& parallel_for) {
  std::vector<PointsOfRegions> found(chunks_of(points.size()));
  in_chunks(parallel_for, points.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              for (std::size_t i = begin; i < end; ++i) {
                const int region = regions.find(points[i]);
                if (region != no_child)
                  found[chunk][static_cast<std::size_t>(region)].push_back(points[i]);
              }
            });
  PointsOfRegions all;
  for (const PointsOfRegions& part : found) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].insert(all[i].end(), part[i].begin(), part[i].end());
    }
  }
  return all;
}

double distance(const Vec3d& a, const Vec3d& b) {
  const Vec3d way = a - b;
  const double square = dot(way, way);
  // Neither overflow nor lost digits: those are rare and may take their time.
  if (square > 1e-280 && square < 1e300) return std::sqrt(square);
  return std::hypot(way.x, way.y, way.z);
}

/// The distances of some of the points to their nearest neighbours among all of them.
std::vector<double> nearest_distances(const std::vector<Vec3d>& points, std::size_t most) {
  std::vector<double> distances;
  const std::size_t step = points.size() / most + 1;
  for (std::size_t i = 0; i < points.size(); i += step) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& other : points) {
      const double length = distance(points[i], other);
      if (length > 0 && length < nearest) nearest = length;
    }
    if (std::isfinite(nearest)) distances.push_back(nearest);
  }
  return distances;
}

}  // namespace

double typical_distance(const std::vector<Vec3d>& points, const ParallelFor& parallel_for) {
  if (points.size() < 2) return 0;
  const Regions regions(points);
  const PointsOfRegions in_regions = points_of(regions, points, parallel_for);
  std::array<std::vector<double>, Regions::most> found;
  parallel_for(regions.size(), [&](std::size_t i) {
    const FloatEnvironment environment;
    found[i] = nearest_distances(in_regions[i], 1024 / regions.size());
  });
  std::vector<double> distances;
  for (const auto& part : found) distances.insert(distances.end(), part.begin(), part.end());
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace boule
