#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/scene/scene.h"
#include "render/apps/job/options/shown_values.h"

namespace boule::cli {

/// Adds the fields of structs to a JSON object, each under its key, in the order of their list.
class FieldInfo {
 public:
  /// `json` must outlive it, and so must `scene`, which holds the materials and groups that are
  /// referred to. Points are counted from `origin`, and told as the scene file counts them.
  FieldInfo(Json& json, const Scene* scene = nullptr, const Vec3d& origin = {})
      : json_(json), scene_(scene), origin_(origin) {}

  /// Leaves out what stands in other files, but for the size of pictures, and optional fields
  /// without a value.
  template <HasFields T>
  void add(const T& value) {
    each_field(value, [this](const auto& field, const auto& member) {
      this->add(std::string(field.key), field.rule, member);
    });
  }

 private:
  template <class Rule, class T>
  void add(const std::string& key, const Rule&, const T& member) {
    json_[key] = shown(member);
  }
  template <class Rule, class T>
  void add(const std::string& key, const Rule& rule, const std::optional<T>& member) {
    if (member) add(key, rule, *member);
  }
  template <HasFields T>
  void add(const std::string&, const TypeRule&, const T& part) {
    add(part);
  }
  void add(const std::string& key, const PointRule&, const Vec3f& point) {
    json_[key] = shown(point, origin_);
  }
  void add(const std::string& key, const MaterialRule&, std::uint32_t index) {
    json_[key] = scene_->materials[index].name;
  }
  void add(const std::string& key, const MaterialRule& rule, MaterialRef material) {
    add(key, rule, material.index());
    if (material.has_color()) json_["color"] = shown(material.color());
  }
  void add(const std::string& key, const GroupRule&, std::uint32_t index) {
    json_[key] = scene_->groups[index].name;
  }
  template <class T>
  void add(const std::string&, const FileRule&, const std::vector<T>&) {}

  Json& json_;
  const Scene* scene_;
  Vec3d origin_;
};

/// The fields of one struct.
template <HasFields T>
Json fields_info(const T& value, const Scene* scene = nullptr, const Vec3d& origin = {}) {
  Json json = Json::object();
  FieldInfo(json, scene, origin).add(value);
  return json;
}

/// The `type` of one kind and its fields.
template <HasFields Kind>
Json kind_info(const Kind& kind, const Vec3d& origin = {}) {
  Json json = {{"type", fields<Kind>.type}};
  FieldInfo(json, nullptr, origin).add(kind);
  return json;
}

template <class... Kinds>
Json kind_info(const std::variant<Kinds...>& one_of, const Vec3d& origin = {}) {
  return std::visit([&](const auto& kind) { return kind_info(kind, origin); }, one_of);
}

}  // namespace boule::cli
