#include "render/cli/camera_option.h"

#include <fmt/format.h>

#include <utility>

namespace boule::cli {

/// The keys are read as those of a scene that has nothing else.
Status use_camera(const RenderCommand& command, LoadedScene& loaded) {
  if (command.camera.empty()) return std::nullopt;
  const Vec3d& origin = loaded.origin;
  const std::string shown_path = "the camera of the command line";
  const std::string text =
      fmt::format("schema = 1\norigin = [{}, {}, {}]\ncamera = {{{}}}\n", origin.x + 0.0,
                  origin.y + 0.0, origin.z + 0.0, command.camera);
  auto read = load_scene_text(text, shown_path);
  if (!read) {
    const Diagnostic& error = read.error();
    const std::string key = error.key.starts_with("camera.") ? error.key.substr(7) + ": " : "";
    return Diagnostic::about("--camera", key + error.message);
  }
  if (!read.value().scene.camera)
    return Diagnostic::about("--camera", "expected the keys of a camera, eye and look_at at least");
  loaded.scene.camera = std::move(read).value().scene.camera;
  return std::nullopt;
}

}  // namespace boule::cli
