#include "render/files/scene_file/npy/npy_reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <span>
#include <utility>

#include "render/files/file/float32.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"
#include "render/files/file/sphere_room.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace boule {
namespace {

/// The rows of a valid file: `columns` numbers of `width` bytes each.
struct RowLayout {
  std::uint64_t begin = 0;  ///< byte of the first one in the file
  std::uint64_t rows = 0;
  std::size_t columns = 4;
  std::size_t width = 4;

  [[nodiscard]] std::size_t bytes() const { return columns * width; }
};

/// The declared layout, if it is one of spheres and the file is exactly as long as it says.
Result<RowLayout> check_layout(const NpyHeader& header, const NpySpheres& request,
                               std::uint64_t file_size) {
  const bool has_radius = request.radius.has_value();
  if (auto done = check_npy_elements(header); !done) {
    if (!header.fields.empty()) done.error().message += ": [[particles]] reads it";
    return done.error();
  }
  const auto& shape = header.shape;
  if (shape.size() != 2 || (shape[1] != 3 && shape[1] != 4)) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          (request.is_scene
                               ? ", expected (N, 4): centre and radius; as particles it is "
                                 "read by --input-format npy"
                               : ", expected (N, 4), or (N, 3) and `radius`"));
  }
  if (shape[1] == 3 && request.is_scene) {
    return Diagnostic::of(
        "has 3 columns, centres alone: that needs a .toml scene with a key 'radius', or "
        "--input-format npy, which reads particles");
  }
  if (shape[1] == 3 && !has_radius)
    return Diagnostic::of("has 3 columns: the key 'radius' is missing");
  if (shape[1] == 4 && has_radius) {
    return Diagnostic::of("has radii of its own in column 3: the key 'radius' contradicts them");
  }
  const RowLayout layout{header.size, shape[0], static_cast<std::size_t>(shape[1]),
                         npy_is_double(header) ? std::size_t{8} : std::size_t{4}};
  if (auto done = check_npy_length(header, layout.bytes(), file_size); !done) return done.error();
  return layout;
}

/// The numbers of a row, as they are.
std::array<double, 4> numbers_of(const unsigned char* row, const RowLayout& layout,
                                 const NpySpheres& request) {
  std::array<double, 4> numbers{0, 0, 0, double{request.radius.value_or(0)}};
  for (std::size_t i = 0; i < layout.columns; ++i) {
    numbers[i] = npy_number_of(row + i * layout.width, layout.width);
  }
  return numbers;
}

/// Decodes the rows of one file.
class RowDecoder {
 public:
  RowDecoder(const RowLayout& layout, const NpySpheres& request)
      : layout_(layout), request_(request) {}

  /// Sets the spheres of some rows, the first of which is row `first` of the file: nothing, or what
  /// is wrong with the first bad one.
  Status decode(const unsigned char* rows, std::uint64_t first, std::span<Sphere> spheres) const {
    const bool all_valid = layout_.width == sizeof(float) ? decode_all<float>(rows, spheres)
                                                          : decode_all<double>(rows, spheres);
    return all_valid ? Status() : explain(rows, first, spheres.size());
  }

 private:
  template <class Number>
  bool decode_all(const unsigned char* rows, std::span<Sphere> spheres) const {
    if (!(request_.origin == Vec3d{})) {
      return layout_.columns == 4 ? decode_all<Number, 4, true>(rows, spheres)
                                  : decode_all<Number, 3, true>(rows, spheres);
    }
    return layout_.columns == 4 ? decode_all<Number, 4, false>(rows, spheres)
                                : decode_all<Number, 3, false>(rows, spheres);
  }
  template <class Number, std::size_t columns, bool has_origin>
  bool decode_all(const unsigned char* rows, std::span<Sphere> spheres) const;
  Status explain(const unsigned char* rows, std::uint64_t first, std::size_t count) const;
  std::optional<std::string> find_problem_in(const unsigned char* row) const;

  const RowLayout& layout_;
  const NpySpheres& request_;
};

