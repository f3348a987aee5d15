#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "core/scene/camera.h"

/// What clients are told of the kinds of camera, and may change of them: all from the lists of
/// fields.
namespace boule {
namespace view {

/// Where a camera's film shows a point, as far as its keys tell: in proportion to the tangent of
/// the angle from the direction of view, to that angle, or to the point's distance from that
/// direction.
enum class Projection { flat, angle, parallel, other };

template <class Kind>
constexpr Projection projection_of() {
  Projection found = Projection::other;
  each_field<Kind>([&found](const auto& field) {
    if (field.key == "height") found = Projection::parallel;
    if constexpr (requires { field.rule.high; }) {
      if (field.key == "fov") found = field.rule.high > 180 ? Projection::angle : Projection::flat;
    }
  });
  return found;
}

/// True of the kinds whose values come from a file of their own, as those of real lenses do.
template <class Struct>
inline constexpr bool has_file = std::apply(
    [](const auto&... field) { return (std::is_same_v<decltype(field.rule), FileRule> || ...); },
    fields<std::remove_const_t<Struct>>.list);

/// Calls visitor(field, member) for each key that clients may change, those of the pose among them.
/// With a file, numbers that must be there belong to it.
template <HasFields Struct, class Visitor>
void each_key(Struct& camera, const Visitor& visitor) {
  each_field(camera, [&visitor](const auto& field, auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (HasFields<Member>) {
      each_key(member, visitor);
    } else if constexpr (!has_file<Struct> || std::is_same_v<Member, std::optional<float>>) {
      visitor(field, member);
    }
  });
}

/// Calls visitor(camera) with a camera of each kind.
template <class Visitor>
void each_kind(const Visitor& visitor) {
  const auto visit = [&visitor]<class... Kinds>(const std::variant<Kinds...>&) {
    (visitor(Kinds{}), ...);
  };
  visit(Camera{});
}

}  // namespace view

template <>
inline constexpr std::array<std::string_view, 4> names<view::Projection>{"flat", "angle",
                                                                         "parallel", "other"};

}  // namespace boule
