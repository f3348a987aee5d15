#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/base/error.h"
#include "render/apps/job/render_job.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/values.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::python {

/// A scene that is to be read: a file, or the tree of a Scene of Python. It holds nothing of
/// Python's, so that any thread may read it.
class SceneRequest {
 public:
  /// The name of a file, with the options of its kind in `keys`: the looks of particles, "frame",
  /// "polygons", "trust"; or a dictionary as a TOML file would have it, without any. Throws Error.
  SceneRequest(const pybind11::object& source, const pybind11::dict& keys);

  /// Reads it. Without the GIL.
  [[nodiscard]] Result<LoadedScene> load(Call& call) const;

 private:
  struct Tree {
    TomlMembers members;
    SceneData data;
    std::string folder;
  };
  std::variant<RenderJob, Tree> source_;
  std::optional<int> frame_;
};

/// Errors about arguments that have the names of options of the command line.
LookOptions look_of(const pybind11::dict& keys);

void bind_scenes(pybind11::module_& module);

}  // namespace boule::python
