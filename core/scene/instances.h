#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/scene.h"

namespace boule {

/// Groups may be nested so deep.
inline constexpr std::size_t max_nesting = 256;

/// What is wrong with one instance of a scene.
struct InstanceProblem {
  /// The group that the instance is in; none: the scene itself.
  std::optional<std::size_t> group{};
  std::size_t instance = 0;  ///< its index there
  Problem problem{};
};

/// The first thing wrong with a scene's instances: a Problem of one by itself, a group or material
/// that there is not, a group that contains itself (the message names the way round), too deep a
/// nesting, more primitives than a scene may have, or a sphere or plane that leaves the range of
/// float. Groups and materials are valid by themselves. Throws std::bad_alloc, as all these do.
std::optional<InstanceProblem> find_instance_problem(const Scene& scene);

/// As find_instance_problem(), but for spheres and planes that leave the range of float: fast,
/// since it does not go through the spheres and planes that the instances show.
std::optional<InstanceProblem> find_reference_problem(const Scene& scene);

/// The most spheres and planes of a scene, with those of groups that are shared
/// (groups_to_share()): ids are 32 bits, those from 2^31 on negative as std::int32_t, and two are
/// no id. In one tree max_primitives.
inline constexpr std::uint64_t max_shown_primitives = 4294967293;

/// How many spheres and planes a scene has, those of its instances among them.
struct PrimitiveCount {
  std::uint64_t spheres = 0, planes = 0;
  std::uint64_t placements = 0;  ///< how often groups that have spheres of their own are shown

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

/// The spheres of a group, but not those of its instances, where an instance shows them.
struct ShownGroup {
  std::uint32_t group = 0;                  ///< index in Scene::groups
  Similarity transform{};                   ///< for transformed()
  std::optional<std::uint32_t> material{};  ///< likewise
};
/// Calls the function for every group that has spheres and is shown, as often as it is, in the
/// order of the spheres' ids.
void visit_shown_groups(const Scene& scene, const std::function<void(const ShownGroup&)>& function);

/// What calls its argument with all of some spheres, a run of them at a time.
using SphereRun = std::span<const Sphere>;
using SphereRuns = std::function<void(const std::function<void(SphereRun)>&)>;

/// The groups that are shown, if it saves much memory not to write their spheres out: in every
/// other case nothing, and expand_instances() is for the scene. What is shown is the same. Throws
/// std::bad_alloc.
std::optional<std::vector<ShownGroup>> groups_to_share(const Scene& scene);

/// The same for a valid scene, of which then only spheres are left in groups; else it is expanded.
std::optional<std::vector<ShownGroup>> share_or_expand(Scene& scene);

/// Coordinates and radii of groups that are shared, where they are shown too, are below this:
/// within the range of the kernels' filters.
inline constexpr double most_shared_coordinate = 1e17;

/// Makes the planes that a valid scene's instances show planes of the scene, with the same ids, and
/// removes those of its groups. Throws std::bad_alloc.
void expand_planes(Scene& scene);

/// Replaces a valid scene's instances by the spheres and planes that they show, and removes its
/// groups. The spheres and planes of a scene without instances stay where they are. Throws
/// std::bad_alloc.
void expand_instances(Scene& scene);

}  // namespace boule
