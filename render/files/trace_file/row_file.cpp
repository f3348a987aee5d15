#include "render/files/trace_file/row_file.h"

#include <utility>

namespace boule {
namespace {

std::size_t number_bytes(const NpyHeader& header) {
  return npy_is_double(header) ? sizeof(double) : sizeof(float);
}

/// An error unless the file has exactly the length that it declares.
Status check_layout(const NpyHeader& header, std::uint64_t file_size,
                    const std::function<Status(const NpyHeader&)>& check) {
  if (auto done = check_npy_elements(header); !done) return done;
  if (auto done = check(header); !done) return done;
  return check_npy_length(header, header.shape[1] * number_bytes(header), file_size);
}

}  // namespace

RowFile::RowFile(std::string path, InputFile file, const NpyHeader& header)
    : path_(std::move(path)),
      file_(std::move(file)),
      rows_(header.shape[0]),
      columns_(header.shape[1]),
      width_(number_bytes(header)) {}

Diagnostic RowFile::in_file(Diagnostic error) const {
  error.file = path_;
  return error;
}

Result<RowFile> RowFile::open(const std::string& path,
                              const std::function<Status(const NpyHeader&)>& check) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  Status right =
      header ? check_layout(header.value(), file.value().size(), check) : Status(header.error());
  if (!right) {
    Diagnostic error = right.error();
    error.file = path;
    return error;
  }
  return RowFile(path, std::move(file).value(), header.value());
}

}  // namespace boule