/// Decodes rows of one kind; true if all are valid. If not, RowDecoder::explain() finds out why.
template <class Number, std::size_t columns, bool has_origin>
bool RowDecoder::decode_all(const unsigned char* rows, std::span<Sphere> spheres) const {
  const float common_radius = request_.radius.value_or(0);
  const MaterialRef material = request_.material;
  const Vec3d& o = request_.origin;
  const double origin[4] = {o.x, o.y, o.z, 0};
  bool all_valid = true;
  for (Sphere& sphere : spheres) {
    float numbers[4] = {0, 0, 0, common_radius};
    for (std::size_t i = 0; i < columns; ++i) {
      const Number number = npy_number<Number>(rows + i * sizeof(Number));
      if constexpr (has_origin) {
        numbers[i] = float32_or_nan(double{number} - origin[i]);
      } else {
        numbers[i] = float32_or_nan(number);
      }
    }
    sphere = {{numbers[0], numbers[1], numbers[2]}, numbers[3], material};
    all_valid &= is_valid(sphere);
    rows += columns * sizeof(Number);
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
  return {};
}

/// What is wrong with the sphere of one row, in words.
std::optional<std::string> RowDecoder::find_problem_in(const unsigned char* row) const {
  constexpr const char* names[] = {"center x", "center y", "center z", "radius"};
  const Vec3d& o = request_.origin;
  const double origin[4] = {o.x, o.y, o.z, 0};
  const std::array<double, 4> read = numbers_of(row, layout_, request_);
  float numbers[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const auto number = to_float32(read[i] - origin[i]);
    if (!number) return std::string(names[i]) + " is too large for a 32-bit float";
    numbers[i] = *number;
  }
  const auto problem = find_problem(Sphere{{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  if (!problem) return std::nullopt;
  return problem->field + " " + problem->message;
}

/// Reads some of the rows, block by block, and calls take(bytes, row, count) for each block.
template <class Take>
Status read_piece(const InputFile& file, const RowLayout& layout, std::size_t row, std::size_t end,
                  const Take& take) {
  constexpr std::size_t rows_per_block = 4096;
  std::vector<unsigned char> block(std::min(rows_per_block, end - row) * layout.bytes());
  for (; row < end; row += rows_per_block) {
    const std::size_t count = std::min(rows_per_block, end - row);
    if (auto done = read_npy_rows(file, layout.begin + row * layout.bytes(), block.data(),
                                  count * layout.bytes());
        !done) {
      return done;
    }
    if (auto done = take(block.data(), row, count); !done) return done;
  }
  return {};
}

/// The same for all rows, of which threads read a piece each.
template <class Take>
Status read_rows(const InputFile& file, const RowLayout& layout, const ParallelFor& parallel_for,
                 const Take& take) {
  constexpr std::size_t rows_per_piece = std::size_t{1} << 16;
  const auto rows = static_cast<std::size_t>(layout.rows);
  std::vector<Status> pieces((rows + rows_per_piece - 1) / rows_per_piece);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const std::size_t row = i * rows_per_piece;
    pieces[i] = read_piece(file, layout, row, std::min(row + rows_per_piece, rows), take);
  });
  for (const Status& piece : pieces) {
    if (!piece) return piece;
  }
  return {};
}

/// A file of spheres that is open.
struct OpenSpheres {
  InputFile file;
  RowLayout layout;
};

/// Opens a file whose spheres fit into memory beside so many others.
Result<OpenSpheres> open_spheres(const NpySpheres& request, std::uint64_t others) {
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
  if (auto done = check_memory(bytes_of_tree(others + rows) - bytes_of_spheres(others),
                               std::to_string(rows) + " spheres need");
      !done) {
    return named(done.error());
  }
  return OpenSpheres{std::move(file).value(), layout.value()};
}

}  // namespace

Status append_spheres(const NpySpheres& request, std::vector<Sphere>& spheres,
                      const ParallelFor& parallel_for) {
  const std::size_t before = spheres.size();
  const auto opened = open_spheres(request, before);
  if (!opened) return opened.error();
  const auto& [file, layout] = opened.value();
  append_blank(spheres, static_cast<std::size_t>(layout.rows), parallel_for);
  const RowDecoder decoder(layout, request);
  const auto decode = [&](const unsigned char* rows, std::size_t row, std::size_t count) {
    return decoder.decode(rows, row, std::span(spheres).subspan(before + row, count));
  };
  if (auto done = read_rows(file, layout, parallel_for, decode); !done) {
    spheres.resize(before);
    done.error().file = request.path;
    return done;
  }
  return {};
}

SphereExtent extent_of(const NpySpheres& request, const ParallelFor& parallel_for) {
  SphereExtent all;
  const auto opened = open_spheres(request, 0);
  if (!opened) return all;
  const RowLayout& layout = opened.value().layout;
  std::mutex mutex;
  const auto take = [&](const unsigned char* rows, std::size_t, std::size_t count) -> Status {
    const SphereExtent some =
        extent_of(count, serial_for, [&](std::size_t i, SphereExtent& extent) {
          const auto [x, y, z, r] = numbers_of(rows + i * layout.bytes(), layout, request);
          extent.add({x, y, z}, r);
        });
    const std::lock_guard lock(mutex);
    all.add(some);
    return {};
  };
  return read_rows(opened.value().file, layout, parallel_for, take) ? all : SphereExtent{};
}

}  // namespace boule
