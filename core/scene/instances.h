#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/kinds.h"
#include "core/scene/scene.h"

namespace boule {

/// The greatest depth of nested groups.
inline constexpr std::size_t max_nesting = 256;

/// A Problem of one instance of a scene.
struct InstanceProblem {
  /// The group that the instance is in; none: the scene itself.
  std::optional<std::size_t> group{};
  std::size_t instance = 0;  ///< its index there
  Problem problem{};
};

/// The first Problem of a scene's instances: one of an instance by itself, an unknown group or
/// material, a group that contains itself (the message names the cycle), too deep nesting, more
/// primitives than a scene may have, or a primitive that leaves the range of float. Groups
/// and materials are valid by themselves. Throws std::bad_alloc, as do all functions here.
std::optional<InstanceProblem> find_instance_problem(const Scene& scene);

/// As find_instance_problem(), but without the test for primitives that leave the range of float.
/// It is fast, because it skips the primitives that the instances show.
std::optional<InstanceProblem> find_reference_problem(const Scene& scene);

/// The largest number of primitives of a scene, those of shared groups (groups_to_share())
/// included: ids have 32 bits, those from 2^31 on are negative as std::int32_t, and two numbers are
/// no ids. One tree holds at most max_primitives.
inline constexpr std::uint64_t max_shown_primitives = 4294967293;

/// The numbers of primitives of a scene, those of its instances included.
struct PrimitiveCount {
  std::uint64_t spheres = 0, planes = 0, capsules = 0;
  std::uint64_t placements = 0;  ///< number of times that groups with spheres of their own are
                                 ///< shown

  [[nodiscard]] std::uint64_t total() const {
    std::uint64_t sum = 0;
    each_kind([&](auto kind) { sum += kind.of(*this); });
    return sum;
  }
  /// Of those that a camera can frame.
  [[nodiscard]] std::uint64_t finite() const { return spheres + capsules; }
};
/// Precondition of this function and of all below, unchecked: find_reference_problem() finds
/// nothing.
PrimitiveCount count_primitives(const Scene& scene);

/// Calls the function with every primitive of a kind that the instances of a valid scene show, in
/// the order of their ids, which follow those of the scene's own. The order is depth first:
/// instance by instance, and in each one the group's own primitives before its instances.
/// Exceptions of the function propagate.
void visit_shown(const Scene& scene, const std::function<void(const Sphere&)>& function);
void visit_shown(const Scene& scene, const std::function<void(const Plane&)>& function);
void visit_shown(const Scene& scene, const std::function<void(const Capsule&)>& function);

/// The spheres of a group, without those of its instances, at the place where an instance shows
/// them.
struct ShownGroup {
  std::uint32_t group = 0;                  ///< index in Scene::groups
  Similarity transform{};                   ///< for transformed()
  std::optional<std::uint32_t> material{};  ///< for transformed()
};
/// Calls the function for every group that has spheres and is shown, as often as it is shown, in
/// the order of the spheres' ids.
void visit_shown_groups(const Scene& scene, const std::function<void(const ShownGroup&)>& function);

/// A function that calls its argument with all spheres of a list, a run of them at a time.
using SphereRun = std::span<const Sphere>;
using SphereRuns = std::function<void(const std::function<void(SphereRun)>&)>;

/// Whether a material of the scene is a Ghost.
bool may_have_ghosts(const Scene& scene);

/// The groups that are shown, if sharing their spheres saves much memory over expanding them;
/// otherwise, and beside ghosts, std::nullopt, and the scene is for expand_instances(). The picture
/// is the same either way. Throws std::bad_alloc.
std::optional<std::vector<ShownGroup>> groups_to_share(const Scene& scene);

/// The same for a valid scene, whose groups then hold only spheres; otherwise expands the scene.
std::optional<std::vector<ShownGroup>> share_or_expand(Scene& scene);

/// The bound of coordinates and radii in shared groups, also as placed in the scene: within the
/// range of the kernels' filters.
inline constexpr double most_shared_coordinate = 1e17;

/// Turns all but the spheres that a valid scene's instances show into primitives of the scene, with
/// the same ids, and removes those of its groups. Throws std::bad_alloc.
void expand_all_but_spheres(Scene& scene);

/// Replaces a valid scene's instances by the primitives that they show, and removes its groups. The
/// primitives of a scene without instances stay in place. Throws std::bad_alloc.
void expand_instances(Scene& scene);

}  // namespace boule
