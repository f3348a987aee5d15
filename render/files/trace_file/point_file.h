#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/files/trace_file/row_file.h"

namespace boule {

/// Points from a .npy file, read piece by piece. The file holds little-endian float32 or float64 in
/// C order, shape (N, 3), and N may be 0. Takes any numbers.
class PointFile {
 public:
  /// Opens a regular file and checks that it holds such points and nothing else. Takes any name.
  /// The error names the file and the expected form.
  static Result<PointFile> open(const std::string& path);

  /// The number of points in the file.
  [[nodiscard]] std::uint64_t size() const { return rows_.rows(); }

  /// Measures points from this one: it is subtracted in double.
  void count_from(const Vec3d& zero) { zero_ = zero; }

  /// Reads the next points.size() points. An error if fewer are left, or if this was moved away.
  Status read(std::span<Vec3d> points);

 private:
  explicit PointFile(RowFile rows) : rows_(std::move(rows)) {}

  RowFile rows_;
  Vec3d zero_{};
};

}  // namespace boule
