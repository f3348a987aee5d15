#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "render/scene_file/input_file.h"

namespace boule {

/// Rays from a .npy file, read piece by piece: little-endian float32 or float64, C order, N x 8:
/// origin x y z, tmin, direction x y z, tmax. Any numbers will do, NaN and Inf too, and N may be 0.
/// Of float64 every number is rounded to the nearest float32 once, the origin too: hits are exact
/// for the rays that come of it. What is too large for a float32 becomes infinite.
class RayFile {
 public:
  /// Opens a regular file, of any name, and checks that it holds such rays and nothing else; the
  /// error names the file and says what was expected.
  static Result<RayFile> open(const std::string& path);

  /// The number of rays in the file.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Reads the next rays.size() rays; an error if there are not so many left, and of a file that
  /// was moved away. Throws std::bad_alloc.
  Status read(std::span<Ray> rays);

  /// How many of the rays that were read have an origin or direction that rounding took away: a
  /// finite number became infinite, or all of a direction 0. They meet nothing.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  RayFile(std::string path, InputFile file, std::uint64_t size, bool is_double);

  std::string path_;
  InputFile file_;
  std::uint64_t size_;
  bool is_double_;
  std::uint64_t lost_ = 0;
  std::vector<unsigned char> rows_;  ///< of one read, as in the file
};

}  // namespace boule
