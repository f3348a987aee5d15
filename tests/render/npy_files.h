#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"
#include "render/frame/traced_hit.h"

namespace boule::test {

/// A .npy file as numpy.save writes it: the header with this dict, padded to 64 bytes, and the
/// data.
inline std::string npy_file(std::string dict, const std::string& data, char version = 1) {
  const std::size_t before = version == 1 ? 10 : 12;
  while ((before + dict.size() + 1) % 64 != 0) dict += ' ';
  dict += '\n';
  std::string file("\x93NUMPY", 6);
  file += version;
  file += '\0';
  for (std::size_t i = 0; i < before - 8; ++i)
    file += static_cast<char>(dict.size() >> 8 * i & 255);
  return file + dict + data;
}

inline std::string npy_dict(const std::string& descr, const std::string& shape,
                            const std::string& order = "False") {
  return "{'descr': " + descr + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

/// The bytes of a plain value. The machines of the tests are little-endian.
template <class T>
void append_bytes(std::string& to, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof bytes);
  to.append(bytes, sizeof bytes);
}

/// A file of N x 4 numbers: the spheres' centres and radii.
inline std::string sphere_file(const std::vector<Sphere>& spheres) {
  std::string data;
  for (const Sphere& s : spheres) {
    for (const float x : {s.center.x, s.center.y, s.center.z, s.radius}) append_bytes(data, x);
  }
  return npy_file(npy_dict("'<f4'", "(" + std::to_string(spheres.size()) + ", 4)"), data);
}

/// A file of N x 8 float32: rays whose origins are floats.
inline std::string ray_rows(const std::vector<Ray>& rays) {
  std::string data;
  for (const Ray& ray : rays) {
    const Vec3f org = vec_cast<float>(ray.org);
    const auto tmin = static_cast<float>(ray.tmin), tmax = static_cast<float>(ray.tmax);
    for (const float x : {org.x, org.y, org.z, tmin}) append_bytes(data, x);
    for (const float x : {ray.dir.x, ray.dir.y, ray.dir.z, tmax}) append_bytes(data, x);
  }
  return data;
}
inline std::string ray_file(const std::vector<Ray>& rays) {
  return npy_file(npy_dict("'<f4'", "(" + std::to_string(rays.size()) + ", 8)"), ray_rows(rays));
}

/// A file of N x 8 float64, of any numbers: origin, tmin, direction, tmax.
using RayRow = std::array<double, 8>;
inline std::string ray_file64(const std::vector<RayRow>& rows) {
  std::string data;
  for (const RayRow& row : rows) {
    for (const double x : row) append_bytes(data, x);
  }
  return npy_file(npy_dict("'<f8'", "(" + std::to_string(rows.size()) + ", 8)"), data);
}

/// The bytes of the file of these hits. NumPy leaves room for a count of 21 digits.
inline std::string hit_dict(const std::string& descr, std::size_t count) {
  const std::string digits = std::to_string(count);
  return npy_dict(descr, "(" + digits + ",)") + std::string(21 - digits.size(), ' ');
}
inline std::string hit_file(const std::vector<TracedHit>& hits) {
  std::string data;
  for (const TracedHit& hit : hits) {
    append_bytes(data, hit.t);
    append_bytes(data, hit.id);
    for (const float x : {hit.normal.x, hit.normal.y, hit.normal.z}) append_bytes(data, x);
    append_bytes(data, hit.entering);
  }
  return npy_file(hit_dict("[('t', '<f8'), ('id', '<i4'), ('normal', '<f4', (3,)), "
                           "('entering', '|b1')]",
                           hits.size()),
                  data);
}
inline std::string met_file(const std::vector<std::uint8_t>& met) {
  return npy_file(hit_dict("'|u1'", met.size()), {met.begin(), met.end()});
}

}  // namespace boule::test
