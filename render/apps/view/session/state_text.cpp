#include "render/apps/view/session/state_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/version.h"
#include "core/math/geometry.h"
#include "core/scene/instances.h"
#include "render/apps/view/messages/camera_kinds.h"
#include "render/apps/view/messages/message_keys.h"
#include "render/apps/view/panes/difference.h"
#include "render/files/particles/colors/color_map.h"
#include "render/files/particles/particle_style.h"
#include "render/prepare/default_camera.h"

namespace boule::view {
namespace {

/// The double that is printed as short as the float.
double shown(float number) { return file_coordinate(number, 0); }

Json point(const Vec3f& p, const Vec3d& origin) {
  return {file_coordinate(p.x, origin.x), file_coordinate(p.y, origin.y),
          file_coordinate(p.z, origin.z)};
}

template <class Enum>
Json all_names() {
  Json all = Json::array();
  for (const std::string_view name : names<Enum>) all.push_back(name);
  return all;
}

Json epsilon(const std::optional<float>& length) {
  if (!length) return nullptr;
  if (*length == 0) return "none";
  return shown(*length);
}

// Values of the keys of cameras, and their rules.

Json value_json(const PointRule&, const Vec3f& p, const Vec3d& origin) { return point(p, origin); }
Json value_json(const DirectionRule&, const Vec3f& v, const Vec3d&) { return point(v, {}); }
Json value_json(const NumberRule&, float number, const Vec3d&) { return shown(number); }
Json value_json(const NumberRule&, const std::optional<float>& number, const Vec3d&) {
  return number ? Json(shown(*number)) : Json();
}
template <class Enum>
Json value_json(const TypeRule&, Enum value, const Vec3d&) {
  return name_of(value);
}

Json rule_json(const PointRule&, const Vec3f&) { return {{"kind", "point"}}; }
Json rule_json(const DirectionRule&, const Vec3f&) { return {{"kind", "direction"}}; }
template <class Number>
Json rule_json(const NumberRule& rule, const Number&) {
  const auto bound = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  const std::string_view unit = rule.unit;
  return {{"kind", "number"},
          {"low", bound(rule.low)},
          {"high", bound(rule.high)},
          {"unit", unit.substr(unit.starts_with(' ') ? 1 : 0)},
          {"optional", std::is_same_v<Number, std::optional<float>>}};
}
template <class Enum>
Json rule_json(const TypeRule&, Enum) {
  return {{"kind", "name"}, {"names", all_names<Enum>()}};
}

Json camera_json(const Camera& camera, const Vec3d& origin) {
  Json json = {{"type", names<Camera>[camera.index()]}};
  const auto add = [&](const auto& field, const auto& member) {
    json[std::string(field.key)] = value_json(field.rule, member, origin);
  };
  std::visit([&add](const auto& any) { each_key(any, add); }, camera);
  return json;
}

/// Each kind of camera: its projection, and the rules of its keys.
Json cameras_json() {
  Json cameras;
  each_kind([&cameras](const auto& camera) {
    using Kind = std::decay_t<decltype(camera)>;
    Json keys;
    each_key(camera, [&keys](const auto& field, const auto& member) {
      keys[std::string(field.key)] = rule_json(field.rule, member);
    });
    cameras[std::string(fields<Kind>.type)] = {{"projection", name_of(projection_of<Kind>())},
                                               {"keys", keys}};
  });
  return cameras;
}

Json settings_json(const ViewSettings& settings) {
  Json panes = Json::array();
  for (const PaneSettings& pane : settings.panes) {
    panes.push_back({{"order", name_of(pane.order)},
                     {"solver", name_of(pane.solver)},
                     {"method", name_of(pane.method)},
                     {"shadow_epsilon", epsilon(pane.shadow_epsilon)}});
  }
  return {{"panes", panes},
          {"difference", name_of(settings.difference)},
          {"size", {settings.width, settings.height}},
          {"spp", settings.spp},
          {"max_depth", settings.max_depth},
          {"exposure", shown(settings.exposure)},
          {"outline", shown(settings.outline)},
          {"fog", shown(settings.fog)},
          {"pace", settings.pace}};
}

Json scale_json(const ParticleColors::Scale& scale) {
  constexpr int stops = 16;
  Json colors = Json::array();
  for (int i = 0; i <= stops; ++i)
    colors.push_back(hex_text(scale.map.color(static_cast<double>(i) / stops)));
  return {{"kind", "scale"}, {"title", scale.by}, {"range", scale.range}, {"stops", colors}};
}

Json colors_json(const std::vector<ParticleFacts>& all) {
  for (const ParticleFacts& facts : all) {
    if (facts.colors.scale) return scale_json(*facts.colors.scale);
    if (facts.colors.species.empty()) continue;
    Json items = Json::array();
    for (const auto& species : facts.colors.species)
      items.push_back({{"name", species.name}, {"color", hex_text(species.color)}});
    return {{"kind", "list"}, {"title", "species"}, {"items", items}};
  }
  return nullptr;
}

Json particles_json(const ShownState& shown) {
  if (shown.loaded.particles.empty()) return nullptr;
  Json look = nullptr;
  if (shown.facts.kind == "particles") {
    const ParticleLook& wanted = shown.wish.look;
    look = {{"color", wanted.color},
            {"map", wanted.map},
            {"range", wanted.range ? Json(*wanted.range) : Json()},
            {"ghost", wanted.ghost},
            {"opacity", wanted.opacity ? Json(*wanted.opacity) : Json()},
            {"outline_by", wanted.outline_by}};
  }
  Json columns = Json::array();
  for (const NumberRange& column : shown.columns)
    columns.push_back({{"name", column.name}, {"low", column.low}, {"high", column.high}});
  return {{"look", look}, {"columns", columns}, {"colors", colors_json(shown.loaded.particles)}};
}

Json series_json(const ShownState& shown) {
  if (!shown.facts.frames) return nullptr;
  const FrameSpan& frames = *shown.facts.frames;
  const auto& all = shown.loaded.particles;
  const bool timed = !all.empty() && all.front().time.has_value();
  return {{"frame", shown.wish.frame},
          {"first", frames.first},
          {"last", frames.last},
          {"step", frames.step},
          {"time", timed ? Json(*all.front().time) : Json()}};
}

/// What the colours of a difference mean.
Json difference_json(Difference kind) {
  if (kind == Difference::none) return nullptr;
  const bool is_color = kind == Difference::color;
  Json stops = Json::array(), labels = {"0"};
  for (const SrgbColor color : false_colors) stops.push_back(hex_text(color));
  long value = 1;
  for (std::size_t i = 1; i < false_colors.size(); ++i) {
    labels.push_back(std::to_string(value) + (i + 1 == false_colors.size() ? "+" : ""));
    value *= is_color ? color_factor : ulp_factor;
  }
  Json json = {{"title", is_color ? "codes of 255 apart" : "floats between their t"},
               {"stops", stops},
               {"labels", labels},
               {"other", nullptr}};
  if (!is_color)
    json["other"] = {{"color", hex_text(other_primitive)}, {"label", "another primitive"}};
  return json;
}

Json choices_json() {
  return {{"orders", all_names<PixelOrder>()},
          {"solvers", all_names<Solver>()},
          {"methods", all_names<Method>()},
          {"shadow_epsilons", {nullptr, "none", 1e-6, 1e-4, 1e-3, 1e-2}},
          {"differences", all_names<Difference>()},
          {"camera_types", editable_cameras()},
          {"cameras", cameras_json()},
          {"formats", {"png"}},
          {"maps", all_names<NamedColorMap>()},
          {"colors", {"element"}},
          {"outline_rules", all_names<OutlineRule>()},
          {"paces", {0, 1000000, 300000, 100000, 30000}},
          {"max_size", {max_view_side, max_view_side}},
          {"max_spp", max_view_spp}};
}

/// Text of which every byte that is not UTF-8 became a question mark.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

SceneFigures figures_of(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  const PrimitiveCount count = count_primitives(scene);
  SceneFigures figures{.spheres = static_cast<std::size_t>(count.spheres),
                       .planes = static_cast<std::size_t>(count.planes),
                       .capsules = static_cast<std::size_t>(count.capsules),
                       .center = {}};
  const SphereBounds box = bounds_of(scene);
  if (!(box.low.x <= box.high.x)) return figures;
  figures.center = (box.low + box.high) * 0.5 + loaded.origin;
  figures.radius = length(box.high - box.low) / 2;
  return figures;
}

std::string state_text(const ShownState& shown) {
  const Scene& scene = shown.loaded.scene;
  const Vec3d& center = shown.figures.center;
  return text_of(
      {{"type", "state"},
       {"number", shown.wish.number},
       {"version", library_version()},
       {"scene",
        {{"path", shown.facts.path},
         {"kind", shown.facts.kind},
         {"spheres", shown.figures.spheres},
         {"planes", shown.figures.planes},
         {"capsules", shown.figures.capsules},
         {"lights", scene.lights.size()},
         {"notes", shown.notes}}},
       {"camera", camera_json(shown.wish.camera, shown.loaded.origin)},
       {"start",
        {{"camera", camera_json(shown.start.camera, shown.loaded.origin)},
         {"size", {shown.start.settings.width, shown.start.settings.height}}}},
       {"bounds", {{"center", {center.x, center.y, center.z}}, {"radius", shown.figures.radius}}},
       {"settings", settings_json(shown.wish.settings)},
       {"difference_colors", difference_json(shown.wish.settings.difference)},
       {"particles", particles_json(shown)},
       {"series", series_json(shown)},
       {"choices", choices_json()}});
}

std::string camera_text(std::uint32_t number, const Camera& camera, const Vec3d& origin) {
  return Json{{"type", "camera"}, {"number", number}, {"camera", camera_json(camera, origin)}}
      .dump();
}

std::string statistics_text(std::uint32_t number, PaneStage& stage,
                            const std::optional<DifferenceFigures>& difference) {
  Json panes = Json::array();
  for (std::size_t i = 0; i < stage.size(); ++i) {
    const LivePane& pane = stage.pane(i);
    const LivePane::Progress now = pane.progress();
    const auto pixels = static_cast<double>(pane.options().width) * pane.options().height;
    const double rate = now.seconds > 0 ? static_cast<double>(now.rays) / now.seconds / 1e6 : 0;
    panes.push_back({{"passes", now.passes},
                     {"samples", now.samples},
                     {"spp", static_cast<double>(now.samples) / pixels},
                     {"share", now.share},
                     {"mrays_per_s", rate},
                     {"seconds", now.seconds},
                     {"scale", stage.shape().scale},
                     {"done", stage.shape().kind == StageKind::rest && pane.done()}});
  }
  Json figures;
  if (difference) figures = {{"pixels", difference->pixels}, {"largest", difference->largest}};
  return text_of(
      {{"type", "statistics"}, {"number", number}, {"panes", panes}, {"difference", figures}});
}

std::string busy_text(const std::string& what) {
  return text_of({{"type", "busy"}, {"text", what.empty() ? Json() : Json(what)}});
}

std::string error_text(const std::string& about, const Diagnostic& error,
                       std::optional<std::uint32_t> id) {
  // An option of the command line has the name of the key.
  const std::string key = error.key.starts_with("--") ? error.key.substr(2) : error.key;
  Json json = {{"type", "error"},
               {"about", about},
               {"text", printable(error.message, 1000)},
               {"key", key.empty() ? Json() : Json(printable(key, 200))}};
  if (id) json["id"] = *id;
  return text_of(json);
}

std::string saving_text(std::uint32_t id, double share) {
  return text_of({{"type", "saving"}, {"id", id}, {"share", share}});
}

std::string saved_text(std::uint32_t id, const std::string& url, const std::string& name) {
  return text_of({{"type", "saved"}, {"id", id}, {"url", url}, {"name", name}});
}

std::string texts_text(std::uint32_t id, const std::string& camera, const std::string& command) {
  return text_of({{"type", "texts"},
                  {"id", id},
                  {"camera", camera},
                  {"command", command.empty() ? Json() : Json(command)}});
}

}  // namespace boule::view
