#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/instances.h"
#include "render/files/packed/pack.h"
#include "render/files/packed/packed_file.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/case_random.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_scenes.h"

namespace boule::test {

/// All that is built at once.
inline constexpr std::uint64_t much_memory = std::uint64_t{1} << 30;
/// A thousand spheres at a time.
inline constexpr std::uint64_t little_memory = 64'000;

/// A test that packs scenes into a folder of its own.
class PackedTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Packs a scene; the size of the file, or 0 after a failure.
  std::uint64_t pack_to(const std::string& file, Scene scene, std::uint64_t memory = much_memory,
                        std::uint64_t chunk = packed_format::packed_spheres) const {
    expand_instances(scene);
    SpheresInMemory spheres(std::exchange(scene.spheres, {}));
    const auto packed = pack({std::move(scene),
                              {1, 2, 3},
                              spheres,
                              file,
                              {.memory = memory, .beside = {}, .chunk = chunk}});
    if (packed) return packed.value().bytes;
    ADD_FAILURE() << format_diagnostic(packed.error());
    return 0;
  }
  /// The scene of a file. If there is none, the test fails.
  static Scene scene_of(const std::string& file) {
    const auto opened = PackedFile::open(file);
    if (!opened) {
      ADD_FAILURE() << format_diagnostic(opened.error());
      return {};
    }
    auto scene = opened.value().scene();
    return scene ? std::move(scene).value() : Scene();
  }
  Scene packed(const Scene& scene, std::uint64_t memory = much_memory,
               std::uint64_t chunk = packed_format::packed_spheres) const {
    const std::string file = path("scene.boule");
    return pack_to(file, scene, memory, chunk) > 0 ? scene_of(file) : Scene();
  }

 private:
  TempDir folder_;
};

/// A cloud of spheres of four materials, some in colours of their own, over a floor.
inline Scene cloud(int spheres) {
  Scene scene = empty_scene(48, 36);
  scene.camera = pinhole({0, 0.5F, 4}, {0, 0, 0}, 50);
  scene.background = GradientBackground{};
  scene.lights = {PointLight{{3, 5, 4}, {0.7F, 0.7F, 0.6F}}};
  const std::uint32_t kinds[] = {add_material(scene, Matte{{0.7F, 0.3F, 0.2F}}),
                                 add_material(scene, Metal{}), add_material(scene, Glass{}),
                                 add_material(scene, Emissive{{2, 1.5F, 1}})};
  CaseRandom random(11);
  const double size = 1.5 / std::cbrt(spheres);
  for (int i = 0; i < spheres; ++i) {
    Sphere sphere{vec_cast<float>(random.direction() * random.uniform(0, 1.5)),
                  static_cast<float>(random.uniform(0.3, 1) * size),
                  kinds[i % 37 == 0 ? 3 : i % 3]};
    if (i % 3 == 0 && i % 37 != 0)
      sphere.material = MaterialRef::colored(kinds[0], {static_cast<std::uint8_t>(i), 128, 200});
    scene.spheres.push_back(sphere);
  }
  scene.planes = {{{0, -1.6F, 0}, {0, 1, 0}, kinds[0]}};
  return scene;
}

}  // namespace boule::test
