#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/math/srgb.h"
#include "core/scene/scene.h"
#include "render/cli/particle_look.h"
#include "render/cli/progress_bar.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/image/encode_image.h"
#include "render/image/write_image.h"
#include "render/parts/part_blocks.h"
#include "render/renderer/aov_channels.h"
#include "render/renderer/run_statistics.h"
#include "render/scene_file/scene_file.h"
#include "simd/abi/isa.h"

namespace boule::cli {

/// Width and height in pixels.
struct Size {
  int width, height;
};

/// What `--background` asks for: a colour, or no background at all.
struct BackgroundChoice {
  std::optional<SrgbColor> color;  ///< none: transparent
};

/// Frames of a series: first, first + step and so on, up to last.
struct FrameRange {
  int first, last;
  int step = 1;  ///< >= 1

  /// How many they are.
  [[nodiscard]] int count() const { return (last - first) / step + 1; }
};

/// Where a checkpoint is, and how often it is replaced.
struct CheckpointChoice {
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

/// The options that render and trace share.
struct RunOptions {
  std::string scene;
  std::string output;
  unsigned threads = 0;
  std::string isa = "auto";
  Solver solver = Solver::robust;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<double> load_limit;  ///< seconds of reading
  bool trust = false;                ///< packed scenes are not checked
  StatsTarget stats;
  Verbosity verbosity = Verbosity::normal;
};

/// `boule render`: what is not given comes from the scene.
struct RenderCommand : RunOptions {
  std::optional<FrameRange> frames;
  std::optional<int> frame;  ///< the frame that is rendered; the names have its number
  std::optional<Size> size;
  std::optional<int> spp;
  std::optional<float> noise;  ///< 0..1; 0: all pixels get the same samples
  std::optional<int> min_spp;
  std::optional<PixelFilter> filter;
  std::optional<BackgroundChoice> background;
  std::optional<float> outline;  ///< pixels
  std::optional<Method> method;
  std::optional<int> max_depth;
  std::string camera;                   ///< keys of [camera]; empty: the scene's
  std::optional<float> shadow_epsilon;  ///< as RenderOptions
  std::optional<PixelRect> crop;
  AovSelection aovs;
  std::uint64_t seed = 0;
  int tile = 0;                      ///< 0: chosen to fit
  std::optional<PixelOrder> order;   ///< tiles, or progressive for a partial picture
  std::optional<double> time_limit;  ///< seconds of rendering
  bool skip_existing = false;
  bool partial = false;  ///< if ended early, write the unfinished picture
  Compression compression = Compression::zip;
  float exposure_stops = 0;
  std::optional<StreamFormat> format;  ///< of pictures on standard output
  PolygonPolicy polygons = PolygonPolicy::plane;
  LookOptions look;    ///< of a particle file
  std::string legend;  ///< a file for it; empty: none
  std::optional<CheckpointChoice> checkpoint;
  bool resume = false;         ///< go on from the checkpoint
  std::optional<Shard> shard;  ///< the share of the picture that goes into a film file
  bool claim = false;          ///< share the series with other processes
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
struct PackCommand {
  std::vector<std::string> inputs;  ///< a scene or particles, or spheres alone: .npy files or "-"
  std::string output;
  std::optional<std::uint64_t> memory;  ///< bytes; none: half of what there is
  unsigned threads = 0;
  PolygonPolicy polygons = PolygonPolicy::plane;
  std::optional<double> load_limit;  ///< seconds of reading a scene
  LookOptions look;                  ///< of a particle file
  bool quiet = false;
};

/// `boule scene`.
struct SceneCommand {
  std::string particles;             ///< a particle file
  std::optional<double> load_limit;  ///< seconds of reading
  LookOptions look;
};

/// `boule view`: `render` has the options that both have; it writes nothing.
struct ViewCommand {
  RenderCommand render;
  std::string address = "127.0.0.1";
  int port = 0;  ///< 0: one that is free
  bool open = false;
  std::optional<double> idle;  ///< seconds
};

/// `boule trace`.
struct TraceCommand : RunOptions {
  std::string rays;
  LookOptions look;  ///< of a particle file: which spheres it stands for
  bool any_hit = false;
};

/// `boule info`.
struct InfoCommand {
  std::string scene;
  std::optional<double> load_limit;  ///< seconds of reading
  std::optional<FrameRange> frames;
  LookOptions look;  ///< of a particle file: its format and frame only
  bool json = false;
  bool trust = false;   ///< a packed scene is not checked
  bool verify = false;  ///< it is read as a whole, for its checksums
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

/// Parses the command line.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace boule::cli
