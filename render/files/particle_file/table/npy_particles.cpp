#include <memory>
#include <utility>

#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/table/binary_table.h"
#include "render/files/particle_file/table/npy_columns.h"

namespace boule {
namespace {

class NpyReader : public ParticleReader {
 public:
  NpyReader(MappedText bytes, std::size_t header_bytes, BinaryTable table,
            ParticleFileOptions options)
      : bytes_(std::move(bytes)),
        header_bytes_(header_bytes),
        table_(std::move(table)),
        options_(std::move(options)) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }

  Result<ParticleFrame> read(std::size_t, const ParallelFor& parallel_for) override {
    return read_binary_table(table_, bytes_.text().data() + header_bytes_, options_, parallel_for);
  }

 private:
  MappedText bytes_;
  std::size_t header_bytes_;
  BinaryTable table_;
  ParticleFileOptions options_;
};

Result<std::unique_ptr<ParticleReader>> open_npy(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  const auto header = parse_npy_header(bytes.text());
  if (!header) return header.error();
  auto table = npy_table(header.value(), options.columns);
  if (!table) return table.error();
  if (auto done = check_npy_length(header.value(), table.value().row_bytes, bytes.text().size());
      !done) {
    return done.error();
  }
  if (auto done = check_binary_columns(table.value()); !done) return done.error();
  const auto header_bytes = static_cast<std::size_t>(header.value().size);
  return std::unique_ptr<ParticleReader>(std::make_unique<NpyReader>(
      std::move(bytes), header_bytes, std::move(table).value(), options));
}

bool starts_like_npy(std::string_view start) { return start.starts_with("\x93NUMPY"); }

}  // namespace

const ParticleFormat npy_format{
    .name = "npy", .endings = {"npz"}, .starts_like = starts_like_npy, .open = open_npy};

}  // namespace boule
