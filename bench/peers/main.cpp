// The referee: Boule against Embree, one process, the same rays, answers compared.
//
//   bench_peers [--scenes u1000,flake4] [--rays primary,shadow,mirror,diffuse,light,...]
//               [--isa avx2,avx512] [--embree-isa avx2,avx512] [--reps N] [--threads N]
//               [--size N] [--json FILE]
//   bench_peers --frames [--scenes flake4,flake5] [--isa avx2,avx512] [--reps N] [--size N]
//               [--pictures FOLDER] [--json FILE]
//
// --frames: whole pictures by Boule's program, Tachyon and POV-Ray instead.
//
// Exit code 1: the truth failed its test against the reference, or a robust contender of Boule's
// differs from it, or a program failed or made another picture than Boule; 2: bad arguments.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>

#include "bench/peers/frames/frame_report.h"
#include "bench/peers/frames/frame_scene.h"
#include "bench/peers/report.h"
#include "bench/peers/summary.h"
#include "bench/tools/command_line.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

struct Arguments {
  RefereeSettings settings;
  std::string json;
  bool whole_frames = false;
  FrameSettings frames;
};

void add_ray_options(CLI::App& app, Arguments& arguments) {
  RefereeSettings& settings = arguments.settings;
  settings.scenes = scene_names();
  settings.kinds = ray_kinds();
  settings.isas = settings.embree_isas = embree_isas();
  std::map<std::string, RayKind> kinds;
  for (const RayKind kind : settings.kinds) kinds[name_of(kind)] = kind;
  app.add_option(
         "--scenes", settings.scenes,
         "uN: N random spheres; flakeD: sphereflake, depth D; or of those of docs/performance.md")
      ->delimiter(',');
  app.add_option("--rays", settings.kinds,
                 "primary, shadow, mirror, diffuse, light, ambient, orthographic, chord")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--isa", settings.isas, "Instruction sets of Boule's kernels")->delimiter(',');
  app.add_option("--embree-isa", settings.embree_isas, "Instruction sets of Embree, avx2 or avx512")
      ->delimiter(',')
      ->check(CLI::IsMember(embree_isas()));
  const auto set_repetitions = [&settings](int repetitions) {
    settings.repetitions = repetitions;
    settings.patience = std::numeric_limits<double>::infinity();
  };
  app.add_option_function<int>("--reps", set_repetitions, "Repetitions (3 to 7, by the time taken)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--threads", settings.threads, "1: CPU time (default); more: wall clock")
      ->check(CLI::Range(1, 1024));
  app.add_option("--size", settings.side, "Pixels along the picture's side (1024)")
      ->check(CLI::Range(1, 16384));
  app.add_option("--json", arguments.json, "File to write the figures to");
}

/// --frames has defaults of its own where the two comparisons share an option.
void add_frame_options(CLI::App& app, Arguments& arguments) {
  CLI::Option* const frames =
      app.add_flag("--frames", arguments.whole_frames,
                   "Whole frames: Boule's program against Tachyon's and POV-Ray's");
  app.add_option("--pictures", arguments.frames.pictures, "Folder to keep the frames' pictures in")
      ->needs(frames);
  for (const char* name : {"--rays", "--threads", "--embree-isa"})
    frames->excludes(app.get_option(name));
  app.final_callback([&app, &arguments] {
    FrameSettings& settings = arguments.frames;
    if (app.count("--scenes") > 0) settings.scenes = arguments.settings.scenes;
    if (app.count("--reps") > 0) settings.repetitions = arguments.settings.repetitions;
    settings.isas = arguments.settings.isas;
    settings.side = arguments.settings.side;
  });
}

void add_options(CLI::App& app, Arguments& arguments) {
  add_ray_options(app, arguments);
  add_frame_options(app, arguments);
}

/// The first ISA that this machine lacks, or the first unknown name; empty if there is none.
Status find_problem(const Arguments& arguments) {
  if (!arguments.whole_frames && !select_kernels("avx2")) {
    return Diagnostic::of("Embree's callbacks need AVX2");
  }
  for (const std::string& isa : arguments.settings.isas) {
    const auto kernels = select_kernels(isa);
    if (!kernels) return kernels.error();
  }
  return {};
}

int fail(const Diagnostic& diagnostic, int code) {
  std::fprintf(stderr, "%s\n", format_diagnostic(diagnostic).c_str());
  return code;
}

bool all_right(const Results& results) {
  const auto true_truth = [](const Check& check) { return check.truth_mismatches == 0; };
  const auto right = [](const Row& row) { return !row.exact || row.mismatches == 0; };
  return std::all_of(results.checks.begin(), results.checks.end(), true_truth) &&
         std::all_of(results.rows.begin(), results.rows.end(), right);
}

int run_frames(const Arguments& arguments) {
  const FrameSettings& settings = arguments.frames;
  for (const std::string& scene : settings.scenes) {
    if (const auto made = make_flake(scene); !made) return fail(made.error(), 2);
  }
  const Machine machine = this_machine();
  print_frame_machine(machine, settings);
  const Result<FrameResults> results = compare_frames(settings, print_frames);
  if (!results) return fail(results.error(), 1);
  const FrameResults& found = results.value();
  if (!arguments.json.empty()) {
    const Status done = write_frames_json(arguments.json, machine, settings, found);
    if (!done) return fail(done.error(), 1);
  }
  const auto alike = [](const FrameRow& row) { return row.alike(); };
  return std::all_of(found.rows.begin(), found.rows.end(), alike) ? 0 : 1;
}

int run(const Arguments& arguments) {
  if (const Status done = find_problem(arguments); !done) return fail(done.error(), 2);
  if (arguments.whole_frames) return run_frames(arguments);
  const Machine machine = this_machine();
  print_machine(machine, arguments.settings);
  const Result<Results> results = compare(arguments.settings, print_workload);
  if (!results) return fail(results.error(), 2);
  print_summary(results.value(), arguments.settings);
  if (!arguments.json.empty()) {
    const Status done = write_json(arguments.json, machine, arguments.settings, results.value());
    if (!done) return fail(done.error(), 1);
  }
  return all_right(results.value()) ? 0 : 1;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  using namespace boule::bench;
  return run_program<Arguments>(
      "Compares Boule with Embree: the same rays, one process, answers checked.", argc, argv,
      add_options, run);
}
