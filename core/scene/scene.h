#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/color.h"
#include "core/scene/background.h"
#include "core/scene/camera.h"
#include "core/scene/distortion.h"
#include "core/scene/field.h"
#include "core/scene/group.h"
#include "core/scene/light.h"
#include "core/scene/material.h"
#include "core/scene/primitive.h"

namespace boule {

inline constexpr int max_image_side = 65535;               ///< pixels
inline constexpr int max_count = 2147483647;               ///< of samples, of bounces
inline constexpr std::size_t max_primitives = 2147483647;  ///< ids are 31 bits

/// How a pixel is made of the samples around it: box: the mean over the pixel itself; tent: over
/// twice its width and height, weighted less and less away from its centre, to 0.
enum class PixelFilter { box, tent };
template <>
inline constexpr std::array<std::string_view, 2> names<PixelFilter>{"box", "tent"};

/// The picture a scene asks for; the command line may override it.
struct ImageSettings {
  int width = 1280;  ///< pixels, 1 .. 65535
  int height = 720;  ///< pixels, 1 .. 65535
  int spp = 1;       ///< samples per pixel, >= 1
  PixelFilter filter = PixelFilter::box;
};

template <>
inline constexpr auto fields<ImageSettings> =
    field_list("image",
               field("size", &ImageSettings::width, &ImageSettings::height,
                     WholeRule{.low = 1, .high = max_image_side}),
               field("spp", &ImageSettings::spp, WholeRule{.low = 1, .high = max_count}),
               field("filter", &ImageSettings::filter));

/// How light is followed: whitted: direct light, mirrors and glass; path: all of it, by chance.
enum class Method { whitted, path };
template <>
inline constexpr std::array<std::string_view, 2> names<Method>{"whitted", "path"};

/// How a scene asks to be rendered; the command line may override it.
struct RenderSettings {
  int max_depth = 5;  ///< bounces after the primary hit, >= 0
  Method method = Method::whitted;
};

/// In the order in which scene files and `boule info` name them.
template <>
inline constexpr auto fields<RenderSettings> = field_list(
    "render", field("method", &RenderSettings::method),
    field("max_depth", &RenderSettings::max_depth, WholeRule{.low = 0, .high = max_count}));

/// The first Problem of the settings: anything outside of what is said above.
std::optional<Problem> find_problem(const ImageSettings& image);
std::optional<Problem> find_problem(const RenderSettings& render);

struct NamedMaterial {
  std::string name;
  Material material;
};

template <>
inline constexpr auto fields<NamedMaterial> = field_list(
    "material", field("name", &NamedMaterial::name), field("material", &NamedMaterial::material));

/// Scene = Camera + Objects + Materials + Lights + Background (lecture "Scene"), as plain values.
/// Primitive ids: spheres in order, then those of the instances (visit_shown()), then planes
/// likewise.
struct Scene {
  ImageSettings image;
  RenderSettings render;
  std::optional<Camera> camera;             ///< none: framed on the objects
  std::optional<DistortionMap> distortion;  ///< of the camera's film
  Background background = ConstantBackground{};
  Color ambient;  ///< what every surface receives from everywhere
  std::vector<NamedMaterial> materials;
  std::vector<Light> lights;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Group> groups;  ///< what instances show; by itself a group shows nothing
  std::vector<Instance> instances;
};

template <>
inline constexpr auto fields<Scene> =
    field_list("scene", field("image", &Scene::image), field("render", &Scene::render),
               field("camera", &Scene::camera), field("camera.distortion", &Scene::distortion),
               field("background", &Scene::background),
               field("background.ambient", &Scene::ambient, rule::not_negative),
               field("material", &Scene::materials), field("light", &Scene::lights),
               field("sphere", &Scene::spheres), field("plane", &Scene::planes),
               field("group", &Scene::groups), field("instance", &Scene::instances));

/// The first thing wrong with a scene, its key a dotted path as in the scene file
/// ("camera.fov", "sphere[3].radius", "group.bunny.instance[0].scale"), or nothing. Whoever renders
/// a scene made in memory need not call it, Renderer, Tracer and prepare() do; the readers return
/// only scenes that pass. Takes any values; an enumerator that has no name counts as one that has.
/// Throws std::bad_alloc.
Status validate(const Scene& scene);

/// As validate(), for readers that have checked each sphere and plane when they read it, and given
/// it a material that there is: not once more, there may be millions. Their number is checked.
/// Instances they check by find_instance_problem().
Status validate_all_but_primitives(const Scene& scene);

/// Nothing, or a Diagnostic with this key that says which whole numbers would do: low to high, or
/// low and above where `high` is max_count. Throws std::bad_alloc.
Status check_range(const char* key, int value, int low, int high);

}  // namespace boule
