#include "render/files/scene_file/nff/nff_reader.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "render/files/file/nearest_name.h"
#include "render/files/file/sphere_room.h"
#include "render/files/scene_file/loaded/scene_origin.h"
#include "render/files/scene_file/nff/nff_camera.h"
#include "render/files/scene_file/nff/nff_cursor.h"
#include "render/files/scene_file/nff/nff_polygon.h"

namespace boule {
namespace {

/// Where a Problem of core/scene stands in a line: the word's index and NFF's name for it.
struct FieldWord {
  std::string_view field;
  const char* key;
  std::size_t word;
};

constexpr FieldWord background_words[] = {{"color", "b.color", 1}};
constexpr FieldWord light_words[] = {{"position", "l.position", 1}, {"intensity", "l.color", 4}};
constexpr FieldWord sphere_words[] = {{"center", "s.center", 1}, {"radius", "s.radius", 4}};
constexpr FieldWord fill_words[] = {{"color", "f.color", 1},    {"kd", "f.Kd", 4},
                                    {"ks", "f.Ks", 5},          {"shininess", "f.shine", 6},
                                    {"transmission", "f.T", 7}, {"ior", "f.ior", 8}};

/// Turns NFF text into a Scene, one entity per call of read_entity().
class NffReader {
 public:
  NffReader(std::string_view text, const std::string& path, PolygonPolicy polygons,
            const Vec3d& origin)
      : error_(path), line_(text, error_, origin), policy_(polygons) {}

  Result<LoadedScene> read();

 private:
  void read_line();
  void read_entity(std::string_view name);
  void read_view();
  void read_background();
  void read_light();
  void read_fill();
  void read_sphere();
  void read_polygon(const char* key, bool has_normals);
  void read_cone();
  bool read_vertices(const char* key, bool has_normals, int count);
  void add_plane(TextPlace place, const char* key);
  std::uint32_t material();
  void finish();

  /// Reports a Problem of what was read from this line, at its word.
  template <std::size_t count>
  void check(const std::optional<Problem>& problem, const FieldWord (&words)[count]);

