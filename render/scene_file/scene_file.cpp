#include "render/scene_file/scene_file.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>

#include "core/base/ascii.h"
#include "core/base/float_environment.h"
#include "render/memory/scene_memory.h"
#include "render/scene_file/input_file.h"
#include "render/scene_file/nff_reader.h"
#include "render/scene_file/npy_reader.h"
#include "render/scene_file/toml_reader.h"

namespace boule {
namespace {

/// True if `path` ends with `extension` (lower case), in either case.
bool has_extension(std::string_view path, std::string_view extension) {
  if (path.size() < extension.size()) return false;
  path.remove_prefix(path.size() - extension.size());
  return std::equal(path.begin(), path.end(), extension.begin(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

Result<LoadedScene> read_text_scene(const std::string& path, const SceneFileOptions& options) {
  const auto text = read_text(path);
  if (!text) return text.error();
  return has_extension(path, ".toml") ? read_toml(text.value(), path, options.frame)
                                      : read_nff(text.value(), path, options.polygons);
}

/// Spheres alone, of the default material.
Result<LoadedScene> read_npy_scene(const std::string& path) {
  LoadedScene loaded;
  loaded.scene.materials.push_back({"default", Matte{}});
  NpySpheres request;
  request.path = path;
  request.is_scene = true;
  if (auto bad = append_spheres(request, loaded.scene.spheres)) return *bad;
  if (auto bad = validate_all_but_primitives(loaded.scene)) {
    bad->file = path;
    return *bad;
  }
  return loaded;
}

Result<LoadedScene> load(const std::string& path, const SceneFileOptions& options) {
  const bool is_npy = has_extension(path, ".npy");
  if (!is_npy && !has_extension(path, ".toml") && !has_extension(path, ".nff")) {
    return Diagnostic::in_file(
        path, "not a scene file by its name, expected an extension .toml, .nff or .npy");
  }
  auto loaded = is_npy ? read_npy_scene(path) : read_text_scene(path, options);
  if (!loaded) return loaded;
  if (auto too_large = check_scene_memory(loaded.value().scene)) {
    too_large->file = path;
    return *too_large;
  }
  return loaded;
}

}  // namespace

Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options) {
  const FloatEnvironment environment;
  const auto too_large = Diagnostic::in_file(path, "needs more memory than there is");
  try {
    return load(path, options);
  } catch (const std::bad_alloc&) {
    return too_large;
  } catch (const std::length_error&) {  // more spheres than a vector can have
    return too_large;
  }
}

}  // namespace boule
