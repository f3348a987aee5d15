#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/math/geometry.h"
#include "core/scene/instances.h"
#include "core/scene/lens_optics.h"

namespace boule {
namespace {

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

/// Collects the first Problem of one thing; later checks are skipped once there is one.
class Checker {
 public:
  Checker& finite(const char* field, float value) {
    return require(field, std::isfinite(value), "must be finite, is " + text_of(double{value}));
  }
  Checker& finite(const char* field, const Vec3f& v) {
    return require(field, is_finite(v), "must be finite");
  }
  Checker& positive(const char* field, float value) {
    return require(field, std::isfinite(value) && value > 0,
                   "must be finite and above 0, is " + text_of(double{value}));
  }
  Checker& not_negative(const char* field, float value) {
    return require(field, std::isfinite(value) && value >= 0,
                   "must be finite and 0 or above, is " + text_of(double{value}));
  }
  Checker& color(const char* field, const Color& c) {
    return not_negative(field, c.r).not_negative(field, c.g).not_negative(field, c.b);
  }
  Checker& direction(const char* field, const Vec3f& v) {
    return finite(field, v).require(field, !(v == Vec3f{}), "must not be the zero vector");
  }
  Checker& require(const char* field, bool holds, const std::string& message) {
    if (!problem_ && !holds) problem_ = Problem{field, message};
    return *this;
  }
  [[nodiscard]] std::optional<Problem> problem() const { return problem_; }

