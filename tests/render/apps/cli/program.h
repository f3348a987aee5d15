#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/file_bytes.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// Whether the line is told because something takes longer than two seconds: how far it is, or what
/// it waits for.
inline bool tells_of_time(const std::string& line) {
  return line.starts_with("boule: ") &&
         (line.find(" ...") != std::string::npos || line.find(" elapsed, ") != std::string::npos);
}

/// The lines but those, which anything may bring about on a slow machine.
inline std::string without_time(const std::string& text) {
  std::string rest;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (!tells_of_time(line)) rest += line;
    at = end;
  }
  return rest;
}

/// Runs the built program; `err` is without_time(), unless --progress asks for it.
inline ProgramRun boule_run(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& environment = {}) {
  ProgramRun run = run_program(BOULE_PROGRAM, {arguments, environment});
  const bool wanted = std::any_of(arguments.begin(), arguments.end(), [](const std::string& word) {
    return word.starts_with("--progress");
  });
  if (!wanted) run.err = without_time(run.err);
  return run;
}

/// A test with a folder of its own and small scenes in it.
class ProgramTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::string write(const std::string& name, const std::string& text) const {
    write_bytes(path(name), text);
    return path(name);
  }
  std::string read(const std::string& name) const { return read_bytes(path(name)); }
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
