#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "render/files/scene_file/scene_file.h"
#include "tests/fuzz/input_folder.h"

namespace boule::fuzz {

/// Loads a scene file of these bytes and checks that it is refused with a good error or is valid.
inline void load_bytes(const InputFolder& folder, const std::string& name, const std::uint8_t* data,
                       std::size_t size, const SceneFileOptions& options) {
  const Result<LoadedScene> loaded = load_scene(folder.write(name, data, size), options);
  if (!loaded) {
    require_good(loaded.error());
    return;
  }
  require(validate(loaded.value().scene).ok(), "a scene that was loaded is valid");
  for (const std::string& warning : loaded.value().warnings)
    require(warning.find(": warning: ") != std::string::npos, "a warning says so: " + warning);
}

}  // namespace boule::fuzz
