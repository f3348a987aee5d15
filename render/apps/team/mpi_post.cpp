#include "render/apps/team/mpi_post.h"

#include <utility>

#include "render/apps/team/mpi_module.h"
#include "render/image/module/module_search.h"

namespace boule {
namespace {

using mpi_module::Table;

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

}  // namespace

Result<std::unique_ptr<Post>> open_mpi_post(const std::string& module) {
  const auto table = open_module<Table>(module, mpi_module::version_mark, mpi_module::entry_point,
                                        mpi_module::version);
  if (!table) return table.error();
  int rank = 0, size = 1;
  if (!table.value()->start(&rank, &size)) return Diagnostic::of("MPI does not start");
  return std::unique_ptr<Post>(std::make_unique<MpiPost>(*table.value(), rank, size));
}

}  // namespace boule
