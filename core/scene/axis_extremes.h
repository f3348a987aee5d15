#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/scene/primitive.h"

namespace boule {

/// The extreme spheres of a sequence: one with the largest radius and, for each direction along an
/// axis of coordinates, both ways, one with the outermost centre and one with the outermost
/// surface. Among equal ones, the first.
class AxisExtremes {
 public:
  void add(const Sphere& sphere);
  /// Adds the extremes of a later part of the sequence.
  void add(const AxisExtremes& later);

  /// Empty for an empty sequence.
  [[nodiscard]] std::vector<Sphere> spheres() const;

 private:
  /// One for the radius, then four for each axis.
  static constexpr std::size_t size = 13;

  std::array<std::optional<Sphere>, size> least_;
};

}  // namespace boule
