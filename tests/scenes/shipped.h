#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/file_bytes.h"

namespace boule::test {

/// The folder of the scenes that come with Boule.
inline std::filesystem::path scenes_folder() { return BOULE_SCENES; }

/// The folder of the documents.
inline std::filesystem::path documents_folder() { return scenes_folder().parent_path() / "docs"; }

}  // namespace boule::test
