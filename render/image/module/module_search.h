#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/image/module/image_module.h"

namespace boule {

/// The folders in which the image module is looked for, given the folder of the running library or
/// program. These are that folder itself and, if it has the name of an installation's folder for
/// programs ("bin"), the library folder beside it, or if it has that of an installation's libraries
/// ("lib"), the folder "boule" in it. If it lies in the tree where it was built, all folders lie in
/// that tree.
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own);

/// A symbol of a module, which is loaded from the first of the folders for the running library or
/// program that has a file with this mark. The mark is read before any of its code runs. The
/// Diagnostic names the folders, or gives the system's error.
Result<void*> load_from_module(const std::string& module, std::string_view mark,
                               const char* symbol);

/// Debian's package that has the modules, but for those of MPI.
inline constexpr const char* modules_package = "boule-image-formats";

/// The table of a module, by a function of this name that returns it; an error if the module is of
/// another version.
template <class Table>
Result<const Table*> open_module(const std::string& module, std::string_view mark,
                                 const char* entry_point, std::uint32_t version) {
  const auto entry = load_from_module(module, mark, entry_point);
  if (!entry) return entry.error();
  const auto* const table = reinterpret_cast<const Table* (*)()>(entry.value())();
  if (table != nullptr && table->version == version) return table;
  return Diagnostic::of(module + ": made for another version of boule");
}

/// The table of the image module.
Result<const image_module::Table*> open_image_module();

}  // namespace boule
