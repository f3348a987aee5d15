#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// Groups inside groups, at most so deep.
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

/// Those of them, all but the last, that are known in no time, before anything that the instances
/// show is looked at.
std::optional<InstanceProblem> find_reference_problem(const Scene& scene);

/// How many spheres and planes a scene has, those of its instances among them.
struct PrimitiveCount {
  std::uint64_t spheres = 0, planes = 0;

  [[nodiscard]] std::uint64_t total() const { return spheres + planes; }
};
/// Precondition, as of all below: find_reference_problem() finds nothing, which they do not check.
PrimitiveCount count_primitives(const Scene& scene);

/// Calls the function with every sphere or plane that the instances of a valid scene show, in the
/// order of their ids, which follow those of the scene's own: instance by instance, in each the
/// group's own before its instances (depth first). What the function throws reaches the caller.
void visit_shown(const Scene& scene, const std::function<void(const Sphere&)>& function);
void visit_shown(const Scene& scene, const std::function<void(const Plane&)>& function);

/// Puts in place of a valid scene's instances the spheres and planes that they show; groups and
/// instances are gone then. A scene without instances keeps its memory. Throws std::bad_alloc.
void expand_instances(Scene& scene);

}  // namespace boule
