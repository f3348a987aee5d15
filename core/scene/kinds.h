#pragma once

#include "core/scene/primitive.h"

namespace boule {

/// The kinds of primitives. What holds some of each (Scene, Group, PrimitiveCount, ...) has a
/// member of the same name for a kind, which PrimitiveKind<P>::of() returns. The names are those of
/// scene files and of messages.
template <class Primitive>
struct PrimitiveKind;

template <>
struct PrimitiveKind<Sphere> {
  using Primitive = Sphere;
  static constexpr const char* name = "sphere";
  static constexpr const char* plural = "spheres";
  template <class Owner>
  static constexpr auto& of(Owner& owner) {
    return owner.spheres;
  }
};

template <>
struct PrimitiveKind<Plane> {
  using Primitive = Plane;
  static constexpr const char* name = "plane";
  static constexpr const char* plural = "planes";
  template <class Owner>
  static constexpr auto& of(Owner& owner) {
    return owner.planes;
  }
};

template <>
struct PrimitiveKind<Capsule> {
  using Primitive = Capsule;
  static constexpr const char* name = "capsule";
  static constexpr const char* plural = "capsules";
  template <class Owner>
  static constexpr auto& of(Owner& owner) {
    return owner.capsules;
  }
};

/// Calls `visit` with the PrimitiveKind of every kind but spheres, in the order of their ids.
/// Spheres, which may be many, are packed, shared and coloured in ways of their own.
template <class Visit>
constexpr void each_other_kind(const Visit& visit) {
  visit(PrimitiveKind<Plane>{});
  visit(PrimitiveKind<Capsule>{});
}

/// The same for all kinds: spheres come first.
template <class Visit>
constexpr void each_kind(const Visit& visit) {
  visit(PrimitiveKind<Sphere>{});
  each_other_kind(visit);
}

}  // namespace boule
