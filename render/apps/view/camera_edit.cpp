#include "render/apps/view/camera_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule::view {
namespace {

using Field = std::pair<std::string, std::string>;  ///< a key and its value

Diagnostic no_such_key(const char* key, const std::string& type) {
  return Diagnostic::about(std::string("camera.") + key, "a camera of type " + type + " has none");
}

std::string type_of(const Camera& camera) { return std::string(names<Camera>[camera.index()]); }

CameraPose pose_of(const Camera& camera) {
  return std::visit([](const auto& any) { return any.pose; }, camera);
}

double look_distance(const CameraPose& pose) {
  return length(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
}

/// The angle of view, in degrees, that a camera has or that shows as much where it looks.
double shown_angle(const Camera& camera) {
  if (const auto* parallel = std::get_if<OrthographicCamera>(&camera)) {
    const double half = double{parallel->height} / (2 * look_distance(parallel->pose));
    return 2 * std::atan(half) * 180 / elementary::pi;
  }
  if (const auto* fisheye = std::get_if<FisheyeCamera>(&camera)) return double{fisheye->fov};
  if (const auto* lens = std::get_if<ThinLensCamera>(&camera)) return double{lens->fov};
  if (const auto* pinhole = std::get_if<PinholeCamera>(&camera)) return double{pinhole->fov};
  return 45;
}

FovAxis axis_of(const Camera& camera) {
  if (std::holds_alternative<OrthographicCamera>(camera)) return FovAxis::y;
  if (const auto* fisheye = std::get_if<FisheyeCamera>(&camera)) return fisheye->fov_axis;
  if (const auto* lens = std::get_if<ThinLensCamera>(&camera)) return lens->fov_axis;
  if (const auto* pinhole = std::get_if<PinholeCamera>(&camera)) return pinhole->fov_axis;
  return FovAxis::x;
}

float flat_angle(double degrees) { return static_cast<float>(std::clamp(degrees, 1.0, 170.0)); }

Camera with_type(const Camera& camera, const std::string& type) {
  const CameraPose pose = pose_of(camera);
  const double angle = shown_angle(camera);
  const FovAxis axis = axis_of(camera);
  if (type == "pinhole") return PinholeCamera{pose, flat_angle(angle), axis};
  if (type == "thin_lens") return ThinLensCamera{pose, flat_angle(angle), axis, 0, {}};
  if (type == "fisheye")
    return FisheyeCamera{pose, static_cast<float>(std::clamp(angle, 1.0, 360.0)), axis};
  const double half = std::tan(double{flat_angle(angle)} * elementary::pi / 360);
  return OrthographicCamera{pose, static_cast<float>(2 * half * look_distance(pose))};
}

bool is_editable(const std::string& type) {
  return std::find(editable_cameras.begin(), editable_cameras.end(), type) !=
         editable_cameras.end();
}

Status check_type(const Camera& camera, const std::string& type) {
  if (type == type_of(camera)) return {};
  if (std::holds_alternative<LensCamera>(camera))
    return Diagnostic::about("camera.type", "a camera of real lenses stays one");
  if (is_editable(type)) return {};
  return Diagnostic::about("camera.type", "expected pinhole, orthographic, fisheye or thin_lens");
}

void move(CameraPose& pose, const CameraEdit& edit, const Vec3d& origin) {
  if (edit.eye) pose.eye = vec_cast<float>(*edit.eye - origin);
  if (edit.look_at) pose.look_at = vec_cast<float>(*edit.look_at - origin);
  if (edit.up) pose.up = vec_cast<float>(*edit.up);
}

/// Sets the numbers of one kind of camera that the edit has; an error for one that this kind lacks.
template <class Kind>
Status set_numbers(Kind& camera, const CameraEdit& edit) {
  const std::string type(fields<Kind>.type);
  if constexpr (requires { camera.fov; }) {
    if (edit.fov) camera.fov = static_cast<float>(*edit.fov);
    if (edit.fov_axis) camera.fov_axis = *edit.fov_axis;
  } else {
    if (edit.fov) return no_such_key("fov", type);
    if (edit.fov_axis) return no_such_key("fov_axis", type);
  }
  if constexpr (requires { camera.height; }) {
    if (edit.height) camera.height = static_cast<float>(*edit.height);
  } else if (edit.height) {
    return no_such_key("height", type);
  }
  if constexpr (requires { camera.aperture; }) {
    if (edit.aperture) camera.aperture = static_cast<float>(*edit.aperture);
  } else if (edit.aperture) {
    return no_such_key("aperture", type);
  }
  if constexpr (requires { camera.focus; }) {
    if (!edit.focus) return {};
    camera.focus.reset();
    if (*edit.focus) camera.focus = static_cast<float>(**edit.focus);
  } else if (edit.focus && *edit.focus) {
    return no_such_key("focus", type);
  }
  return {};
}

std::string point_text(const Vec3f& point, const Vec3d& origin) {
  return fmt::format("[{}, {}, {}]", shortest(file_coordinate(point.x, origin.x)),
                     shortest(file_coordinate(point.y, origin.y)),
                     shortest(file_coordinate(point.z, origin.z)));
}

/// The keys of a camera and their values as TOML has them.
class FieldTexts {
 public:
  FieldTexts(const Camera& camera, const Vec3d& origin) : origin_(origin) {
    all.emplace_back("type", "\"" + type_of(camera) + "\"");
    std::visit([this](const auto& any) { this->add_fields(any); }, camera);
  }

  std::vector<Field> all;

 private:
  template <HasFields T>
  void add_fields(const T& value) {
    each_field(value, [this](const auto& field, const auto& member) {
      this->add(std::string(field.key), field.rule, member);
    });
  }
  template <class Rule, HasFields T>
  void add(const std::string&, const Rule&, const T& part) {
    add_fields(part);
  }
  void add(const std::string& key, const PointRule&, const Vec3f& point) {
    all.emplace_back(key, point_text(point, origin_));
  }
  void add(const std::string& key, const DirectionRule&, const Vec3f& vector) {
    all.emplace_back(key, point_text(vector, {}));
  }
  template <class Rule>
  void add(const std::string& key, const Rule&, float number) {
    all.emplace_back(key, shortest(number));
  }
  template <class Rule>
  void add(const std::string& key, const Rule& rule, const std::optional<float>& number) {
    if (number) add(key, rule, *number);
  }
  void add(const std::string& key, const TypeRule&, FovAxis axis) {
    all.emplace_back(key, "\"" + std::string(name_of(axis)) + "\"");
  }
  void add(const std::string&, const FileRule&, const std::vector<LensSurface>&) {}

  Vec3d origin_;
};

/// A number as TOML reads it: with a point or an exponent.
std::string with_point(const std::string& text) {
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string shortest(float number) { return with_point(fmt::format("{}", number)); }
std::string shortest(double number) { return with_point(fmt::format("{}", number)); }

/// Without an origin the float's own shortest text is the number that people wrote.
double file_coordinate(float coordinate, double origin) {
  if (origin != 0) return double{coordinate} + origin;
  const std::string text = fmt::format("{}", coordinate);
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

Result<Camera> edited(const Camera& camera, const CameraEdit& edit, const Vec3d& origin) {
  Camera result = camera;
  if (edit.type) {
    if (auto done = check_type(camera, *edit.type); !done) return done.error();
    if (*edit.type != type_of(camera)) result = with_type(camera, *edit.type);
  }
  const auto apply = [&](auto& any) {
    move(any.pose, edit, origin);
    return set_numbers(any, edit);
  };
  if (auto done = std::visit(apply, result); !done) return done.error();
  if (const auto problem = find_problem(result))
    return Diagnostic::about("camera." + problem->field, problem->message);
  return result;
}

std::string camera_toml(const Camera& camera, const Vec3d& origin) {
  std::string text = "[camera]\n";
  for (const auto& [key, value] : FieldTexts(camera, origin).all)
    text += key + " = " + value + "\n";
  return text;
}

std::string camera_keys(const Camera& camera, const Vec3d& origin) {
  std::string text;
  for (const auto& [key, value] : FieldTexts(camera, origin).all)
    text += (text.empty() ? "" : ", ") + key + " = " + value;
  return text;
}

}  // namespace boule::view
