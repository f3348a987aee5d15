// Moving the spheres of a tracer.
#include <string>
#include <utility>

#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"
#include "render/renderer/preparation.h"
#include "render/renderer/queries/trace_worker.h"
#include "render/renderer/tracer.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

Status check_moved(std::span<const Sphere> spheres, std::size_t expected) {
  if (spheres.size() != expected) {
    return Diagnostic::about("spheres", "there are " + std::to_string(expected) + ", got " +
                                            std::to_string(spheres.size()));
  }
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (is_valid(spheres[k])) continue;
    const auto problem = find_problem(spheres[k]);
    return Diagnostic::about(
        "spheres", "sphere " + std::to_string(k) + ": " + problem->field + " " + problem->message);
  }
  return {};
}

}  // namespace

Status Tracer::update(std::span<const Sphere> spheres) {
  if (workers_.empty()) return moved_away();
  if (!geometry_.owns_spheres()) {
    return Diagnostic::of(
        "the spheres of packed scenes, and those of groups that instances share, cannot be moved");
  }
  if (auto done = check_moved(spheres, geometry_.sphere_count()); !done) return done;
  const FloatEnvironment environment;
  Scheduler scheduler(options_.threads);
  const ParallelFor parallel_for = scheduler.parallel_for();
  bool is_good = false, has_moved = false;
  const auto move = [&] {
    has_moved = geometry_.refit(spheres, parallel_for);
    view_ = geometry_.view();
    is_good = has_moved && geometry_.cost() <= tuning::worn_tree * built_cost_;
  };
  const auto build = [&] {
    geometry_ = geometry_.with_spheres({spheres.begin(), spheres.end()}, parallel_for);
    view_ = geometry_.view();
    built_cost_ = geometry_.cost();
  };
  if (auto done = diagnose(std::cref(move)); !done) return done;
  if (is_good) return {};
  const std::uint64_t most = bytes_of_spheres(spheres.size()) + bytes_of_tree(spheres.size());
  Status built = check_memory(most, std::to_string(spheres.size()) + " spheres need");
  if (built) built = diagnose(std::cref(build));
  return has_moved ? Status() : built;  // a worn tree is right as well
}

std::vector<Sphere> Tracer::spheres() const {
  if (workers_.empty() || !geometry_.owns_spheres()) return {};
  return geometry_.spheres();
}

}  // namespace boule
