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

/// A copy of a group in the scene (lecture "Scene graph"): the contents of the group are scaled,
/// then rotated, then moved.
struct Instance {
  std::uint32_t group = 0;  ///< index in Scene::groups
  Vec3f translate{};
  Vec3f rotate{};   ///< degrees about x, then y, then z (rotation())
  float scale = 1;  ///< above 0
  /// Replaces every material in the group and in the groups inside it, with its colour.
  std::optional<std::uint32_t> material{};
};

template <>
inline constexpr auto fields<Instance> =
    field_list("instance", field("group", &Instance::group, rule::group),
               field("translate", &Instance::translate, rule::point),
               field("rotate", &Instance::rotate, rule::finite),
               field("scale", &Instance::scale, rule::positive),
               field("material", &Instance::material, rule::material));

/// Spheres, planes, capsules and other groups under a name, with a coordinate system of their own.
struct Group {
  std::string name{};
  std::vector<Sphere> spheres{};
  std::vector<Plane> planes{};
  std::vector<Instance> instances{};
  std::vector<Capsule> capsules{};
};

template <>
inline constexpr auto fields<Group> = field_list("group", field("name", &Group::name),
                                                 field("sphere", &Group::spheres),
                                                 field("plane", &Group::planes),
                                                 field("instance", &Group::instances),
                                                 field("capsule", &Group::capsules));

/// The first Problem of an instance by itself: a field against its rule.
std::optional<Problem> find_problem(const Instance& instance);

/// The transformation of a valid instance. For an invalid one it may hold NaN and infinities.
Similarity transform_of(const Instance& instance);

/// A primitive under a transformation, with another material if one is given. Every number is
/// computed in double and rounded to float once. Numbers beyond float's range become infinite:
/// find_problem() of the result finds them.
Sphere transformed(const Sphere& sphere, const Similarity& transform,
                   std::optional<std::uint32_t> material);
Plane transformed(const Plane& plane, const Similarity& transform,
                  std::optional<std::uint32_t> material);
Capsule transformed(const Capsule& capsule, const Similarity& transform,
                    std::optional<std::uint32_t> material);

}  // namespace boule
