#include "render/apps/team/mpi_post.h"

#include <dlfcn.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "render/apps/team/mpi_module.h"
#include "render/image/module_search.h"

namespace boule {
namespace {

using mpi_module::Table;
namespace fs = std::filesystem;

class MpiPost : public Post {
 public:
  MpiPost(const Table& table, int rank, int size) : table_(table), rank_(rank), size_(size) {}

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }
  void send(int to, std::string_view bytes) override {
    table_.send(to, bytes.data(), bytes.size());
  }
  std::optional<Letter> receive() override {
    mpi_module::Letter letter{};
    if (!table_.receive(&letter)) return std::nullopt;
    return Letter{letter.from, std::string(letter.bytes, letter.count)};
  }
  bool idle() override { return table_.idle(); }
  void finish() override { table_.finish(); }
  void end_all(int code) override { table_.end_all(code); }

 private:
  const Table& table_;
  int rank_, size_;
};

bool has_mark(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return bytes.find(mpi_module::version_mark) != std::string::npos;
}

/// The file of the module; the error says where it was looked for.
Result<fs::path> find_module(const std::string& module) {
  std::string searched;
  for (const fs::path& folder : module_folders(own_module_folder())) {
    std::error_code ignored;
    if (fs::exists(folder / module, ignored)) return folder / module;
    searched += (searched.empty() ? "" : " nor in ") + folder.string();
  }
  return Diagnostic::of(module + " is not in " + searched);
}

}  // namespace

Result<std::unique_ptr<Post>> open_mpi_post(const std::string& module) {
  const auto file = find_module(module);
  if (!file) return file.error();
  const Diagnostic other =
      Diagnostic::of(file.value().string() + ": made for another version of boule");
  if (!has_mark(file.value())) return other;
  void* const handle = dlopen(file.value().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return Diagnostic::of(dlerror());
  using EntryPoint = const Table* (*)();
  const auto entry = reinterpret_cast<EntryPoint>(dlsym(handle, mpi_module::entry_point));
  const Table* const table = entry != nullptr ? entry() : nullptr;
  if (table == nullptr || table->version != mpi_module::version) return other;
  int rank = 0, size = 1;
  if (!table->start(&rank, &size)) return Diagnostic::of("MPI does not start");
  return std::unique_ptr<Post>(std::make_unique<MpiPost>(*table, rank, size));
}

}  // namespace boule
