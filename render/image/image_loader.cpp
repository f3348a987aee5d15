#include "render/image/image_loader.h"

#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

namespace boule {
namespace {

using image_module::Table;
namespace fs = std::filesystem;

constexpr const char* module_name = "boule_image_io.so";

/// The folder of the shared library this code is in, or of the program if it is linked into it.
fs::path own_folder() {
  static const char anchor = 0;
  Dl_info info{};
  link_map* map = nullptr;
  std::error_code ignored;
  if (dladdr1(&anchor, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0 &&
      map != nullptr && *map->l_name != 0) {
    return fs::canonical(map->l_name, ignored).parent_path();
  }
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::vector<fs::path> candidates() {
  std::vector<fs::path> folders;
  if (const fs::path own = own_folder(); !own.empty()) {
    folders = {own, own.parent_path() / "lib" / "boule"};
  }
  folders.emplace_back(BOULE_IMAGE_MODULE_BUILD_DIR);
  folders.emplace_back(BOULE_IMAGE_MODULE_INSTALL_DIR);
  return folders;
}

/// The module's table, or null and the reason.
const Table* open_module(const fs::path& file, std::string& reason) {
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    reason = dlerror();
    return nullptr;
  }
  using EntryPoint = const Table* (*)();
  const auto entry = reinterpret_cast<EntryPoint>(dlsym(handle, image_module::entry_point));
  const Table* table = entry != nullptr ? entry() : nullptr;
  if (table != nullptr && table->version == image_module::version) return table;
  reason = file.string() + ": made for another version of boule";
  dlclose(handle);
  return nullptr;
}

}  // namespace

Result<const Table*> load_image_module() {
  static std::mutex mutex;
  static const Table* loaded = nullptr;
  const std::lock_guard lock(mutex);
  if (loaded != nullptr) return loaded;
  std::string places, reason;
  for (const fs::path& folder : candidates()) {
    const fs::path file = folder / module_name;
    places += (places.empty() ? "" : ", ") + folder.string();
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    loaded = open_module(file, reason);
    if (loaded != nullptr) return loaded;
  }
  if (reason.empty()) reason = std::string(module_name) + " not found in " + places;
  return Diagnostic{"cannot load the image module: " + reason, {}, {}, 0, 0};
}

}  // namespace boule
