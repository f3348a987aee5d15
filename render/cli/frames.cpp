#include "render/cli/frames.h"

#include "render/cli/run_report.h"
#include "render/scene_file/frame_name.h"

namespace boule::cli {

Status check_frames(const RenderCommand& command) {
  if (!has_frame_place(command.output)) {
    return wrong_option(
        "with --frames the picture's name needs a place for the number, such as "
        "out.####.png",
        "--output");
  }
  const bool to_file = !command.stats.file.empty() && command.stats.file != "-";
  if (to_file && !has_frame_place(command.stats.file)) {
    return wrong_option(
        "with --frames the file's name needs a place for the number, such as "
        "json:stats.####.json",
        "--stats");
  }
  return std::nullopt;
}

RenderCommand command_of_frame(const RenderCommand& command, int frame) {
  RenderCommand one = command;
  one.frame = frame;
  one.scene = frame_name(command.scene, frame);
  one.output = frame_name(command.output, frame);
  one.stats.file = frame_name(command.stats.file, frame);
  return one;
}

}  // namespace boule::cli
