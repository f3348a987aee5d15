#include "render/cli/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <limits>
#include <utility>

#include "core/base/version.h"
#include "core/scene/scene.h"
#include "render/cli/command_app.h"
#include "render/cli/look_options.h"
#include "render/cli/look_values.h"
#include "render/cli/option_kinds.h"
#include "render/cli/option_values.h"
#include "render/cli/pack_options.h"
#include "render/cli/part_options.h"
#include "render/cli/usage.h"
#include "render/cli/view_options.h"

namespace boule::cli {
namespace {

constexpr const char* description =
    "Boule renders scenes of spheres and planes: exact hits, the same bits on every machine.";

void add_scene(CLI::App& app, std::string& scene) {
  app.add_option("SCENE", scene,
                 "Scene: .toml, .nff, .boule, or spheres alone, N x 4: .npy; or particles")
      ->required()
      ->type_name("");
}

void add_output(CLI::App& app, std::string& output, const std::string& type,
                const std::string& help) {
  app.add_option("-o,--output", output, help)->required()->type_name(type);
}

void add_frames(CLI::App& app, std::optional<FrameRange>& frames, const std::string& help) {
  add_parsed(app, "--frames", frames, parse_frames,
             "A-B with 0 <= A <= B, or A-B:N for every Nth of them", "A-B[:N]", help);
}

void add_duration(CLI::App& app, const std::string& name, std::optional<double>& seconds,
                  const std::string& help) {
  add_parsed(app, name, seconds, parse_duration, "a time above 0 in ms, s, m or h, such as 90s",
             "TIME", help);
}

void add_load_limit(CLI::App& app, std::optional<double>& seconds) {
  add_duration(app, "--load-limit", seconds,
               "Give up when reading the scene and data files takes longer (no limit)");
}

void add_trust(CLI::App& app, bool& trust) {
  app.add_flag("--trust", trust,
               "Open a packed scene without checking it: for files of one's own only");
}

void add_size(CLI::App& app, RenderCommand& command) {
  add_parsed(app, "--size", command.size, parse_size,
             "WIDTHxHEIGHT in pixels, each 1 to 65535, such as 1280x720", "WxH",
             "Pixels of the picture");
  add_whole(app, "--spp", command.spp, rule::samples.low, rule::samples.high, "Samples per pixel");
}

void add_noise(CLI::App& app, RenderCommand& command) {
  add_parsed(
      app, "--noise", command.noise,
      [](const std::string& text) { return parse_number(text, 0.0F, 1.0F); },
      "a number from 0 to 1", "X",
      "Samples until each pixel is right to X of 0..1 as it is shown (95 %), --spp at most "
      "(4096); 0.004 is a step of 8 bits; 0: --spp for all");
  add_whole(app, "--min-spp", command.min_spp, rule::least_samples.low, rule::least_samples.high,
            "With --noise: the fewest samples of a pixel (32)");
}

void add_order(CLI::App& app, RenderCommand& command, const std::string& help) {
  add_choice(app, "--order", command.order, choices<PixelOrder>(), help);
}

/// Options that change the picture.
void add_picture_options(CLI::App& app, RenderCommand& command) {
  start_group(app, "Picture");
  add_size(app, command);
  add_noise(app, command);
  add_choice(app, "--filter", command.filter, choices<PixelFilter>(),
             "How a pixel is made of samples: the pixel alone, or with its surroundings");
  add_parsed(app, "--background", command.background, parse_background,
             "a colour such as #ffffff, or transparent", "COLOR",
             "What shows where nothing is: #rrggbb, or transparent (EXR, PNG)");
  const auto parse_width = [](const std::string& text) { return parse_number(text, 0.0F, 100.0F); };
  add_parsed(app, "--outline", command.outline, parse_width, "a number of pixels from 0 to 100",
             "W", "Dark lines W pixels wide where what is seen changes (0)");
  add_whole(app, "--seed", command.seed, std::uint64_t{0},
            std::numeric_limits<std::uint64_t>::max(), "Seed of the random numbers (0)");
  add_parsed(app, "--crop", command.crop, parse_crop,
             "X0,Y0,X1,Y1 in pixels from the upper left corner, 0 <= X0 < X1 and 0 <= Y0 < Y1",
             "X0,Y0,X1,Y1", "Render these pixels of the frame only");
  add_parsed(
      app, "--aov", command.aovs, parse_aovs, "some of " + list_aovs() + ", each once", "NAMES",
      "More channels in an EXR picture, each pixel's centre, unfiltered: any of " + list_aovs());
  add_choice(app, "--polygons", command.polygons,
             std::array{Choice{"plane", PolygonPolicy::plane}, Choice{"skip", PolygonPolicy::skip},
                        Choice{"error", PolygonPolicy::error}},
             "What an NFF polygon becomes (plane)");
}

void add_camera(CLI::App& app, RenderCommand& command) {
  add_parsed(app, "--camera", command.camera, parse_words, "keys of a scene's [camera]", "KEYS",
             "Another camera: keys of [camera], such as \"eye = [0, 1, 9], look_at = [0, 1, 0]\"");
}

void add_shadow_epsilon(CLI::App& app, RenderCommand& command) {
  add_parsed(app, "--shadow-epsilon", command.shadow_epsilon, parse_shadow_epsilon,
             "none, or a length of 0 or more", "X|none",
             "For teaching: shadow rays start X from a surface, as in lectures, or with no remedy "
             "against false shadows at all (Boule's own way, which needs no epsilon)");
}

void add_light_options(CLI::App& app, RenderCommand& command) {
  start_group(app, "Camera and light");
  add_camera(app, command);
  add_choice(app, "--method", command.method, choices<Method>(), "How light is followed");
  add_whole(app, "--max-depth", command.max_depth, rule::bounces.low, rule::bounces.high,
            "Bounces after the first hit");
  add_shadow_epsilon(app, command);
  const auto parse_stops = [](const std::string& text) {
    return parse_number(text, -100.0F, 100.0F);
  };
  add_parsed(app, "--exposure", command.exposure_stops, parse_stops, "a number from -100 to 100",
             "STOPS", "Brighten 8-bit pictures by 2^STOPS (0)");
}

/// Options that say in which pieces the work is done, and how much of it.
void add_work_options(CLI::App& app, RenderCommand& command) {
  start_group(app, "Work");
  add_frames(app, command.frames,
             "Render a series: #### in the names of scene, data and output is the frame's number");
  app.add_flag("--skip-existing", command.skip_existing,
               "Leave a picture alone that is there already, finished, readable, of this size");
  add_duration(app, "--time-limit", command.time_limit,
               "Stop rendering after so long, such as 90s, 500ms, 5m; reading, preparing and "
               "writing not counted");
  add_load_limit(app, command.load_limit);
  add_trust(app, command.trust);
  app.add_flag("--partial", command.partial,
               "Stopped by --time-limit or the first signal: write the picture as far as it is");
  add_order(app, command,
            "Order of the pixels; never shows in a finished picture (tiles; with --partial: "
            "progressive)");
  add_whole(app, "--tile", command.tile, 1, max_tile,
            "Side of a tile in pixels (16 to 256, as fits)");
}

void add_threads(CLI::App& app, RunOptions& command) {
  add_whole(app, "-t,--threads", command.threads, 0U, 1024U, "Threads, 0: all (0)");
}

void add_compression(CLI::App& app, Compression& compression) {
  add_choice(app, "--compression", compression,
             std::array{Choice{"none", Compression::none}, Choice{"rle", Compression::rle},
                        Choice{"zip", Compression::zip}},
             "Packing of EXR pictures (zip)");
}

/// Options for what is reported during the work and after it.
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

void add_machine_options(CLI::App& app, RunOptions& command) {
  start_group(app, "Machine");
  app.add_option("--isa", command.isa, "Instruction set; boule isa lists them (auto)")
      ->type_name("NAME");
  add_choice(app, "--solver", command.solver, choices<Solver>(), "How hits are found (robust)");
  add_threads(app, command);
}

void add_legend(CLI::App& app, std::string& legend) {
  add_parsed(app, "--legend", legend, parse_svg_name, "a file's name that ends with .svg",
             "FILE.svg", "Write what the colours of particles mean: a bar or a list");
}

void add_render(CLI::App& app, RenderCommand& command) {
  add_scene(app, command.scene);
  add_picture_options(app, command);
  add_light_options(app, command);
  add_look_options(app, command.look);
  add_work_options(app, command);
  app.get_option("--frame")->excludes("--frames");
  add_part_options(app, command);
  start_group(app, "Output");
  add_output(app, command.output, "IMAGE",
             "Picture to write; its extension names the format; - is standard output");
  add_choice(app, "--format", command.format, choices<StreamFormat>(),
             "Format of pictures on standard output");
  add_legend(app, command.legend);
  add_compression(app, command.compression);
  add_report_options(app, command);
  add_machine_options(app, command);
}

void add_view(CLI::App& app, ViewCommand& view) {
  RenderCommand& command = view.render;
  add_scene(app, command.scene);
  add_view_options(app, view);
  start_group(app, "Picture");
  add_size(app, command);
  add_order(app, command, "Order of the pixels at the beginning (progressive)");
  add_camera(app, command);
  add_whole(app, "--max-depth", command.max_depth, 0, view::max_view_depth,
            "Bounces after the first hit");
  add_choice(app, "--method", command.method, choices<Method>(), "How light is followed");
  add_shadow_epsilon(app, command);
  add_look_options(app, command.look);
  start_group(app, "Reading");
  add_frames(app, command.frames,
             "A series: #### in the names of scene and data is the frame's number");
  app.get_option("--frame")->excludes("--frames");
  add_load_limit(app, command.load_limit);
  add_trust(app, command.trust);
  add_machine_options(app, command);
}

void add_trace(CLI::App& app, TraceCommand& command) {
  add_scene(app, command.scene);
  start_group(app, "Rays");
  app.add_option("--rays", command.rays,
                 "Rays, .npy: float32 or float64, N x 8: origin x y z, tmin, direction x y z, tmax")
      ->required()
      ->type_name("RAYS.npy");
  app.add_flag("--any-hit", command.any_hit,
               "Only whether anything is met with tmin < t <= tmax: N bytes (uint8), 1 or 0");
  add_load_limit(app, command.load_limit);
  add_trust(app, command.trust);
  add_shape_options(app, command.look);
  start_group(app, "Output");
  add_output(
      app, command.output, "HITS.npy",
      "Hits to write, .npy: N records of t (float64), id (int32), normal (3 float32); a miss "
      "is inf, -1, 0");
  add_report_options(app, command);
  add_machine_options(app, command);
}

void add_scene_text(CLI::App& app, SceneCommand& command) {
  app.add_option("FILE", command.particles, "Particle file: .xyz and others")
      ->required()
      ->type_name("");
  add_look_options(app, command.look);
  start_group(app, "Work");
  add_load_limit(app, command.load_limit);
}

void add_info(CLI::App& app, InfoCommand& command) {
  add_scene(app, command.scene);
  add_frames(app, command.frames,
             "Tell of these frames: #### in the names of scene and data is the frame's number");
  start_group(app, look_heading);
  add_file_options(app, command.look);
  start_group(app, "Options");
  app.get_option("--frame")->excludes("--frames");
  app.add_flag("--json", command.json, "As JSON, for programs");
  add_load_limit(app, command.load_limit);
  add_trust(app, command.trust);
  app.add_flag("--verify", command.verify,
               "Read a packed scene as a whole, to check its checksums");
}

/// A help text; CLI11 leaves two blank lines between groups.
TextCommand help_text(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return {std::move(text)};
}

/// The help of the whole program, or of one command.
Command help_on(const CLI::App& app, const std::string& name) {
  // Not app.help(): it would print the help of the chosen command, which is help itself.
  const auto all = [&] {
    return app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
  };
  if (name.empty()) return help_text(all());
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == name) return help_text(command->help(app.get_name()));
  }
  return unknown_command(app, name);
}

