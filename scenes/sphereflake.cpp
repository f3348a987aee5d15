/// Writes the spheres of a sphereflake (Haines, "A Proposal for Standard Graphics Environments",
/// 1987) as a .npy file for [[spheres]]: float32 rows of center and radius.
///
///   boule_sphereflake DEPTH FILE.npy     DEPTH 0 .. 6: (9^(DEPTH + 1) - 1) / 8 spheres
///
/// A sphere of radius 1 at the origin carries nine of a third of its size, six around its equator
/// and three above, each of those carries nine in turn. Only + - * and roots: the bytes are the
/// same on every machine.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/primitive.h"
#include "scenes/write_spheres.h"

namespace {

using namespace boule;

constexpr int deepest = 6;  // 597,871 spheres, 9.6 MB

/// Which way a sphere grows: `up` away from its parent, the others around it.
struct Frame {
  Vec3d side, front, up;
};

/// The frame of the child that lies at height `sine` above the equator of `parent`, at the angle
/// around it whose cosine and sine are (c, s).
Frame child_frame(const Frame& parent, double c, double s, double sine) {
  const Vec3d out = parent.side * c + parent.front * s;
  const Vec3d along = parent.front * c - parent.side * s;
  const Vec3d up = normalize(out * std::sqrt(1 - sine * sine) + parent.up * sine);
  return {along, normalize(cross(up, along)), up};
}

void grow(const Vec3d& center, double radius, const Frame& frame, int depth,
          std::vector<Sphere>& spheres) {
  spheres.push_back({vec_cast<float>(center), static_cast<float>(radius)});
  if (depth == 0) return;
  const double h = std::sqrt(3.0) / 2;  // the sine of 60 degrees
  const double equator[][2] = {{1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}, {-0.5, -h}, {0.5, -h}};
  const double above[][2] = {{h, 0.5}, {-h, 0.5}, {0, -1}};
  const auto grow_child = [&](const Frame& child) {
    grow(center + child.up * (radius * 4 / 3), radius / 3, child, depth - 1, spheres);
  };
  for (const auto& [c, s] : equator) grow_child(child_frame(frame, c, s, 0));
  for (const auto& [c, s] : above) grow_child(child_frame(frame, c, s, h));
}

/// DEPTH of the command line, or -1.
int parse_depth(std::string_view text) {
  int depth = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), depth);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && depth >= 0 && depth <= deepest ? depth : -1;
}

}  // namespace

int main(int argc, char** argv) {
  const int depth = argc == 3 ? parse_depth(argv[1]) : -1;
  if (depth < 0) {
    std::fputs("usage: boule_sphereflake DEPTH FILE.npy    (DEPTH 0 to 6)\n", stderr);
    return 2;
  }
  std::vector<Sphere> spheres;
  grow({0, 0, 0}, 1, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, depth, spheres);
  return write_spheres(spheres, argv[2]);
}
