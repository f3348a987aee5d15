#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"
#include "render/files/trace_file/row_file.h"

namespace boule {

/// Rays from a .npy file, read piece by piece. The file holds little-endian float32 or float64 in C
/// order, shape (N, 8): origin x y z, tmin, direction x y z, tmax; or (N, 10), with source and
/// inside behind them, as in Ray. Takes any numbers, NaN and infinity included, but for sources,
/// and N may be 0. Directions of float64 are rounded to the nearest float32; a number beyond its
/// range becomes infinite. Other numbers stay as they are.
class RayFile {
 public:
  /// Opens a regular file and checks that it holds such rays and nothing else. Takes any name. The
  /// error names the file and the expected form.
  static Result<RayFile> open(const std::string& path);

  /// The number of rays in the file.
  [[nodiscard]] std::uint64_t size() const { return rows_.rows(); }

  /// Measures the origins of rays from this point: it is subtracted in double.
  void count_from(const Vec3d& zero) { zero_ = zero; }
  /// Sources are no_primitive or below this number.
  void limit_sources(std::size_t ids) { ids_ = ids; }

  /// Reads the next rays.size() rays. An error if fewer are left, if a source is no id, or if this
  /// was moved away.
  Status read(std::span<Ray> rays);

  /// The number of rays read whose direction was lost by rounding: a finite number became infinite,
  /// or all became 0. Such rays miss everything.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  explicit RayFile(RowFile rows) : rows_(std::move(rows)) {}
  template <class Number>
  Result<Ray> decode(const unsigned char* row);
  Status read_source(double source, double inside, Ray& ray) const;

  RowFile rows_;
  Vec3d zero_;
  std::size_t ids_ = max_primitives;
  std::uint64_t read_ = 0;  ///< number of rays read before
  std::uint64_t lost_ = 0;
};

}  // namespace boule
