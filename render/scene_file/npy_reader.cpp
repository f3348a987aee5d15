#include "render/scene_file/npy_reader.h"

#include <algorithm>
#include <cstddef>

#include "render/scene_file/float32.h"
#include "render/scene_file/input_file.h"
#include "render/scene_file/npy_header.h"
#include "render/scene_file/npy_rows.h"

namespace boule {
namespace {

/// The rows of a valid file: `columns` numbers of `width` bytes each.
struct RowLayout {
  std::uint64_t rows = 0;
  std::size_t columns = 4;
  std::size_t width = 4;

  [[nodiscard]] std::size_t bytes() const { return columns * width; }
};

Diagnostic refusal(const std::string& message) { return {message, "", "", 0, 0}; }

/// The declared layout, if it is one of spheres and the file is exactly as long as it says.
Result<RowLayout> check_layout(const NpyHeader& header, bool has_radius, std::uint64_t file_size) {
  if (header.descr != "<f4" && header.descr != "<f8") {
    return refusal("holds " + quote(header.descr) +
                   ", expected '<f4' or '<f8' (little-endian float32 or float64)");
  }
  if (auto bad = check_npy_order(header)) return *bad;
  const auto& shape = header.shape;
  if (shape.size() != 2 || (shape[1] != 3 && shape[1] != 4)) {
    return refusal("has shape " + npy_shape_text(header) +
                   ", expected (N, 4), or (N, 3) and `radius`");
  }
  if (shape[1] == 3 && !has_radius) return refusal("has 3 columns: the key 'radius' is missing");
  if (shape[1] == 4 && has_radius) {
    return refusal("has radii of its own in column 3: the key 'radius' contradicts them");
  }
  const RowLayout layout{shape[0], static_cast<std::size_t>(shape[1]),
                         header.descr == "<f4" ? std::size_t{4} : std::size_t{8}};
  if (auto bad = check_npy_length(header, layout.bytes(), file_size)) return *bad;
  return layout;
}

/// One number of 4 or 8 bytes.
double decode(const unsigned char* bytes, std::size_t width) {
  return width == 8 ? npy_float64(bytes) : double{npy_float32(bytes)};
}

/// The sphere of one row, or what is wrong with it.
Result<Sphere> decode_row(const unsigned char* row, const RowLayout& layout,
                          const NpySpheres& request) {
  constexpr const char* names[] = {"center x", "center y", "center z", "radius"};
  float numbers[4] = {0, 0, 0, request.radius.value_or(0)};
  for (std::size_t i = 0; i < layout.columns; ++i) {
    const auto number = to_float32(decode(row + i * layout.width, layout.width));
    if (!number) return refusal(std::string(names[i]) + " is too large for a 32-bit float");
    numbers[i] = *number;
  }
  const Sphere sphere{{numbers[0], numbers[1], numbers[2]}, numbers[3], request.material};
  if (auto problem = find_problem(sphere)) return refusal(problem->field + " " + problem->message);
  return sphere;
}

Status append_rows(InputFile& file, const RowLayout& layout, const NpySpheres& request,
                   std::vector<Sphere>& spheres) {
  constexpr std::size_t rows_per_block = 4096;
  std::vector<unsigned char> block(rows_per_block * layout.bytes());
  spheres.reserve(spheres.size() + static_cast<std::size_t>(layout.rows));
  for (std::uint64_t row = 0; row < layout.rows;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(rows_per_block, layout.rows - row));
    if (auto bad = read_npy_rows(file, block.data(), count * layout.bytes())) return *bad;
    for (std::size_t i = 0; i < count; ++i, ++row) {
      const auto sphere = decode_row(block.data() + i * layout.bytes(), layout, request);
      if (!sphere) return refusal("row " + std::to_string(row) + ": " + sphere.error().message);
      spheres.push_back(sphere.value());
    }
  }
  return std::nullopt;
}

}  // namespace

Status append_spheres(const NpySpheres& request, std::vector<Sphere>& spheres) {
  const auto named = [&](Diagnostic error) {
    error.file = request.path;
    return error;
  };
  auto file = InputFile::open(request.path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return named(header.error());
  const auto layout = check_layout(header.value(), request.radius.has_value(), file.value().size());
  if (!layout) return named(layout.error());
  const std::size_t before = spheres.size();
  if (auto bad = append_rows(file.value(), layout.value(), request, spheres)) {
    spheres.resize(before);
    return named(*bad);
  }
  return std::nullopt;
}

}  // namespace boule
