#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_rows.h"

namespace boule {

/// Rows of numbers from a .npy file, read piece by piece: little-endian float32 or float64 in C
/// order. There may be 0 rows.
class RowFile {
 public:
  /// Opens a regular file of any name whose columns pass `check`, and checks that it holds such
  /// rows and nothing else. The error names the file.
  static Result<RowFile> open(const std::string& path,
                              const std::function<Status(const NpyHeader&)>& check);

  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  /// Bytes of a number.
  [[nodiscard]] std::size_t width() const { return width_; }

  /// Reads the next rows: visit(k, bytes) takes the k-th of them, and returns a Status. An error if
  /// fewer are left, or if this was moved away; it names the file.
  template <class Visit>
  Status read(std::size_t count, const Visit& visit) {
    const FloatEnvironment environment;
    if (const auto open = file_.read(nullptr, 0); !open) return open.error();  // it was moved away
    const std::size_t row_bytes = columns_ * width_;
    bytes_.resize(rows_per_read * row_bytes);
    for (std::size_t first = 0; first < count; first += rows_per_read) {
      const std::size_t some = std::min(rows_per_read, count - first);
      if (auto done = read_npy_rows(file_, bytes_.data(), some * row_bytes); !done)
        return in_file(done.error());
      for (std::size_t k = 0; k < some; ++k) {
        if (auto done = visit(first + k, bytes_.data() + k * row_bytes); !done)
          return in_file(done.error());
      }
    }
    return {};
  }

 private:
  static constexpr std::size_t rows_per_read = 4096;

  RowFile(std::string path, InputFile file, const NpyHeader& header);
  [[nodiscard]] Diagnostic in_file(Diagnostic error) const;

  std::string path_;
  InputFile file_;
  std::uint64_t rows_;
  std::size_t columns_, width_;
  std::vector<unsigned char> bytes_;  ///< of one read, as in the file
};

}  // namespace boule
