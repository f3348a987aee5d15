#include "core/scene/instances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace boule {
namespace {

/// The material that replaces all others inside an instance, if there is one.
using Replacement = std::optional<std::uint32_t>;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max() / 4;

/// The sum of two counts, limited to `most`, because nested groups multiply counts beyond 64 bits.
PrimitiveCount add(const PrimitiveCount& a, const PrimitiveCount& b) {
  PrimitiveCount sum;
  each_kind([&](auto kind) { kind.of(sum) = std::min(kind.of(a) + kind.of(b), most); });
  sum.placements = std::min(a.placements + b.placements, most);
  return sum;
}

/// The primitives of a scene or a group, without those of its instances.
template <class Owner>
PrimitiveCount count_own(const Owner& owner) {
  PrimitiveCount count;
  each_kind([&](auto kind) { kind.of(count) = kind.of(owner).size(); });
  return count;
}

/// Goes through all groups, each once and inner ones first. It counts the primitives in
/// them, and finds groups that contain themselves or are nested too deep.
class GroupSurvey {
 public:
  explicit GroupSurvey(const Scene& scene)
      : scene_(scene),
        counts_(scene.groups.size()),
        depths_(scene.groups.size()),
        states_(scene.groups.size(), State::unseen) {
    for (std::size_t i = 0; i < scene.groups.size() && !problem_; ++i) visit(i);
  }

  /// The first Problem of an instance in a group, if any.
  [[nodiscard]] const std::optional<InstanceProblem>& problem() const { return problem_; }

  /// The primitives in each group, those of its instances included.
  [[nodiscard]] const std::vector<PrimitiveCount>& counts() const { return counts_; }

 private:
  enum class State { unseen, open, done };

  void visit(std::size_t group) {
    states_[group] = State::open;
    way_.push_back(group);
    const Group& own = scene_.groups[group];
    PrimitiveCount count = count_own(own);
    count.placements = own.spheres.empty() ? 0 : 1;
    std::size_t depth = 1;
    for (std::size_t i = 0; i < own.instances.size() && !problem_; ++i) {
      const std::size_t inner = own.instances[i].group;
      enter(group, i, inner);
      count = add(count, counts_[inner]);
      depth = std::max(depth, depths_[inner] + 1);
    }
    counts_[group] = count;
    depths_[group] = depth;
    states_[group] = State::done;
    way_.pop_back();
  }

  /// Visits the group `inner` of an instance, unless it was visited before. Reports a cycle, and a
  /// nesting deeper than max_nesting: of the groups that lead here, or of those inside `inner`.
  void enter(std::size_t group, std::size_t instance, std::size_t inner) {
    if (states_[inner] == State::open) {
      return report(group, instance, "makes a cycle: " + way_round(inner));
    }
    if (states_[inner] == State::unseen && way_.size() < max_nesting) visit(inner);
    if (way_.size() < max_nesting && depths_[inner] < max_nesting) return;
    report(group, instance, "groups are nested more than " + std::to_string(max_nesting) + " deep");
  }

  /// "'a' -> 'b' -> 'a'".
  std::string way_round(std::size_t begin) const {
    auto at = std::find(way_.begin(), way_.end(), begin);
    std::string text;
    for (; at != way_.end(); ++at) text += quote(scene_.groups[*at].name) + " -> ";
    return text + quote(scene_.groups[begin].name);
  }

  void report(std::size_t group, std::size_t instance, std::string message) {
    problem_ = InstanceProblem{group, instance, {"group", std::move(message)}};
  }

  const Scene& scene_;
  std::vector<PrimitiveCount> counts_;
  std::vector<std::size_t> depths_;  ///< by group: levels of groups in it, itself included
  std::vector<State> states_;
  std::vector<std::size_t> way_;  ///< the groups that are open, outer ones first
  std::optional<InstanceProblem> problem_;
};

PrimitiveCount count_with(const Scene& scene, const std::vector<PrimitiveCount>& groups) {
  PrimitiveCount count = count_own(scene);
  for (const Instance& instance : scene.instances) count = add(count, groups[instance.group]);
  return count;
}

/// Calls function(shown) for all groups with primitives of one kind, of their own or of their
/// instances', that instances show. It recurses at most max_nesting deep.
template <class Primitive, class Function>
class Walk {
 public:
  Walk(const Scene& scene, const std::vector<PrimitiveCount>& counts, const Function& function)
      : scene_(scene), counts_(counts), function_(function) {}

  void visit(const std::vector<Instance>& instances, const Similarity& outer,
             Replacement material) {
    for (const Instance& instance : instances) {
      if (PrimitiveKind<Primitive>::of(counts_[instance.group]) == 0) continue;
      const Group& group = scene_.groups[instance.group];
      const Similarity transform = compose(outer, transform_of(instance));
      const Replacement inside = material ? material : instance.material;
      if (!PrimitiveKind<Primitive>::of(group).empty())
        function_({instance.group, transform, inside});
      visit(group.instances, transform, inside);
    }
  }

