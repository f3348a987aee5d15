#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/scene/primitive.h"

namespace boule {

/// The points of a primitive, which are counted from an origin.
template <class Primitive>
requires std::same_as<std::remove_const_t<Primitive>, Sphere>
constexpr auto points_of(Primitive& sphere) { return std::array{&sphere.center}; }
template <class Primitive>
requires std::same_as<std::remove_const_t<Primitive>, Capsule>
constexpr auto points_of(Primitive& capsule) { return std::array{&capsule.a, &capsule.b}; }

/// How many there are.
template <class Primitive>
inline constexpr std::size_t point_count =
    std::tuple_size_v<decltype(points_of(std::declval<Primitive&>()))>;

/// True if a capsule by itself has no Problem: as is_valid() of a sphere.
inline bool is_valid(const Capsule& capsule) {
  const auto& [a, b, radius, material] = capsule;
  return is_valid(Sphere{a, radius, material}) && is_valid(Sphere{b, radius, material});
}

}  // namespace boule
