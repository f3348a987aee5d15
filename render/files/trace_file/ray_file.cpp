#include "render/files/trace_file/ray_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/float_environment.h"
#include "render/files/file/float32.h"
#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"

namespace boule {
namespace {

constexpr std::size_t columns = 8;
constexpr std::size_t rows_per_read = 4096;

std::size_t ray_bytes(bool is_double) {
  return columns * (is_double ? sizeof(double) : sizeof(float));
}

Diagnostic named(Diagnostic error, const std::string& path) {
  error.file = path;
  return error;
}

/// An error unless the file declares rays and has exactly the length that it declares.
Status check_layout(const NpyHeader& header, std::uint64_t file_size) {
  if (auto done = check_npy_elements(header); !done) return done;
  if (header.shape.size() != 2 || header.shape[1] != columns) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          ", expected (N, 8): origin, tmin, direction, tmax");
  }
  return check_npy_length(header, ray_bytes(npy_is_double(header)), file_size);
}

/// The ray of one row, counted from `zero`. Adds 1 to `lost` if rounding took its origin or
/// direction away.
template <class Number>
Ray decode_row(const unsigned char* row, const Vec3d& zero, std::uint64_t& lost) {
  const double subtracted[columns] = {zero.x, zero.y, zero.z};
  double exact[columns];
  float x[columns];
  bool overflows = false;
  for (std::size_t i = 0; i < columns; ++i) {
    exact[i] = double{npy_number<Number>(row + i * sizeof(Number))} - subtracted[i];
    x[i] = float32_or_inf(exact[i]);
    const bool is_bound = i == 3 || i == 7;
    overflows |= !is_bound && std::isfinite(exact[i]) && !std::isfinite(x[i]);
  }
  const bool vanishes =
      x[4] == 0 && x[5] == 0 && x[6] == 0 && (exact[4] != 0 || exact[5] != 0 || exact[6] != 0);
  lost += overflows || vanishes ? 1 : 0;
  Ray ray{vec_cast<double>(Vec3f{x[0], x[1], x[2]}), {x[4], x[5], x[6]}};
  ray.tmin = x[3];
  ray.tmax = x[7];
  return ray;
}

}  // namespace

RayFile::RayFile(std::string path, InputFile file, std::uint64_t size, bool is_double)
    : path_(std::move(path)), file_(std::move(file)), size_(size), is_double_(is_double) {}

Result<RayFile> RayFile::open(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return named(header.error(), path);
  if (auto done = check_layout(header.value(), file.value().size()); !done)
    return named(done.error(), path);
  return RayFile(path, std::move(file).value(), header.value().shape[0],
                 npy_is_double(header.value()));
}

Status RayFile::read(std::span<Ray> rays) {
  const FloatEnvironment environment;
  if (const auto open = file_.read(nullptr, 0); !open) return open.error();  // it was moved away
  const std::size_t width = ray_bytes(is_double_);
  rows_.resize(rows_per_read * width);
  for (std::size_t first = 0; first < rays.size(); first += rows_per_read) {
    const std::size_t count = std::min(rows_per_read, rays.size() - first);
    if (auto done = read_npy_rows(file_, rows_.data(), count * width); !done) {
      return named(done.error(), path_);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const unsigned char* const row = rows_.data() + k * width;
      rays[first + k] =
          is_double_ ? decode_row<double>(row, zero_, lost_) : decode_row<float>(row, zero_, lost_);
    }
  }
  return {};
}

}  // namespace boule
