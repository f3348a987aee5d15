#include "scenes/write_spheres.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace boule {
namespace {

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

}  // namespace

int write_spheres(const std::vector<Sphere>& spheres, const char* path) {
  const std::string bytes = npy_file(spheres);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "error: cannot write '%s'\n", path);
  return 1;
}

}  // namespace boule
