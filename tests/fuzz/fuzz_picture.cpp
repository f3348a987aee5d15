// Pictures that scenes name, of any bytes. The first byte says which kind of picture is read. The
// target is what Boule makes of the sizes, windows, channels and numbers that OpenImageIO reports;
// a finding in OpenImageIO itself or in a library below shows in its stack.
#include <algorithm>

#include "render/image/finished_picture.h"
#include "tests/fuzz/fuzz_scene.h"
#include "tests/fuzz/input_budget.h"

namespace {

using namespace boule;
using fuzz::require;

/// A picture as a map, and as an environment.
void load_scenes(const fuzz::InputFolder& folder, const std::string& picture) {
  const std::string scenes[] = {
      "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n[camera.distortion]\nfile = \"" +
          picture + "\"\n",
      "schema = 1\n[background]\ntype = \"environment\"\nfile = \"" + picture + "\"\n"};
  for (const std::string& scene : scenes) {
    fuzz::load_bytes(folder, "scene.toml", reinterpret_cast<const std::uint8_t*>(scene.data()),
                     scene.size(), {});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputBudget budget;
  static const fuzz::InputFolder folder;
  constexpr const char* names[] = {"a.exr", "a.hdr", "a.png", "a.jpg",
                                   "a.tif", "a.ppm", "a.bmp", "a.tga"};
  if (size == 0) return 0;
  const std::string name = names[data[0] % std::size(names)];
  const std::string path = folder.write(name, data + 1, size - 1);
  load_scenes(folder, name);
  is_finished_picture(
      path, {4, 3, {}, {}});  // true for the corpus' pictures, so that its code is reached
  require(!is_finished_picture(path, {0, 0, {}, {}}), "no picture has no pixels");
  return 0;
}
