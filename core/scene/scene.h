#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/math/color.h"
#include "core/scene/background.h"
#include "core/scene/camera.h"
#include "core/scene/camera_fit.h"
#include "core/scene/clip.h"
#include "core/scene/distortion.h"
#include "core/scene/field.h"
#include "core/scene/group.h"
#include "core/scene/light.h"
#include "core/scene/material.h"
#include "core/scene/outline_groups.h"
#include "core/scene/packed_spheres.h"
#include "core/scene/primitive.h"

namespace boule {

inline constexpr int max_image_side = 65535;               ///< pixels
inline constexpr int max_count = 2147483647;               ///< of samples, of bounces
inline constexpr std::size_t max_primitives = 2147483647;  ///< ids have 31 bits

namespace rule {
inline constexpr WholeRule image_side{.low = 1, .high = max_image_side};
inline constexpr WholeRule samples{.low = 1, .high = max_count};
inline constexpr NumberRule outline{.low = 0, .high = 100, .unit = " pixels"};
inline constexpr NumberRule fog{.low = 0, .high = 1};
inline constexpr WholeRule bounces{.low = 0, .high = max_count};
inline constexpr NumberRule noise{.low = 0, .high = 1};
inline constexpr NumberRule aa{.low = 0, .high = 255};
inline constexpr NumberRule weight{.low = 0, .high = 1};
inline constexpr WholeRule least_samples{.low = 16, .high = max_count};
}  // namespace rule

/// The filter that combines samples into a pixel. box: the mean over the pixel itself. tent: a mean
/// over twice its width and height, with weights that fall from the pixel's centre to 0 at the rim.
enum class PixelFilter { box, tent };
template <>
inline constexpr std::array<std::string_view, 2> names<PixelFilter>{"box", "tent"};

/// What can be drawn on a picture: what colours mean, a bar of a known length, the directions of x,
/// y and z, the time or the frame of a series.
enum class OverlayPart { legend, scale, axes, time };
template <>
inline constexpr std::array<std::string_view, 4> names<OverlayPart>{"legend", "scale", "axes",
                                                                    "time"};

/// Which of these, each once.
using OverlayParts = std::vector<OverlayPart>;

/// The picture a scene asks for; the command line may override it.
struct ImageSettings {
  int width = 1280;  ///< pixels, 1 .. 65535
  int height = 720;  ///< pixels, 1 .. 65535
  int spp = 1;       ///< samples per pixel, >= 1
  PixelFilter filter = PixelFilter::box;
  bool transparent = false;  ///< with alpha: the fraction of a pixel that objects cover
  float outline = 0;         ///< width of dark lines around objects, in pixels; 0: off
  OverlayParts overlay{};    ///< drawn on the finished picture
  /// The share of the backdrop in what is farthest, 0 .. 1, which grows from 0 at the depth
  /// `fog_from` to all at `fog_to`; 0: no fog. Depths are along the camera's view, in units of
  /// length; none: by the objects.
  float fog = 0;
  std::optional<float> fog_from{}, fog_to{};
};

template <>
inline constexpr auto fields<ImageSettings> = field_list(
    "image", field("size", &ImageSettings::width, &ImageSettings::height, rule::image_side),
    field("spp", &ImageSettings::spp, rule::samples), field("filter", &ImageSettings::filter),
    field("transparent", &ImageSettings::transparent),
    field("outline", &ImageSettings::outline, rule::outline),
    field("overlay", &ImageSettings::overlay), field("fog", &ImageSettings::fog, rule::fog),
    field("fog_from", &ImageSettings::fog_from, rule::not_negative),
    field("fog_to", &ImageSettings::fog_to, rule::not_negative));

/// The rendering method. whitted: direct light, mirrors and glass. path: all light, by path
/// tracing.
enum class Method { whitted, path };
template <>
inline constexpr std::array<std::string_view, 2> names<Method>{"whitted", "path"};

/// The render settings a scene asks for; the command line may override them.
struct RenderSettings {
  int max_depth = 5;  ///< bounces after the primary hit, >= 0
  Method method = Method::whitted;
  /// The half-width of the 95 % confidence interval at which a pixel stops, 0 .. 1, in displayed
  /// values; a pixel gets min_spp to image.spp samples. 0: all pixels get image.spp samples.
  float noise = 0;
  int min_spp = 32;  ///< >= 16
  /// Adaptive antialiasing: the step in codes of 0 .. 255 from pixel to pixel above which they get
  /// more than one sample, up to image.spp. 0: all pixels get image.spp samples.
  float aa = 0;
  /// Mirrored and refracted rays are left out whose weights in a sample add up to at most this,
  /// 0 .. 1. For method whitted.
  float least_weight = 0;
};

/// In the order in which scene files and `boule info` name them.
template <>
inline constexpr auto fields<RenderSettings> =
    field_list("render", field("method", &RenderSettings::method),
               field("max_depth", &RenderSettings::max_depth, rule::bounces),
               field("noise", &RenderSettings::noise, rule::noise),
               field("min_spp", &RenderSettings::min_spp, rule::least_samples),
               field("aa", &RenderSettings::aa, rule::aa),
               field("least_weight", &RenderSettings::least_weight, rule::weight));

/// The first Problem of the settings: a field against its rule.
std::optional<Problem> find_problem(const ImageSettings& image);
std::optional<Problem> find_problem(const RenderSettings& render);

struct NamedMaterial {
  std::string name{};
  Material material{};
};

template <>
inline constexpr auto fields<NamedMaterial> = field_list(
    "material", field("name", &NamedMaterial::name), field("material", &NamedMaterial::material));

/// Scene = Camera + Objects + Materials + Lights + Background (lecture "Scene"), as plain values.
/// Primitive ids: spheres in order, then those of the instances (visit_shown()), then planes
/// and capsules likewise. If there are packed spheres, they are the only ones.
struct Scene {
  ImageSettings image{};
  RenderSettings render{};
  std::optional<Camera> camera{};             ///< none: fitted to the objects
  CameraFit fit{};                            ///< the settings of the fitted camera
  std::optional<DistortionMap> distortion{};  ///< of the camera's film
  Background background = ConstantBackground{};
  Color ambient{};  ///< light that every surface receives from all directions
  /// The colour for camera rays that miss; none: the background. Mirrors, glass and paths always
  /// see the background.
  std::optional<Color> backdrop{};
  std::vector<NamedMaterial> materials{};
  std::vector<Light> lights{};
  std::vector<Sphere> spheres{};
  std::vector<Plane> planes{};
  std::vector<Capsule> capsules{};
  std::vector<Clip> clips{};
  std::vector<Group> groups{};  ///< shown by instances only
  std::vector<Instance> instances{};
  std::shared_ptr<const PackedSpheres> packed{};  ///< null: none
  OutlineGroups outline_groups{};                 ///< of the spheres and capsules above
};

template <>
inline constexpr auto fields<Scene> = field_list(
    "scene", field("image", &Scene::image), field("render", &Scene::render),
    field("camera", &Scene::camera), field("camera", &Scene::fit),
    field("camera.distortion", &Scene::distortion), field("background", &Scene::background),
    field("background.ambient", &Scene::ambient, rule::not_negative),
    field("background.backdrop", &Scene::backdrop, rule::not_negative),
    field("material", &Scene::materials), field("light", &Scene::lights),
    field("sphere", &Scene::spheres), field("plane", &Scene::planes),
    field("capsule", &Scene::capsules), field("clip", &Scene::clips),
    field("group", &Scene::groups), field("instance", &Scene::instances),
    field("packed", &Scene::packed), field("outline_groups", &Scene::outline_groups));

/// The first Problem of a scene, or std::nullopt. The Diagnostic's key is a dotted path as in scene
/// files ("camera.fov", "sphere[3].radius", "group.bunny.instance[0].scale"). Renderer, Tracer and
/// prepare() call it, and the readers return only scenes that pass. Takes any values; an unknown
/// enumerator is accepted and acts as a known one. Throws std::bad_alloc.
Status validate(const Scene& scene);

/// As validate(), but of the primitives and instances it checks only the number of primitives. For
/// readers, which check each primitive as they read it (there may be millions) and call
/// find_instance_problem() for the instances.
Status validate_all_but_primitives(const Scene& scene);

/// std::nullopt, or a Diagnostic with this key that gives the allowed whole numbers (WholeRule).
/// Throws std::bad_alloc.
Status check_range(const char* key, int value, const WholeRule& rule);

}  // namespace boule
