/// Writes the three things of scenes/lecture.toml, made of spheres, as .npy files for [[spheres]]:
/// float32 rows of centre and radius.
///
///   boule_lecture_objects bunny|teapot|table FILE.npy
///
/// Each stands on y = 0 around the origin and looks along z; the teapot's spout is at +x. A tube or
/// a rounded body is a row of spheres so close together that it looks smooth. Only + - * / and
/// roots, and turn_of() for angles: the bytes are the same on every machine.
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "core/math/geometry.h"
#include "core/math/similarity.h"
#include "core/scene/primitive.h"
#include "scenes/write_spheres.h"

namespace {

using namespace boule;

/// Spheres, one after the other.
class Shape {
 public:
  void add(const Vec3d& center, double radius) {
    spheres_.push_back({vec_cast<float>(center), static_cast<float>(radius)});
  }
  /// The same on both sides of the plane x = 0.
  void add_pair(const Vec3d& center, double radius) {
    add(center, radius);
    add({-center.x, center.y, center.z}, radius);
  }
  /// `count` spheres around the y axis, their centres `distance` from it at height y.
  void add_ring(double distance, double y, double radius, int count) {
    for (int i = 0; i < count; ++i) {
      const auto [c, s] = turn_of(360.0 * i / count);
      add({distance * c, y, distance * s}, radius);
    }
  }
  /// Along a cubic Bezier curve, the radius of the ends joined by a straight line.
  void add_tube(const Vec3d (&p)[4], double begin_radius, double end_radius, int count) {
    for (int i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / (count - 1), u = 1 - t;
      const Vec3d center =
          p[0] * (u * u * u) + p[1] * (3 * u * u * t) + p[2] * (3 * u * t * t) + p[3] * (t * t * t);
      add(center, begin_radius * u + end_radius * t);
    }
  }
  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }

 private:
  std::vector<Sphere> spheres_;
};

/// A bunny that sits on its haunches: few glass balls, so that each is a lens; where two overlap
/// they look grown together.
Shape make_bunny() {
  Shape bunny;
  bunny.add({0, 0.44, -0.30}, 0.44);         // haunches
  bunny.add({0, 0.50, 0.18}, 0.32);          // chest
  bunny.add({0, 1.00, 0.36}, 0.28);          // head
  bunny.add({0, 0.92, 0.58}, 0.14);          // muzzle
  bunny.add({0, 0.36, -0.82}, 0.15);         // tail
  bunny.add_pair({0.30, 0.15, 0.02}, 0.15);  // hind feet
  bunny.add_pair({0.15, 0.11, 0.44}, 0.11);  // forepaws
  const double ears[] = {0.075, 0.100, 0.115, 0.115, 0.100, 0.075, 0.050};
  Vec3d at{0.13, 1.30, 0.28};
  const Vec3d along = normalize(Vec3d{0.22, 1.0, -0.42});
  double last = 0;
  for (const double radius : ears) {
    if (last > 0) at = at + along * (0.56 * (last + radius));
    bunny.add_pair(at, radius);
    last = radius;
  }
  return bunny;
}

Shape make_teapot() {
  Shape teapot;
  teapot.add_ring(0.45, 0.06, 0.06, 500);   // foot
  teapot.add_ring(0.36, 0.56, 0.50, 1500);  // body: rounder than tall
  teapot.add_ring(0.30, 1.02, 0.055, 500);  // rim of the lid
  teapot.add({0, 0.66, 0}, 0.48);           // lid
  teapot.add({0, 1.24, 0}, 0.10);           // its knob
  teapot.add_ring(0.03, 1.15, 0.05, 200);
  teapot.add_tube({{0.70, 0.42, 0}, {1.20, 0.42, 0}, {1.05, 0.98, 0}, {1.42, 1.06, 0}}, 0.17, 0.075,
                  1500);
  teapot.add_tube({{-0.62, 0.92, 0}, {-1.45, 1.12, 0}, {-1.55, 0.30, 0}, {-0.74, 0.32, 0}}, 0.065,
                  0.065, 1500);
  return teapot;
}

/// A round table of balls: a top of close-packed ones in a rim, a leg, three feet.
Shape make_table() {
  Shape table;
  constexpr double radius = 0.07, pitch = 0.12, rim = 2.05, height = 1.6;  // so close: no holes
  const double row = pitch * std::sqrt(3.0) / 2;
  const double y = height - radius;
  const int rows = static_cast<int>(rim / row);
  for (int j = -rows; j <= rows; ++j) {
    const double shift = j % 2 == 0 ? 0 : pitch / 2;
    for (int i = -rows * 2; i <= rows * 2; ++i) {
      const Vec3d center{pitch * i + shift, y, row * j};
      if (std::sqrt(center.x * center.x + center.z * center.z) <= rim - 0.05)
        table.add(center, radius);
    }
  }
  table.add_ring(rim, y, 0.1, 1500);
  for (int i = 0; i < 900; ++i) {  // the leg, slimmest in the middle
    const double t = i / 899.0, waist = 2 * t - 1;
    table.add({0, 0.3 + t * (height - 0.6), 0}, 0.10 + 0.12 * waist * waist);
  }
  for (int foot = 0; foot < 3; ++foot) {
    const auto [c, s] = turn_of(90.0 + 120 * foot);
    table.add_tube({{0, 0.35, 0},
                    {0.5 * c, 0.45, 0.5 * s},
                    {0.8 * c, 0.10, 0.8 * s},
                    {1.15 * c, 0.09, 1.15 * s}},
                   0.14, 0.09, 700);
  }
  return table;
}

/// No spheres for a name that is none.
Shape make(std::string_view name) {
  if (name == "bunny") return make_bunny();
  if (name == "teapot") return make_teapot();
  if (name == "table") return make_table();
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const Shape shape = argc == 3 ? make(argv[1]) : Shape{};
  if (shape.spheres().empty()) {
    std::fputs("usage: boule_lecture_objects bunny|teapot|table FILE.npy\n", stderr);
    return 2;
  }
  return write_spheres(shape.spheres(), argv[2]);
}
