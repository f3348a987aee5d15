#include "render/apps/python/scenes/scene_values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/kinds.h"
#include "render/apps/job/picture/legend.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/field_values.h"
#include "render/apps/python/values/values.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// Turns the parts of one scene into values.
class SceneValues {
 public:
  explicit SceneValues(LoadedScene&& loaded) : loaded_(std::move(loaded)), world_(loaded_.origin) {
    for (const NamedMaterial& material : loaded_.scene.materials) {
      names_.push_back(unused(material.name));
    }
  }

  py::dict all();

 private:
  [[nodiscard]] std::string unused(const std::string& name) const;
  [[nodiscard]] py::object camera() const;
  [[nodiscard]] py::dict fit() const;
  [[nodiscard]] py::dict background() const;
  [[nodiscard]] py::list materials() const;
  [[nodiscard]] py::list lights() const;
  [[nodiscard]] py::list clips() const;
  template <class Arrays, class Primitive>
  [[nodiscard]] py::object many(std::vector<Primitive>&& primitives, const Vec3d& base) const;
  [[nodiscard]] py::list planes(const std::vector<Plane>& planes, const FieldValues& values) const;
  template <class Owner>
  void add_objects(py::dict& to, Owner& owner, const Vec3d& origin,
                   const FieldValues& values) const;
  [[nodiscard]] py::list instances(const std::vector<Instance>& all, const Vec3d& origin) const;
  [[nodiscard]] py::list groups();
  [[nodiscard]] py::object origin() const;

  LoadedScene loaded_;
  FieldValues world_;
  FieldValues own_;  ///< of what has coordinates of its own
  std::vector<std::string> names_;
};

/// A name that no material has yet.
std::string SceneValues::unused(const std::string& name) const {
  const std::string wanted = name.empty() ? "material" : name;
  std::string free = wanted;
  for (int i = 2; std::find(names_.begin(), names_.end(), free) != names_.end(); ++i) {
    free = wanted + " " + std::to_string(i);
  }
  return free;
}

template <class T>
Data data_of(T value) {
  return Data{std::shared_ptr<const T>(std::make_shared<T>(std::move(value)))};
}

Image picture_of(const EnvironmentBackground& background) {
  Image image;
  image.width = background.width;
  image.height = background.height;
  image.pixels = background.pixels;
  return image;
}

Image picture_of(const DistortionMap& map) {
  Image image(map.width, map.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {map.st[2 * i], map.st[2 * i + 1], 0};
  }
  return image;
}

py::dict SceneValues::fit() const {
  const CameraFit& fit = loaded_.scene.fit;
  py::dict values = own_.of(fit);
  values["fit"] = true;
  if (fit.type == FittedCamera::orthographic) {
    for (const char* key : {"fov", "fov_axis"}) {
      if (values.contains(key)) values.attr("pop")(key);
    }
  }
  return values;
}

py::object SceneValues::camera() const {
  const Scene& scene = loaded_.scene;
  const bool is_plain = scene.fit == CameraFit{} && !scene.distortion;
  if (!scene.camera && is_plain) return py::none();
  py::dict values = scene.camera ? world_.of(*scene.camera) : fit();
  if (scene.camera) {
    if (const auto* lens = std::get_if<LensCamera>(&*scene.camera)) {
      values["file"] = data_of(lens->surfaces);
    }
  }
  if (scene.distortion) {
    py::dict distortion;
    distortion["file"] = data_of(picture_of(*scene.distortion));
    values["distortion"] = distortion;
  }
  return values;
}

py::dict SceneValues::background() const {
  py::dict values = own_.of(loaded_.scene.background);
  if (const auto* sky = std::get_if<EnvironmentBackground>(&loaded_.scene.background)) {
    values["file"] = data_of(picture_of(*sky));
  }
  return values;
}

py::list SceneValues::materials() const {
  py::list all;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    all.append(py::make_tuple(names_[i], own_.of(loaded_.scene.materials[i].material)));
  }
  return all;
}

