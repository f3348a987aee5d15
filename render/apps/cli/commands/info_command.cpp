#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/info/packed_info.h"
#include "render/apps/cli/info/particle_info.h"
#include "render/apps/cli/info/scene_info.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/render/frames.h"
#include "render/apps/job/particle_scene.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/packed/packed_file.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "render/files/scene_file/scene_file.h"
#include "render/frame/scheduler.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What is told of one scene, or one frame of a series.
Result<Json> info_of(const InfoCommand& command, const std::string& scene,
                     std::optional<int> frame) {
  SceneFileOptions options;
  options.frame = frame;
  options.trust = command.trust;
  Scheduler scheduler(0);
  options.parallel_for = scheduler.parallel_for();
  ReadingLimit limit(command.load_limit);
  const ReadingLimit::Reading reading(limit, scene);
  if (is_particle_input(scene, command.look)) return particle_info(scene, command.look, frame);
  if (!command.look.first.empty()) return not_particles(scene, command.look.first);
  if (is_packed_name(scene)) return packed_info(command, scene, options);
  if (command.verify)
    return Diagnostic::about("--verify", "is of packed scenes, and " + quote(scene) + " is none");
  auto loaded = load_known(scene, command.look, options);
  if (!loaded) return loaded.error();
  return scene_info(std::move(loaded).value(), scene);
}

/// Tells of one scene, or one frame of a series.
ExitCode tell(const InfoCommand& command, const std::string& scene, std::optional<int> frame) {
  const auto found = info_of(command, scene, frame);
  if (!found) return report(found.error(), code_of_loading(found.error()));
  const Json& info = found.value();
  // A file name may hold any bytes: what is not UTF-8 is replaced rather than refused.
  const auto as_json = [&] {
    return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  };
  return print_as_result(command.json ? as_json() : scene_info_text(info));
}

}  // namespace

ExitCode run(const InfoCommand& command) {
  if (!command.frames) {
    const auto done = check_single_scene(command.scene);
    return done ? tell(command, command.scene, std::nullopt) : report(done.error(), wrong_usage);
  }
  const FrameRange& range = *command.frames;
  for (int frame = range.first; frame <= range.last; frame += range.step) {
    const ExitCode code = tell(command, frame_name(command.scene, frame), frame);
    if (code != done) return code;
  }
  return done;
}

}  // namespace boule::cli
