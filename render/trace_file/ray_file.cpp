#include "render/trace_file/ray_file.h"

#include <algorithm>
#include <utility>

#include "core/base/float_environment.h"
#include "render/scene_file/npy_header.h"
#include "render/scene_file/npy_rows.h"

namespace boule {
namespace {

constexpr std::size_t columns = 8;
constexpr std::size_t row_bytes = columns * sizeof(float);
constexpr std::size_t rows_per_read = 4096;

Diagnostic refusal(const std::string& message) { return {message, "", "", 0, 0}; }

Diagnostic named(Diagnostic error, const std::string& path) {
  error.file = path;
  return error;
}

/// Whether the file declares rays and is exactly as long as it says.
Status check_layout(const NpyHeader& header, std::uint64_t file_size) {
  if (header.descr != "<f4") {
    return refusal("holds " + quote(header.descr) + ", expected '<f4' (little-endian float32)");
  }
  if (auto bad = check_npy_order(header)) return bad;
  if (header.shape.size() != 2 || header.shape[1] != columns) {
    return refusal("has shape " + npy_shape_text(header) +
                   ", expected (N, 8): origin, tmin, direction, tmax");
  }
  return check_npy_length(header, row_bytes, file_size);
}

Ray decode_row(const unsigned char* row) {
  float x[columns];
  for (std::size_t i = 0; i < columns; ++i) x[i] = npy_number<float>(row + i * sizeof(float));
  Ray ray{vec_cast<double>(Vec3f{x[0], x[1], x[2]}), {x[4], x[5], x[6]}};
  ray.tmin = x[3];
  ray.tmax = x[7];
  return ray;
}

}  // namespace

RayFile::RayFile(std::string path, InputFile file, std::uint64_t size)
    : path_(std::move(path)), file_(std::move(file)), size_(size) {}

Result<RayFile> RayFile::open(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return named(header.error(), path);
  if (auto bad = check_layout(header.value(), file.value().size())) return named(*bad, path);
  return RayFile(path, std::move(file).value(), header.value().shape[0]);
}

Status RayFile::read(std::span<Ray> rays) {
  const FloatEnvironment environment;
  if (const auto here = file_.read(nullptr, 0); !here) return here.error();  // or moved away
  rows_.resize(rows_per_read * row_bytes);
  for (std::size_t first = 0; first < rays.size(); first += rows_per_read) {
    const std::size_t count = std::min(rows_per_read, rays.size() - first);
    if (auto bad = read_npy_rows(file_, rows_.data(), count * row_bytes)) {
      return named(*bad, path_);
    }
    for (std::size_t k = 0; k < count; ++k) {
      rays[first + k] = decode_row(rows_.data() + k * row_bytes);
    }
  }
  return std::nullopt;
}

}  // namespace boule
