#include "render/apps/view/messages/camera_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "render/apps/view/messages/camera_kinds.h"

namespace boule::view {
namespace {

using Field = std::pair<std::string, std::string>;  ///< a key and its value

std::string type_of(const Camera& camera) { return std::string(names<Camera>[camera.index()]); }

CameraPose pose_of(const Camera& camera) {
  return std::visit([](const auto& any) { return any.pose; }, camera);
}

double look_distance(const CameraPose& pose) {
  return length(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
}

/// The angle of view, in degrees, that a camera has or that shows as much where it looks.
double shown_angle(const Camera& camera) {
  const auto angle = [](const auto& any) {
    if constexpr (requires { any.fov; }) {
      return double{any.fov};
    } else if constexpr (requires { any.height; }) {
      const double half = double{any.height} / (2 * look_distance(any.pose));
      return 2 * std::atan(half) * 180 / elementary::pi;
    } else {
      return 45.0;
    }
  };
  return std::visit(angle, camera);
}

FovAxis axis_of(const Camera& camera) {
  const auto axis = [](const auto& any) {
    if constexpr (requires { any.fov_axis; }) return any.fov_axis;
    return projection_of<std::decay_t<decltype(any)>>() == Projection::parallel ? FovAxis::y
                                                                                : FovAxis::x;
  };
  return std::visit(axis, camera);
}

/// Gives a camera the pose of another, and as much of what that one shows as it can.
template <class Kind>
void show_as_much(Kind& camera, const Camera& other) {
  camera.pose = pose_of(other);
  const double widest = projection_of<Kind>() == Projection::angle ? 360 : 170;
  const auto angle = static_cast<float>(std::clamp(shown_angle(other), 1.0, widest));
  if constexpr (requires { camera.fov; }) camera.fov = angle;
  if constexpr (requires { camera.fov_axis; }) camera.fov_axis = axis_of(other);
  if constexpr (requires { camera.height; }) {
    const double half = std::tan(double{angle} * elementary::pi / 360);
    camera.height = static_cast<float>(2 * half * look_distance(camera.pose));
  }
}

/// The camera as one of another kind, which edits can name.
Result<Camera> with_type(const Camera& camera, const std::string& type) {
  if (std::visit([](const auto& any) { return has_file<std::decay_t<decltype(any)>>; }, camera))
    return Diagnostic::about("camera.type", "a camera of real lenses stays one");
  std::optional<Camera> result;
  each_kind([&](auto fresh) {
    if (has_file<decltype(fresh)> || fields<decltype(fresh)>.type != type) return;
    show_as_much(fresh, camera);
    result = fresh;
  });
  if (result) return *result;
  return Diagnostic::about("camera.type",
                           fmt::format("expected {}", fmt::join(editable_cameras(), ", ")));
}

/// Sets a member to a value, and tells whether the value is one for it.
struct Setter {
  const CameraValue& value;
  Vec3d origin;  ///< of a point; else 0

  bool operator()(Vec3f& member) const {
    const auto* const vector = std::get_if<Vec3d>(&value);
    if (vector != nullptr) member = vec_cast<float>(*vector - origin);
    return vector != nullptr;
  }
  bool operator()(float& member) const {
    const auto* const number = std::get_if<double>(&value);
    if (number != nullptr) member = static_cast<float>(*number);
    return number != nullptr;
  }
  bool operator()(std::optional<float>& member) const {
    member.reset();
    return std::holds_alternative<std::monostate>(value) || (*this)(member.emplace());
  }
  template <class Enum>
  bool operator()(Enum& member) const {
    const auto* const name = std::get_if<std::string>(&value);
    for (std::size_t i = 0; name != nullptr && i < names<Enum>.size(); ++i) {
      if (names<Enum>[i] != *name) continue;
      member = static_cast<Enum>(i);
      return true;
    }
    return false;
  }
};

/// Sets the keys of one kind of camera that the edit has; an error for one that this kind lacks,
/// unless its value is null.
template <class Kind>
Status set_keys(Kind& camera, const CameraEdit& edit, const Vec3d& origin) {
  auto left = edit.values;
  each_key(camera, [&](const auto& field, auto& member) {
    constexpr bool is_point = std::is_same_v<decltype(field.rule), PointRule>;
    const auto found = left.find(field.key);
    if (found != left.end() && Setter{found->second, is_point ? origin : Vec3d{}}(member))
      left.erase(found);
  });
  for (const auto& [key, value] : left) {
    if (std::holds_alternative<std::monostate>(value)) continue;
    return Diagnostic::about("camera." + key,
                             fmt::format("a camera of type {} has none", fields<Kind>.type));
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
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(const std::string& key, const TypeRule&, Enum value) {
    all.emplace_back(key, "\"" + std::string(name_of(value)) + "\"");
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

std::vector<std::string_view> editable_cameras() {
  std::vector<std::string_view> types;
  each_kind([&types](const auto& camera) {
    using Kind = std::decay_t<decltype(camera)>;
    if (!has_file<Kind>) types.push_back(fields<Kind>.type);
  });
  return types;
}

Result<Camera> edited(const Camera& camera, const CameraEdit& edit, const Vec3d& origin) {
  Camera result = camera;
  if (edit.type && *edit.type != type_of(camera)) {
    auto other = with_type(camera, *edit.type);
    if (!other) return other.error();
    result = other.value();
  }
  const auto apply = [&](auto& any) { return set_keys(any, edit, origin); };
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
