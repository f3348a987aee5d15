#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/apps/cli/process/exit_code.h"
#include "render/apps/cli/report/live_report.h"
#include "render/apps/cli/report/stats.h"
#include "render/apps/job/options/option_values.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::cli {

/// Checks the options that render and trace share, without reading the scene. Above all, the output
/// and the statistics must not replace one of `inputs`, or each other. `output` is what messages
/// call the output: "picture" or "hits".
Status check_run(const SceneJob& job, const RunOptions& options, const std::string& output,
                 const std::vector<std::string>& inputs = {});

/// Whether the output is a pipe or device, which is written to instead of being replaced.
bool is_stream(const std::string& output);

/// An error if the output or the statistics would replace one of the scene's data files.
Status check_data_files(const RunOptions& options, const std::string& output,
                        const std::vector<std::string>& files);

/// To be called when data begin to go to a pipe or device: from then on a signal's message says
/// that the output is incomplete.
void tell_sending(const std::string& output);

/// Writes the messages of one run of render or trace, or of one frame of a series, to standard
/// error as the options for verbosity say, and its statistics.
class RunReport {
 public:
  /// All must outlive it; a series has one LiveReport for all its frames.
  RunReport(const SceneJob& job, const RunOptions& options, LiveReport& live)
      : job_(job), options_(options), live_(live) {}

  /// note(): a line, unless quiet. note_once(): the same, once in a series. detail(): a line that
  /// begins with "boule: note: ", if verbose.
  void note(const std::string& text) const;
  void note_once(const std::string& text) const;
  void detail(const std::string& text) const;

  /// Writes the scene's warnings, a note if it is empty, and its figures.
  void loaded(const LoadedScene& loaded, double seconds) const;
  void prepared(const RunStatistics& run) const;

  /// Writes the statistics.
  [[nodiscard]] ExitCode finish(const Stats& stats) const;

 private:
  const SceneJob& job_;
  const RunOptions& options_;
  LiveReport& live_;
};

}  // namespace boule::cli