/// What can be told of each command.
struct Commands {
  RenderCommand render;
  ViewCommand view;
  MergeCommand merge;
  PackCommand pack;
  SceneCommand scene;
  TraceCommand trace;
  InfoCommand info;
  IsaCommand isa;
  std::string help_topic;
};

void add_commands(CLI::App& app, Commands& commands) {
  const auto add = [&app](const char* name, const char* what) -> CLI::App& {
    CLI::App* const command = app.add_subcommand(name, what);
    command->group("Commands");
    return *command;
  };
  add_render(add("render", "Render a scene to a picture"), commands.render);
  add_view(add("view", "Show a scene in a browser"), commands.view);
  add_pack(add("pack", "Pack a scene of any size into a file that is opened at once"),
           commands.pack);
  add_merge(add("merge", "Make a picture of the films of its shards"), commands.merge);
  add_scene_text(add("scene", "Write the scene that shows a particle file"), commands.scene);
  add_trace(add("trace", "Trace the rays of a file to hits"), commands.trace);
  add_info(add("info", "Tell what a scene holds"), commands.info);
  add("isa", "List the instruction sets")
      .add_flag("--json", commands.isa.json, "As JSON, for programs");
  add("help", "Tell the options of a command")
      .add_option("COMMAND", commands.help_topic, "One of these commands")
      ->type_name("");
  add("version", "Tell the version");
}