py::list SceneValues::lights() const {
  py::list all;
  for (const Light& light : loaded_.scene.lights) {
    const LightFrame frame = std::visit([](const auto& one) { return one.relative_to; }, light);
    all.append(frame == LightFrame::camera ? own_.of(light) : world_.of(light));
  }
  return all;
}

py::list SceneValues::clips() const {
  py::list all;
  for (const Clip& clip : loaded_.scene.clips) all.append(world_.of(clip));
  return all;
}

template <class Arrays, class Primitive>
py::object SceneValues::many(std::vector<Primitive>&& primitives, const Vec3d& base) const {
  if (primitives.empty()) return py::none();
  Arrays arrays;
  arrays.base = base;
  arrays.materials = names_;
  arrays.has_colors = std::any_of(primitives.begin(), primitives.end(),
                                  [](const Primitive& one) { return one.material.has_color(); });
  PrimitiveKind<Primitive>::of(arrays) = std::move(primitives);
  return py::cast(data_of(std::move(arrays)));
}

py::list SceneValues::planes(const std::vector<Plane>& planes, const FieldValues& values) const {
  py::list all;
  for (const Plane& plane : planes) {
    py::dict one = values.of(plane);
    one["material"] = names_[plane.material.index()];
    if (plane.material.has_color()) one["color"] = hex_text(plane.material.color());
    all.append(one);
  }
  return all;
}

/// All objects but instances, of a scene or a group.
template <class Owner>
void SceneValues::add_objects(py::dict& to, Owner& owner, const Vec3d& origin,
                              const FieldValues& values) const {
  to["spheres"] = many<SphereArrays>(std::move(owner.spheres), origin);
  to["planes"] = planes(owner.planes, values);
  to["capsules"] = many<CapsuleArrays>(std::move(owner.capsules), origin);
}

py::list SceneValues::instances(const std::vector<Instance>& all, const Vec3d& origin) const {
  py::list list;
  for (const Instance& instance : all) {
    py::dict one = FieldValues(shown_origin(loaded_, instance, origin)).of(instance);
    one["group"] = loaded_.scene.groups[instance.group].name;
    if (instance.material) one["material"] = names_[*instance.material];
    list.append(one);
  }
  return list;
}

py::list SceneValues::groups() {
  py::list all;
  for (std::size_t i = 0; i < loaded_.scene.groups.size(); ++i) {
    Group& group = loaded_.scene.groups[i];
    const Vec3d origin = loaded_.origin_of(i);
    py::dict one;
    add_objects(one, group, origin, FieldValues(origin));
    one["instances"] = instances(group.instances, origin);
    all.append(py::make_tuple(group.name, one));
  }
  return all;
}

py::object SceneValues::origin() const {
  const Vec3d& o = loaded_.origin;
  if (o == Vec3d{}) return py::str("auto");
  return py::make_tuple(o.x, o.y, o.z);
}

py::dict SceneValues::all() {
  Scene& scene = loaded_.scene;
  py::dict values;
  values["image"] = own_.of(scene.image);
  values["render"] = own_.of(scene.render);
  values["camera"] = camera();
  values["background"] = background();
  values["ambient"] = to_python(scene.ambient);
  values["backdrop"] = scene.backdrop ? to_python(*scene.backdrop) : py::object(py::none());
  values["materials"] = materials();
  values["lights"] = lights();
  values["clips"] = clips();
  values["instances"] = instances(scene.instances, loaded_.origin);
  values["groups"] = groups();
  add_objects(values, scene, loaded_.origin, world_);
  values["origin"] = origin();
  values["notes"] = loaded_.notes;
  values["warnings"] = loaded_.warnings;
  values["legend"] = legend_svg(colors_of(loaded_.particles));
  return values;
}

}  // namespace

py::dict values_of(LoadedScene&& loaded) {
  if (loaded.scene.packed) {
    throw_error(Diagnostic::in_file(loaded.scene.packed->file,
                                    "is packed: its spheres cannot be taken apart, but render() "
                                    "and Tracer take the scene by its name"));
  }
  return SceneValues(std::move(loaded)).all();
}

}  // namespace boule::python
