#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>

#include "tests/render/files/particle_file/read_text.h"

namespace boule::test {

/// The bytes of a file. Millions of them are made when a test wants them: every start of the
/// program makes the parameters of all tests.
class FileBytes {
 public:
  FileBytes(const char* all) : begin_(all) {}
  FileBytes(std::string all) : begin_(std::move(all)) {}
  FileBytes(std::string begin, int times, std::string repeated, std::string end)
      : begin_(std::move(begin)),
        times_(times),
        repeated_(std::move(repeated)),
        end_(std::move(end)) {}

  std::string all() const {
    std::string bytes = begin_;
    for (int i = 0; i < times_; ++i) bytes += repeated_;
    return bytes + end_;
  }

 private:
  std::string begin_;
  int times_ = 0;
  std::string repeated_, end_;
};

/// A file that is refused: the parameter of tests.
struct BrokenFile {
  const char* what;  ///< the test's name
  FileBytes bytes;
  std::string error;  ///< a part of "LINE:COLUMN: MESSAGE (KEY)"
  ParticleFileOptions options{};
};

inline void PrintTo(const BrokenFile& file, std::ostream* out) { *out << file.what; }

inline std::string broken_name(const testing::TestParamInfo<BrokenFile>& test) {
  return test.param.what;
}

/// Reads all of the file's frames under a name with this ending, and expects the error.
inline void expect_refused(const BrokenFile& file, const std::string& ending) {
  const std::string name = "a." + ending;
  EXPECT_THAT(particle_error(name, file.bytes.all(), file.options), testing::HasSubstr(file.error));
}

}  // namespace boule::test
