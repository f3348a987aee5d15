#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "render/files/scene_file/scene_file.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// A folder to write scene files into and to load them from.
class SceneFolder {
 public:
  /// Writes a file of that name; its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
    std::string path = (dir_.path() / name).string();
    write_bytes(path, bytes);
    return path;
  }
  /// Writes a scene and loads it.
  [[nodiscard]] Result<LoadedScene> load(const std::string& name, const std::string& bytes,
                                         const SceneFileOptions& options = {}) const {
    return load_scene(write(name, bytes), options);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (dir_.path() / name).string();
  }

 private:
  TempDir dir_;
};

/// A text that must be refused: where, under which key, and words of the message.
struct Refusal {
  const char* name;
  std::string text;
  int line, column;
  const char* key;
  std::string words;
};

inline std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.name;
}

/// Loads the text as a file of that name and compares the Diagnostic with what is expected.
inline void expect_refused(const Refusal& refusal, const std::string& file_name) {
  const SceneFolder files;
  const auto loaded = files.load(file_name, refusal.text);
  ASSERT_FALSE(loaded.ok()) << refusal.text;
  const Diagnostic& error = loaded.error();
  EXPECT_EQ(error.file, files.path(file_name));
  EXPECT_EQ(error.line, refusal.line) << error.message;
  EXPECT_EQ(error.column, refusal.column) << error.message;
  EXPECT_EQ(error.key, refusal.key) << error.message;
  EXPECT_THAT(error.message, testing::HasSubstr(refusal.words));
}

/// The test name of a Refusal.
inline std::string refusal_name(const testing::TestParamInfo<Refusal>& info) {
  return info.param.name;
}

}  // namespace boule::test
