#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "tests/render/apps/cli/program.h"
#include "tests/render/npy_files.h"
#include "tests/render/ray_clouds.h"

namespace boule::test {

using Arguments = std::vector<std::string>;

/// All digits of a double.
inline std::string text_of(double x) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", x);
  return digits;
}

/// A test of `boule trace`, with a folder and scenes of its own.
class Trace : public ProgramTest {
 protected:
  /// Spheres of a .npy file, and two planes; no camera, no light.
  std::string cloud_scene(int spheres) const {
    write("cloud.npy", sphere_file(sphere_cloud(spheres)));
    return write("cloud.toml",
                 "schema = 1\n[[plane]]\npoint = [0, -9, 0]\nnormal = [0, 2, 0]\n"
                 "[[spheres]]\nfile = \"cloud.npy\"\n"
                 "[[plane]]\npoint = [0, 0, -12]\nnormal = [0.25, 0, -1]\n");
  }
  static Scene cloud(int spheres) {
    return objects(sphere_cloud(spheres), {{{0, -9, 0}, {0, 2, 0}}, {{0, 0, -12}, {0.25f, 0, -1}}});
  }

  /// Traces "r.npy" against the scene to "h.npy", with these options.
  ProgramRun trace(const std::string& scene, const Arguments& options) const {
    Arguments arguments = {"trace", scene, "--rays", path("r.npy"), "-o", path("h.npy")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return boule_run(arguments);
  }
  /// The bytes of the hits of a run that must succeed in silence.
  std::string hits(const std::string& scene, const Arguments& options = {}) const {
    Arguments all = {"-q"};
    all.insert(all.end(), options.begin(), options.end());
    const ProgramRun run = trace(scene, all);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, testing::IsEmpty());
    EXPECT_THAT(run.err, testing::IsEmpty());
    return read("h.npy");
  }
};

}  // namespace boule::test
