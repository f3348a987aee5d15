#pragma once

#include <filesystem>
#include <vector>

#include "core/base/error.h"
#include "render/image/image_module.h"

namespace boule {

/// The folders in which the image module is looked for, given the folder of the running library or
/// program. These are that folder itself and, if it has the name of an installation's folder for
/// programs ("bin"), the library folder beside it, or if it has that of an installation's libraries
/// ("lib"), the folder "boule" in it. If it lies in the tree where it was built, all folders lie in
/// that tree.
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own);

/// The folder of the running library or program.
std::filesystem::path own_module_folder();

/// Loads the module from the first of these folders that has one of this version. The version is
/// read from the file before any of its code runs. The Diagnostic names the folders, or gives the
/// system's error.
Result<const image_module::Table*> open_image_module();

}  // namespace boule
