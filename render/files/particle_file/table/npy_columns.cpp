#include "render/files/particle_file/table/npy_columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "render/files/file/npy_rows.h"

namespace boule {
namespace {

constexpr std::uint64_t longest_row = std::uint64_t{1} << 31;
/// So many columns a row has at most: each takes memory before the file's length is compared.
constexpr std::uint64_t most_columns = std::uint64_t{1} << 17;

/// The type of a value, with its bytes.
struct ValueType {
  BinaryKind kind = BinaryKind::real;
  std::size_t width = 0;
  bool is_big_endian = false;
};

/// True if NumPy has values of this kind in so many bytes, and a double or a text can hold them.
bool is_width_of(BinaryKind kind, std::uint64_t width) {
  switch (kind) {
    case BinaryKind::real:
      return width == 2 || width == 4 || width == 8;
    case BinaryKind::integer:
    case BinaryKind::unsigned_integer:
      return width == 1 || width == 2 || width == 4 || width == 8;
    case BinaryKind::boolean:
      return width == 1;
    case BinaryKind::bytes:
    case BinaryKind::characters:
      return width >= 1 && width <= longest_row / 4;
  }
  return false;
}

std::optional<BinaryKind> kind_of(char letter) {
  constexpr std::string_view letters = "fiubSU";
  const std::size_t found = letters.find(letter);
  if (found == std::string_view::npos) return std::nullopt;
  return static_cast<BinaryKind>(found);
}

/// "<f8", "|S2", ">U4": the order of bytes, the kind, and the bytes (of U: the characters).
std::optional<ValueType> parse_type(std::string_view descr) {
  if (descr.size() < 3 || std::string_view("<>|=").find(descr[0]) == std::string_view::npos) {
    return std::nullopt;
  }
  const auto kind = kind_of(descr[1]);
  std::uint64_t width = 0;
  const char* const end = descr.data() + descr.size();
  const auto [stop, error] = std::from_chars(descr.data() + 2, end, width);
  if (!kind || error != std::errc{} || stop != end || !is_width_of(*kind, width)) {
    return std::nullopt;
  }
  const std::uint64_t bytes = *kind == BinaryKind::characters ? 4 * width : width;
  return ValueType{*kind, static_cast<std::size_t>(bytes), descr[0] == '>'};
}

/// Bytes that NumPy leaves between fields: "|V4".
std::optional<std::uint64_t> parse_gap(std::string_view descr) {
  if (!descr.starts_with("|V")) return std::nullopt;
  std::uint64_t bytes = 0;
  const char* const end = descr.data() + descr.size();
  const auto [stop, error] = std::from_chars(descr.data() + 2, end, bytes);
  if (error != std::errc{} || stop != end || bytes > longest_row) return std::nullopt;
  return bytes;
}

/// What the values of a field are called.
std::string value_name(const NpyField& field, std::uint64_t i) {
  constexpr std::array axes{"x", "y", "z"};
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), field.name) != names.end();
  };
  if (field.count == 1) return field.name;
  if (field.count != 3) return field.name + "_" + std::to_string(i + 1);
  std::string axis = axes[static_cast<std::size_t>(i)];
  if (is_one_of({"pos", "position", "positions"})) return axis;
  if (is_one_of({"vel", "velocity", "velocities"})) return "v" + axis;
  return field.name + "_" + axis;
}

Diagnostic unknown_type(const NpyField& field) {
  return Diagnostic::about(field.name,
                           "holds " + quote(field.descr) +
                               ", expected numbers (f2, f4, f8, i, u, b) or texts (S, U) of a "
                               "fixed width");
}

/// Adds the columns of one field, and its bytes to the row.
Status add_field(const NpyField& field, BinaryTable& table, std::uint64_t& row_bytes) {
  if (const auto gap = parse_gap(field.descr)) {
    row_bytes += *gap * field.count;
    return {};
  }
  const auto type = parse_type(field.descr);
  if (!type) return unknown_type(field);
  if (row_bytes + type->width * field.count > longest_row) {
    return Diagnostic::about(field.name, "makes rows longer than 2^31 bytes");
  }
  if (table.columns.size() + field.count > most_columns) {
    return Diagnostic::about(field.name,
                             "makes more than " + std::to_string(most_columns) + " columns");
  }
  for (std::uint64_t i = 0; i < field.count; ++i) {
    table.columns.push_back({value_name(field, i), type->kind, type->width,
                             static_cast<std::size_t>(row_bytes), type->is_big_endian});
    row_bytes += type->width;
  }
  return {};
}

/// The fields that rows of numbers stand for.
Result<std::vector<NpyField>> plain_fields(const NpyHeader& header,
                                           const std::vector<std::string>& names) {
  constexpr std::array usual{"x", "y", "z", "radius"};
  constexpr std::uint64_t most_plain = 4096;
  if (header.shape.size() != 2 || header.shape[1] < 3 || header.shape[1] > most_plain) {
    return Diagnostic::of("has shape " + npy_shape_text(header) +
                          ", expected (N, 3) or more columns: x, y, z, radius");
  }
  const auto count = static_cast<std::size_t>(header.shape[1]);
  if (!names.empty() && names.size() != count) {
    return Diagnostic::about("columns", "names " + std::to_string(names.size()) +
                                            " columns, the file has " + std::to_string(count));
  }
  std::vector<NpyField> fields;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = !names.empty()     ? names[i]
                             : i < usual.size() ? usual[i]
                                                : "c" + std::to_string(i + 1);
    fields.push_back({name, header.descr, 1});
  }
  return fields;
}

}  // namespace

Result<BinaryTable> npy_table(const NpyHeader& header, const std::vector<std::string>& names) {
  if (header.fortran_order) {
    return Diagnostic::of("is in Fortran order, expected C order (row by row)");
  }
  if (!header.fields.empty() && header.shape.size() != 1) {
    return Diagnostic::of("has named fields and shape " + npy_shape_text(header) +
                          ", expected one dimension");
  }
  std::vector<NpyField> fields = header.fields;
  if (fields.empty()) {
    auto plain = plain_fields(header, names);
    if (!plain) return plain.error();
    fields = std::move(plain).value();
  }
  BinaryTable table;
  std::uint64_t row_bytes = 0;
  for (const NpyField& field : fields) {
    if (auto done = add_field(field, table, row_bytes); !done) return done.error();
  }
  if (row_bytes == 0 || row_bytes > longest_row) return Diagnostic::of("has rows without values");
  table.row_bytes = static_cast<std::size_t>(row_bytes);
  table.rows = static_cast<std::size_t>(header.shape[0]);
  return table;
}

}  // namespace boule