 private:
  const Scene& scene_;
  const std::vector<PrimitiveCount>& counts_;
  const Function& function_;
};

template <class Primitive, class Function>
void walk_groups(const Scene& scene, const std::vector<PrimitiveCount>& counts,
                 const std::vector<Instance>& instances, const Function& function) {
  Walk<Primitive, Function>(scene, counts, function).visit(instances, {}, {});
}

/// Calls function(primitive) with all primitives of one kind that these instances of the scene
/// show.
template <class Primitive, class Function>
void walk(const Scene& scene, const std::vector<PrimitiveCount>& counts,
          const std::vector<Instance>& instances, const Function& function) {
  walk_groups<Primitive>(scene, counts, instances, [&](const ShownGroup& shown) {
    for (const Primitive& one : PrimitiveKind<Primitive>::of(scene.groups[shown.group]))
      function(transformed(one, shown.transform, shown.material));
  });
}

/// Adds the primitives of a kind that the scene's instances show to its own.
template <class Primitive>
void expand(Scene& scene, const std::vector<PrimitiveCount>& counts,
            PrimitiveKind<Primitive> kind) {
  walk<Primitive>(scene, counts, scene.instances,
                  [&](const Primitive& one) { kind.of(scene).push_back(one); });
}

/// The first Problem of an instance by itself, or of its references to a group and a material.
std::optional<Problem> find_own_problem(const Scene& scene, const Instance& instance) {
  if (auto problem = find_problem(instance)) return problem;
  if (instance.group >= scene.groups.size()) {
    return Problem{"group", "names no group of the scene"};
  }
  if (instance.material && *instance.material >= scene.materials.size()) {
    return Problem{"material", "names no material of the scene"};
  }
  return std::nullopt;
}

std::optional<InstanceProblem> find_own_problem(const Scene& scene,
                                                const std::vector<Instance>& instances,
                                                std::optional<std::size_t> group) {
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (auto problem = find_own_problem(scene, instances[i])) {
      return InstanceProblem{group, i, *problem};
    }
  }
  return std::nullopt;
}

/// The range of a group's own spheres.
struct SphereRange {
  float largest = 0;  ///< of all absolute coordinates and radii
  float smallest_radius = std::numeric_limits<float>::infinity();

  /// True if all numbers are certainly below `limit` at the place where the spheres are shown, and
  /// if radii keep all their digits.
  [[nodiscard]] bool stays_below(double limit, const Similarity& transform) const {
    const Vec3d& s = transform.shift;
    const double farthest = std::max({std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)});
    const double size = 2 * transform.scale * double{largest};  // every row is at most sqrt(3) long
    return size + farthest < limit && transform.scale * double{smallest_radius} > 1e-37;
  }
};

SphereRange range_of(const std::vector<Sphere>& spheres) {
  SphereRange range;
  for (const Sphere& s : spheres) {
    range.largest = std::max({range.largest, std::fabs(s.center.x), std::fabs(s.center.y),
                              std::fabs(s.center.z), s.radius});
    range.smallest_radius = std::min(range.smallest_radius, s.radius);
  }
  return range;
}

std::vector<SphereRange> ranges_of(const std::vector<Group>& groups) {
  std::vector<SphereRange> ranges;
  ranges.reserve(groups.size());
  for (const Group& group : groups) ranges.push_back(range_of(group.spheres));
  return ranges;
}

/// True if every primitive that an instance shows is still valid after rounding to float.
/// Skips groups that certainly stay in range.
bool stays_in_range(const Scene& scene, const std::vector<PrimitiveCount>& counts,
                    const std::vector<SphereRange>& ranges, const Instance& instance) {
  bool good = true;
  walk_groups<Sphere>(scene, counts, {instance}, [&](const ShownGroup& shown) {
    if (!good || ranges[shown.group].stays_below(1e38, shown.transform)) return;
    for (const Sphere& sphere : scene.groups[shown.group].spheres)
      good = good && is_valid(transformed(sphere, shown.transform, {}));
  });
  each_other_kind([&](auto kind) {
    using Primitive = typename decltype(kind)::Primitive;
    walk<Primitive>(scene, counts, {instance},
                    [&good](const Primitive& one) { good = good && !find_problem(one); });
  });
  return good;
}

/// The number of bytes of a sphere in a tree, and of showing a tree once more.
constexpr std::uint64_t bytes_of_sphere = 26, bytes_of_placement = 512;

/// Whether keeping the groups takes half the memory, or less.
bool saves_memory(const Scene& scene, const PrimitiveCount& count) {
  constexpr std::uint64_t fewest = 1U << 17;
  const std::uint64_t shown = count.spheres - scene.spheres.size();
  std::uint64_t kept = 0;
  for (const Group& group : scene.groups) kept += group.spheres.size();
  return shown >= fewest && shown * bytes_of_sphere / 2 >=
                                kept * bytes_of_sphere + count.placements * bytes_of_placement;
}

}  // namespace

