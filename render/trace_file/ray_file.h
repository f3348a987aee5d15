#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "render/scene_file/input_file.h"

namespace boule {

/// Rays from a .npy file, read piece by piece: little-endian float32, C order, N x 8: origin x y z,
/// tmin, direction x y z, tmax. Any numbers will do, NaN and Inf too, and N may be 0.
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

 private:
  RayFile(std::string path, InputFile file, std::uint64_t size);

  std::string path_;
  InputFile file_;
  std::uint64_t size_;
  std::vector<unsigned char> rows_;  ///< of one read, as in the file
};

}  // namespace boule
