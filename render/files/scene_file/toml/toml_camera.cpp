#include "render/files/scene_file/toml/toml_camera.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/scene/problem_finder.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/toml/lens_file.h"
#include "render/files/scene_file/toml/picture_file.h"
#include "render/files/scene_file/toml/toml_fields.h"

namespace boule {
namespace {

void finish(TomlTable& table) { table.finish({"eye", "look_at"}); }

template <class Kind>
void read_camera_kind(TomlTable& table, Kind& camera) {
  read_fields(table, camera);
  finish(table);
}

void require_positive(TomlTable& table, const char* key, float value) {
  const NumberRule& allowed = rule::positive;
  if (!allowed.allows(double{value})) table.report(key, "must be " + describe(allowed));
}

/// The radius of the lens: itself, or by the f-number, which is the focal length over the diameter.
void read_aperture(TomlTable& table, float& aperture) {
  float f_number = 0, focal_length = 0;
  table.read("aperture", aperture);
  table.read("f_number", f_number);
  table.read("focal_length", focal_length);
  finish(table);
  const bool by_radius = table.has("aperture"), by_number = table.has("f_number");
  if (by_radius && by_number) table.report("f_number", "cannot stand beside 'aperture'");
  if (!by_radius && !by_number) {
    table.report("aperture", "missing key 'aperture', or 'f_number' with 'focal_length'");
  }
  if (by_number != table.has("focal_length")) {
    const char* missing = by_number ? "focal_length" : "f_number";
    const char* there = by_number ? "f_number" : "focal_length";
    table.report(missing,
                 std::string("missing key '") + missing + "': it goes with '" + there + "'");
  }
  if (!by_number) return;
  require_positive(table, "f_number", f_number);
  require_positive(table, "focal_length", focal_length);
  aperture = static_cast<float>(double{focal_length} / (2 * double{f_number}));
  if (!std::isfinite(aperture)) table.report("f_number", "makes the lens too large for a number");
}

/// The distance that is sharp, given as a number or by a point that lies there.
template <class Kind>
void read_focus(TomlTable& table, Kind& camera) {
  if (!table.has_array("focus")) {
    if (table.has("focus")) table.read("focus", camera.focus.emplace());
    return;
  }
  Vec3f point;
  table.read_point("focus", point);
  if (!table.has("eye") || !table.has("look_at")) return;  // finish() reports it
  table.check(first_problem(camera.pose));                 // without a view there is no depth
  const double depth = depth_of(camera.pose, point);
  if (!(depth > 0)) table.report("focus", "must lie in front of the camera");
  camera.focus = static_cast<float>(depth);
}

void read_camera_kind(TomlTable& table, ThinLensCamera& camera) {
  read_fields(table, camera);
  read_focus(table, camera);
  read_aperture(table, camera.aperture);
}

/// Narrows the stop as the key `f_number` says, if it is there.
void stop_down(TomlTable& table, float f_number, LensCamera& camera) {
  if (!table.has("f_number") || first_problem(camera)) return;
  const auto stop = find_stop(camera.surfaces);
  if (!stop) return table.report("f_number", "the lens must have one stop, flat and in one medium");
  LensSurface& surface = camera.surfaces[*stop];
  const double open = stop_diameter(camera.surfaces, *stop, double{surface.aperture});
  const double least = least_width * double{camera.surfaces.back().aperture};
  const double closed = std::max(stop_diameter(camera.surfaces, *stop, least), open);
  if (!(double{f_number} >= open && double{f_number} <= closed)) {
    return table.report("f_number", "this lens has " + std::to_string(open) + " wide open to " +
                                        std::to_string(closed));
  }
  surface.aperture = static_cast<float>(stop_diameter(camera.surfaces, *stop, double{f_number}));
}

Result<std::vector<LensSurface>> read_surfaces(TomlTable& table, const std::string& name) {
  const SceneData* const data = table.data();
  if (const auto* known = find_data(data != nullptr ? &data->lenses : nullptr, name)) {
    return *known;
  }
  return read_lens(table.file_path(name));
}

void read_camera_kind(TomlTable& table, LensCamera& camera) {
  std::string name;
  float f_number = 1;
  read_fields(table, camera.pose);  // first: errors list the keys in the order of reading
  table.read_file_name("file", name);
  table.read("f_number", f_number);
  read_fields(table, camera);
  read_focus(table, camera);
  table.finish({"eye", "look_at", "file"});
  require_positive(table, "f_number", f_number);
  if (!table.ok()) return;
  auto surfaces = read_surfaces(table, name);
  if (!surfaces) {
    Diagnostic error = surfaces.error();
    if (error.line == 0) return table.report("file", quote(name) + ": " + error.message);
    error.key = table.path() + ".file";
    return table.report(error);
  }
  camera.surfaces = std::move(surfaces).value();
  stop_down(table, f_number, camera);
}

/// The map in a picture's red and green.
DistortionMap map_of(const Image& image) {
  DistortionMap map{image.width, image.height, {}};
  map.st.reserve(2 * image.pixels.size());
  for (const Color& c : image.pixels) map.st.insert(map.st.end(), {c.r, c.g});
  return map;
}

DistortionMap read_map(TomlTable table) {
  std::string name;
  table.read_file_name("file", name);
  table.finish({"file"});
  if (!table.ok()) return {};
  const auto image = read_picture(table, name, PictureContent::numbers);
  if (!image) {
    table.report("file", quote(name) + ": " + image.error().message);
    return {};
  }
  DistortionMap map = map_of(image.value());
  if (const auto problem = find_problem(map)) {
    table.report(problem->field, quote(name) + ": " + problem->message);
  }
  return map;
}

}  // namespace

Camera read_camera(TomlTable& table) {
  table.has("distortion");  // makes it known: it has a reader of its own
  table.has("key");         // likewise: apply_camera_keys() has read these tables
  table.has("fit");         // is false
  Camera camera =
      read_kind<Camera>(table, [](auto& from, auto& kind) { read_camera_kind(from, kind); });
  table.check(find_problem(camera));
  return camera;
}

std::optional<CameraFit> read_camera_fit(TomlTable& table) {
  bool is_fitted = false;
  table.read("fit", is_fitted);
  if (!is_fitted) return std::nullopt;
  for (const char* key : {"eye", "look_at", "key"}) {
    if (table.has(key)) table.report(key, "cannot stand beside 'fit'");
  }
  table.has("distortion");
  CameraFit fit;
  read_fields(table, fit);
  if (fit.type == FittedCamera::orthographic) {
    for (const char* key : {"fov", "fov_axis"}) {
      if (table.has(key)) table.report(key, "an orthographic camera has none");
    }
  }
  table.finish();
  table.check(find_problem(fit));
  return fit;
}

std::optional<DistortionMap> read_distortion(TomlTable& camera) {
  std::optional<TomlTable> table = camera.table("distortion");
  if (!table) return std::nullopt;
  return read_map(std::move(*table));
}

}  // namespace boule
