#include "render/files/file/npy_rows.h"

namespace boule {

std::string npy_shape_text(const NpyHeader& header) {
  std::string text = "(";
  for (const std::uint64_t count : header.shape) {
    text += (text.size() > 1 ? ", " : "") + std::to_string(count);
  }
  return text + ")";
}

Status check_npy_elements(const NpyHeader& header) {
  if (!header.fields.empty()) {
    return Diagnostic::of("has named fields, expected rows of numbers");
  }
  if (header.descr != "<f4" && header.descr != "<f8") {
    return Diagnostic::of("holds " + quote(header.descr) +
                          ", expected '<f4' or '<f8' (little-endian float32 or float64)");
  }
  if (!header.fortran_order) return {};
  return Diagnostic::of("is in Fortran order, expected C order (row by row)");
}

Status check_npy_length(const NpyHeader& header, std::size_t row_bytes, std::uint64_t file_size) {
  const std::uint64_t rows = header.shape[0], present = file_size - header.size;
  if (present % row_bytes == 0 && present / row_bytes == rows) return {};
  return Diagnostic::of("declares " + std::to_string(rows) + " rows of " +
                        std::to_string(row_bytes) + " bytes, but holds " + std::to_string(present) +
                        " bytes of data");
}

namespace {

Status check_read(const Result<std::size_t>& got, std::size_t bytes) {
  if (!got) return got.error();
  if (got.value() < bytes) return Diagnostic::of("became shorter while it was read");
  return {};
}

}  // namespace

Status read_npy_rows(InputFile& file, unsigned char* rows, std::size_t bytes) {
  return check_read(file.read(rows, bytes), bytes);
}

Status read_npy_rows(const InputFile& file, std::uint64_t begin, unsigned char* rows,
                     std::size_t bytes) {
  return check_read(file.read_at(begin, rows, bytes), bytes);
}

}  // namespace boule
