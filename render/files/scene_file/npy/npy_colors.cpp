#include "render/files/scene_file/npy/npy_colors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/math/srgb.h"
#include "core/scene/number_text.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_header.h"
#include "render/files/file/npy_rows.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

template <class Number>
double number_at(const unsigned char* bytes) {
  return static_cast<double>(npy_number<Number>(bytes));
}

double byte_at(const unsigned char* bytes) { return static_cast<double>(*bytes); }

/// A type of numbers, as headers name it.
struct NumberType {
  std::string_view descr;
  std::size_t width;
  double (*read)(const unsigned char* bytes);
};

constexpr std::array number_types{NumberType{"<f4", 4, number_at<float>},
                                  NumberType{"<f8", 8, number_at<double>},
                                  NumberType{"|u1", 1, byte_at},
                                  NumberType{"<i4", 4, number_at<std::int32_t>},
                                  NumberType{"<u4", 4, number_at<std::uint32_t>},
                                  NumberType{"<i8", 8, number_at<std::int64_t>},
                                  NumberType{"<u8", 8, number_at<std::uint64_t>}};

Diagnostic row_error(std::uint64_t row, const std::string& message) {
  return Diagnostic::of("row " + std::to_string(row) + ": " + message);
}

/// A file of `rows` rows of numbers, read block by block.
class NumberRows {
 public:
  static Result<NumberRows> open(const std::string& path, std::size_t rows, std::size_t columns,
                                 const char* of_each);

  [[nodiscard]] bool holds_bytes() const { return type_.width == 1; }
  [[nodiscard]] bool holds_floats() const { return type_.descr[1] == 'f'; }

  /// Calls take(row, numbers), `columns` of them, for each row in order; the first error ends it.
  Status visit(const std::function<Status(std::size_t, const double*)>& take);

 private:
  NumberRows(InputFile file, NumberType type, std::size_t rows, std::size_t columns)
      : file_(std::move(file)), type_(type), rows_(rows), columns_(columns) {}

  InputFile file_;
  NumberType type_;
  std::size_t rows_, columns_;
};

/// Refuses another shape than rows x columns; of one column also that of a plain list.
Status check_shape(const NpyHeader& header, std::size_t rows, std::size_t columns,
                   const char* of_each) {
  const auto& shape = header.shape;
  const bool is_list = columns == 1 && shape.size() == 1;
  const bool is_table = shape.size() == 2 && shape[1] == columns;
  if ((is_list || is_table) && shape[0] == rows) return {};
  const std::string count = std::to_string(rows);
  return Diagnostic::of("has shape " + npy_shape_text(header) + ", expected (" + count +
                        (columns == 1 ? ",)" : ", " + std::to_string(columns) + ")") +
                        ": a row for each " + of_each);
}

Result<NumberRows> NumberRows::open(const std::string& path, std::size_t rows, std::size_t columns,
                                    const char* of_each) {
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const auto header = read_npy_header(file.value());
  if (!header) return header.error();
  const auto type = std::find_if(number_types.begin(), number_types.end(), [&](const auto& known) {
    return known.descr == header.value().descr;
  });
  if (type == number_types.end()) {
    return Diagnostic::of("holds " + quote(header.value().descr) +
                          ", expected float32, float64, uint8 or whole numbers of 32 or 64 bits");
  }
  if (header.value().fortran_order && columns > 1) {
    return Diagnostic::of("is in Fortran order, expected C order (row by row)");
  }
  if (auto done = check_shape(header.value(), rows, columns, of_each); !done) return done.error();
  if (auto done = check_npy_length(header.value(), columns * type->width, file.value().size());
      !done) {
    return done.error();
  }
  return NumberRows(std::move(file).value(), *type, rows, columns);
}

Status NumberRows::visit(const std::function<Status(std::size_t, const double*)>& take) {
  constexpr std::size_t rows_per_block = 4096;
  const std::size_t row_bytes = columns_ * type_.width;
  std::vector<unsigned char> block(rows_per_block * row_bytes);
  std::vector<double> numbers(columns_);
  for (std::size_t first = 0; first < rows_; first += rows_per_block) {
    const std::size_t count = std::min(rows_per_block, rows_ - first);
    if (auto done = read_npy_rows(file_, block.data(), count * row_bytes); !done) return done;
    const unsigned char* next = block.data();
    for (std::size_t row = first; row < first + count; ++row) {
      for (double& number : numbers) {
        number = type_.read(next);
        next += type_.width;
      }
      if (auto done = take(row, numbers.data()); !done) return done;
    }
  }
  return {};
}

}  // namespace

std::optional<std::uint8_t> color_code(double number, ColorSpace space) {
  if (!(number >= 0 && number <= 1)) return std::nullopt;
  if (space == ColorSpace::linear) return SrgbTable::get().code(static_cast<float>(number));
  return static_cast<std::uint8_t>(std::lround(number * 255));
}

Status color_by_npy(const std::string& path, ColorSpace space, const MaterialRows& materials) {
  auto rows = NumberRows::open(path, materials.count, 3, materials.of_each);
  if (!rows) return rows.error();
  const bool holds_bytes = rows.value().holds_bytes();
  if (!holds_bytes && !rows.value().holds_floats()) {
    return Diagnostic::of("holds whole numbers, expected uint8 from 0 to 255, or floats");
  }
  if (holds_bytes && space == ColorSpace::linear) {
    return Diagnostic::of("holds uint8, which are sRGB codes: linear colours must be floats");
  }
  return rows.value().visit([&](std::size_t row, const double* rgb) -> Status {
    std::array<std::uint8_t, 3> codes{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto code = color_code(holds_bytes ? rgb[i] / 255 : rgb[i], space);
      if (!code) return row_error(row, "must be from 0 to 1, is " + number_text(rgb[i]));
      codes[i] = *code;
    }
    MaterialRef& material = materials.at(row);
    material = MaterialRef::colored(material.index(), {codes[0], codes[1], codes[2]});
    return {};
  });
}

Result<std::vector<double>> read_npy_scalars(const std::string& path, std::size_t count,
                                             const char* of_each) {
  auto rows = NumberRows::open(path, count, 1, of_each);
  if (!rows) return rows.error();
  if (auto done = check_memory(std::uint64_t{count} * sizeof(double),
                               std::to_string(count) + " numbers need");
      !done) {
    return done.error();
  }
  std::vector<double> numbers(count);
  auto done = rows.value().visit([&](std::size_t row, const double* number) -> Status {
    if (!std::isfinite(*number)) return row_error(row, "must be finite");
    numbers[row] = *number;
    return {};
  });
  if (!done) return done.error();
  return numbers;
}

}  // namespace boule
