#include "bench/peers/frames/frames.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "bench/peers/frames/child_process.h"
#include "bench/peers/frames/frame_programs.h"
#include "bench/peers/frames/frame_scene.h"
#include "bench/tools/median.h"
#include "tests/support/temp_dir.h"

namespace boule::bench {
namespace {

using std::filesystem::path;

constexpr int start_up_side = 8;

/// What a program's frames took, a value per repetition.
struct Times {
  std::vector<double> cpu, wall;
};

/// The times of whole runs minus the median start-up time.
Spread less(std::vector<double> whole, const std::vector<double>& start_ups) {
  const double start_up = median(start_ups);
  for (double& time : whole) time -= start_up;
  const auto [min, max] = std::minmax_element(whole.begin(), whole.end());
  return {median(whole), *min, *max};
}

/// One program on one scene, with the files of its pictures and its times so far.
class Run {
 public:
  Run(FrameProgram program, path folder)
      : program_(std::move(program)), folder_(std::move(folder)) {}

  [[nodiscard]] const FrameProgram& program() const { return program_; }
  [[nodiscard]] bool installed() const { return !program_.path.empty(); }
  [[nodiscard]] path picture() const { return folder_ / (program_.name + program_.extension); }

  /// One repetition more.
  Status repeat(int side) {
    if (!installed()) return {};
    if (auto done = time(start_up_side, 1, start_); !done) return done;
    if (auto done = time(side, 1, frame_); !done) return done;
    if (!program_.ours) return {};
    if (auto done = time(start_up_side, 2, start_of_two_); !done) return done;
    return time(side, 2, frame_of_two_);
  }

  [[nodiscard]] FrameRow row(const std::string& scene) const {
    FrameRow row;
    row.scene = scene;
    row.program = program_.name;
    if (!installed()) {
      row.missing = program_.binary;
      return row;
    }
    row.cpu = less(frame_.cpu, start_.cpu);
    row.start_up = median(start_.cpu);
    row.tolerance = program_.tolerance;
    return row;
  }

  [[nodiscard]] ScalingRow scaling(const std::string& scene) const {
    const Spread one = less(frame_.wall, start_.wall);
    const Spread two = less(frame_of_two_.wall, start_of_two_.wall);
    return {scene, program_.name, one, two, one.median / two.median};
  }

 private:
  Status time(int side, unsigned threads, Times& times) {
    const bool is_frame = side != start_up_side && threads == 1;
    const path picture =
        is_frame ? this->picture() : folder_ / ("thrown_away" + program_.extension);
    const auto taken = run_child(program_.command(side, threads, picture.string()),
                                 (folder_ / (program_.name + ".log")).string());
    if (!taken) return taken.error();
    times.cpu.push_back(taken.value().cpu);
    times.wall.push_back(taken.value().wall);
    return {};
  }

  FrameProgram program_;
  path folder_;
  Times start_, frame_, start_of_two_, frame_of_two_;
};

/// Holds every picture against the first program's, which is Boule.
Status compare_all(const std::vector<Run>& runs, std::vector<FrameRow>& rows) {
  const auto ours = read_picture(runs.front().picture().string(), runs.front().program().curve);
  if (!ours) return ours.error();
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].installed()) continue;
    const FrameProgram& program = runs[i].program();
    const auto theirs = read_picture(runs[i].picture().string(), program.curve);
    if (!theirs) return theirs.error();
    rows[i].difference = compare_pictures(ours.value(), theirs.value(), program.habit);
  }
  return {};
}

void set_ratios(const std::vector<Run>& runs, std::vector<FrameRow>& rows) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].program().ours) best = std::min(best, rows[i].cpu.median);
  }
  for (FrameRow& row : rows) row.ratio = row.cpu.median / best;
}

Status keep_pictures(const std::vector<Run>& runs, const path& folder, const std::string& scene) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  for (const Run& run : runs) {
    if (!run.installed() || failed) continue;
    std::filesystem::copy_file(run.picture(),
                               folder / (scene + "-" + run.picture().filename().string()),
                               std::filesystem::copy_options::overwrite_existing, failed);
  }
  if (!failed) return {};
  return Diagnostic::of("cannot keep pictures in " + quote(folder.string(), 200));
}

Result<FrameResults> compare_scene(const std::string& name, const FrameSettings& settings) {
  const auto flake = make_flake(name);
  if (!flake) return flake.error();
  const test::TempDir folder;
  auto programs = make_frame_programs(flake.value(), settings.isas, settings.side, folder.path());
  if (!programs) return programs.error();
  std::vector<Run> runs;
  for (FrameProgram& program : programs.value())
    runs.emplace_back(std::move(program), folder.path());
  for (int i = 0; i < settings.repetitions; ++i) {
    for (Run& run : runs) {
      if (auto done = run.repeat(settings.side); !done) return done.error();
    }
  }
  FrameResults results;
  for (const Run& run : runs) {
    results.rows.push_back(run.row(name));
    if (run.program().ours) results.scaling.push_back(run.scaling(name));
  }
  if (auto done = compare_all(runs, results.rows); !done) return done.error();
  set_ratios(runs, results.rows);
  if (settings.pictures.empty()) return results;
  if (auto done = keep_pictures(runs, settings.pictures, name); !done) return done.error();
  return results;
}

}  // namespace

Result<FrameResults> compare_frames(const FrameSettings& settings,
                                    const std::function<void(const FrameResults&)>& report) {
  FrameResults all;
  for (const std::string& scene : settings.scenes) {
    const auto results = compare_scene(scene, settings);
    if (!results) return results.error();
    const auto& [rows, scaling] = results.value();
    report(results.value());
    all.rows.insert(all.rows.end(), rows.begin(), rows.end());
    all.scaling.insert(all.scaling.end(), scaling.begin(), scaling.end());
  }
  return all;
}

}  // namespace boule::bench
