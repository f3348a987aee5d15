#include "render/apps/job/options/camera_option.h"

#include <fmt/format.h>

#include <utility>

#include "core/scene/principal_pose.h"

namespace boule {

/// The keys are read as those of a scene that has nothing else.
Status use_camera(const std::string& keys, const SceneFileOptions& series, LoadedScene& loaded) {
  if (keys.empty()) return {};
  const Vec3d& origin = loaded.origin;
  const std::string shown_path = "the camera of the command line";
  const std::string text = fmt::format("schema = 1\norigin = [{}, {}, {}]\ncamera = {{{}}}\n",
                                       origin.x + 0.0, origin.y + 0.0, origin.z + 0.0, keys);
  SceneFileOptions options;
  options.frame = series.frame;
  options.between = series.between;
  auto read = load_scene_text(text, shown_path, options);
  if (!read) {
    const Diagnostic& error = read.error();
    const bool names_key = error.message.starts_with("missing key");
    const bool has_key = error.key.starts_with("camera.") && !names_key;
    return Diagnostic::about("--camera",
                             (has_key ? error.key.substr(7) + ": " : "") + error.message);
  }
  Scene& scene = read.value().scene;
  loaded.scene.camera = std::move(scene.camera);
  loaded.scene.distortion = std::move(scene.distortion);
  if (loaded.scene.camera) return {};
  loaded.scene.fit = scene.fit;
  loaded.scene.fit = settled_fit(loaded.scene);
  return {};
}

}  // namespace boule
