#pragma once

#include <string>
#include <vector>

#include "tests/render/apps/cli/program.h"

namespace boule::test {

/// Tests of runs that are interrupted, shared out and put together.
class PartTest : public ProgramTest {
 protected:
  /// With everything that a film holds: alpha, lines, channels.
  std::vector<std::string> options(const std::string& spp = "20") const {
    return {"--size",      "97x61",     "--spp", spp,        "--aov", "depth,id",
            "-q",          "--outline", "1.5",   "--method", "path",  "--seed",
            "3",           "--tile",    "16",    "--filter", "tent",  "--background",
            "transparent", "--fog",     "0.4"};
  }
  /// `render` with those options and more, into a file of the folder.
  std::vector<std::string> render(const std::string& output,
                                  const std::vector<std::string>& more = {},
                                  const std::string& spp = "20") const {
    std::vector<std::string> words = {"render", small_scene(), "-o", path(output)};
    for (const auto& list : {options(spp), more})
      words.insert(words.end(), list.begin(), list.end());
    return words;
  }
  /// `render` of a picture whose noise is asked for, with everything that its film holds.
  std::vector<std::string> render_noise(const std::string& output,
                                        const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"render",
                                      small_scene(),
                                      "-o",
                                      path(output),
                                      "--size",
                                      "97x61",
                                      "--noise",
                                      "0.1",
                                      "--min-spp",
                                      "16",
                                      "--spp",
                                      "64",
                                      "--outline",
                                      "1",
                                      "--aov",
                                      "id,noise,samples",
                                      "--method",
                                      "path",
                                      "--background",
                                      "transparent",
                                      "--tile",
                                      "16",
                                      "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// `render` of particles with bonds, in the edges of their cell: cut, with ghosts, in fog.
  std::vector<std::string> render_bonds(const std::string& output,
                                        const std::vector<std::string>& more = {}) const {
    std::string text = "60\nLattice=\"6 0 0 0 6 0 0 0 6\" Properties=species:S:1:pos:R:3\n";
    for (int i = 0; i < 60; ++i) {
      text += i % 3 == 0 ? "O" : "C";
      for (const int step : {7, 11, 17}) text += " " + std::to_string(i * step % 60 / 10.0);
      text += "\n";
    }
    std::vector<std::string> words = {"render",       write("bonds.xyz", text),
                                      "-o",           path(output),
                                      "--size",       "97x61",
                                      "--spp",        "3",
                                      "--tile",       "16",
                                      "--aov",        "id",
                                      "--style",      "balls-and-sticks",
                                      "--bonds",      "2",
                                      "--cell-edges", "-q",
                                      "--clip",       "x<4",
                                      "--ghost",      "species == 'O'",
                                      "--fog",        "0.5",
                                      "--outline",    "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// The bytes of the picture of one run without interruption.
  std::string whole_picture(const std::string& spp = "20") const {
    const ProgramRun run = boule_run(render("whole.exr", {}, spp));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("whole.exr");
  }
};

}  // namespace boule::test