std::string version_line() { return std::string("boule ") + library_version(); }

/// Tells the app all that can be typed; `commands` takes it.
void describe(CLI::App& app, Commands& commands) {
  app.set_version_flag("--version", version_line(), "Tell the version");
  app.require_subcommand(1);
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  add_commands(app, commands);
}

/// The command that was chosen, or what is wrong with it.
Command chosen_command(const CLI::App& app, Commands& commands) {
  const auto is_chosen = [&app](const char* name) { return app.got_subcommand(name); };
  const auto checked = [&app](const char* name, auto& command, LookOptions& look) -> Command {
    if (auto bad = check_look_options(*app.get_subcommand(name), look)) return *bad;
    return command;
  };
  if (is_chosen("help")) return help_on(app, commands.help_topic);
  if (is_chosen("version")) return TextCommand{version_line() + "\n"};
  if (is_chosen("render")) return checked("render", commands.render, commands.render.look);
  if (is_chosen("view")) return checked("view", commands.view, commands.view.render.look);
  if (is_chosen("scene")) return checked("scene", commands.scene, commands.scene.look);
  if (is_chosen("pack")) return checked("pack", commands.pack, commands.pack.look);
  if (is_chosen("merge")) return commands.merge;
  if (is_chosen("trace")) return checked("trace", commands.trace, commands.trace.look);
  if (is_chosen("info")) return checked("info", commands.info, commands.info.look);
  return commands.isa;
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  Commands commands;
  CLI::App app(description, "boule");
  describe(app, commands);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return help_text(app.help());  // of the command that was chosen, if any
  } catch (const CLI::CallForVersion&) {
    return TextCommand{version_line() + "\n"};
  } catch (const CLI::ParseError& error) {
    return explain_usage(app, error);
  }
  return chosen_command(app, commands);
}

void visit_commands(const std::function<void(const CLI::App&)>& visit) {
  Commands commands;
  CLI::App app(description, "boule");
  describe(app, commands);
  visit(app);
}

}  // namespace boule::cli
