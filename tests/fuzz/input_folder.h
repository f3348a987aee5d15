#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "tests/fuzz/require.h"
#include "tests/support/temp_dir.h"

namespace boule::fuzz {

/// A folder for files made of the fuzzer's bytes, removed when the program ends.
class InputFolder {
 public:
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    const std::string path = folder_.path() / name;
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    require(file.flush().good(), "a temporary file can be written");
    return path;
  }

 private:
  test::TempDir folder_;
};

}  // namespace boule::fuzz
