#include "render/scene_file/npy_rows.h"

#include <bit>

namespace boule {
namespace {

Diagnostic refusal(const std::string& message) { return {message, "", "", 0, 0}; }

/// `width` bytes, the lowest first.
std::uint64_t decode(const unsigned char* bytes, std::size_t width) {
  std::uint64_t bits = 0;
  for (std::size_t i = width; i-- > 0;) bits = bits << 8 | bytes[i];
  return bits;
}

}  // namespace

std::string npy_shape_text(const NpyHeader& header) {
  std::string text = "(";
  for (const std::uint64_t count : header.shape) {
    text += (text.size() > 1 ? ", " : "") + std::to_string(count);
  }
  return text + ")";
}

Status check_npy_order(const NpyHeader& header) {
  if (!header.fortran_order) return std::nullopt;
  return refusal("is in Fortran order, expected C order (row by row)");
}

Status check_npy_length(const NpyHeader& header, std::size_t row_bytes, std::uint64_t file_size) {
  const std::uint64_t rows = header.shape[0], present = file_size - header.size;
  if (present % row_bytes == 0 && present / row_bytes == rows) return std::nullopt;
  return refusal("declares " + std::to_string(rows) + " rows of " + std::to_string(row_bytes) +
                 " bytes, but holds " + std::to_string(present) + " bytes of data");
}

Status read_npy_rows(InputFile& file, unsigned char* rows, std::size_t bytes) {
  const auto got = file.read(rows, bytes);
  if (!got) return got.error();
  if (got.value() < bytes) return refusal("became shorter while it was read");
  return std::nullopt;
}

float npy_float32(const unsigned char* bytes) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(decode(bytes, 4)));
}

double npy_float64(const unsigned char* bytes) { return std::bit_cast<double>(decode(bytes, 8)); }

}  // namespace boule
