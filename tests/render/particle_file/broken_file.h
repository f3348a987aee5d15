#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "tests/render/particle_file/read_text.h"

namespace boule::test {

/// A file that is refused: the parameter of tests.
struct BrokenFile {
  const char* what;   ///< the test's name
  std::string bytes;  ///< of the file
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
  EXPECT_THAT(particle_error(name, file.bytes, file.options), testing::HasSubstr(file.error));
}

}  // namespace boule::test
