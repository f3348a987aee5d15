#include "render/image/image_loader.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "render/threads/threads.h"

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

/// What is loaded and runs; one for the process, as OpenImageIO is.
struct Loaded {
  std::mutex mutex;
  const Table* table = nullptr;
  bool has_pool = false;  ///< OpenImageIO's threads run
};
Loaded& loaded() {
  static Loaded one;
  return one;
}

/// The module's table, or null and the reasons, of all places.
const Table* open_somewhere(std::string& reason) {
  std::string places;
  for (const fs::path& folder : candidates()) {
    const fs::path file = folder / module_name;
    places += (places.empty() ? "" : ", ") + folder.string();
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    if (const Table* table = open_module(file, reason)) return table;
  }
  if (reason.empty()) reason = std::string(module_name) + " not found in " + places;
  return nullptr;
}

Diagnostic cannot_load(const std::string& reason) {
  return {"cannot load the image module: " + reason, {}, {}, 0, 0};
}

/// OpenImageIO's pool, which begins with as many threads as the hardware runs.
unsigned pool_threads(const Loaded& one) { return one.has_pool ? 0 : hardware_threads(); }

}  // namespace

Result<const Table*> load_image_module(const ImageFormat& format) {
  constexpr unsigned at_load = 4;  // log4cplus
  Loaded& one = loaded();
  const std::lock_guard lock(one.mutex);
  // Reading and writing TIFF starts the pool, however many threads are asked for.
  const bool takes_pool = format.writer == std::string_view("tiff");
  const unsigned threads =
      (one.table == nullptr ? at_load : 0) + (takes_pool ? pool_threads(one) : 0);
  if (threads > 0 && !can_start_threads(threads)) {
    return cannot_load(std::generic_category().message(EAGAIN));
  }
  if (one.table == nullptr) {
    std::string reason;
    one.table = open_somewhere(reason);
    if (one.table == nullptr) return cannot_load(reason);
  }
  one.has_pool = one.has_pool || takes_pool;
  return one.table;
}

int image_threads(int wanted) {
  constexpr int most = 256;
  const auto count = static_cast<unsigned>(std::clamp(wanted, 1, most));
  if (count == 1) return 1;
  Loaded& one = loaded();
  const std::lock_guard lock(one.mutex);
  // The pool is resized to `count`; OpenEXR has one of its own.
  if (!can_start_threads(std::max(count, pool_threads(one)) + count)) return 1;
  one.has_pool = true;
  return static_cast<int>(count);
}

}  // namespace boule
