#pragma once

#include <nlohmann/json.hpp>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"

namespace boule::cli {

using Json = nlohmann::ordered_json;

/// Values as `boule info` and pictures' headers show them.

/// The double that prints as short as the float does: 0.1, not 0.10000000149011612.
double shown(float x);
Json shown(const Vec3f& v);
Json shown(const Color& c);

/// Enumerators by their names in scene files.
const char* method_name(Method method);
const char* filter_name(PixelFilter filter);
const char* fov_axis_name(FovAxis axis);

}  // namespace boule::cli
