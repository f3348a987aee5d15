#pragma once

#include <fstream>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "core/scene/camera.h"
#include "render/files/scene_file/scene_file.h"
#include "tests/scenes/shipped.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// A shipped lens with a film of that width, at the origin, looking along -z at what is 3 m away.
inline LensCamera shipped_lens(const std::string& name, const std::string& keys) {
  const TempDir dir;
  const std::string path = (dir.path() / "lens.toml").string();
  std::ofstream(path) << "schema = 1\n[camera]\ntype = 'lens'\neye = [0, 0, 0]\n"
                      << "look_at = [0, 0, -3]\nfile = '" << (scenes_folder() / name).string()
                      << "'\n"
                      << keys;
  const auto loaded = load_scene(path);
  if (!loaded) {
    ADD_FAILURE() << format_diagnostic(loaded.error());
    return {};
  }
  return std::get<LensCamera>(*loaded.value().scene.camera);
}
inline LensCamera double_gauss() {
  return shipped_lens("double_gauss_50mm.lens", "film_width = 20\n");
}
inline LensCamera stopped_down() {
  return shipped_lens("double_gauss_50mm.lens", "film_width = 20\nf_number = 8\n");
}
inline LensCamera wide_angle() { return shipped_lens("wide_angle_22mm.lens", "film_width = 30\n"); }

}  // namespace boule::test