  FirstError error_;
  NffCursor line_;
  PolygonPolicy policy_;
  Scene scene_;
  NffCamera view_;
  bool is_empty_ = true;
  bool has_background_ = false;
  std::vector<std::size_t> uncolored_lights_;
  std::vector<Vec3f> vertices_;  // of one polygon; kept for its memory
  TextPlace first_polygon_;
};

Result<LoadedScene> NffReader::read() {
  while (error_.status() && line_.next_line()) read_line();
  finish();
  if (!error_.status()) return error_.status().error();
  std::vector<std::string> warnings;
  if (!scene_.planes.empty()) {
    warnings.push_back(error_.file() + ":" + std::to_string(first_polygon_.line) +
                       ": warning: a polygon becomes its infinite plane (" +
                       std::to_string(scene_.planes.size()) + " in this file)");
  }
  return LoadedScene{std::move(scene_), std::move(warnings)};
}

void NffReader::read_line() {
  is_empty_ = false;
  const std::string_view name = line_.take_word();
  if (view_.is_open()) {
    if (view_.read_member(name, line_, error_)) return;
    view_.end(scene_, error_);
  }
  read_entity(name);
}

void NffReader::read_entity(std::string_view name) {
  if (name == "s") return read_sphere();
  if (name == "p") return read_polygon("p", false);
  if (name == "pp") return read_polygon("pp", true);
  if (name == "c") return read_cone();
  if (name == "f") return read_fill();
  if (name == "l") return read_light();
  if (name == "b") return read_background();
  if (name == "v") return read_view();
  error_.report(line_.place(), safe_name(name),
                "unknown entity " + quote(name) +
                    ", expected 'v', 'b', 'l', 'f', 's', 'p', 'pp' or a comment");
}

template <std::size_t count>
void NffReader::check(const std::optional<Problem>& problem, const FieldWord (&words)[count]) {
  if (!problem) return;
  for (const FieldWord& word : words) {
    if (word.field == problem->field) {
      error_.report(line_.place(word.word), word.key, problem->message);
    }
  }
}

void NffReader::read_view() {
  if (!view_.begin(line_.place())) error_.report(line_.place(), "v", "a second v block");
  line_.take_line_end("v");
}

void NffReader::read_background() {
  ConstantBackground background;
  if (has_background_) error_.report(line_.place(), "b", "a second background");
  has_background_ = true;
  if (!line_.take("b.color", background.color) || !line_.take_line_end("b")) return;
  check(find_problem(Background{background}), background_words);
  scene_.background = background;
}

void NffReader::read_light() {
  PointLight light;
  if (!line_.take_point("l.position", light.position)) return;
  if (line_.at_line_end()) {
    uncolored_lights_.push_back(scene_.lights.size());
  } else if (!line_.take("l.color", light.intensity) || !line_.take_line_end("l")) {
    return;
  }
  check(find_problem(Light{light}), light_words);
  scene_.lights.emplace_back(light);
}

void NffReader::read_fill() {
  Phong fill;
  const bool is_complete = line_.take("f.color", fill.color) && line_.take("f.Kd", fill.kd) &&
                           line_.take("f.Ks", fill.ks) && line_.take("f.shine", fill.shininess) &&
                           line_.take("f.T", fill.transmission) && line_.take("f.ior", fill.ior) &&
                           line_.take_line_end("f");
  if (!is_complete) return;
  // Some SPD programs (teapot) write 0 for opaque surfaces, which have no use for the index.
  if (fill.ior == 0 && fill.transmission == 0) fill.ior = 1;
  check(find_problem(Material{fill}), fill_words);
  scene_.materials.push_back({"f@" + std::to_string(line_.place().line), fill});
}

void NffReader::read_sphere() {
  Sphere sphere;
  const bool is_complete = line_.take_point("s.center", sphere.center) &&
                           line_.take("s.radius", sphere.radius) && line_.take_line_end("s");
  if (!is_complete) return;
  if (!is_valid(sphere)) check(find_problem(sphere), sphere_words);
  sphere.material = material();
  if (scene_.spheres.size() == scene_.spheres.capacity()) make_room(scene_.spheres, 1);
  scene_.spheres.push_back(sphere);
}

void NffReader::read_polygon(const char* key, bool has_normals) {
  const TextPlace place = line_.place(), count_place = line_.place(1);
  int count = 0;
  if (policy_ == PolygonPolicy::error) error_.report(place, key, "polygons are not accepted");
  if (!line_.take(key, count) || !line_.take_line_end(key)) return;
  if (count < 3) {
    error_.report(count_place, key,
                  "a polygon has 3 vertices or more, not " + std::to_string(count));
  }
  if (!error_.status() || !read_vertices(key, has_normals, count)) return;
  if (policy_ == PolygonPolicy::plane) add_plane(place, key);
}

/// Reads `count` lines with a vertex each. Those of `pp` have a shading normal as well, which
/// planes ignore.
bool NffReader::read_vertices(const char* key, bool has_normals, int count) {
  vertices_.clear();  // not reserved: `count` may be anything
  for (int i = 0; i < count; ++i) {
    Vec3f vertex, normal;
    if (!line_.next_line()) {
      error_.report(line_.end_place(), key,
                    "the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                        " vertices");
      return false;
    }
    const bool is_complete = line_.take_point(key, vertex) &&
                             (!has_normals || line_.take(key, normal)) && line_.take_line_end(key);
    if (!is_complete) return false;
    vertices_.push_back(vertex);
  }
  return true;
}

/// A cone or a cylinder: two lines with a centre and a radius each, which are skipped as polygons
/// are.
void NffReader::read_cone() {
  if (policy_ != PolygonPolicy::skip) {
    error_.report(line_.place(), "c",
                  "cones and cylinders are not read, only left out where polygons are "
                  "(--polygons skip)");
  }
  if (!line_.take_line_end("c")) return;
  for (int i = 0; i < 2; ++i) {
    Vec3f center;
    float radius = 0;
    if (!line_.next_line()) {
      return error_.report(line_.end_place(), "c",
                           "the file ends after " + std::to_string(i) + " of 2 ends of a cone");
    }
    const bool is_complete = line_.take("c.center", center) && line_.take("c.radius", radius) &&
                             line_.take_line_end("c");
    if (!is_complete) return;
  }
}

void NffReader::add_plane(TextPlace place, const char* key) {
  auto plane = plane_through(vertices_);
  if (!plane) return error_.report(place, key, plane.error().message);
  plane.value().material = material();
  if (scene_.planes.empty()) first_polygon_ = place;
  scene_.planes.push_back(plane.value());
}

/// The material of the latest `f`; before the first one, NFF's white.
std::uint32_t NffReader::material() {
  if (scene_.materials.empty()) scene_.materials.push_back({"default", Phong{{1, 1, 1}}});
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

void NffReader::finish() {
  if (view_.is_open()) view_.end(scene_, error_);
  if (is_empty_)
    error_.report(line_.end_place(), "v", "the scene is empty: the file has no v block");
  if (!view_.is_there()) error_.report(line_.end_place(), "v", "the file has no v block");
  // Haines: n lights without a colour have an intensity of 1 / sqrt(n) each.
  const double share = 1 / std::sqrt(static_cast<double>(scene_.lights.size()));
  for (const std::size_t i : uncolored_lights_) {
    std::get<PointLight>(scene_.lights[i]).intensity = gray(static_cast<float>(share));
  }
  if (!error_.status()) return;
  if (const auto done = validate_all_but_primitives(scene_); !done)
    error_.report({}, done.error().key, done.error().message);
}

/// Where the spheres are. What is no sphere is refused when it is read.
SphereExtent extent_of(std::string_view text) {
  SphereExtent extent;
  FirstError ignored("");
  NffCursor line(text, ignored);
  while (line.next_line()) {
    Vec3d center;
    double radius = 0;
    if (line.take_word() == "s" && line.take("", center.x) && line.take("", center.y) &&
        line.take("", center.z) && line.take("", radius)) {
      extent.add(center, radius);
    }
  }
  return extent;
}

}  // namespace

Result<LoadedScene> read_nff(std::string_view text, const std::string& path, PolygonPolicy polygons,
                             const std::optional<Vec3d>& origin) {
  std::vector<std::string> notes;
  SceneExtents extents;
  if (!origin) extents.push_back(extent_of(text));
  const Vec3d zero = choose_origin(extents, origin, notes);
  auto loaded = NffReader(text, path, polygons, zero).read();
  if (!loaded) return loaded;
  loaded.value().notes = std::move(notes);
  loaded.value().origin = zero;
  return loaded;
}

}  // namespace boule
