#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// Groups may be nested so deep.
inline constexpr std::size_t max_nesting = 256;

/// What is wrong with one instance of a scene.
struct InstanceProblem {
  std::optional<std::size_t> group;  ///< the group that the instance is in; none: the scene itself
  std::size_t instance = 0;          ///< its index there
  Problem problem;
};

/// The first thing wrong with a scene's instances: a Problem of one by itself, a group or material
/// that there is not, a group that contains itself (the message names the way round), too deep a
/// nesting, more primitives than a scene may have, or a sphere or plane that leaves the range of
/// float. Groups and materials are valid by themselves. Throws std::bad_alloc, as all these do.
std::optional<InstanceProblem> find_instance_problem(const Scene& scene);

/// As find_instance_problem(), but for spheres and planes that leave the range of float: fast,
/// since it does not go through the spheres and planes that the instances show.
std::optional<InstanceProblem> find_reference_problem(const Scene& scene);

/// How many spheres and planes a scene has, those of its instances among them.
struct PrimitiveCount {
  std::uint64_t spheres = 0, planes = 0;

  [[nodiscard]] std::uint64_t total() const { return spheres + planes; }
};
/// Precondition of this and of all functions below, not checked: find_reference_problem() finds
/// nothing.
PrimitiveCount count_primitives(const Scene& scene);

/// Calls the function with every sphere or plane that the instances of a valid scene show, in the
/// order of their ids, which follow those of the scene's own. The order is depth first: instance by
/// instance, and in each one the group's own spheres or planes before its instances. What the
/// function throws reaches the caller.
void visit_shown(const Scene& scene, const std::function<void(const Sphere&)>& function);
void visit_shown(const Scene& scene, const std::function<void(const Plane&)>& function);

/// Replaces a valid scene's instances by the spheres and planes that they show, and removes its
/// groups. The spheres and planes of a scene without instances stay where they are. Throws
/// std::bad_alloc.
void expand_instances(Scene& scene);

}  // namespace boule
