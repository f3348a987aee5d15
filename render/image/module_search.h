#pragma once

#include <filesystem>
#include <vector>

#include "core/base/error.h"
#include "render/image/image_module.h"

namespace boule {

/// The folders in which the image module may lie, by the one that the running library or program is
/// in: this one, and the library folder of an installation around it if it is named as that of
/// programs is ("bin"); within the tree it was built
/// in, nothing but the folders of that tree.
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own);

/// Loads the module from the first of the running program's folders that has one of this version,
/// which is looked for in the file before anything of it runs. The Diagnostic says where it was
/// looked for, or what the system said.
Result<const image_module::Table*> open_image_module();

}  // namespace boule
