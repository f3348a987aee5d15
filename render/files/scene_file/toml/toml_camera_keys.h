#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/math/monotone_cubic.h"
#include "core/scene/camera.h"
#include "render/files/scene_file/loaded/first_error.h"
#include "render/files/scene_file/toml/toml_document.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// One quantity of a camera over time: three components, or one.
struct CameraTrack {
  std::string_view key;
  std::size_t components;
  std::array<std::vector<TimedValue>, 3> values{};
  std::vector<TextPlace> places{};  ///< of each key that names it
};

/// The contents of the tables [[camera.key]] of a scene file.
struct CameraMotion {
  std::vector<int> frames{};  ///< of the keys
  std::array<CameraTrack, 5> tracks{CameraTrack{"eye", 3}, CameraTrack{"look_at", 3},
                                    CameraTrack{"fov", 1}, CameraTrack{"aperture", 1},
                                    CameraTrack{"focus", 1}};
};

/// Replaces the tables [[camera.key]] of a scene file by what they say for one frame: the reader of
/// [camera] then sees a camera that stands still. Each quantity is interpolated between the keys
/// that name it, component by component, by monotone_cubic() in double. Without a frame, that of
/// the first key is taken. `root` holds the members of the whole file. Returns nothing if there are
/// no such tables.
std::optional<CameraMotion> apply_camera_keys(TomlMembers& root, std::optional<double> frame,
                                              FirstError& error);

/// Reports the first key whose frame `camera`, read from `table` for another frame, cannot show.
void check_camera_keys(const CameraMotion& motion, const Camera& camera, TomlTable& table);

}  // namespace boule