std::optional<InstanceProblem> find_reference_problem(const Scene& scene) {
  for (std::size_t i = 0; i < scene.groups.size(); ++i) {
    if (auto bad = find_own_problem(scene, scene.groups[i].instances, i)) return bad;
  }
  if (auto bad = find_own_problem(scene, scene.instances, {})) return bad;
  const GroupSurvey survey(scene);
  if (survey.problem()) return survey.problem();
  PrimitiveCount count = count_own(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    count = add(count, survey.counts()[scene.instances[i].group]);
    const bool many = count.total() > max_primitives;
    if (!many || (saves_memory(scene, count) && count.total() <= max_shown_primitives)) continue;
    return InstanceProblem{
        {},
        i,
        {"group",
         "with it the scene has more than " +
             std::to_string(saves_memory(scene, count) ? max_shown_primitives : max_primitives) +
             " primitives"}};
  }
  return std::nullopt;
}

std::optional<InstanceProblem> find_instance_problem(const Scene& scene) {
  if (auto bad = find_reference_problem(scene)) return bad;
  const GroupSurvey survey(scene);
  const std::vector<SphereRange> ranges = ranges_of(scene.groups);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (stays_in_range(scene, survey.counts(), ranges, scene.instances[i])) continue;
    return InstanceProblem{
        {}, i, {"scale", "takes a primitive of the group out of a 32-bit float's range"}};
  }
  const bool many = count_with(scene, survey.counts()).total() > max_primitives;
  if (!many || groups_to_share(scene)) return std::nullopt;
  return InstanceProblem{
      {},
      0,
      {"group",
       "shows more than 2147483647 primitives, some of them beyond 1e17 or beside ghosts"}};
}

PrimitiveCount count_primitives(const Scene& scene) {
  PrimitiveCount count = count_own(scene);
  if (!scene.instances.empty()) count = count_with(scene, GroupSurvey(scene).counts());
  if (scene.packed) count.spheres += scene.packed->count;
  return count;
}

void visit_shown(const Scene& scene, const std::function<void(const Sphere&)>& function) {
  if (scene.instances.empty()) return;
  const GroupSurvey survey(scene);
  walk<Sphere>(scene, survey.counts(), scene.instances, function);
}

void visit_shown(const Scene& scene, const std::function<void(const Plane&)>& function) {
  if (scene.instances.empty()) return;
  const GroupSurvey survey(scene);
  walk<Plane>(scene, survey.counts(), scene.instances, function);
}

void visit_shown(const Scene& scene, const std::function<void(const Capsule&)>& function) {
  if (scene.instances.empty()) return;
  const GroupSurvey survey(scene);
  walk<Capsule>(scene, survey.counts(), scene.instances, function);
}

void visit_shown_groups(const Scene& scene,
                        const std::function<void(const ShownGroup&)>& function) {
  if (scene.instances.empty()) return;
  const GroupSurvey survey(scene);
  walk_groups<Sphere>(scene, survey.counts(), scene.instances, function);
}

bool may_have_ghosts(const Scene& scene) {
  return std::any_of(
      scene.materials.begin(), scene.materials.end(),
      [](const NamedMaterial& named) { return std::holds_alternative<Ghost>(named.material); });
}

std::optional<std::vector<ShownGroup>> groups_to_share(const Scene& scene) {
  if (scene.instances.empty() || may_have_ghosts(scene)) return std::nullopt;
  const GroupSurvey survey(scene);
  const PrimitiveCount count = count_with(scene, survey.counts());
  if (!saves_memory(scene, count)) return std::nullopt;
  const std::vector<SphereRange> ranges = ranges_of(scene.groups);
  std::vector<ShownGroup> groups;
  groups.reserve(static_cast<std::size_t>(count.placements));
  bool fits = double{range_of(scene.spheres).largest} < most_shared_coordinate;
  walk_groups<Sphere>(scene, survey.counts(), scene.instances, [&](const ShownGroup& shown) {
    const SphereRange& range = ranges[shown.group];
    fits = fits && double{range.largest} < most_shared_coordinate &&
           range.stays_below(most_shared_coordinate, shown.transform);
    groups.push_back(shown);
  });
  return fits ? std::optional(std::move(groups)) : std::nullopt;
}

void expand_all_but_spheres(Scene& scene) {
  if (scene.instances.empty()) return;
  const GroupSurvey survey(scene);
  each_other_kind([&](auto kind) {
    expand(scene, survey.counts(), kind);
    for (Group& group : scene.groups) kind.of(group) = {};
  });
}

std::optional<std::vector<ShownGroup>> share_or_expand(Scene& scene) {
  auto groups = groups_to_share(scene);
  groups ? expand_all_but_spheres(scene) : expand_instances(scene);
  return groups;
}

void expand_instances(Scene& scene) {
  if (!scene.instances.empty()) {
    const GroupSurvey survey(scene);
    const PrimitiveCount count = count_with(scene, survey.counts());
    each_kind([&](auto kind) {
      kind.of(scene).reserve(static_cast<std::size_t>(kind.of(count)));
      expand(scene, survey.counts(), kind);
    });
  }
  scene.instances = {};
  scene.groups = {};
}

}  // namespace boule
