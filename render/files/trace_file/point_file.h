#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_header.h"

namespace boule {

/// Points from a .npy file, read piece by piece. The file holds little-endian float32 or float64 in
/// C order, shape (N, 3), and N may be 0. Takes any numbers.
class PointFile {
 public:
  /// Opens a regular file and checks that it holds such points and nothing else. Takes any name.
  /// The error names the file and the expected form.
  static Result<PointFile> open(const std::string& path);

  /// The number of points in the file.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Measures points from this one: it is subtracted in double.
  void count_from(const Vec3d& zero) { zero_ = zero; }

  /// Reads the next points.size() points. An error if fewer are left, or if this was moved away.
  Status read(std::span<Vec3d> points);

 private:
  PointFile(std::string path, InputFile file, const NpyHeader& header);

  std::string path_;
  InputFile file_;
  std::uint64_t size_;
  std::size_t width_;  ///< bytes of a number
  Vec3d zero_{};
  std::vector<unsigned char> rows_;  ///< of one read, as in the file
};

}  // namespace boule
