#include "render/files/scene_file/npy/npy_reader.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

#include "core/scene/kinds.h"
#include "render/files/file/float32.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"
#include "render/files/file/sphere_room.h"
#include "render/files/scene_file/loaded/primitive_points.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace boule {
namespace {

/// What a row holds: the numbers of points, and a radius.
template <class Primitive>
struct RowOf;

template <>
struct RowOf<Sphere> {
  static constexpr std::array names{"center x", "center y", "center z", "radius"};
  static constexpr const char* points = "centre";
  static constexpr const char* alone = "centres";
  static Sphere primitive(const float* x, MaterialRef material) {
    return {{x[0], x[1], x[2]}, x[3], material};
  }
  static std::uint64_t bytes(std::uint64_t count) { return bytes_of_spheres(count); }
  static std::uint64_t bytes_prepared(std::uint64_t count) { return bytes_of_tree(count); }
};

template <>
struct RowOf<Capsule> {
  static constexpr std::array names{"a x", "a y", "a z", "b x", "b y", "b z", "radius"};
  static constexpr const char* points = "both ends";
  static constexpr const char* alone = "ends";
  static Capsule primitive(const float* x, MaterialRef material) {
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], material};
  }
  static std::uint64_t bytes(std::uint64_t count) { return count * sizeof(Capsule); }
  static std::uint64_t bytes_prepared(std::uint64_t count) {
    return bytes(count) + bytes_of_capsule_tree(count);
  }
};

/// How many numbers a row with a radius has.
template <class Primitive>
constexpr std::size_t row_size = RowOf<Primitive>::names.size();

/// The rows of a valid file: `columns` numbers of `width` bytes each.
struct RowLayout {
  std::uint64_t begin = 0;  ///< byte of the first one in the file
  std::uint64_t rows = 0;
  std::size_t columns = 4;
  std::size_t width = 4;

  [[nodiscard]] std::size_t bytes() const { return columns * width; }
};

/// The refusal of a shape, if it is one.
template <class Primitive>
Status check_shape(const NpyHeader& header, const NpyPrimitives<Primitive>& request) {
  constexpr std::size_t full = row_size<Primitive>;
  using Row = RowOf<Primitive>;
  const std::string with = std::to_string(full), without = std::to_string(full - 1);
  const bool has_radius = request.radius.has_value();
  const auto& shape = header.shape;
  if (shape.size() != 2 || (shape[1] != full - 1 && shape[1] != full)) {
    return Diagnostic::of("has shape " + npy_shape_text(header) + ", expected (N, " + with + ")" +
                          (request.is_scene
                               ? std::string(": ") + Row::points +
                                     " and radius; as particles it is read by --input-format npy"
                               : ", or (N, " + without + ") and `radius`"));
  }
  if (shape[1] == full - 1 && request.is_scene) {
    return Diagnostic::of("has " + without + " columns, " + Row::alone +
                          " alone: that needs a .toml scene with a key 'radius', or "
                          "--input-format npy, which reads particles");
  }
  if (shape[1] == full - 1 && !has_radius)
    return Diagnostic::of("has " + without + " columns: the key 'radius' is missing");
  if (shape[1] == full && has_radius) {
    return Diagnostic::of("has radii of its own in column " + without +
                          ": the key 'radius' contradicts them");
  }
  return {};
}

/// The declared layout, if it is one of such primitives and the file is exactly as long as it says.
template <class Primitive>
Result<RowLayout> check_layout(const NpyHeader& header, const NpyPrimitives<Primitive>& request,
                               std::uint64_t file_size) {
  if (auto done = check_npy_elements(header); !done) {
    if (!header.fields.empty()) done.error().message += ": [[particles]] reads it";
    return done.error();
  }
  if (auto done = check_shape(header, request); !done) return done.error();
  const RowLayout layout{header.size, header.shape[0], static_cast<std::size_t>(header.shape[1]),
                         npy_is_double(header) ? std::size_t{8} : std::size_t{4}};
  if (auto done = check_npy_length(header, layout.bytes(), file_size); !done) return done.error();
  return layout;
}

/// The numbers of a row, as they are.
template <class Primitive>
std::array<double, row_size<Primitive>> numbers_of(const unsigned char* row,
                                                   const RowLayout& layout,
                                                   const NpyPrimitives<Primitive>& request) {
  std::array<double, row_size<Primitive>> numbers{};
  numbers.back() = double{request.radius.value_or(0)};
  for (std::size_t i = 0; i < layout.columns; ++i) {
    numbers[i] = npy_number_of(row + i * layout.width, layout.width);
  }
  return numbers;
}

