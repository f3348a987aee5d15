#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "core/math/color.h"
#include "core/math/srgb.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule {

using Json = nlohmann::ordered_json;

/// Values as `boule info` and pictures' headers show them.

/// The double that is printed as short as the float: 0.1, not 0.10000000149011612.
double shown(float x);
Json shown(const Vec3f& v);
/// A point that is counted from `origin`, as it is counted from 0.
Json shown(const Vec3f& point, const Vec3d& origin);
Json shown(const Color& c);
inline Json shown(SrgbColor color) { return hex_text(color); }
inline Json shown(int number) { return number; }
inline Json shown(bool flag) { return flag; }
inline Json shown(const Both<const int>& both) { return {both.first, both.second}; }
inline Json shown(const std::string& name) { return name; }
/// An enumerator by its name.
template <class Enum>
requires std::is_enum_v<Enum> Json shown(Enum value) { return name_of(value); }
template <class Enum>
requires std::is_enum_v<Enum> Json shown(const std::vector<Enum>& some) {
  Json list = Json::array();
  for (const Enum one : some) list.push_back(name_of(one));
  return list;
}

}  // namespace boule
