/// Writes the spheres of a sphereflake (Haines, "A Proposal for Standard Graphics Environments",
/// 1987) as a .npy file for [[spheres]]: float32 rows of center and radius.
///
///   boule_sphereflake DEPTH FILE.npy     DEPTH 0 .. 6: (9^(DEPTH + 1) - 1) / 8 spheres
///
/// A sphere of radius 1 at the origin carries nine of a third of its size, six around its equator
/// and three above, each of those carries nine in turn. Only + - * and roots: the bytes are the
/// same on every machine.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/geometry.h"
#include "core/scene/primitive.h"

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

/// The 128 bytes of header that NumPy puts before float32 data of `rows` x 4 (format version 1.0).
std::string npy_header(std::size_t rows) {
  std::string dict =
      "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", 4), }";
  dict.resize(128 - 10 - 1, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(dict.size() + 1) + '\0' + dict +
         '\n';
}

void append_little_endian(float number, std::string& bytes) {
  const auto bits = std::bit_cast<std::uint32_t>(number);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

std::string npy_file(const std::vector<Sphere>& spheres) {
  std::string bytes = npy_header(spheres.size());
  for (const Sphere& s : spheres) {
    for (const float number : {s.center.x, s.center.y, s.center.z, s.radius}) {
      append_little_endian(number, bytes);
    }
  }
  return bytes;
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
  const std::string bytes = npy_file(spheres);
  std::ofstream file(argv[2], std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    std::fprintf(stderr, "error: cannot write '%s'\n", argv[2]);
    return 1;
  }
  return 0;
}
