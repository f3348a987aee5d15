#include "render/apps/cli/options/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "core/base/version.h"
#include "render/apps/cli/options/command_app.h"
#include "render/apps/cli/options/look_options.h"
#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/cli/options/pack_options.h"
#include "render/apps/cli/options/part_options.h"
#include "render/apps/cli/options/trace_options.h"
#include "render/apps/cli/options/usage.h"
#include "render/apps/cli/options/view_options.h"
#include "render/apps/job/options/look_values.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/options/render_choices.h"

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

/// The options of a scene's job under one heading.
void add_scene_choices(CLI::App& app, SceneJob& job, std::string_view group) {
  add_rows(app, scene_choices(), job, [&](const auto& row) { return row.group == group; });
}

/// The options of one heading of render_choices().
void add_choices(CLI::App& app, RenderJob& job, std::string_view group) {
  add_rows(app, render_choices(), job, [&](const auto& row) { return row.group == group; });
}

void add_camera(CLI::App& app, RenderJob& job) {
  add_parsed(app, "--camera", job.camera, parse_words, "keys of a scene's [camera]", "KEYS",
             "Another camera: keys of [camera], such as \"eye = [0, 1, 9], look_at = [0, 1, 0]\"");
}

/// Options that say in which pieces the work is done, and how much of it.
void add_work_options(CLI::App& app, RenderCommand& command) {
  start_group(app, heading::work);
  add_frames(app, command.frames,
             "Render a series: #### in the names of scene, data and output is the frame's number");
  add_whole(
      app, "--interpolate", command.interpolate, 2, 1000,
      "Render N pictures from frame to frame of a series of particles, which move in between");
  add_whole(app, "--turn", command.turn, 2, 100'000,
            "Render a turntable: N pictures of one scene, which turns once; #### in the output's "
            "name is the number, from 0");
  app.add_flag("--skip-existing", command.skip_existing,
               "Leave a picture alone that is there already, finished, readable, of this size");
  add_duration(app, "--time-limit", command.time_limit,
               "Stop rendering after so long, such as 90s, 500ms, 5m; reading, preparing and "
               "writing not counted");
  add_load_limit(app, command.load_limit);
  add_scene_choices(app, command, heading::work);
  app.add_flag("--partial", command.partial,
               "Stopped by --time-limit or the first signal: write the picture as far as it is");
  add_choices(app, command, heading::work);
}

void add_compression(CLI::App& app, Compression& compression) {
  add_choice(app, "--compression", compression, choices<Compression>(),
             "Packing of EXR pictures (zip)");
}

/// Options for what is reported during the work and after it.
void add_report_options(CLI::App& app, RunOptions& command) {
  add_choice(app, "--progress", command.progress,
             std::array{Named{"auto", ProgressStyle::automatic}, Named{"bar", ProgressStyle::bar},
                        Named{"plain", ProgressStyle::plain}, Named{"json", ProgressStyle::json},
                        Named{"none", ProgressStyle::none}},
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

void add_machine_options(CLI::App& app, SceneJob& job) {
  start_group(app, heading::machine);
  add_scene_choices(app, job, heading::machine);
}

void add_legend(CLI::App& app, std::string& legend) {
  add_parsed(app, "--legend", legend, parse_svg_name, "a file's name that ends with .svg",
             "FILE.svg", "Write what the colours of particles mean: a bar or a list");
}

void add_render(CLI::App& app, RenderCommand& command) {
  add_scene(app, command.scene);
  start_group(app, heading::picture);
  add_choices(app, command, heading::picture);
  add_scene_choices(app, command, heading::picture);
  start_group(app, heading::light);
  add_camera(app, command);
  add_choices(app, command, heading::light);
  add_look_options(app, command.look);
  add_work_options(app, command);
  app.get_option("--frame")->excludes("--frames");
  add_part_options(app, command);
  start_group(app, "Output");
  add_output(app, command.output, "IMAGE",
             "Picture to write; its extension names the format; - is standard output; .mp4, .webm "
             "and .gif are movies of all frames, by the program ffmpeg");
  add_parsed(
      app, "--fps", command.fps,
      [](const std::string& text) { return parse_number(text, 0.01, 1000.0); },
      "a number from 0.01 to 1000", "N", "Pictures a second of a movie (25)");
  add_choice(app, "--format", command.format, choices<StreamFormat>(),
             "Format of pictures on standard output");
  add_legend(app, command.legend);
  add_compression(app, command.compression);
  add_report_options(app, command);
  add_machine_options(app, command);
}

/// The options of pictures that the page can change, too.
void add_page_choices(CLI::App& app, RenderJob& job) {
  add_rows(app, render_choices(), job, [](const auto& row) {
    return row.name == "size" || row.name == "spp" || row.name == "method" ||
           row.name == "shadow_epsilon" || row.name == "outline" || row.name == "fog";
  });
  add_whole(app, "--max-depth", job.max_depth, 0, view::max_view_depth,
            "Bounces after the first hit");
}

void add_view(CLI::App& app, ViewCommand& view) {
  RenderCommand& command = view.render;
  add_scene(app, command.scene);
  add_view_options(app, view);
  start_group(app, heading::picture);
  add_page_choices(app, command);
  add_choice(app, "--order", command.order, choices<PixelOrder>(),
             "Order of the pixels at the beginning (progressive)");
  add_camera(app, command);
  add_look_options(app, command.look);
  start_group(app, "Reading");
  add_frames(app, command.frames,
             "A series: #### in the names of scene and data is the frame's number");
  app.get_option("--frame")->excludes("--frames");
  add_load_limit(app, command.load_limit);
  add_scene_choices(app, command, heading::work);
  add_machine_options(app, command);
}

void add_trace(CLI::App& app, TraceCommand& command) {
  add_scene(app, command.scene);
  add_questions(app, command);
  add_load_limit(app, command.load_limit);
  add_scene_choices(app, command, heading::work);
  add_shape_options(app, command.look);
  start_group(app, "Output");
  add_output(
      app, command.output, "HITS.npy",
      "Hits to write, .npy: N records of t (float64), id (int32), normal (3 float32), entering "
      "(bool); a miss is inf, -1, 0, false");
  add_report_options(app, command);
  add_machine_options(app, command);
}

void add_scene_text(CLI::App& app, SceneCommand& command) {
  app.add_option("FILE", command.scene, "Particle file: .xyz and others")
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
  add_scene_choices(app, command, heading::work);
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

/// Names the options that one excludes in the order of their names: CLI11 keeps them in the order
/// of their addresses, which differs from run to run.
class OrderedFormatter : public CLI::Formatter {
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string label = " " + get_label("Excludes") + ":";
    const std::size_t at = text.find(label);
    if (at == std::string::npos) return text;
    std::set<std::string> names;
    for (const CLI::Option* const other : option->get_excludes()) names.insert(other->get_name());
    text.erase(at + label.size());
    for (const std::string& name : names) text += " " + name;
    return text;
  }
};

/// Tells the app all that can be typed; `commands` takes it.
void describe(CLI::App& app, Commands& commands) {
  app.set_version_flag("--version", version_line(), "Tell the version");
  app.require_subcommand(1);
  app.formatter(std::make_shared<OrderedFormatter>());
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

std::optional<StatsTarget> parse_stats(const std::string& text) {
  const std::string json_to = "json:";
  if (text == "text") return StatsTarget{StatsForm::text, {}};
  if (text == "json") return StatsTarget{StatsForm::json, "-"};
  if (!text.starts_with(json_to) || text == json_to) return std::nullopt;
  return StatsTarget{StatsForm::json, text.substr(json_to.size())};
}

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
