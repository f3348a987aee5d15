#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/standard_error.h"
#include "render/apps/cli/process/text_output.h"
#include "render/apps/cli/render/claim.h"
#include "render/apps/cli/render/frames.h"
#include "render/apps/cli/render/rendering.h"
#include "render/apps/cli/render/team_start.h"
#include "render/apps/cli/report/live_report.h"
#include "render/apps/cli/report/movie.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/apps/job/particle_scene.h"
#include "render/apps/job/picture/legend.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "render/frame/scheduler.h"

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
  /// A frame that another rank rendered.
  void add_other() { ++others_; }

  /// "20 frames, 3 of them there already, 12.30 s, 4.2 Mray/s (avx2, 2 threads)". `seconds` is the
  /// time of the whole series; the speed is that of rendering alone.
  [[nodiscard]] std::string text(double seconds) const {
    std::string text = counted(rendered_ + skipped_ + others_, "frame");
    if (others_ > 0) text += fmt::format(", {} of them by other ranks", others_);
    if (skipped_ > 0) text += fmt::format(", {} of them there already", skipped_);
    text += fmt::format(", {:.2f} s", seconds);
    if (rendered_ == 0) return text;
    return text + fmt::format(", {:.1f} Mray/s ({}, {})", mrays_per_s(work_), work_.isa,
                              counted(work_.threads, "thread"));
  }

 private:
  std::size_t rendered_ = 0, skipped_ = 0, others_ = 0;
  Stats work_;
};

/// Writes the legend, if one is asked for.
ExitCode write_legend(const RenderCommand& command, const SceneLoader& loader) {
  if (command.legend.empty()) return done;
  const Status status =
      write_guarded([&] { return write_text_file(legend_svg(loader.colors()), command.legend); });
  return status ? done : report(status.error(), failed);
}

/// A series, frame by frame; with --claim only frames that no other process has.
class Series {
 public:
  /// `movie` may be null; else the frames go there, and the series ends with it. `team` may be
  /// null. Its ranks share out the frames where there are more frames than ranks; else they render
  /// each picture together.
  Series(const RenderCommand& command, const FrameRange& frames, Team* team, Movie* movie)
      : command_(command),
        movie_(movie),
        live_(command, frames.count()),
        loader_(command),
        dealing_(team != nullptr && frames.count() > team->size() ? team : nullptr),
        together_(dealing_ == nullptr ? team : nullptr) {
    for (int number = frames.first; number <= frames.last; number += frames.step)
      rest_.push_back(number);
  }

  ExitCode run();

 private:
  ExitCode run_round();
  ExitCode run_dealt(const std::vector<int>& frames);
  ExitCode run_claimed(int number);
  ExitCode run_frame(int number);

  const RenderCommand& command_;
  Movie* const movie_;
  LiveReport live_;
  SeriesTotals totals_;
  SceneLoader loader_;
  Claims claims_;
  Team* const dealing_;    ///< which deals out frames
  Team* const together_;   ///< which renders each frame
  std::vector<int> rest_;  ///< frames to look at, in this round or in the next
};

/// Frames of other processes are looked at again until they are finished, or their owners gone.
ExitCode Series::run() {
  constexpr timespec pause{0, 200'000'000};
  while (!rest_.empty()) {
    const ExitCode code = run_round();
    if (code != done) return code;
    if (!rest_.empty()) nanosleep(&pause, nullptr);
  }
  live_.end_series();
  const Status finished = movie_ != nullptr ? movie_->finish() : Status();
  if (!finished) return report(finished.error(), failed);
  if (live_.is_series() && command_.verbosity != Verbosity::quiet)
    print_note("boule: " + printable(shown_output(command_)) + ": " +
               totals_.text(live_.seconds()));
  return write_legend(command_, loader_);
}

ExitCode Series::run_round() {
  if (dealing_ != nullptr) return run_dealt(std::exchange(rest_, {}));
  for (const int number : std::exchange(rest_, {})) {
    const ExitCode code = command_.claim ? run_claimed(number) : run_frame(number);
    if (code != done) return code;
  }
  return done;
}

/// Frames that went to other ranks in between count as frames of the series, too.
ExitCode Series::run_dealt(const std::vector<int>& frames) {
  const int count = static_cast<int>(frames.size());
  for (int next = 0; next < count;) {
    const int mine = dealing_->next_frame(count).value_or(count);
    for (; next < mine; ++next) {
      live_.start_frame();
      live_.skip_frame();
      totals_.add_other();
    }
    if (mine == count) break;
    const ExitCode code = run_frame(frames[static_cast<std::size_t>(mine)]);
    if (code != done) return code;
    next = mine + 1;
  }
  return done;
}

ExitCode Series::run_claimed(int number) {
  const std::string picture = frame_name(command_.output, number);
  const auto claim = claims_.take(picture);
  if (!claim) return report(claim.error(), failed);
  if (!claim.value()) {
    rest_.push_back(number);
    return done;
  }
  if (command_.partial || !claims_.is_new(picture)) return run_frame(number);
  live_.start_frame();
  live_.skip_frame();
  totals_.add_skipped();
  return done;
}

