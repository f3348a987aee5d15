#include "render/image/module/module_search.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

namespace boule {
namespace {

namespace fs = std::filesystem;

/// The folder of the shared library that holds this code, or of the program that does.
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

bool is_within(const fs::path& folder, const fs::path& tree) {
  return std::mismatch(tree.begin(), tree.end(), folder.begin(), folder.end()).first == tree.end();
}

/// The bytes of a file. (A stream iterator would throw if the file cannot be read.)
Result<std::string> contents_of(const fs::path& file) {
  errno = 0;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (failed) return Diagnostic::of(file.string() + ": " + failed.message());
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (in.read(bytes.data(), static_cast<std::streamsize>(size))) return bytes;
  const int code = errno != 0 ? errno : EIO;  // EIO: the file became shorter meanwhile
  return Diagnostic::of(file.string() + ": " + std::generic_category().message(code));
}

Diagnostic of_other_version(const std::string& file) {
  return Diagnostic::of(file + ": made for another version of boule");
}

Result<void*> load_symbol(const fs::path& file, std::string_view mark, const char* symbol) {
  const auto bytes = contents_of(file);
  if (!bytes) return bytes.error();
  if (bytes.value().find(mark) == std::string::npos) return of_other_version(file.string());
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return Diagnostic::of(dlerror());
  void* const found = dlsym(handle, symbol);
  if (found != nullptr) return found;
  dlclose(handle);
  return of_other_version(file.string());
}

}  // namespace

std::vector<fs::path> module_folders(const fs::path& own) {
  if (own.empty()) return {};
  std::error_code ignored;
  const fs::path installed = (own / BOULE_LIBRARY_FOLDER / "boule").lexically_normal();
  const fs::path tree = fs::canonical(BOULE_BUILD_TREE, ignored);
  std::vector<fs::path> folders = {own};
  // The shared library.
  if (own.filename() == BOULE_SHARED_FOLDER) folders.push_back(own / "boule");
  if (tree.empty() || !is_within(own, tree)) {
    // Beside another folder, say /tmp/mine, the library folder could be anybody's.
    if (own.filename() == BOULE_PROGRAM_FOLDER) folders.push_back(installed);
    return folders;
  }
  if (is_within(installed, tree)) folders.push_back(installed);
  folders.push_back(fs::canonical(BOULE_IMAGE_MODULE_FOLDER, ignored));
  return folders;
}

Result<void*> load_from_module(const std::string& module, std::string_view mark,
                               const char* symbol) {
  std::string searched;
  std::optional<Diagnostic> reason;
  for (const fs::path& folder : module_folders(own_folder())) {
    const fs::path file = folder / module;
    searched += (searched.empty() ? "" : " nor in ") + folder.string();
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    auto found = load_symbol(file, mark, symbol);
    if (found) return found;
    if (!reason) reason = found.error();
  }
  if (reason) return *reason;
  return Diagnostic::of(module + " is not in " + searched);
}

Result<const image_module::Table*> open_image_module() {
  using image_module::Table;
  auto table = open_module<Table>("boule_image_io.so", image_module::version_mark,
                                  image_module::entry_point, image_module::version);
  if (table) return table;
  return Diagnostic::of(table.error().message +
                        "; formats other than PNG and PPM need it, and OpenImageIO: Debian's "
                        "package " +
                        modules_package + " has both");
}

}  // namespace boule
