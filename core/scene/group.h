#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/similarity.h"
#include "core/math/vec.h"
#include "core/scene/field.h"
#include "core/scene/primitive.h"

namespace boule {

/// One showing of a group (lecture "Scene graph"): all that is in it, scaled, then turned, then
/// moved.
struct Instance {
  std::uint32_t group = 0;  ///< index in Scene::groups
  Vec3f translate;
  Vec3f rotate;     ///< degrees about x, then y, then z (rotation())
  float scale = 1;  ///< above 0
  /// In place of every material in the group and in the groups inside it.
  std::optional<std::uint32_t> material;
};

template <>
inline constexpr auto fields<Instance> =
    field_list("instance", field("group", &Instance::group, rule::group),
               field("translate", &Instance::translate, rule::finite),
               field("rotate", &Instance::rotate, rule::finite),
               field("scale", &Instance::scale, rule::positive),
               field("material", &Instance::material, rule::material));

/// Spheres, planes and other groups under a name, with a coordinate system of their own.
struct Group {
  std::string name;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Instance> instances;
};

template <>
inline constexpr auto fields<Group> = field_list("group", field("name", &Group::name),
                                                 field("sphere", &Group::spheres),
                                                 field("plane", &Group::planes),
                                                 field("instance", &Group::instances));

/// The first Problem of an instance by itself: anything not finite, scale <= 0.
std::optional<Problem> find_problem(const Instance& instance);

/// Where a valid instance puts what is in its group; NaN or infinite where it is not.
Similarity transform_of(const Instance& instance);

/// A sphere or plane under a transformation, every number computed in double and rounded to float
/// once; with another material where one is given. What leaves float's range is infinite:
/// find_problem() of what comes out tells.
Sphere place(const Sphere& sphere, const Similarity& transform,
             std::optional<std::uint32_t> material);
Plane place(const Plane& plane, const Similarity& transform, std::optional<std::uint32_t> material);

}  // namespace boule
