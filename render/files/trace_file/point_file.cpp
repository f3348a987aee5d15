#include "render/files/trace_file/point_file.h"

namespace boule {
namespace {

Status check_point_columns(const NpyHeader& header) {
  if (header.shape.size() == 2 && header.shape[1] == 3) return {};
  return Diagnostic::of("has shape " + npy_shape_text(header) + ", expected (N, 3): points");
}

}  // namespace

Result<PointFile> PointFile::open(const std::string& path) {
  auto rows = RowFile::open(path, check_point_columns);
  if (!rows) return rows.error();
  return PointFile(std::move(rows).value());
}

Status PointFile::read(std::span<Vec3d> points) {
  const std::size_t width = rows_.width();
  return rows_.read(points.size(), [&](std::size_t k, const unsigned char* row) -> Status {
    points[k] = Vec3d{npy_number_of(row, width), npy_number_of(row + width, width),
                      npy_number_of(row + 2 * width, width)} -
                zero_;
    return {};
  });
}

}  // namespace boule
