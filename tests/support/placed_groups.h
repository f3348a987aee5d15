#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/group.h"
#include "simd/geometry/geometry.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// Groups of spheres and where they are shown.
struct PlacedGroups {
  struct Place {
    std::size_t group;
    std::optional<Similarity> transform;
  };
  std::string name;
  std::vector<std::vector<Sphere>> groups;
  std::vector<Place> places;

  /// All spheres that are shown, in the order of their ids.
  [[nodiscard]] std::vector<Sphere> written_out() const {
    std::vector<Sphere> all;
    for (const Place& place : places) {
      for (const Sphere& one : groups[place.group])
        all.push_back(place.transform ? transformed(one, *place.transform, {}) : one);
    }
    return all;
  }
  /// The same as a geometry of parts.
  [[nodiscard]] Geometry in_parts(const std::vector<Plane>& planes, Structure structure) const {
    std::vector<std::shared_ptr<const Geometry>> trees;
    for (const auto& group : groups)
      trees.push_back(std::make_shared<const Geometry>(group, std::vector<Plane>(), structure));
    std::vector<GeometryPart> parts;
    for (const Place& place : places) parts.push_back({trees[place.group], place.transform, {}});
    return Geometry::of_parts(std::move(parts), planes);
  }
};

inline Similarity placed(const Vec3d& degrees, double scale, const Vec3d& shift) {
  Similarity transform = rotation(degrees);
  transform.scale = scale;
  transform.shift = shift;
  return transform;
}

inline Vec3d random_point(CaseRandom& random, double spread) {
  const double x = random.uniform(-spread, spread);
  const double y = random.uniform(-spread, spread);
  const double z = random.uniform(-spread, spread);
  return {x, y, z};
}

inline Similarity random_placement(CaseRandom& random, double scale, double spread) {
  const Vec3d degrees = random_point(random, 180);
  const double scaled = scale * random.uniform(0.5, 2);
  return placed(degrees, scaled, random_point(random, spread));
}

/// Spheres in a cube around `center`.
inline std::vector<Sphere> cube_of_spheres(CaseRandom& random, int count, const Vec3d& center,
                                           double spread, double radius) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const Vec3d at = center + random_point(random, spread);
    spheres.push_back(
        {vec_cast<float>(at), static_cast<float>(radius * random.uniform(0.2, 1)), 0});
  }
  return spheres;
}

}  // namespace boule::test
