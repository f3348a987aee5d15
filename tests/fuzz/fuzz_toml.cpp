// Scenes in TOML: any bytes.
#include "tests/fuzz/fuzz_scene.h"

namespace {

/// Two spheres that a scene may ask for: float32, 2 x 4.
void write_spheres(const boule::fuzz::InputFolder& folder) {
  std::string bytes("\x93NUMPY\x01\x00\x76\x00", 10);
  bytes += "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }";
  bytes.resize(127, ' ');
  bytes += '\n';
  const float spheres[] = {0, 0, 0, 1, 3, 0, 0, 0.5F};
  bytes.append(reinterpret_cast<const char*>(spheres), sizeof spheres);
  folder.write("spheres.npy", reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const boule::fuzz::InputFolder folder;
  static const bool written = (write_spheres(folder), true);
  static_cast<void>(written);
  boule::fuzz::load_bytes(folder, "scene.toml", data, size, {});
  return 0;
}
