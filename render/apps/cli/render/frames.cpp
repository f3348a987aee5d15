#include "render/apps/cli/render/frames.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/apps/cli/report/run_report.h"
#include "render/files/scene_file/loaded/frame_name.h"

namespace boule::cli {

Status check_frames(const RenderCommand& command) {
  if (command.output != standard_output && !has_frame_slot(command.output)) {
    return wrong_option(
        "with --frames or --turn the picture's name needs a place for the number, such as "
        "out.####.png",
        "--output");
  }
  const bool to_file = !command.stats.file.empty() && command.stats.file != "-";
  if (to_file && !has_frame_slot(command.stats.file)) {
    return wrong_option(
        "with --frames the file's name needs a place for the number, such as "
        "json:stats.####.json",
        "--stats");
  }
  if (command.checkpoint && !has_frame_slot(command.checkpoint->file)) {
    return wrong_option(
        "with --frames the file's name needs a place for the number, such as run.####.film",
        "--checkpoint");
  }
  return {};
}

Status check_single(const RenderCommand& command) {
  const auto refuse = [](const std::string& name, const char* option) {
    return wrong_option(quote(name) + " has a place for a frame's number: --frames is missing",
                        option);
  };
  if (has_wide_frame_slot(command.output)) return refuse(command.output, "--output");
  if (has_wide_frame_slot(command.stats.file)) return refuse(command.stats.file, "--stats");
  if (command.preview && has_wide_frame_slot(command.preview->file))
    return refuse(command.preview->file, "--preview");
  return check_single_scene(command.scene);
}

Status check_single_scene(const std::string& scene) {
  std::error_code ignored;
  if (!has_wide_frame_slot(scene) || std::filesystem::exists(scene, ignored)) return {};
  return wrong_option(quote(scene) +
                          " is not there, but has a place for a frame's number: "
                          "--frames is missing",
                      "SCENE");
}

RenderCommand command_of_frame(const RenderCommand& command, int frame) {
  RenderCommand one = command;
  one.frame = frame;
  if (one.claim) one.skip_existing = true;  // another process may have made it a moment ago
  one.scene = frame_name(command.scene, frame / command.interpolate);
  one.output = frame_name(command.output, frame);
  one.stats.file = frame_name(command.stats.file, frame);
  if (one.preview) one.preview->file = frame_name(command.preview->file, frame);
  if (one.checkpoint) one.checkpoint->file = frame_name(command.checkpoint->file, frame);
  return one;
}

Status check_folders(const RenderCommand& command, const FrameRange& frames) {
  const bool numbered =
      std::filesystem::path(command.output).parent_path().string().find('#') != std::string::npos;
  if (!numbered || command.skip_existing) return {};
  for (int number = frames.first; number <= frames.last; number += frames.step) {
    if (auto done = check_output(frame_name(command.output, number)); !done) {
      done.error().message = fmt::format("frame {}: {}", number, done.error().message);
      return done;
    }
  }
  return {};
}

}  // namespace boule::cli
