#include "render/apps/cli/options/trace_options.h"

#include <limits>

#include "render/apps/cli/options/command_app.h"
#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/job/options/option_values.h"

namespace boule::cli {
namespace {

/// What is asked of the rays, in place of their nearest hits.
void add_answers(CLI::App& app, TraceCommand& command) {
  CLI::Option* options[4] = {};
  std::size_t count = 0;
  const auto add = [&](const char* name, HitKind answer, const char* help) {
    CLI::Option* const option = app.add_flag_callback(
        name, [&command, answer] { command.answer = answer; }, help);
    for (std::size_t i = 0; i < count; ++i) option->excludes(options[i]);
    options[count++] = option;
  };
  add("--any-hit", HitKind::any,
      "Only whether anything is met with tmin < t <= tmax: N bytes (uint8), 1 or 0");
  add("--all-hits", HitKind::all,
      "All crossings, in order: records of ray (int64, its row), t, id, entering (bool)");
  add("--count", HitKind::count, "The number of crossings of each ray: N int64");
  add("--chord", HitKind::chord,
      "The length of each ray inside the union of all spheres, in units of t: N float64");
  add_whole(app, "--limit", command.limit, std::size_t{0}, std::size_t{max_primitives} * 2,
            "With --all-hits: the first N crossings of each ray (all)");
  app.get_option("--limit")->needs("--all-hits");
  for (const CLI::Option* option : options) app.get_option(option->get_name())->needs("--rays");
}

void add_number(CLI::App& app, const char* name, std::optional<double>& target, const char* type,
                const char* help) {
  const auto parse = [](const std::string& text) {
    constexpr double most = std::numeric_limits<double>::max();
    return parse_number(text, -most, most);
  };
  add_parsed(app, name, target, parse, "a number", type, help);
}

void add_points(CLI::App& app, TraceCommand& command) {
  start_group(app, "Points and pairs, in place of rays");
  app.add_option(
         "--points", command.points,
         "Points, .npy: float32 or float64, N x 3. Of each the nearest object: N records of "
         "distance (float64, negative inside), id (int32)")
      ->type_name("POINTS.npy");
  add_whole(app, "--nearest", command.nearest, std::size_t{1}, std::size_t{max_primitives},
            "The N nearest objects of each point, the nearest first (1)");
  app.add_flag("--inside", command.inside,
               "All objects that each point is in: records of point (int64, its row), id");
  add_number(app, "--within", command.within, "R",
             "All objects at most R away from each point, likewise; with --nearest only those");
  add_number(app, "--pairs", command.pairs, "GAP",
             "All pairs of spheres at most GAP apart: records of first, second (int32), gap "
             "(float64)");
  for (const char* name : {"--nearest", "--inside", "--within"})
    app.get_option(name)->needs("--points");
  app.get_option("--inside")->excludes("--nearest")->excludes("--within");
  app.get_option("--points")->excludes("--rays");
  app.get_option("--pairs")->excludes("--rays")->excludes("--points");
}

}  // namespace

HitKind kind_of(const TraceCommand& command) {
  if (command.pairs) return HitKind::pairs;
  if (command.points.empty()) return command.answer;
  const bool all = command.inside || command.within;
  return all && !command.nearest ? HitKind::members : HitKind::nearest;
}

void add_questions(CLI::App& app, TraceCommand& command) {
  start_group(app, "Rays");
  app.add_option(
         "--rays", command.rays,
         "Rays, .npy: float32 or float64, N x 8: origin x y z, tmin, direction x y z, tmax; "
         "or N x 10: source (an id, or -1) and inside (0 or 1), too")
      ->type_name("RAYS.npy");
  add_answers(app, command);
  add_points(app, command);
}

Status check_questions(const TraceCommand& command) {
  if (command.pairs || !command.rays.empty() || !command.points.empty()) return {};
  return wrong_option("expected --rays, --points or --pairs", "--rays");
}

}  // namespace boule::cli
