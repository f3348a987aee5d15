#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/scene/scene.h"

namespace boule::test {

/// A Scene as text with every field and every bit of its numbers: two scenes are the same where
/// their texts are, and a difference is readable.
class SceneDump {
 public:
  explicit SceneDump(const Scene& scene) { put(scene); }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void put(int value) { text_ += " " + std::to_string(value); }
  void put(std::uint32_t value) { text_ += " " + std::to_string(value); }
  void put(MaterialRef material) { put(material.bits()); }
  void put(float value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, " %a", static_cast<double>(value));
    text_ += buffer;
  }
  void put(const std::string& value) { text_ += " '" + value + "'"; }
  void put(const Vec3f& v) { put(v.x), put(v.y), put(v.z); }
  void put(const Color& c) { put(c.r), put(c.g), put(c.b); }
  void put(const Both<const int>& both) { put(both.first), put(both.second); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void put(Enum value) { put(static_cast<int>(value)); }

  /// A line for each field.
  template <HasFields T>
  void put(const T& value) {
    text_ += " " + std::string(fields<T>.type) + "\n";
    each_field(value, [this](const auto& field, const auto& member) {
      text_ += std::string(field.key) + ":";
      this->put(member);
      text_ += "\n";
    });
  }
  /// Packed spheres are told by their digest.
  void put(const std::shared_ptr<const PackedSpheres>& packed) {
    text_ += packed ? " " + std::to_string(packed->count) + " " + std::to_string(packed->digest)
                    : " none";
  }
  template <class T>
  void put(const std::optional<T>& value) {
    value ? put(*value) : static_cast<void>(text_ += " none");
  }
  template <class... Kinds>
  void put(const std::variant<Kinds...>& one_of) {
    std::visit([this](const auto& any) { this->put(any); }, one_of);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    text_ += " " + std::to_string(list.size());
    for (const T& one : list) put(one);
  }

  std::string text_;
};

inline std::string dump(const Scene& scene) { return SceneDump(scene).text(); }

}  // namespace boule::test
