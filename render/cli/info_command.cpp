#include <optional>
#include <utility>

#include "render/cli/commands.h"
#include "render/cli/frames.h"
#include "render/cli/messages.h"
#include "render/cli/reading_limit.h"
#include "render/cli/scene_info.h"
#include "render/scene_file/frame_name.h"
#include "render/scene_file/scene_file.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A value on one line: numbers with spaces between them, members with commas.
std::string inline_text(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& item : value.items()) {
    if (!text.empty()) text += value.is_array() ? " " : ", ";
    if (value.is_object()) text += item.key() + " ";
    text += inline_text(item.value());
  }
  return text;
}

/// True for a list of things rather than of coordinates: each gets a line.
bool is_list(const std::string& key) {
  return key == "lights" || key == "materials" || key == "notes" || key == "warnings";
}

std::string as_text(const Json& info) {
  std::string text;
  for (const auto& [key, value] : info.items()) {
    if (key == "schema" || (is_list(key) && value.empty())) continue;
    text += key + ": " + (is_list(key) ? std::to_string(value.size()) : inline_text(value)) + "\n";
    if (!is_list(key)) continue;
    for (const Json& one : value) text += "  " + inline_text(one) + "\n";
  }
  return text;
}

/// One scene, or one frame of a series.
ExitCode tell(const InfoCommand& command, const std::string& scene, std::optional<int> frame) {
  SceneFileOptions options;
  options.frame = frame;
  const auto load = [&] {
    ReadingLimit limit(command.load_limit);
    const ReadingLimit::Reading reading(limit, scene);
    return load_scene(scene, options);
  };
  auto loaded = load();
  if (!loaded) return report(loaded.error(), invalid_input);
  const Json info = scene_info(std::move(loaded).value(), scene);
  // A file name may hold any bytes: what is not UTF-8 is replaced rather than refused.
  const auto as_json = [&] {
    return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  };
  return print_as_result(command.json ? as_json() : as_text(info));
}

}  // namespace

ExitCode run(const InfoCommand& command) {
  if (!command.frames) {
    const auto bad = check_single_scene(command.scene);
    return bad ? report(*bad, wrong_usage) : tell(command, command.scene, std::nullopt);
  }
  const FrameRange& range = *command.frames;
  for (int frame = range.first; frame <= range.last; frame += range.step) {
    const ExitCode code = tell(command, frame_name(command.scene, frame), frame);
    if (code != done) return code;
  }
  return done;
}

}  // namespace boule::cli
