#pragma once

#include <string>
#include <vector>

#include "tests/render/apps/cli/program.h"

namespace boule::test {

/// Renders files of particles.
class ParticlesTest : public ProgramTest {
 protected:
  /// Two atoms of water in a cell, with a speed.
  std::string water() const {
    return write("water.xyz",
                 "3\nLattice=\"4 0 0 0 4 0 0 0 4\" Properties=species:S:1:pos:R:3:speed:R:1\n"
                 "O 1 1 1 0.5\nH 2 1 1 1.5\nH 1 2 1.2 2.5\n");
  }
  /// A trajectory that grows: four atoms in a square, twice as far apart in each frame.
  std::string growing(int frames) const {
    std::string text;
    double side = 1;
    for (int frame = 0; frame < frames; ++frame, side *= 2) {
      text += "4\nProperties=species:S:1:pos:R:3:heat:R:1\n";
      for (const char* corner : {"-1 -1", "-1 1", "1 -1", "1 1"}) {
        const double x = corner[0] == '-' ? -side : side;
        const double y = std::string(corner).ends_with("-1") ? -side : side;
        text += "C " + std::to_string(x) + " " + std::to_string(y) + " 0 " +
                std::to_string(x + 2 * y) + "\n";
      }
    }
    return write("growing.xyz", text);
  }
  ProgramRun render(const std::string& file, const std::string& picture,
                    std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments = {"render", file, "-o", path(picture), "--size", "40x30"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"--spp", "2"});
    ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  /// The scene of a file, in the test's folder.
  std::string scene_of(const std::string& file, std::vector<std::string> options) const {
    std::vector<std::string> arguments = {"scene", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return write("made.toml", run.out);
  }
};

}  // namespace boule::test
