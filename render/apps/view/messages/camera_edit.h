#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "core/scene/camera.h"

namespace boule::view {

/// The value of a camera's key: null, a number, the name of an enumerator, or a vector.
using CameraValue = std::variant<std::monostate, double, std::string, Vec3d>;

/// Some keys of a camera, as a client sends them; what is not there stays. Points are in the
/// coordinates of the file.
struct CameraEdit {
  std::optional<std::string> type{};
  std::map<std::string, CameraValue, std::less<>> values{};
};

/// The kinds of camera that an edit can name: those without a file of their own.
std::vector<std::string_view> editable_cameras();

/// The camera after an edit. `origin` was subtracted from the file's points. Another type keeps the
/// pose, and shows about as much of what is looked at. Numbers are rounded to float once. An error
/// names the key: one that this kind of camera does not have, or a Problem of the camera.
Result<Camera> edited(const Camera& camera, const CameraEdit& edit, const Vec3d& origin);

/// The table [camera] of a scene file, a key on each line. A LensCamera lacks its file.
std::string camera_toml(const Camera& camera, const Vec3d& origin);

/// The same as the value of --camera: the keys on one line.
std::string camera_keys(const Camera& camera, const Vec3d& origin);

/// A number as TOML and JSON have it, as short as it is read back the same.
std::string shortest(float number);
std::string shortest(double number);

/// A coordinate of the file. The float that is read back from it is the same, unless the origin is
/// so far away that the file's doubles are coarser there than the float.
double file_coordinate(float coordinate, double origin);

}  // namespace boule::view
