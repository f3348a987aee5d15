#include <string>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/particle_scene.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/particle_file/particle_file.h"
#include "render/frame/scheduler.h"

namespace boule::cli {

ExitCode run(const SceneCommand& command) {
  const std::string& path = command.scene;
  if (!is_particle_input(path, command.look)) {
    const std::string message = "particles are expected, and it is none by its name or content: ";
    return report(Diagnostic::in_file(path, message + known_particle_endings()), wrong_usage);
  }
  Scheduler scheduler(0);
  SceneFileOptions options;
  options.parallel_for = scheduler.parallel_for();
  const auto load = [&] {
    ReadingLimit limit(command.load_limit);
    const ReadingLimit::Reading reading(limit, path);
    return load_particle_scene(path, command.look, options);
  };
  const auto scene = load();
  return scene ? print_as_result(scene.value().text)
               : report(scene.error(), code_of_loading(scene.error()));
}

}  // namespace boule::cli
