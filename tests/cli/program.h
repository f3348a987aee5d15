#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// Runs the built program.
inline ProgramRun boule_run(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& environment = {}) {
  return run_program(BOULE_PROGRAM, {arguments, environment});
}

/// A test with a folder of its own and small scenes in it.
class ProgramTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// Names in the folder, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// A sphere on a plane, lit, mirrored a little: every kind of ray in 32 x 18 pixels.
  std::string small_scene() const {
    return write("scene.toml", R"(schema = 1
[image]
size = [32, 18]
[camera]
eye = [0.0, 1.0, 5.0]
look_at = [0.0, 0.8, 0.0]
[background]
type = "constant"
color = [0.2, 0.3, 0.5]
[material.shiny]
type = "phong"
color = [0.8, 0.3, 0.1]
kd = 0.7
ks = 0.3
shininess = 20
transmission = 0.2
ior = 1.3
[[light]]
type = "point"
position = [3.0, 5.0, 4.0]
[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 1.0
material = "shiny"
[[plane]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 1.0, 0.0]
)");
  }

  /// Runs the program and checks what holds for every refusal: the exit code, one error in three
  /// lines at most, nothing new in the folder.
  ProgramRun refused_run(const std::vector<std::string>& arguments, int code,
                         const std::vector<std::string>& environment = {}) const {
    const auto before = files();
    ProgramRun run = boule_run(arguments, environment);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_THAT(run.out, testing::IsEmpty());
    EXPECT_THAT(run.err, testing::HasSubstr("error: "));
    EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 3) << run.err;
    EXPECT_EQ(files(), before);
    return run;
  }

 private:
  TempDir folder_;
};

}  // namespace boule::test