 private:
  std::optional<Problem> problem_;
};

Checker check_pose(const CameraPose& pose) {
  Checker checker;
  checker.finite("eye", pose.eye).finite("look_at", pose.look_at).direction("up", pose.up);
  checker.require("look_at", !(pose.eye == pose.look_at), "must differ from eye");
  if (checker.problem()) return checker;
  const Vec3d view = normalize(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
  const Vec3d up = normalize(vec_cast<double>(pose.up));
  return checker.require("up", length(cross(view, up)) > 1e-6,
                         "must not be within 1e-6 rad of the view direction");
}

struct LensProblem {
  std::optional<Problem> operator()(const LensSurface& s) const {
    Checker checker;
    checker.finite("radius", s.radius)
        .not_negative("thickness", s.thickness)
        .require("index", s.index >= least_index && s.index <= most_index,
                 "must be from " + text_of(double{least_index}) + " to " +
                     text_of(double{most_index}) + ", is " + text_of(double{s.index}))
        .positive("aperture", s.aperture);
    return checker
        .require("aperture", s.radius == 0 || s.aperture <= 2 * std::fabs(s.radius),
                 "is wider than its sphere")
        .problem();
  }
};

struct CameraProblem {
  /// The keys of a film that sees less than half the world.
  template <class Kind>
  [[nodiscard]] Checker check_acute(const Kind& c) const {
    return check_pose(c.pose).require(
        "fov", c.fov > 0 && c.fov < 180,
        "must be above 0 and below 180 degrees, is " + text_of(double{c.fov}));
  }

  std::optional<Problem> operator()(const PinholeCamera& c) const {
    return check_acute(c).problem();
  }
  std::optional<Problem> operator()(const OrthographicCamera& c) const {
    return check_pose(c.pose).positive("height", c.height).problem();
  }
  std::optional<Problem> operator()(const FisheyeCamera& c) const {
    return check_pose(c.pose)
        .require("fov", c.fov > 0 && c.fov <= 360,
                 "must be above 0 and at most 360 degrees, is " + text_of(double{c.fov}))
        .problem();
  }
  std::optional<Problem> operator()(const ThinLensCamera& c) const {
    Checker checker = check_acute(c).not_negative("aperture", c.aperture);
    return (c.focus ? checker.positive("focus", *c.focus) : checker).problem();
  }
  std::optional<Problem> operator()(const LensCamera& c) const {
    Checker checker = check_pose(c.pose)
                          .positive("film_width", c.film_width)
                          .positive("scale", c.scale)
                          .require("file", !c.surfaces.empty(), "must have surfaces");
    if (c.focus) checker.positive("focus", *c.focus);
    for (std::size_t i = 0; i < c.surfaces.size(); ++i) {
      const std::string place = "surface " + std::to_string(i + 1) + ": its ";
      const auto bad = LensProblem{}(c.surfaces[i]);
      checker.require("file", !bad, bad ? place + bad->field + " " + bad->message : "");
      const double width = c.surfaces[i].aperture, last = c.surfaces.back().aperture;
      checker.require("file", !(width < least_width * last),
                      place + "aperture is less than a 500th of the last one's");
    }
    if (checker.problem()) return checker.problem();
    const double focal = focal_length(c.surfaces);
    checker.require("file", std::isfinite(focal) && focal > 0, "must gather light, to a focus");
    const double focus = focus_of(c.pose, c.focus);
    const double behind = image_distance(c.surfaces, focus / double{c.scale});
    checker.require("focus", std::isfinite(behind) && behind > 0,
                    "is nearer than the lens can be focused");
    if (checker.problem()) return checker.problem();
    return checker
        .require("file", std::isfinite(1 / gathered_light(c)),
                 "lets no light to the middle of the film at this focus")
        .problem();
  }
};

struct MaterialProblem {
  std::optional<Problem> operator()(const Matte& m) const {
    return Checker{}.color("color", m.color).problem();
  }
  std::optional<Problem> operator()(const Plastic& m) const {
    return Checker{}
        .color("color", m.color)
        .not_negative("specular", m.specular)
        .not_negative("shininess", m.shininess)
        .not_negative("reflect", m.reflect)
        .problem();
  }
  std::optional<Problem> operator()(const Metal& m) const {
    return Checker{}.color("color", m.color).problem();
  }
  std::optional<Problem> operator()(const Glass& m) const {
    return Checker{}.color("color", m.color).positive("ior", m.ior).problem();
  }
  std::optional<Problem> operator()(const Emissive& m) const {
    return Checker{}.color("radiance", m.radiance).problem();
  }
  std::optional<Problem> operator()(const Phong& m) const {
    return Checker{}
        .color("color", m.color)
        .not_negative("ka", m.ka)
        .not_negative("kd", m.kd)
        .not_negative("ks", m.ks)
        .not_negative("shininess", m.shininess)
        .not_negative("transmission", m.transmission)
        .positive("ior", m.ior)
        .problem();
  }
};

struct LightProblem {
  std::optional<Problem> operator()(const PointLight& l) const {
    return Checker{}.finite("position", l.position).color("intensity", l.intensity).problem();
  }
  std::optional<Problem> operator()(const DirectionalLight& l) const {
    return Checker{}.direction("direction", l.direction).color("intensity", l.intensity).problem();
  }
  std::optional<Problem> operator()(const SphereLight& l) const {
    return Checker{}
        .finite("center", l.center)
        .positive("radius", l.radius)
        .color("radiance", l.radiance)
        .problem();
  }
};

Status located(const std::string& place, const std::optional<Problem>& problem) {
  if (!problem) return std::nullopt;
  return Diagnostic{problem->message, place + "." + problem->field, {}, 0, 0};
}

bool is_valid(const Plane& plane) { return !find_problem(plane); }

template <class Primitive>
Status check_primitives(const std::string& name, const std::vector<Primitive>& primitives,
                        const Scene& scene) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const bool has_material = primitives[i].material < scene.materials.size();
    if (is_valid(primitives[i]) && has_material) continue;
    const std::string place = name + "[" + std::to_string(i) + "]";
    if (auto problem = find_problem(primitives[i])) return located(place, problem);
    return Diagnostic{"names no material of the scene", place + ".material", {}, 0, 0};
  }
  return std::nullopt;
}

Status check_objects(const Scene& scene) {
  if (auto bad = check_primitives("sphere", scene.spheres, scene)) return bad;
  if (auto bad = check_primitives("plane", scene.planes, scene)) return bad;
  for (const Group& group : scene.groups) {
    const std::string path = "group." + group.name + ".";
    if (auto bad = check_primitives(path + "sphere", group.spheres, scene)) return bad;
    if (auto bad = check_primitives(path + "plane", group.planes, scene)) return bad;
  }
  const auto bad = find_instance_problem(scene);
  if (!bad) return std::nullopt;
  const std::string path = bad->group ? "group." + scene.groups[*bad->group].name + "." : "";
  return located(path + "instance[" + std::to_string(bad->instance) + "]", bad->problem);
}

Status check_settings(const Scene& scene) {
  if (auto bad = check_range("image.size", scene.image.width, 1, max_image_side)) return bad;
  if (auto bad = check_range("image.size", scene.image.height, 1, max_image_side)) return bad;
  if (auto bad = check_range("image.spp", scene.image.spp, 1, max_count)) return bad;
  return check_range("render.max_depth", scene.render.max_depth, 0, max_count);
}

}  // namespace

