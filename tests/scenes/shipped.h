#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace boule::test {

/// The folder of the scenes that come with Boule.
inline std::filesystem::path scenes_folder() { return BOULE_SCENES; }

/// The folder of the documents.
inline std::filesystem::path documents_folder() { return scenes_folder().parent_path() / "docs"; }

/// All bytes of a file; none if it cannot be read.
inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace boule::test
