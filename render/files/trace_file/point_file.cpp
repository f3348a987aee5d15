#include "render/files/trace_file/point_file.h"

#include <algorithm>
#include <utility>

#include "core/base/float_environment.h"
#include "render/files/file/npy_rows.h"

namespace boule {
namespace {

constexpr std::size_t point_columns = 3, points_per_read = 4096;

std::size_t number_bytes(const NpyHeader& header) {
  return npy_is_double(header) ? sizeof(double) : sizeof(float);
}

/// An error unless the file declares points and has exactly the length that it declares.
Status check_point_layout(const NpyHeader& header, std::uint64_t file_size) {
  if (auto done = check_npy_elements(header); !done) return done;
  if (header.shape.size() != 2 || header.shape[1] != point_columns)
    return Diagnostic::of("has shape " + npy_shape_text(header) + ", expected (N, 3): points");
  return check_npy_length(header, point_columns * number_bytes(header), file_size);
}

Diagnostic in_file(Diagnostic error, const std::string& path) {
  error.file = path;
  return error;
}

}  // namespace

PointFile::PointFile(std::string path, InputFile file, const NpyHeader& header)
    : path_(std::move(path)),
      file_(std::move(file)),
      size_(header.shape[0]),
      width_(number_bytes(header)) {}

Result<PointFile> PointFile::open(const std::string& path) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return in_file(header.error(), path);
  if (auto done = check_point_layout(header.value(), file.value().size()); !done)
    return in_file(done.error(), path);
  return PointFile(path, std::move(file).value(), header.value());
}

Status PointFile::read(std::span<Vec3d> points) {
  const FloatEnvironment environment;
  if (const auto open = file_.read(nullptr, 0); !open) return open.error();  // it was moved away
  rows_.resize(points_per_read * point_columns * width_);
  for (std::size_t first = 0; first < points.size(); first += points_per_read) {
    const std::size_t count = std::min(points_per_read, points.size() - first);
    if (auto done = read_npy_rows(file_, rows_.data(), count * point_columns * width_); !done)
      return in_file(done.error(), path_);
    const unsigned char* at = rows_.data();
    for (std::size_t k = 0; k < count; ++k, at += point_columns * width_) {
      points[first + k] = Vec3d{npy_number_of(at, width_), npy_number_of(at + width_, width_),
                                npy_number_of(at + 2 * width_, width_)} -
                          zero_;
    }
  }
  return {};
}

}  // namespace boule
