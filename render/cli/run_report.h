#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/cli/exit_code.h"
#include "render/cli/options.h"
#include "render/cli/progress_bar.h"
#include "render/cli/slow_stage.h"
#include "render/cli/stats.h"
#include "render/frame/progress.h"
#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// An error about the command line itself, with the option as its key.
Diagnostic wrong_option(const std::string& message, const char* option);

/// What is wrong with the options that render and trace share, without reading the scene: above
/// all, that the `output` ("picture") or the statistics would replace one of `inputs`, or each
/// other.
Status check_run(const RunOptions& options, const std::string& output,
                 const std::vector<std::string>& inputs = {});

/// Whether the output is a pipe or device, which is written to instead of being replaced.
bool is_stream(const std::string& output);

/// What would be lost: the output, or the statistics, would replace one of the scene's data files.
Status check_data_files(const RunOptions& options, const std::string& output,
                        const std::vector<std::string>& files);

/// A pipe or device gets the data now: a signal's message says that the output is incomplete.
void tell_sending(const std::string& output);

/// What one run of render or trace tells on standard error, as loud as its options say, and its
/// statistics.
class RunReport {
 public:
  /// `options` must outlive it.
  explicit RunReport(const RunOptions& options) : options_(options) {}

  /// A line unless quiet; a "boule: note: " if verbose.
  void note(const std::string& text) const;
  void detail(const std::string& text) const;

  /// The scene's warnings, and its figures.
  void loaded(const LoadedScene& loaded, double seconds) const;
  void prepared(const RunStatistics& run) const;

  /// What is done before there is progress to tell: "reading", "preparing". Told where it takes its
  /// time; ends with the next stage, with the progress bar, or with end_stage().
  void start_stage(const std::string& what);
  void end_stage() { stage_.reset(); }

  /// The progress bar, from start to end.
  void start_progress();
  void progress(const Progress& progress);
  void end_progress();

  /// Writes the statistics.
  [[nodiscard]] ExitCode finish(const Stats& stats) const;

 private:
  const RunOptions& options_;
  std::optional<SlowStage> stage_;
  std::optional<ProgressBar> bar_;
};

}  // namespace boule::cli
