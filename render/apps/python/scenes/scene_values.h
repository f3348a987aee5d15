#pragma once

#include <pybind11/pybind11.h>

#include "render/files/scene_file/scene_file.h"

namespace boule::python {

/// A scene that was read as plain values of Python, as its TOML would have them, with Data for what
/// is large: the way back of SceneRequest.
pybind11::dict values_of(LoadedScene&& loaded);

}  // namespace boule::python
