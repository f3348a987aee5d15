#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "render/apps/job/render_job.h"
#include "render/apps/parts/part_blocks.h"
#include "render/files/trace_file/hit_file.h"
#include "render/image/encode_image.h"
#include "render/image/write_image.h"

namespace boule::cli {

/// A file that is replaced again and again while a picture is rendered.
struct TimedFile {
  std::string file;
  double interval = 60;  ///< seconds
};

/// Whether the processes that a launcher of MPI started work together.
enum class MpiUse { automatic, never };

/// How statistics are written: text for people, on standard error, or JSON.
enum class StatsForm { none, text, json };

/// Whether and where statistics go.
struct StatsTarget {
  StatsForm form = StatsForm::none;
  std::string file;  ///< of JSON; "-" is standard output
};

/// How much is said on standard error besides errors.
enum class Verbosity { quiet, normal, verbose };

/// How progress is told, always on standard error.
/// bar: one line that is rewritten ten times a second, also while nothing moves.
/// plain: lines, none within the first two seconds of the run; from then on one when both ten
/// seconds have passed and ten per cent are done since the last, and at the end one if there were
/// any before.
/// json: a JSON object a line, at most ten a second: {"share", "elapsed_s", "remaining_s" (null at
/// first), "mrays_per_s"}, once noise is measured {"mean_spp", "settled"} too, in a series
/// {"frame", "frames", "series_remaining_s"}. automatic: bar on a terminal, else plain.
enum class ProgressStyle { automatic, bar, plain, json, none };

/// The name of an output that stands for standard output.
inline constexpr const char* standard_output = "-";

/// What render and trace share besides the job: what they write and tell.
struct RunOptions {
  std::string output;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<double> load_limit;  ///< seconds of reading
  StatsTarget stats;
  Verbosity verbosity = Verbosity::normal;
};

/// `boule render`.
struct RenderCommand : RenderJob, RunOptions {
  std::optional<int> frame;  ///< the frame that is rendered; the names have its number
  bool skip_existing = false;
  Compression compression = Compression::zip;
  std::optional<StreamFormat> format;  ///< of pictures on standard output
  std::optional<double> fps;           ///< of a movie
  std::string movie;   ///< that is made of the pictures on standard output; empty: none
  std::string legend;  ///< a file for it; empty: none
  std::optional<TimedFile> checkpoint;
  std::optional<TimedFile> preview;  ///< the picture as far as it is
  bool resume = false;               ///< go on from the checkpoint
  std::optional<Shard> shard;        ///< the share of the picture that goes into a film file
  bool claim = false;                ///< share the series with other processes
  MpiUse mpi = MpiUse::automatic;
};

/// `boule merge`.
struct MergeCommand {
  std::vector<std::string> films;
  std::string output;
  float exposure_stops = 0;
  Compression compression = Compression::zip;
  unsigned threads = 0;
  bool quiet = false;
};

/// `boule pack`.
struct PackCommand : SceneJob {
  std::vector<std::string> inputs;  ///< a scene or particles, or spheres alone: .npy files or "-"
  std::string output;
  std::optional<std::uint64_t> memory;  ///< bytes; none: half of what there is
  std::optional<double> load_limit;     ///< seconds of reading a scene
  bool quiet = false;
};

/// `boule scene`, of a particle file.
struct SceneCommand : SceneJob {
  std::optional<double> load_limit;  ///< seconds of reading
};

/// `boule view`: `render` has the options that both have; it writes nothing.
struct ViewCommand {
  RenderCommand render;
  std::string address = "127.0.0.1";
  int port = 0;        ///< 0: one that is free
  std::string socket;  ///< its path, in place of an address; empty: none
  bool embed = false;  ///< in pages of others
  bool open = false;
  std::optional<double> idle;  ///< seconds
};

/// `boule trace`.
struct TraceCommand : SceneJob, RunOptions {
  std::string rays;
  HitKind answer = HitKind::closest;  ///< about the rays
  std::optional<std::size_t> limit;   ///< crossings of a ray
  std::string points;                 ///< empty: there are none
  std::optional<std::size_t> nearest;
  bool inside = false;
  std::optional<double> within, pairs;
};

/// What is asked: about rays, points or spheres.
HitKind kind_of(const TraceCommand& command);

/// `boule info`.
struct InfoCommand : SceneJob {
  std::optional<double> load_limit;  ///< seconds of reading
  std::optional<FrameRange> frames;
  bool json = false;
  bool verify = false;  ///< a packed scene is read as a whole, for its checksums
};

/// `boule isa`.
struct IsaCommand {
  bool json = false;
};

/// Text to print instead of doing anything: the help, the version.
struct TextCommand {
  std::string text;
};

/// A wrong command line: the reason, and the command that helps.
struct UsageError {
  std::string text;
  std::string help = "boule --help";
};

using Command = std::variant<RenderCommand, ViewCommand, MergeCommand, PackCommand, SceneCommand,
                             TraceCommand, InfoCommand, IsaCommand, TextCommand, UsageError>;

/// An error about the command line itself, with the option as its key.
inline Diagnostic wrong_option(const std::string& message, const char* option) {
  return Diagnostic::about(option, message);
}

/// "text", "json" or "json:FILE", FILE not empty.
std::optional<StatsTarget> parse_stats(const std::string& text);

/// Parses the command line.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace boule::cli