/// What is subtracted from the numbers of a row.
template <class Primitive>
std::array<double, row_size<Primitive>> origin_of(const NpyPrimitives<Primitive>& request) {
  const Vec3d& o = request.origin;
  const double point[3] = {o.x, o.y, o.z};
  std::array<double, row_size<Primitive>> origin{};
  for (std::size_t i = 0; i + 1 < origin.size(); ++i) origin[i] = point[i % 3];
  return origin;
}

/// Decodes the rows of one file.
template <class Primitive>
class RowDecoder {
 public:
  RowDecoder(const RowLayout& layout, const NpyPrimitives<Primitive>& request)
      : layout_(layout), request_(request), origin_(origin_of(request)) {}

  /// Sets the primitives of some rows, the first of which is row `first` of the file: nothing, or
  /// what is wrong with the first bad one.
  Status decode(const unsigned char* rows, std::uint64_t first,
                std::span<Primitive> primitives) const {
    const bool all_valid = layout_.width == sizeof(float) ? decode_all<float>(rows, primitives)
                                                          : decode_all<double>(rows, primitives);
    return all_valid ? Status() : explain(rows, first, primitives.size());
  }

 private:
  static constexpr std::size_t full = row_size<Primitive>;

  template <class Number>
  bool decode_all(const unsigned char* rows, std::span<Primitive> primitives) const {
    if (!(request_.origin == Vec3d{})) {
      return layout_.columns == full ? decode_all<Number, full, true>(rows, primitives)
                                     : decode_all<Number, full - 1, true>(rows, primitives);
    }
    return layout_.columns == full ? decode_all<Number, full, false>(rows, primitives)
                                   : decode_all<Number, full - 1, false>(rows, primitives);
  }
  template <class Number, std::size_t columns, bool has_origin>
  bool decode_all(const unsigned char* rows, std::span<Primitive> primitives) const;
  Status explain(const unsigned char* rows, std::uint64_t first, std::size_t count) const;
  std::optional<std::string> find_problem_in(const unsigned char* row) const;

  const RowLayout& layout_;
  const NpyPrimitives<Primitive>& request_;
  std::array<double, full> origin_;
};

/// Decodes rows of one kind; true if all are valid. If not, RowDecoder::explain() finds out why.
template <class Primitive>
template <class Number, std::size_t columns, bool has_origin>
bool RowDecoder<Primitive>::decode_all(const unsigned char* rows,
                                       std::span<Primitive> primitives) const {
  const float common_radius = request_.radius.value_or(0);
  const MaterialRef material = request_.material;
  const auto origin = origin_;
  bool all_valid = true;
  for (Primitive& primitive : primitives) {
    float numbers[full] = {};
    numbers[full - 1] = common_radius;
    for (std::size_t i = 0; i < columns; ++i) {
      const Number number = npy_number<Number>(rows + i * sizeof(Number));
      if constexpr (has_origin) {
        numbers[i] = float32_or_nan(double{number} - origin[i]);
      } else {
        numbers[i] = float32_or_nan(number);
      }
    }
    primitive = RowOf<Primitive>::primitive(numbers, material);
    all_valid &= is_valid(primitive);
    rows += columns * sizeof(Number);
  }
  return all_valid;
}

/// The refusal of the first bad one among these rows.
template <class Primitive>
Status RowDecoder<Primitive>::explain(const unsigned char* rows, std::uint64_t first,
                                      std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto problem = find_problem_in(rows + i * layout_.bytes())) {
      return Diagnostic::of("row " + std::to_string(first + i) + ": " + *problem);
    }
  }
  return {};
}

/// What is wrong with the primitive of one row, in words.
template <class Primitive>
std::optional<std::string> RowDecoder<Primitive>::find_problem_in(const unsigned char* row) const {
  const auto read = numbers_of(row, layout_, request_);
  float numbers[full];
  for (std::size_t i = 0; i < full; ++i) {
    const auto number = to_float32(read[i] - origin_[i]);
    if (!number)
      return std::string(RowOf<Primitive>::names[i]) + " is too large for a 32-bit float";
    numbers[i] = *number;
  }
  const auto problem = find_problem(RowOf<Primitive>::primitive(numbers, {}));
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

/// Calls act(begin, end) for pieces of so many rows; the first error in their order.
template <class Act>
Status in_pieces(std::size_t rows, std::size_t rows_per_piece, const ParallelFor& parallel_for,
                 const Act& act) {
  std::vector<Status> pieces((rows + rows_per_piece - 1) / rows_per_piece);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const std::size_t row = i * rows_per_piece;
    pieces[i] = act(row, std::min(row + rows_per_piece, rows));
  });
  const auto wrong =
      std::find_if(pieces.begin(), pieces.end(), [](const Status& piece) { return !piece; });
  return wrong == pieces.end() ? Status() : *wrong;
}

