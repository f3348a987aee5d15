#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "render/cli/commands.h"
#include "render/cli/frames.h"
#include "render/cli/interrupt.h"
#include "render/cli/legend.h"
#include "render/cli/live_report.h"
#include "render/cli/messages.h"
#include "render/cli/picture_stream.h"
#include "render/cli/rendering.h"
#include "render/cli/scene_loader.h"
#include "render/cli/text_output.h"

namespace boule::cli {
namespace {

/// What the frames of a series took together.
class SeriesTotals {
 public:
  /// A frame that was rendered.
  void add(const Stats& frame) {
    ++rendered_;
    work_.work_seconds += frame.work_seconds;
    work_.rays += frame.rays;
    work_.isa = frame.isa;
    work_.threads = std::max(work_.threads, frame.threads);
  }
  /// A frame whose picture was there already.
  void add_skipped() { ++skipped_; }

  /// "20 frames, 3 of them there already, 12.30 s, 4.2 Mray/s (avx2, 2 threads)". `seconds` is the
  /// time of the whole series; the speed is that of rendering alone.
  [[nodiscard]] std::string text(double seconds) const {
    std::string text = counted(rendered_ + skipped_, "frame");
    if (skipped_ > 0) text += fmt::format(", {} of them there already", skipped_);
    text += fmt::format(", {:.2f} s", seconds);
    if (rendered_ == 0) return text;
    return text + fmt::format(", {:.1f} Mray/s ({}, {})", mrays_per_s(work_), work_.isa,
                              counted(work_.threads, "thread"));
  }

 private:
  std::size_t rendered_ = 0, skipped_ = 0;
  Stats work_;
};

/// Writes the legend, if one is asked for, of the first scene that was read.
ExitCode write_legend(const RenderCommand& command, const SceneLoader& loader) {
  if (command.legend.empty()) return done;
  Status status;
  {
    const WriteGuard guard;
    status = write_text_file(legend_svg(loader.colors()), command.legend);
  }
  exit_if_interrupted();
  return status ? report(*status, failed) : done;
}

ExitCode run_series(const RenderCommand& command, const FrameRange& frames) {
  if (auto bad = check_frames(command)) return report(*bad, wrong_usage);
  if (auto bad = check_folders(command, frames)) return report(*bad, failed);
  LiveReport live(command, frames.count());
  SeriesTotals totals;
  SceneLoader loader(command);
  for (int number = frames.first; number <= frames.last; number += frames.step) {
    live.start_frame();
    Rendering frame(command_of_frame(command, number), live, loader);
    const ExitCode code = frame.run();
    if (code != done) return code;
    if (frame.skipped()) {
      live.skip_frame();
      totals.add_skipped();
    } else {
      totals.add(frame.stats());
    }
    set_written("earlier frames had been written, this one not");
  }
  live.end_series();
  if (live.is_series() && command.verbosity != Verbosity::quiet)
    print_note("boule: " + printable(shown_output(command.output)) + ": " +
               totals.text(live.seconds()));
  return write_legend(command, loader);
}

}  // namespace

ExitCode run(const RenderCommand& command) {
  if (command.frames) return run_series(command, *command.frames);
  if (auto bad = check_single(command)) return report(*bad, wrong_usage);
  LiveReport live(command);
  SceneLoader loader(command);
  const ExitCode code = Rendering(command, live, loader).run();
  return code == done ? write_legend(command, loader) : code;
}

}  // namespace boule::cli
