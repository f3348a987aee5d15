#include "render/files/scene_file/scene_file.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/base/float_environment.h"
#include "core/base/text.h"
#include "render/files/file/input_file.h"
#include "render/files/packed/packed_file.h"
#include "render/files/scene_file/loaded/particle_file_cache.h"
#include "render/files/scene_file/nff/nff_reader.h"
#include "render/files/scene_file/npy/npy_reader.h"
#include "render/files/scene_file/scene_tree.h"
#include "render/files/scene_file/toml/toml_packed.h"
#include "render/files/scene_file/toml/toml_reader.h"
#include "render/memory/scene_memory.h"

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
  return has_extension(path, ".toml")
             ? read_toml(text.value(), path, options)
             : read_nff(text.value(), path, options.polygons, options.origin);
}

/// Spheres alone, of the default material.
Result<LoadedScene> read_npy_scene(const std::string& path, const SceneFileOptions& options) {
  LoadedScene loaded;
  loaded.scene.materials.push_back({"default", Matte{}});
  NpySpheres request;
  request.path = path;
  request.is_scene = true;
  const ParallelFor& parallel_for = options.parallel_for;
  SceneExtents extents;
  if (!options.origin) extents.push_back(extent_of(request, parallel_for));
  loaded.origin = request.origin = choose_origin(extents, options.origin, loaded.notes);
  if (auto done = append_spheres(request, loaded.scene.spheres, parallel_for); !done)
    return done.error();
  if (auto done = validate_all_but_primitives(loaded.scene); !done) {
    done.error().file = path;
    return done.error();
  }
  return loaded;
}

Result<LoadedScene> read_packed_scene(const std::string& path, const SceneFileOptions& options) {
  auto packed = open_packed(path, options);
  if (!packed) return packed.error();
  LoadedScene loaded;
  loaded.scene = std::move(packed.value().scene);
  loaded.origin = packed.value().origin;
  return loaded;
}

Result<LoadedScene> load(const std::string& path, const SceneFileOptions& options) {
  if (is_packed_name(path)) return read_packed_scene(path, options);
  const bool is_npy = has_extension(path, ".npy");
  if (!is_npy && !has_extension(path, ".toml") && !has_extension(path, ".nff")) {
    if (const auto file = InputFile::open(path); !file) return file.error();
    return Diagnostic::in_file(
        path, "not a scene file by its name, expected an extension .toml, .nff, .npy or .boule");
  }
  return is_npy ? read_npy_scene(path, options) : read_text_scene(path, options);
}

/// Calls `read`, and refuses what does not fit into memory.
template <class Read>
Result<LoadedScene> load_checked(const std::string& path, const SceneFileOptions& options,
                                 const Read& read) {
  const FloatEnvironment environment;
  const auto too_large = [&] {
    Diagnostic error = Diagnostic::in_file(path, "needs more memory than there is");
    error.of_memory = true;
    return error;
  };
  try {
    Result<LoadedScene> loaded = read();
    if (options.particle_files != nullptr) options.particle_files->close_unused();
    if (!loaded) return loaded;
    if (auto done = check_scene_memory(loaded.value().scene); !done) {
      done.error().file = path;
      return done.error();
    }
    return loaded;
  } catch (const std::bad_alloc&) {
    return too_large();
  } catch (const std::length_error&) {  // more spheres than a vector can have
    return too_large();
  }
}

}  // namespace

Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options) {
  return load_checked(path, options, [&] { return load(path, options); });
}

Result<LoadedScene> load_scene_text(const std::string& toml, const std::string& shown_path,
                                    const SceneFileOptions& options) {
  return load_checked(shown_path, options, [&] { return read_toml(toml, shown_path, options); });
}

Result<LoadedScene> load_scene_tree(TomlMembers root, const std::string& shown_path,
                                    const SceneFileOptions& options) {
  return load_checked(shown_path, options, [&] {
    return read_toml_tree({{}, std::move(root)}, shown_path, options);
  });
}

}  // namespace boule
