#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/files/packed/sphere_survey.h"

namespace boule {

/// Divides space, and radii, among buckets such that each gets about as many of the spheres that a
/// sample stands for: a tree of cuts.
class Partition {
 public:
  /// `most`: spheres that a bucket should have at most. Some may have more, where the sample does
  /// not tell; is_one() if all in the sample are copies of one sphere.
  Partition(const SphereSample& sample, std::uint64_t most);

  struct Cut {
    int axis = -1;                      ///< x, y, z, radius; -1: no cut, but a bucket
    float value = 0;                    ///< what is below goes left
    std::uint32_t left = 0, right = 0;  ///< cuts
    std::uint32_t bucket = 0;
  };
  /// The root is the first; children come after their parents.
  [[nodiscard]] const std::vector<Cut>& cuts() const { return cuts_; }
  [[nodiscard]] std::size_t buckets() const { return buckets_; }
  [[nodiscard]] bool is_one() const { return buckets_ == 1; }
  [[nodiscard]] std::uint16_t bucket_of(const Sphere& sphere) const;

 private:
  std::uint32_t divide(std::vector<Sphere>& spheres, std::size_t first, std::size_t end,
                       std::size_t most);

  std::vector<Cut> cuts_;
  std::uint32_t buckets_ = 0;
};

}  // namespace boule
