// Spheres and rays in .npy files of any bytes. The first byte says how they are read.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "render/files/scene_file/npy/npy_reader.h"
#include "render/files/scene_file/scene_file.h"
#include "render/files/trace_file/ray_file.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/input_folder.h"

namespace {

using namespace boule;
using fuzz::require;

void read_spheres(const std::string& path, std::optional<float> radius) {
  const Sphere before{{1, 2, 3}, 4, 5};
  std::vector<Sphere> spheres{before};
  const Status read = append_spheres({path, radius, 7}, spheres);
  require(!spheres.empty() && spheres.front().radius == before.radius, "what was there stays");
  if (!read) {
    fuzz::require_good(read.error());
    require(spheres.size() == 1, "an error leaves the spheres as they were");
  }
  for (const Sphere& s : spheres) {
    const bool finite = std::isfinite(s.center.x) && std::isfinite(s.center.y) &&
                        std::isfinite(s.center.z) && std::isfinite(s.radius);
    require(finite && s.radius > 0, "a sphere that was read is one");
  }
}

void read_scene(const std::string& path) {
  const Result<LoadedScene> loaded = load_scene(path);
  if (!loaded) return fuzz::require_good(loaded.error());
  require(validate(loaded.value().scene).ok(), "a scene that was read is valid");
}

void read_rays(const std::string& path) {
  Result<RayFile> file = RayFile::open(path);
  if (!file) {
    fuzz::require_good(file.error());
    return;
  }
  std::vector<Ray> rays(64);
  for (std::uint64_t left = file.value().size(); left > 0;) {
    const std::size_t count = std::min<std::uint64_t>(left, rays.size());
    const Status read = file.value().read(std::span(rays).first(count));
    require(read.ok(), "a file has the rays that its size promises");
    left -= count;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputBudget budget;
  static const fuzz::InputFolder folder;
  if (size == 0) return 0;
  const std::string path = folder.write("data.npy", data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      read_spheres(path, std::nullopt);
      break;
    case 1:
      read_spheres(path, 0.25F);
      break;
    case 2:
      read_rays(path);
      break;
    default:
      read_scene(path);
      break;
  }
  return 0;
}
