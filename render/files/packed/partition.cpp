#include "render/files/packed/partition.h"

#include <algorithm>

namespace boule {
namespace {

/// In one go spheres are divided among so many buckets: each has a buffer.
constexpr std::uint64_t most_buckets = 512;

float coordinate(const Sphere& s, int axis) {
  return axis == 0 ? s.center.x : axis == 1 ? s.center.y : axis == 2 ? s.center.z : s.radius;
}

/// How long the sample is along an axis.
struct CenterRange {
  float low, high;
};

CenterRange range_along(int axis, const Sphere* begin, const Sphere* end) {
  const auto [low, high] =
      std::minmax_element(begin, end, [axis](const Sphere& a, const Sphere& b) {
        return coordinate(a, axis) < coordinate(b, axis);
      });
  return {coordinate(*low, axis), coordinate(*high, axis)};
}

/// The longest of x, y and z; the radius where centres are the same; -1 where all is the same.
int longest_axis(const Sphere* begin, const Sphere* end) {
  int axis = -1;
  double longest = 0;
  for (int k = 0; k < 4; ++k) {
    const auto [low, high] = range_along(k, begin, end);
    const double length = double{high} - double{low};
    if (length > longest && (k < 3 || axis < 0)) {
      longest = length;
      axis = k;
    }
  }
  return axis;
}

}  // namespace

Partition::Partition(const SphereSample& sample, std::uint64_t most) {
  std::vector<Sphere> spheres;
  for (const Sphere& sphere : sample.spheres()) {
    if (in_filter_range(sphere)) spheres.push_back(sphere);
  }
  const std::uint64_t count = std::max<std::uint64_t>(sample.count(), 1);
  // A quarter is left for what the sample does not tell.
  const std::uint64_t target =
      count <= most ? count : std::max(most - most / 4, count / most_buckets);
  const double share = static_cast<double>(target) / static_cast<double>(count);
  const auto in_sample = static_cast<std::size_t>(share * static_cast<double>(spheres.size()));
  divide(spheres, 0, spheres.size(), std::max<std::size_t>(in_sample, 1));
}

/// Divides a part of the sample, and returns its cut.
std::uint32_t Partition::divide(std::vector<Sphere>& spheres, std::size_t first, std::size_t end,
                                std::size_t most) {
  const auto index = static_cast<std::uint32_t>(cuts_.size());
  cuts_.emplace_back();
  const auto begin = spheres.data() + first, stop = spheres.data() + end;
  const int axis = end - first <= most ? -1 : longest_axis(begin, stop);
  if (axis < 0) {
    cuts_[index].bucket = buckets_++;
    return index;
  }
  Sphere* const middle = begin + (end - first) / 2;
  std::nth_element(begin, middle, stop, [axis](const Sphere& a, const Sphere& b) {
    return coordinate(a, axis) < coordinate(b, axis);
  });
  float value = coordinate(*middle, axis);
  if (!(range_along(axis, begin, stop).low < value)) {  // none is below: the next larger value
    float larger = range_along(axis, begin, stop).high;
    std::for_each(begin, stop, [&](const Sphere& s) {
      const float x = coordinate(s, axis);
      if (x > value && x < larger) larger = x;
    });
    value = larger;
  }
  const auto right =
      std::partition(begin, stop, [&](const Sphere& s) { return coordinate(s, axis) < value; });
  const std::size_t cut = first + static_cast<std::size_t>(right - begin);
  const std::uint32_t left_cut = divide(spheres, first, cut, most);
  const std::uint32_t right_cut = divide(spheres, cut, end, most);
  cuts_[index] = {axis, value, left_cut, right_cut, 0};
  return index;
}

std::uint16_t Partition::bucket_of(const Sphere& sphere) const {
  const Cut* cut = cuts_.data();
  while (cut->axis >= 0)
    cut = &cuts_[coordinate(sphere, cut->axis) < cut->value ? cut->left : cut->right];
  return static_cast<std::uint16_t>(cut->bucket);
}

}  // namespace boule
