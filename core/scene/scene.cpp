#include "core/scene/scene.h"

#include <algorithm>

#include "core/scene/instances.h"
#include "core/scene/problem_finder.h"
#include "core/scene/scene_check.h"

namespace boule {
namespace {

Status located(const std::string& path, const std::optional<Problem>& problem) {
  if (!problem) return {};
  return Diagnostic::about(path + "." + problem->field, problem->message);
}

/// "sphere[3]".
std::string numbered(const std::string& name, std::size_t index) {
  return name + "[" + std::to_string(index) + "]";
}

/// Checks all of a scene except its objects, section by section in the order of fields<Scene>.
class SectionCheck {
 public:
  explicit SectionCheck(const Scene& scene) {
    each_field(scene, [this](const auto& field, const auto& section) {
      if (status_) status_ = this->check(std::string(field.key), field.rule, section);
    });
  }

  [[nodiscard]] const Status& status() const { return status_; }

 private:
  /// A struct, or a variant of some.
  template <class T>
  static Status check(const std::string& key, const TypeRule&, const T& section) {
    return located(key, find_problem(section));
  }
  template <class T>
  static Status check(const std::string& key, const TypeRule& rule, const std::optional<T>& some) {
    return some ? check(key, rule, *some) : Status();
  }
  static Status check(const std::string& key, const NumberRule& rule, const Color& color) {
    ProblemFinder finder;
    finder.check(key, rule, color);
    if (!finder.problem()) return {};
    return Diagnostic::about(key, finder.problem()->message);
  }
  static Status check(const std::string& key, const NumberRule& rule,
                      const std::optional<Color>& color) {
    return color ? check(key, rule, *color) : Status();
  }
  static Status check(const std::string& key, const TypeRule&,
                      const std::vector<NamedMaterial>& materials) {
    for (const NamedMaterial& named : materials) {
      if (auto done = located(key + "." + named.name, find_problem(named.material)); !done)
        return done;
    }
    return {};
  }
  static Status check(const std::string& key, const TypeRule&, const std::vector<Light>& lights) {
    return check_list(key, lights);
  }
  static Status check(const std::string& key, const TypeRule&, const std::vector<Clip>& clips) {
    return check_list(key, clips);
  }
  template <class T>
  static Status check_list(const std::string& key, const std::vector<T>& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (auto done = located(numbered(key, i), find_problem(list[i])); !done) return done;
    }
    return {};
  }
  /// check_objects() checks the objects.
  static Status check(const std::string&, const TypeRule&, const std::vector<Sphere>&) {
    return {};
  }
  static Status check(const std::string&, const TypeRule&, const std::vector<Plane>&) { return {}; }
  static Status check(const std::string&, const TypeRule&, const std::vector<Capsule>&) {
    return {};
  }
  static Status check(const std::string&, const TypeRule&, const std::vector<Group>&) { return {}; }
  static Status check(const std::string&, const TypeRule&, const std::vector<Instance>&) {
    return {};
  }
  /// The code that made them has checked them: there may be too many for another pass.
  static Status check(const std::string&, const TypeRule&,
                      const std::shared_ptr<const PackedSpheres>&) {
    return {};
  }
  /// Any numbers are groups.
  static Status check(const std::string&, const TypeRule&, const OutlineGroups&) { return {}; }

  Status status_;
};

bool is_valid(const Plane& plane) { return !find_problem(plane); }
bool is_valid(const Capsule& capsule) { return !find_problem(capsule); }

/// The index of the first invalid primitive, or the number of primitives.
template <class Primitive>
std::size_t find_wrong(const std::vector<Primitive>& primitives, std::size_t materials,
                       const ParallelFor& parallel_for) {
  constexpr std::size_t size = std::size_t{1} << 16;
  const auto wrong = [&](const Primitive& one) {
    return !is_valid(one) || one.material.index() >= materials;
  };
  std::vector<std::size_t> found((primitives.size() + size - 1) / size, primitives.size());
  parallel_for(found.size(), [&](std::size_t i) {
    const auto first = primitives.begin() + static_cast<std::ptrdiff_t>(i * size);
    const auto end =
        first + static_cast<std::ptrdiff_t>(std::min(size, primitives.size() - i * size));
    const auto at = std::find_if(first, end, wrong);
    if (at != end) found[i] = static_cast<std::size_t>(at - primitives.begin());
  });
  return found.empty() ? 0 : *std::min_element(found.begin(), found.end());
}

template <class Primitive>
Status check_primitives(const std::string& name, const std::vector<Primitive>& primitives,
                        const Scene& scene, const ParallelFor& parallel_for = serial_for) {
  const std::size_t i = find_wrong(primitives, scene.materials.size(), parallel_for);
  if (i == primitives.size()) return {};
  const std::string path = numbered(name, i);
  if (auto problem = find_problem(primitives[i])) return located(path, problem);
  return Diagnostic::about(path + ".material", "names no material of the scene");
}

Status check_packed(const Scene& scene) {
  if (!scene.packed) return {};
  if (count_primitives(scene).spheres != scene.packed->count)
    return Diagnostic::about("packed", "a scene has no other spheres beside packed ones");
  if (scene.materials.size() < scene.packed->made_of.size())
    return Diagnostic::about("packed", "the scene lacks materials of its packed spheres");
  return {};
}

Status check_objects(const Scene& scene, const ParallelFor& parallel_for) {
  if (auto done = check_primitives("sphere", scene.spheres, scene, parallel_for); !done)
    return done;
  Status done;
  each_other_kind([&](auto kind) {
    if (done) done = check_primitives(kind.name, kind.of(scene), scene);
  });
  for (const Group& group : scene.groups) {
    each_kind([&](auto kind) {
      if (done)
        done = check_primitives("group." + group.name + "." + kind.name, kind.of(group), scene);
    });
  }
  if (!done) return done;
  const auto bad = find_instance_problem(scene);
  if (!bad) return check_packed(scene);
  const std::string path = bad->group ? "group." + scene.groups[*bad->group].name + "." : "";
  return located(numbered(path + "instance", bad->instance), bad->problem);
}

}  // namespace

Status check_range(const char* key, int value, const WholeRule& rule) {
  if (rule.allows(value)) return {};
  return Diagnostic::about(key, "must be " + describe(rule) + ", is " + std::to_string(value));
}

Status validate_all_but_primitives(const Scene& scene) {
  const SectionCheck sections(scene);
  if (!sections.status()) return sections.status();
  const std::uint64_t packed = scene.packed ? scene.packed->count : 0;
  std::uint64_t own = scene.clips.size();  // their caps have ids, too
  each_kind([&](auto kind) { own += kind.of(scene).size(); });
  const std::uint64_t most =
      packed > 0 && scene.packed->trees.size() > 1 ? max_shown_primitives : max_primitives;
  if (packed > most || packed + own > most) {
    return Diagnostic::about("sphere",
                             "a scene has at most " + std::to_string(most) + " primitives");
  }
  return {};
}

Status validate_in_parallel(const Scene& scene, const ParallelFor& parallel_for) {
  if (auto done = validate_all_but_primitives(scene); !done) return done;
  return check_objects(scene, parallel_for);
}

Status validate(const Scene& scene) { return validate_in_parallel(scene, serial_for); }

}  // namespace boule
