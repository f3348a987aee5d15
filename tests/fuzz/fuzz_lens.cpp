// Lens prescriptions of any bytes. One that is read is checked as the camera of a scene.
#include "render/files/scene_file/toml/lens_file.h"
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/input_budget.h"

namespace {

constexpr const char* scene =
    "schema = 1\n[camera]\ntype = \"lens\"\nfile = \"a.lens\"\neye = [0, 1, 5]\n"
    "look_at = [0, 0, 0]\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const boule::fuzz::InputBudget budget;
  using namespace boule;
  static const fuzz::InputFolder folder;
  const auto surfaces = read_lens(folder.write("a.lens", data, size));
  if (!surfaces) fuzz::require_good(surfaces.error());
  const std::string text = scene;
  fuzz::load_bytes(folder, "scene.toml", reinterpret_cast<const std::uint8_t*>(text.data()),
                   text.size(), {});
  return 0;
}
