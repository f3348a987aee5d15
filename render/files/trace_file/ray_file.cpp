#include "render/files/trace_file/ray_file.h"

#include <cmath>
#include <utility>

#include "core/scene/number_text.h"
#include "render/files/file/float32.h"

namespace boule {
namespace {

constexpr std::size_t columns = 8, columns_with_source = 10;

Status check_ray_columns(const NpyHeader& header) {
  if (header.shape.size() == 2 &&
      (header.shape[1] == columns || header.shape[1] == columns_with_source)) {
    return {};
  }
  return Diagnostic::of("has shape " + npy_shape_text(header) +
                        ", expected (N, 8): origin, tmin, direction, tmax; or (N, 10): source "
                        "and inside, too");
}

}  // namespace

/// The ray of one row. Adds 1 to lost_ if rounding took its direction away.
template <class Number>
Result<Ray> RayFile::decode(const unsigned char* row) {
  const auto number = [row](std::size_t i) {
    return double{npy_number<Number>(row + i * sizeof(Number))};
  };
  const Vec3d dir{number(4), number(5), number(6)};
  Ray ray{Vec3d{number(0), number(1), number(2)} - zero_,
          {float32_or_inf(dir.x), float32_or_inf(dir.y), float32_or_inf(dir.z)}};
  ray.tmin = number(3);
  ray.tmax = number(7);
  const auto overflows = [](double exact, float rounded) {
    return std::isfinite(exact) && !std::isfinite(rounded);
  };
  const bool too_large =
      overflows(dir.x, ray.dir.x) || overflows(dir.y, ray.dir.y) || overflows(dir.z, ray.dir.z);
  const bool vanishes = ray.dir == Vec3f{0, 0, 0} && dir != Vec3d{0, 0, 0};
  lost_ += too_large || vanishes ? 1 : 0;
  if (rows_.columns() == columns) return ray;
  if (auto done = read_source(number(8), number(9), ray); !done) return done.error();
  return ray;
}

Status RayFile::read_source(double source, double inside, Ray& ray) const {
  const bool is_id = source >= -1 && source < static_cast<double>(ids_);
  if (!is_id || source != std::floor(source)) {
    return Diagnostic::about("source", "row " + std::to_string(read_) +
                                           ": must be -1 or an id below " + std::to_string(ids_) +
                                           ", is " + number_text(source));
  }
  if (inside != 0 && inside != 1) {
    return Diagnostic::about(
        "inside", "row " + std::to_string(read_) + ": must be 0 or 1, is " + number_text(inside));
  }
  ray.source = static_cast<std::int32_t>(source);
  ray.inside = inside != 0;
  return {};
}

Result<RayFile> RayFile::open(const std::string& path) {
  auto rows = RowFile::open(path, check_ray_columns);
  if (!rows) return rows.error();
  return RayFile(std::move(rows).value());
}

Status RayFile::read(std::span<Ray> rays) {
  const bool is_double = rows_.width() == sizeof(double);
  return rows_.read(rays.size(), [&](std::size_t k, const unsigned char* row) -> Status {
    const Result<Ray> ray = is_double ? decode<double>(row) : decode<float>(row);
    if (!ray) return ray.error();
    rays[k] = ray.value();
    ++read_;
    return {};
  });
}

}  // namespace boule
