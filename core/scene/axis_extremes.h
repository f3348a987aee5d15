#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

/// Of spheres that pass by, one with the largest radius, and for each direction along an axis of
/// coordinates, both ways, one whose centre lies outermost and one whose surface does. Of several,
/// the first that came.
class AxisExtremes {
 public:
  void add(const Sphere& sphere);
  /// Adds those of spheres that came later.
  void add(const AxisExtremes& later);

  /// Of no spheres: none.
  [[nodiscard]] std::vector<Sphere> spheres() const;

 private:
  /// One for the radius, then four for each axis.
  static constexpr std::size_t size = 13;

  std::array<std::optional<Sphere>, size> least_;
};

}  // namespace boule
