#include "render/scene_file/npy_reader.h"

#include <algorithm>
#include <cstddef>

#include "render/file/float32.h"
#include "render/file/input_file.h"
#include "render/file/npy_header.h"
#include "render/file/npy_rows.h"
#include "render/file/sphere_room.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace boule {
namespace {

/// The rows of a valid file: `columns` numbers of `width` bytes each.
struct RowLayout {
  std::uint64_t rows = 0;
  std::size_t columns = 4;
  std::size_t width = 4;

  [[nodiscard]] std::size_t bytes() const { return columns * width; }
};

/// The declared layout, if it is one of spheres and the file is exactly as long as it says.
Result<RowLayout> check_layout(const NpyHeader& header, const NpySpheres& request,
                               std::uint64_t file_size) {
  const bool has_radius = request.radius.has_value();
  if (auto bad = check_npy_elements(header)) {
    if (!header.fields.empty()) bad->message += ": [[particles]] reads it";
    return *bad;
  }
  const auto& shape = header.shape;
  if (shape.size() != 2 || (shape[1] != 3 && shape[1] != 4)) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          (request.is_scene ? ", expected (N, 4): centre and radius"
                                            : ", expected (N, 4), or (N, 3) and `radius`"));
  }
  if (shape[1] == 3 && request.is_scene) {
    return Diagnostic::of(
        "has 3 columns, centres alone: that needs a .toml scene with a key 'radius'");
  }
  if (shape[1] == 3 && !has_radius)
    return Diagnostic::of("has 3 columns: the key 'radius' is missing");
  if (shape[1] == 4 && has_radius) {
    return Diagnostic::of("has radii of its own in column 3: the key 'radius' contradicts them");
  }
  const RowLayout layout{shape[0], static_cast<std::size_t>(shape[1]),
                         npy_is_double(header) ? std::size_t{8} : std::size_t{4}};
  if (auto bad = check_npy_length(header, layout.bytes(), file_size)) return *bad;
  return layout;
}

/// Decodes the rows of one file.
class RowDecoder {
 public:
  RowDecoder(const RowLayout& layout, const NpySpheres& request)
      : layout_(layout), request_(request) {}

  /// Appends the spheres of `count` rows, the first of which is row `first` of the file: nothing,
  /// or what is wrong with the first bad one.
  Status append(const unsigned char* rows, std::uint64_t first, std::size_t count,
                std::vector<Sphere>& spheres) const {
    const bool all_valid = layout_.width == sizeof(float)
                               ? append_all<float>(rows, count, spheres)
                               : append_all<double>(rows, count, spheres);
    return all_valid ? std::nullopt : explain(rows, first, count);
  }

 private:
  template <class Number>
  bool append_all(const unsigned char* rows, std::size_t count,
                  std::vector<Sphere>& spheres) const {
    if (!(request_.origin == Vec3d{})) {
      return layout_.columns == 4 ? append_all<Number, 4, true>(rows, count, spheres)
                                  : append_all<Number, 3, true>(rows, count, spheres);
    }
    return layout_.columns == 4 ? append_all<Number, 4, false>(rows, count, spheres)
                                : append_all<Number, 3, false>(rows, count, spheres);
  }
  template <class Number, std::size_t columns, bool has_origin>
  bool append_all(const unsigned char* rows, std::size_t count, std::vector<Sphere>& spheres) const;
  Status explain(const unsigned char* rows, std::uint64_t first, std::size_t count) const;
  std::optional<std::string> find_problem_in(const unsigned char* row) const;

  const RowLayout& layout_;
  const NpySpheres& request_;
};

/// Appends rows of one kind; true if all are valid. If not, RowDecoder::explain() finds out why.
template <class Number, std::size_t columns, bool has_origin>
bool RowDecoder::append_all(const unsigned char* rows, std::size_t count,
                            std::vector<Sphere>& spheres) const {
  const float common_radius = request_.radius.value_or(0);
  const MaterialRef material = request_.material;
  const Vec3d& o = request_.origin;
  const double origin[4] = {o.x, o.y, o.z, 0};
  bool all_valid = true;
  for (std::size_t row = 0; row < count; ++row, rows += columns * sizeof(Number)) {
    float numbers[4] = {0, 0, 0, common_radius};
    for (std::size_t i = 0; i < columns; ++i) {
      const Number number = npy_number<Number>(rows + i * sizeof(Number));
      if constexpr (has_origin) {
        numbers[i] = float32_or_nan(double{number} - origin[i]);
      } else {
        numbers[i] = float32_or_nan(number);
      }
    }
    const Sphere sphere{{numbers[0], numbers[1], numbers[2]}, numbers[3], material};
    all_valid &= is_valid(sphere);
    spheres.push_back(sphere);
  }
  return all_valid;
}

/// The refusal of the first bad one among these rows.
Status RowDecoder::explain(const unsigned char* rows, std::uint64_t first,
                           std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto problem = find_problem_in(rows + i * layout_.bytes())) {
      return Diagnostic::of("row " + std::to_string(first + i) + ": " + *problem);
    }
  }
  return std::nullopt;
}

/// What is wrong with the sphere of one row, in words.
std::optional<std::string> RowDecoder::find_problem_in(const unsigned char* row) const {
  constexpr const char* names[] = {"center x", "center y", "center z", "radius"};
  const Vec3d& o = request_.origin;
  const double origin[4] = {o.x, o.y, o.z, 0};
  float numbers[4] = {0, 0, 0, request_.radius.value_or(0)};
  for (std::size_t i = 0; i < layout_.columns; ++i) {
    const unsigned char* bytes = row + i * layout_.width;
    const double read =
        layout_.width == 8 ? npy_number<double>(bytes) : double{npy_number<float>(bytes)};
    const auto number = to_float32(read - origin[i]);
    if (!number) return std::string(names[i]) + " is too large for a 32-bit float";
    numbers[i] = *number;
  }
  const auto problem = find_problem(Sphere{{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  if (!problem) return std::nullopt;
  return problem->field + " " + problem->message;
}

Status append_rows(InputFile& file, const RowLayout& layout, const NpySpheres& request,
                   std::vector<Sphere>& spheres) {
  constexpr std::size_t rows_per_block = 4096;
  std::vector<unsigned char> block(rows_per_block * layout.bytes());
  make_room(spheres, static_cast<std::size_t>(layout.rows));
  const RowDecoder decoder(layout, request);
  for (std::uint64_t row = 0; row < layout.rows;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(rows_per_block, layout.rows - row));
    if (auto bad = read_npy_rows(file, block.data(), count * layout.bytes())) return bad;
    if (auto bad = decoder.append(block.data(), row, count, spheres)) return bad;
    row += count;
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
  const auto layout = check_layout(header.value(), request, file.value().size());
  if (!layout) return named(layout.error());
  const std::uint64_t rows = layout.value().rows;
  if (auto bad = check_memory(bytes_of_spheres(rows) + bytes_of_tree(spheres.size() + rows),
                              std::to_string(rows) + " spheres need")) {
    return named(*bad);
  }
  const std::size_t before = spheres.size();
  if (auto bad = append_rows(file.value(), layout.value(), request, spheres)) {
    spheres.resize(before);
    return named(*bad);
  }
  return std::nullopt;
}

}  // namespace boule
