#include "render/apps/job/options/shown_values.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

namespace boule {

double shown(float x) {
  const std::string text = fmt::format("{}", x);
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

Json shown(const Vec3f& v) { return {shown(v.x), shown(v.y), shown(v.z)}; }
Json shown(const Vec3f& point, const Vec3d& origin) {
  return {shown(point.x) + origin.x, shown(point.y) + origin.y, shown(point.z) + origin.z};
}
Json shown(const Color& c) { return {shown(c.r), shown(c.g), shown(c.b)}; }

}  // namespace boule
