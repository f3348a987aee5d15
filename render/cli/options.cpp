#include "render/cli/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <limits>

#include "core/scene/scene.h"
#include "render/cli/option_values.h"

namespace boule::cli {
namespace {

constexpr const char* description =
    "Boule renders scenes of spheres and planes: exact hits, the same bits on every machine.";

/// "--threads" of "-t,--threads".
std::string long_name(const std::string& names) { return names.substr(names.rfind(',') + 1); }

CLI::ValidationError refuse(const std::string& names, const std::string& text,
                            const std::string& expected) {
  return CLI::ValidationError(long_name(names),
                              quote(text) + " is not understood, expected " + expected);
}

/// An option whose value `parse` makes a std::optional of; none is refused.
template <class Target, class Parse>
void add_parsed(CLI::App& app, const std::string& names, Target& target, const Parse& parse,
                const std::string& expected, const std::string& type, const std::string& help) {
  const auto store = [&target, names, parse, expected](const std::string& text) {
    const auto value = parse(text);
    if (!value) throw refuse(names, text, expected);
    target = *value;
  };
  app.add_option_function<std::string>(names, store, help)->type_name(type);
}

/// An option that takes a whole number within low .. high.
template <class Number, class Target>
void add_whole(CLI::App& app, const std::string& names, Target& target, Number low, Number high,
               const std::string& help) {
  const auto parse = [low, high](const std::string& text) { return parse_number(text, low, high); };
  add_parsed(app, names, target, parse,
             "a whole number from " + std::to_string(low) + " to " + std::to_string(high), "N",
             help);
}

template <class T>
struct Choice {
  const char* name;
  T value;
};
template <class T>
Choice(const char*, T) -> Choice<T>;

/// An option that takes one of a few names.
template <class Target, class T, std::size_t n>
void add_choice(CLI::App& app, const std::string& name, Target& target,
                const std::array<Choice<T>, n>& choices, const std::string& help) {
  std::string names;
  for (const Choice<T>& choice : choices)
    names += (names.empty() ? "" : "|") + std::string(choice.name);
  const auto parse = [choices](const std::string& text) -> std::optional<T> {
    for (const Choice<T>& choice : choices) {
      if (text == choice.name) return choice.value;
    }
    return std::nullopt;
  };
  add_parsed(app, name, target, parse, "one of " + names, names, help);
}

void add_scene(CLI::App& app, std::string& scene) {
  app.add_option("scene", scene, "Scene file, .toml or .nff")->required()->type_name("FILE");
}

void add_output(CLI::App& app, std::string& output, const std::string& type,
                const std::string& help) {
  app.add_option("-o,--output", output, help)->required()->type_name(type);
}

void add_frames(CLI::App& app, std::optional<FrameRange>& frames, const std::string& help) {
  add_parsed(app, "--frames", frames, parse_frames,
             "A-B with 0 <= A <= B, or A-B:N for every Nth of them", "A-B[:N]", help);
}

/// What shows in the picture, and how it is stored.
void add_picture_options(CLI::App& app, RenderCommand& command) {
  add_scene(app, command.scene);
  add_output(app, command.output, "IMAGE", "Picture to write; its extension names the format");
  add_parsed(app, "--size", command.size, parse_size,
             "WIDTHxHEIGHT in pixels, each 1 to 65535, such as 1280x720", "WxH",
             "Pixels of the picture");
  add_whole(app, "--spp", command.spp, 1, max_count, "Samples per pixel");
  add_choice(app, "--filter", command.filter,
             std::array{Choice{"box", PixelFilter::box}, Choice{"tent", PixelFilter::tent}},
             "How a pixel is made of samples: the pixel alone, or with its surroundings");
  add_whole(app, "--seed", command.seed, std::uint64_t{0},
            std::numeric_limits<std::uint64_t>::max(), "Seed of the random numbers (0)");
  add_choice(app, "--method", command.method,
             std::array{Choice{"whitted", Method::whitted}, Choice{"path", Method::path}},
             "How light is followed");
  add_whole(app, "--max-depth", command.max_depth, 0, max_count, "Bounces after the first hit");
  add_parsed(app, "--crop", command.crop, parse_crop,
             "X0,Y0,X1,Y1 in pixels from the upper left corner, 0 <= X0 < X1 and 0 <= Y0 < Y1",
             "X0,Y0,X1,Y1", "Render these pixels of the frame only");
  add_frames(app, command.frames,
             "Render a series: #### in the names of scene, data and output is the frame's number");
  app.add_flag("--skip-existing", command.skip_existing,
               "Leave a picture alone that is there already, finished, readable, of this size");
  add_parsed(app, "--aov", command.views, parse_views,
             "some of depth,normal,position,id,albedo, each once", "NAMES",
             "More channels in an EXR picture, each pixel's centre, unfiltered: any of "
             "depth,normal,position,id,albedo");
}

void add_file_options(CLI::App& app, RenderCommand& command) {
  const auto parse_stops = [](const std::string& text) {
    return parse_number(text, -100.0F, 100.0F);
  };
  add_parsed(app, "--exposure", command.exposure_stops, parse_stops, "a number from -100 to 100",
             "STOPS", "Brighten 8-bit pictures by 2^STOPS (0)");
  add_choice(app, "--compression", command.compression,
             std::array{Choice{"none", Compression::none}, Choice{"rle", Compression::rle},
                        Choice{"zip", Compression::zip}},
             "Packing of EXR pictures (zip)");
  add_choice(app, "--polygons", command.polygons,
             std::array{Choice{"plane", PolygonPolicy::plane}, Choice{"skip", PolygonPolicy::skip},
                        Choice{"error", PolygonPolicy::error}},
             "What an NFF polygon becomes (plane)");
}

void add_block_options(CLI::App& app, RenderCommand& command) {
  add_whole(app, "--tile", command.tile, 1, max_tile,
            "Side of a tile in pixels (16 to 256, as fits)");
  add_choice(app, "--order", command.order,
             std::array{Choice{"rows", PixelOrder::rows}, Choice{"tiles", PixelOrder::tiles},
                        Choice{"progressive", PixelOrder::progressive},
                        Choice{"frameless", PixelOrder::frameless}},
             "Order of the pixels; never shows in a finished picture (tiles; with --partial: "
             "progressive)");
  add_parsed(
      app, "--time-limit", command.time_limit, parse_duration,
      "a time above 0 in ms, s, m or h, such as 90s", "TIME",
      "Stop rendering after so long, such as 90s, 500ms, 5m; loading and writing not counted");
  app.add_flag("--partial", command.partial,
               "Stopped by --time-limit or the first signal: write the picture as far as it is");
}

/// What is traced, and where the hits go.
void add_trace_options(CLI::App& app, TraceCommand& command) {
  add_scene(app, command.scene);
  app.add_option("--rays", command.rays,
                 "Rays, .npy: float32, N x 8: origin x y z, tmin, direction x y z, tmax")
      ->required()
      ->type_name("RAYS.npy");
  add_output(
      app, command.output, "HITS.npy",
      "Hits to write, .npy: N records of t (float64), id (int32), normal (3 float32); a miss "
      "is inf, -1, 0");
  app.add_flag("--any-hit", command.any_hit,
               "Only whether anything is met with tmin < t <= tmax: N bytes (uint8), 1 or 0");
}

void add_machine_options(CLI::App& app, RunOptions& command) {
  app.add_option("--isa", command.isa, "Instruction set; boule isa lists them (auto)")
      ->type_name("NAME");
  add_choice(app, "--solver", command.solver,
             std::array{Choice{"fast", Solver::fast}, Choice{"robust", Solver::robust},
                        Choice{"reference", Solver::reference}},
             "How hits are found (robust)");
  add_whole(app, "-t,--threads", command.threads, 0U, 1024U, "Threads, 0: all (0)");
}

/// What is told while and after the work.
void add_report_options(CLI::App& app, RunOptions& command) {
  add_choice(app, "--progress", command.progress,
             std::array{Choice{"auto", ProgressStyle::automatic}, Choice{"bar", ProgressStyle::bar},
                        Choice{"plain", ProgressStyle::plain}, Choice{"json", ProgressStyle::json},
                        Choice{"none", ProgressStyle::none}},
             "Progress on standard error (auto: bar on a terminal, else plain)");
  add_parsed(app, "--stats", command.stats, parse_stats, "text, json or json:FILE",
             "text|json[:FILE]",
             "Times and ray counts: text on standard error, JSON to FILE or standard output");
  const auto set = [&command](Verbosity verbosity) {
    return [&command, verbosity](std::int64_t) { command.verbosity = verbosity; };
  };
  CLI::Option* const quiet = app.add_flag_function(
      "-q,--quiet", set(Verbosity::quiet), "No progress, no notes and warnings, only errors");
  app.add_flag_function("-v,--verbose", set(Verbosity::verbose), "More notes")->excludes(quiet);
}

/// What is wrong with a command line that CLI11 refused. Unknown words come first: where there is
/// no command CLI11 would only say that one is required.
UsageError explain(const CLI::App& app, const CLI::ParseError& error) {
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const auto unknown = app.remaining(true);
  if (!unknown.empty() && (extra || app.get_subcommands().empty())) {
    return {"argument not expected: " + quote(unknown.front())};
  }
  return {printable(error.what(), 400)};  // CLI11 repeats what was typed
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  RenderCommand render;
  TraceCommand trace;
  InfoCommand info;
  IsaCommand isa;
  CLI::App app(description, "boule");
  app.set_version_flag("--version", "boule " BOULE_VERSION);
  app.require_subcommand(1);
  CLI::App* const render_app = app.add_subcommand("render", "Render a scene to a picture");
  add_picture_options(*render_app, render);
  add_file_options(*render_app, render);
  add_block_options(*render_app, render);
  add_machine_options(*render_app, render);
  add_report_options(*render_app, render);
  CLI::App* const trace_app = app.add_subcommand("trace", "Trace the rays of a file to hits");
  add_trace_options(*trace_app, trace);
  add_machine_options(*trace_app, trace);
  add_report_options(*trace_app, trace);
  CLI::App* const info_app = app.add_subcommand("info", "Tell what a scene holds");
  add_scene(*info_app, info.scene);
  add_frames(*info_app, info.frames,
             "Tell of these frames: #### in the names of scene and data is the frame's number");
  info_app->add_flag("--json", info.json, "As JSON, for programs");
  CLI::App* const isa_app = app.add_subcommand("isa", "List the instruction sets");
  isa_app->add_flag("--json", isa.json, "As JSON, for programs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    return TextCommand{chosen.empty() ? app.help() : chosen.front()->help()};
  } catch (const CLI::CallForVersion& version) {
    return TextCommand{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    return explain(app, error);
  }
  if (render_app->parsed()) return render;
  if (trace_app->parsed()) return trace;
  if (info_app->parsed()) return info;
  return isa;
}

}  // namespace boule::cli
