#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/math/color.h"
#include "core/math/geometry.h"
#include "core/scene/background.h"
#include "core/scene/camera.h"
#include "core/scene/camera_fit.h"
#include "core/scene/distortion.h"
#include "core/scene/field.h"
#include "core/scene/number_text.h"
#include "core/scene/primitive.h"

namespace boule {

class ProblemFinder;
struct ImageSettings;

/// Check the conditions on several fields together, for the types that have such conditions. They
/// are called only if every field by itself is valid.
void check_whole(ProblemFinder& finder, const CameraPose& pose);
void check_whole(ProblemFinder& finder, const CameraFit& fit);
void check_whole(ProblemFinder& finder, const LensSurface& surface);
void check_whole(ProblemFinder& finder, const LensCamera& camera);
void check_whole(ProblemFinder& finder, const DistortionMap& map);
void check_whole(ProblemFinder& finder, const EnvironmentBackground& background);
void check_whole(ProblemFinder& finder, const ImageSettings& image);
template <class T>
void check_whole(ProblemFinder&, const T&) {}

/// Keeps the first Problem of a struct of the scene, whose fields it checks in the order of their
/// list. All functions throw std::bad_alloc.
class ProblemFinder {
 public:
  /// Checks each field by its rule, then the whole.
  template <HasFields T>
  ProblemFinder& check(const T& value) {
    each_field(value, [this](const auto& field, const auto& member) {
      this->check(field.key, field.rule, member);
    });
    if (!problem_) check_whole(*this, value);
    return *this;
  }

  void check(std::string_view key, const NumberRule& rule, float value) {
    if (rule.allows(double{value})) return;
    report(key, "must be " + describe(rule) + ", is " + number_text(double{value}));
  }
  void check(std::string_view key, const NumberRule& rule, const Vec3f& v) {
    const bool allows =
        rule.allows(double{v.x}) && rule.allows(double{v.y}) && rule.allows(double{v.z});
    if (!allows) report(key, "must be " + describe(rule));
  }
  void check(std::string_view key, const NumberRule& rule, const Color& c) {
    for (const float component : {c.r, c.g, c.b}) check(key, rule, component);
  }
  void check(std::string_view key, const WholeRule& rule, int value) {
    if (rule.allows(value)) return;
    report(key, "must be " + describe(rule) + ", is " + std::to_string(value));
  }
  void check(std::string_view key, const WholeRule& rule, const Both<const int>& both) {
    check(key, rule, both.first);
    check(key, rule, both.second);
  }
  void check(std::string_view key, const DirectionRule&, const Vec3f& v) {
    check(key, rule::finite, v);
    if (v == Vec3f{}) report(key, "must not be the zero vector");
  }
  template <class Rule, class T>
  void check(std::string_view key, const Rule& rule, const std::optional<T>& value) {
    if (value) check(key, rule, *value);
  }
  template <HasFields T>
  void check(std::string_view, const TypeRule&, const T& part) {
    check(part);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void check(std::string_view, const TypeRule&, Enum) {}
  template <class Enum>
  requires std::is_enum_v<Enum>
  void check(std::string_view key, const TypeRule&, const std::vector<Enum>& some) {
    for (const Enum one : some)
      require(key, std::count(some.begin(), some.end(), one) == 1, "must have each name once");
  }
  void check(std::string_view, const TypeRule&, bool) {}
  /// validate() checks whether the scene has the material or group.
  void check(std::string_view, const MaterialRule&, std::uint32_t) {}
  void check(std::string_view, const MaterialRule&, MaterialRef) {}
  void check(std::string_view, const GroupRule&, std::uint32_t) {}
  /// Checked by check_whole().
  template <class T>
  void check(std::string_view, const FileRule&, const T&) {}

  /// Reports a Problem if a condition fails.
  void require(std::string_view key, bool holds, std::string message) {
    if (!holds) report(key, std::move(message));
  }

  [[nodiscard]] const std::optional<Problem>& problem() const { return problem_; }

 private:
  void report(std::string_view key, std::string message) {
    if (!problem_) problem_ = Problem{std::string(key), std::move(message)};
  }

  std::optional<Problem> problem_;
};

/// The first Problem of any struct of the scene.
template <HasFields T>
std::optional<Problem> first_problem(const T& value) {
  return ProblemFinder{}.check(value).problem();
}

}  // namespace boule
