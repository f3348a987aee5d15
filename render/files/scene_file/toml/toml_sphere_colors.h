#pragma once

#include <optional>
#include <string>

#include "core/scene/primitive.h"
#include "render/files/particles/particle_spheres.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/npy/npy_colors.h"
#include "render/files/scene_file/toml/toml_color_map.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// Where the primitives of a table [[spheres]] or [[capsules]] have their colours from: a file of
/// colours, or one of numbers that a map makes colours of.
struct SphereColors {
  std::string colors;  ///< name of the file, or empty
  ColorSpace space = ColorSpace::srgb;
  std::string scalar;     ///< likewise
  std::string written{};  ///< that name with the place for a frame's number
  ColorMapKeys map;

  [[nodiscard]] bool any() const { return !colors.empty() || !scalar.empty(); }
};

/// What a map has made of numbers.
struct MappedSpheres {
  ParticleColors::Scale scale;
  ParticleChoices own{};  ///< the numbers' range, if it was chosen
  std::string note{};     ///< if it was chosen
};

/// Reads the keys `colors`, `color_space`, `scalar`, `map` and `range`. Errors are reported through
/// the table.
SphereColors read_sphere_colors(TomlTable& table);

/// Colours the spheres or capsules of a table; they keep their material, which is one that can be
/// coloured. The map of numbers, if there is one. Errors are reported through the table.
std::optional<MappedSpheres> color_spheres(TomlTable& table, const SphereColors& keys,
                                           const MaterialRows& materials,
                                           const SceneFileOptions& options);

}  // namespace boule
