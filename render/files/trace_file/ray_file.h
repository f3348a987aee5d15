#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "core/math/vec.h"
#include "render/files/file/input_file.h"

namespace boule {

/// Rays from a .npy file, read piece by piece. The file holds little-endian float32 or float64 in C
/// order, shape (N, 8): origin x y z, tmin, direction x y z, tmax. Takes any numbers, NaN and
/// infinity included, and N may be 0. Each float64 is rounded to the nearest float32, those of the
/// origin included; the hits are exact for the rounded rays. A number beyond the range of float32
/// becomes infinite.
class RayFile {
 public:
  /// Opens a regular file and checks that it holds such rays and nothing else. Takes any name. The
  /// error names the file and the expected form.
  static Result<RayFile> open(const std::string& path);

  /// The number of rays in the file.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Measures the origins of rays from this point: it is subtracted in double before they are
  /// rounded.
  void count_from(const Vec3d& zero) { zero_ = zero; }

  /// Reads the next rays.size() rays. An error if fewer are left, or if this was moved away.
  Status read(std::span<Ray> rays);

  /// The number of rays read whose origin or direction was lost by rounding: a finite number became
  /// infinite, or a direction became 0. Such rays miss everything.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  RayFile(std::string path, InputFile file, std::uint64_t size, bool is_double);

  std::string path_;
  InputFile file_;
  std::uint64_t size_;
  bool is_double_;
  Vec3d zero_;
  std::uint64_t lost_ = 0;
  std::vector<unsigned char> rows_;  ///< of one read, as in the file
};

}  // namespace boule
