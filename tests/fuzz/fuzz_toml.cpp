// Scenes in TOML: any bytes.
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/input_budget.h"
#include "tests/render/npy_files.h"

namespace {

/// A .npy file that a scene may name: two spheres, float32, 2 x 4.
void write_spheres(const boule::fuzz::InputFolder& folder) {
  const std::string bytes = boule::test::sphere_file({{{0, 0, 0}, 1}, {{3, 0, 0}, 0.5F}});
  folder.write("spheres.npy", reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const boule::fuzz::InputBudget budget;
  static const boule::fuzz::InputFolder folder;
  static const bool written = (write_spheres(folder), true);
  static_cast<void>(written);
  boule::fuzz::load_bytes(folder, "scene.toml", data, size, {});
  return 0;
}