/// The same for all rows, of which threads read a piece each.
template <class Take>
Status read_rows(const InputFile& file, const RowLayout& layout, const ParallelFor& parallel_for,
                 const Take& take) {
  return in_pieces(
      static_cast<std::size_t>(layout.rows), std::size_t{1} << 16, parallel_for,
      [&](std::size_t row, std::size_t end) { return read_piece(file, layout, row, end, take); });
}

/// A file of primitives that is open.
struct OpenRows {
  InputFile file;
  RowLayout layout;
};

/// Opens a file whose primitives fit into memory beside so many others.
template <class Primitive>
Result<OpenRows> open_rows(const NpyPrimitives<Primitive>& request, std::uint64_t others) {
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
  using Row = RowOf<Primitive>;
  if (auto done =
          check_memory(Row::bytes_prepared(others + rows) - Row::bytes(others),
                       std::to_string(rows) + " " + PrimitiveKind<Primitive>::plural + " need");
      !done) {
    return named(done.error());
  }
  return OpenRows{std::move(file).value(), layout.value()};
}

template <class Primitive>
Status append_rows(const NpyPrimitives<Primitive>& request, std::vector<Primitive>& primitives,
                   const ParallelFor& parallel_for) {
  const std::size_t before = primitives.size();
  const auto opened = open_rows(request, before);
  if (!opened) return opened.error();
  const auto& [file, layout] = opened.value();
  append_blank(primitives, static_cast<std::size_t>(layout.rows), parallel_for);
  const RowDecoder decoder(layout, request);
  const auto decode = [&](const unsigned char* rows, std::size_t row, std::size_t count) {
    return decoder.decode(rows, row, std::span(primitives).subspan(before + row, count));
  };
  if (auto done = read_rows(file, layout, parallel_for, decode); !done) {
    primitives.resize(before);
    done.error().file = request.path;
    return done;
  }
  return {};
}

template <class Primitive>
SphereExtent extent_of_rows(const NpyPrimitives<Primitive>& request,
                            const ParallelFor& parallel_for) {
  SphereExtent all;
  const auto opened = open_rows(request, 0);
  if (!opened) return all;
  const RowLayout& layout = opened.value().layout;
  std::mutex mutex;
  const auto take = [&](const unsigned char* rows, std::size_t, std::size_t count) -> Status {
    const SphereExtent some =
        boule::extent_of(count, serial_for, [&](std::size_t i, SphereExtent& extent) {
          const auto numbers = numbers_of(rows + i * layout.bytes(), layout, request);
          for (std::size_t at = 0; at + 1 < numbers.size(); at += 3)
            extent.add({numbers[at], numbers[at + 1], numbers[at + 2]}, numbers.back());
        });
    const std::lock_guard lock(mutex);
    all.add(some);
    return {};
  };
  return read_rows(opened.value().file, layout, parallel_for, take) ? all : SphereExtent{};
}

}  // namespace

Status append_spheres(const NpySpheres& request, std::vector<Sphere>& spheres,
                      const ParallelFor& parallel_for) {
  return append_rows(request, spheres, parallel_for);
}

Status append_capsules(const NpyCapsules& request, std::vector<Capsule>& capsules,
                       const ParallelFor& parallel_for) {
  return append_rows(request, capsules, parallel_for);
}

Status decode_spheres(const unsigned char* rows, std::size_t width, std::uint64_t first,
                      const Vec3d& origin, std::span<Sphere> spheres,
                      const ParallelFor& parallel_for) {
  constexpr std::size_t piece = 16'384;
  const RowLayout layout{.width = width};
  NpySpheres request;
  request.origin = origin;
  const RowDecoder decoder(layout, request);
  return in_pieces(spheres.size(), piece, parallel_for, [&](std::size_t begin, std::size_t end) {
    return decoder.decode(rows + begin * layout.bytes(), first + begin,
                          spheres.subspan(begin, end - begin));
  });
}

SphereExtent extent_of(const NpySpheres& request, const ParallelFor& parallel_for) {
  return extent_of_rows(request, parallel_for);
}

SphereExtent extent_of(const NpyCapsules& request, const ParallelFor& parallel_for) {
  return extent_of_rows(request, parallel_for);
}

}  // namespace boule
