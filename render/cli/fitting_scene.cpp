#include "render/cli/fitting_scene.h"

#include "render/renderer/scene_memory.h"

namespace boule::cli {

Result<LoadedScene> load_fitting_scene(const std::string& path, const SceneFileOptions& options) {
  auto loaded = load_scene(path, options);
  if (!loaded) return loaded;
  if (auto bad = check_scene_memory(loaded.value().scene)) {
    bad->file = path;
    return *bad;
  }
  return loaded;
}

}  // namespace boule::cli