Status check_range(const char* key, int value, int low, int high) {
  if (value >= low && value <= high) return std::nullopt;
  const std::string range = high == max_count ? std::to_string(low) + " or above"
                                              : std::to_string(low) + " to " + std::to_string(high);
  return Diagnostic{"must be " + range + ", is " + std::to_string(value), key, {}, 0, 0};
}

std::optional<Problem> find_problem(const Sphere& sphere) {
  if (is_valid(sphere)) return std::nullopt;  // the checker words its messages beforehand
  return Checker{}.finite("center", sphere.center).positive("radius", sphere.radius).problem();
}

std::optional<Problem> find_problem(const Plane& plane) {
  return Checker{}.finite("point", plane.point).direction("normal", plane.normal).problem();
}

std::optional<Problem> find_problem(const Instance& instance) {
  return Checker{}
      .finite("translate", instance.translate)
      .finite("rotate", instance.rotate)
      .positive("scale", instance.scale)
      .problem();
}

std::optional<Problem> find_problem(const Camera& camera) {
  return std::visit(CameraProblem{}, camera);
}

std::optional<Problem> find_problem(const DistortionMap& map) {
  const auto count = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
  return Checker{}
      .require("file", map.width >= 2 && map.height >= 2,
               "must have 2 x 2 pixels or more, has " + std::to_string(map.width) + " x " +
                   std::to_string(map.height))
      .require("file", map.st.size() == 2 * count(map.width) * count(map.height),
               "must have two numbers a pixel")
      .require("file",
               std::all_of(map.st.begin(), map.st.end(), [](float x) { return std::isfinite(x); }),
               "must be finite everywhere")
      .problem();
}

std::optional<Problem> find_problem(const Material& material) {
  return std::visit(MaterialProblem{}, material);
}

std::optional<Problem> find_problem(const Light& light) {
  return std::visit(LightProblem{}, light);
}

std::optional<Problem> find_problem(const Background& background) {
  if (const auto* constant = std::get_if<ConstantBackground>(&background)) {
    return Checker{}.color("color", constant->color).problem();
  }
  if (const auto* image = std::get_if<EnvironmentBackground>(&background)) {
    Checker checker;
    checker.finite("rotation", image->rotation);
    const bool whole = image->width >= 1 && image->height >= 1 &&
                       image->pixels.size() == static_cast<std::size_t>(image->width) *
                                                   static_cast<std::size_t>(image->height);
    checker.require("file", whole, "must have width x height pixels, 1 or more");
    const auto good = [](float x) { return std::isfinite(x) && x >= 0; };
    for (const Color& c : image->pixels) {
      if (good(c.r) && good(c.g) && good(c.b)) continue;
      return Problem{"file", "must have finite numbers of 0 or above only"};
    }
    return checker.problem();
  }
  const auto& gradient = std::get<GradientBackground>(background);
  return Checker{}
      .color("bottom", gradient.bottom)
      .color("top", gradient.top)
      .direction("up", gradient.up)
      .problem();
}

Status validate_all_but_primitives(const Scene& scene) {
  if (auto bad = check_settings(scene)) return bad;
  if (scene.camera) {
    if (auto bad = located("camera", find_problem(*scene.camera))) return bad;
  }
  if (scene.distortion) {
    if (auto bad = located("camera.distortion", find_problem(*scene.distortion))) return bad;
  }
  if (auto bad = located("background", find_problem(scene.background))) return bad;
  if (auto bad = located("background", Checker{}.color("ambient", scene.ambient).problem())) {
    return bad;
  }
  for (const NamedMaterial& named : scene.materials) {
    if (auto bad = located("material." + named.name, find_problem(named.material))) return bad;
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (auto bad = located("light[" + std::to_string(i) + "]", find_problem(scene.lights[i]))) {
      return bad;
    }
  }
  if (scene.spheres.size() + scene.planes.size() > max_primitives) {
    return Diagnostic{"a scene has at most 2147483647 primitives", "sphere", {}, 0, 0};
  }
  return std::nullopt;
}

Status validate(const Scene& scene) {
  if (auto bad = validate_all_but_primitives(scene)) return bad;
  return check_objects(scene);
}

}  // namespace boule
