#include "render/files/trace_file/ray_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/float_environment.h"
#include "core/scene/number_text.h"
#include "render/files/file/float32.h"
#include "render/files/file/npy_rows.h"

namespace boule {
namespace {

constexpr std::size_t columns = 8, columns_with_source = 10;
constexpr std::size_t rows_per_read = 4096;

Diagnostic named(Diagnostic error, const std::string& path) {
  error.file = path;
  return error;
}

std::size_t ray_bytes(const NpyHeader& header) {
  return header.shape[1] * (npy_is_double(header) ? sizeof(double) : sizeof(float));
}

/// An error unless the file declares rays and has exactly the length that it declares.
Status check_layout(const NpyHeader& header, std::uint64_t file_size) {
  if (auto done = check_npy_elements(header); !done) return done;
  if (header.shape.size() != 2 ||
      (header.shape[1] != columns && header.shape[1] != columns_with_source)) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          ", expected (N, 8): origin, tmin, direction, tmax; or (N, 10): source "
                          "and inside, too");
  }
  return check_npy_length(header, ray_bytes(header), file_size);
}

}  // namespace

RayFile::RayFile(std::string path, InputFile file, const NpyHeader& header)
    : path_(std::move(path)),
      file_(std::move(file)),
      size_(header.shape[0]),
      columns_(header.shape[1]),
      is_double_(npy_is_double(header)) {}

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
  if (columns_ == columns) return ray;
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
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return named(header.error(), path);
  if (auto done = check_layout(header.value(), file.value().size()); !done)
    return named(done.error(), path);
  return RayFile(path, std::move(file).value(), header.value());
}

Status RayFile::read(std::span<Ray> rays) {
  const FloatEnvironment environment;
  if (const auto open = file_.read(nullptr, 0); !open) return open.error();  // it was moved away
  const std::size_t width = columns_ * (is_double_ ? sizeof(double) : sizeof(float));
  rows_.resize(rows_per_read * width);
  for (std::size_t first = 0; first < rays.size(); first += rows_per_read) {
    const std::size_t count = std::min(rows_per_read, rays.size() - first);
    if (auto done = read_npy_rows(file_, rows_.data(), count * width); !done) {
      return named(done.error(), path_);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const unsigned char* const row = rows_.data() + k * width;
      const Result<Ray> ray = is_double_ ? decode<double>(row) : decode<float>(row);
      if (!ray) return named(ray.error(), path_);
      rays[first + k] = ray.value();
      ++read_;
    }
  }
  return {};
}

}  // namespace boule