ExitCode Series::run_frame(int number) {
  live_.start_frame();
  Rendering frame(command_of_frame(command_, number), live_, loader_, together_);
  const ExitCode code = frame.run();
  if (code != done) return code;
  if (frame.skipped()) {
    live_.skip_frame();
    totals_.add_skipped();
  } else {
    totals_.add(frame.stats());
  }
  set_written("earlier frames had been written, this one not");
  return done;
}

ExitCode run_series(const RenderCommand& command, const FrameRange& frames, Team* team,
                    Movie* movie) {
  if (auto done = check_frames(command); !done) return report(done.error(), wrong_usage);
  if (auto done = check_folders(command, frames); !done) return report(done.error(), failed);
  return Series(command, frames, team, movie).run();
}

/// By this process alone, or as the part of it in a team.
ExitCode run_in(Team* team, const RenderCommand& command, Movie* movie = nullptr) {
  if (command.frames) return run_series(command, *command.frames, team, movie);
  if (auto done = check_single(command); !done) return report(done.error(), wrong_usage);
  LiveReport live(command);
  SceneLoader loader(command);
  const ExitCode code = Rendering(command, live, loader, team).run();
  return code == done ? write_legend(command, loader) : code;
}

/// A rank that is not the leader says nothing itself: the leader tells what it had to tell.
ExitCode run_as_rank(Team& team, const RenderCommand& command) {
  if (!team.leads()) keep_lines();
  const auto run = [&]() -> ExitCode {
    if (auto done = check_team(command); !done) return report(done.error(), wrong_usage);
    return run_in(&team, team.leads() ? command : command_of_rank(command));
  };
  const ExitCode own = run();
  ignore_interrupts();  // launchers send some when the first rank ends
  const std::string told = kept_lines();
  const auto code = static_cast<ExitCode>(team.leave(own, told.substr(0, told.find('\n'))));
  if (team.leads() && own == done && code != done)
    return report(Diagnostic::of(team.failures()), code);
  return code;
}

/// With --interpolate N the numbers of a series are those of pictures, N from frame to frame.
Status count_pictures(RenderCommand& command) {
  const int pictures = command.interpolate;
  if (pictures == 1) return {};
  const auto refuse = [](const char* why) { return wrong_option(why, "--interpolate"); };
  if (command.turn) return refuse("is of frames of particles, not of --turn");
  if (!command.frames) return refuse("is of a series: --frames is missing, or a movie");
  FrameRange& frames = *command.frames;
  if (frames.step != 1) return refuse("needs all frames, --frames without a step");
  constexpr int most = std::numeric_limits<int>::max();
  if (frames.last > most / pictures) return refuse("makes too many pictures");
  frames = {frames.first * pictures, frames.last * pictures};
  return {};
}

/// The frames of a movie: those that are asked for, or all of a trajectory.
Result<FrameRange> movie_frames(const RenderCommand& command) {
  const Diagnostic none =
      wrong_option("a movie has many frames: --frames or --turn is missing", "--output");
  if (command.frames) return *command.frames;
  if (has_wide_frame_slot(command.scene) || !is_particle_input(command.scene, command.look))
    return none;
  Scheduler scheduler(command.threads);
  auto file =
      ParticleFile::open(command.scene, file_options_of(command.look), scheduler.parallel_for());
  if (!file) return file.error();
  const auto count = static_cast<int>(file.value().frames());
  return count > 1 ? Result<FrameRange>(FrameRange{0, count - 1}) : none;
}

/// A series whose pictures go to ffmpeg.
ExitCode run_movie(RenderCommand command) {
  if (command.format) return report(check_picture_stream(command).error(), wrong_usage);
  const auto frames = movie_frames(command);
  if (!frames) return report(frames.error(), code_of_loading(frames.error()));
  command.frames = frames.value();
  if (auto done = count_pictures(command); !done) return report(done.error(), wrong_usage);
  constexpr double usual_fps = 25;
  auto movie = Movie::start(command.output, command.fps.value_or(usual_fps));
  if (!movie) return report(movie.error(), failed);
  command.movie = std::exchange(command.output, standard_output);
  command.format = StreamFormat::ppm;
  return run_in(nullptr, command, &movie.value());
}

}  // namespace

ExitCode run(const RenderCommand& given) {
  RenderCommand command = given;
  if (command.turn && command.frames)
    return report(wrong_option("makes a series of its own, without --frames", "--turn"),
                  wrong_usage);
  if (command.turn) command.frames = FrameRange{0, *command.turn - 1};
  const bool is_movie = is_movie_name(command.output);
  if (auto done = is_movie ? Status() : count_pictures(command); !done)
    return report(done.error(), wrong_usage);
  if (auto done = check_copies(command); !done) return report(done.error(), wrong_usage);
  if (command.fps && !is_movie)
    return report(wrong_option("is of movies: " + joined(movie_endings, ", "), "--fps"),
                  wrong_usage);
  const auto team = join_team(command);
  if (!team) return report(team.error(), failed);
  if (team.value()) return run_as_rank(*team.value(), command);
  return is_movie ? run_movie(std::move(command)) : run_in(nullptr, command);
}

}  // namespace boule::cli
