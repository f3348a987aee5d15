#include "render/files/particle_file/table/binary_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>

#include "render/files/file/load_number.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

/// Values of a column that follow each other, and where their numbers go.
struct Run {
  const char* from;
  std::size_t from_stride;  ///< bytes
  double* to;
  std::size_t to_stride;  ///< doubles
  std::size_t count;
};

template <class T, bool is_big_endian>
void convert(const Run& run, double divisor) {
  const char* from = run.from;
  double* to = run.to;
  for (std::size_t i = 0; i < run.count; ++i, from += run.from_stride, to += run.to_stride) {
    *to = static_cast<double>(load_number<T>(from, is_big_endian)) / divisor;
  }
}

/// A float of 16 bits (IEEE 754 binary16): 1 of sign, 5 of power, 10 of fraction. Every one of them
/// is a double.
double half_number(std::uint16_t bits) {
  const int power = bits >> 10 & 0x1F;
  const double fraction = bits & 0x3FF;
  double size = std::ldexp(fraction, -24);  // below the least normal one
  if (power == 0x1F) {
    size = fraction == 0 ? std::numeric_limits<double>::infinity()
                         : std::numeric_limits<double>::quiet_NaN();
  } else if (power > 0) {
    size = std::ldexp(fraction + 0x400, power - 25);
  }
  return (bits & 0x8000) != 0 ? -size : size;
}

template <bool is_big_endian>
void convert_halves(const Run& run, double divisor) {
  const char* from = run.from;
  double* to = run.to;
  for (std::size_t i = 0; i < run.count; ++i, from += run.from_stride, to += run.to_stride) {
    *to = half_number(load_number<std::uint16_t>(from, is_big_endian)) / divisor;
  }
}

using Convert = void (*)(const Run&, double);

/// Index: the logarithm of the width. Booleans are one byte.
template <bool is_big_endian>
Convert convert_of(const BinaryColumn& column) {
  constexpr bool big = is_big_endian;
  const auto size = static_cast<std::size_t>(std::bit_width(column.width) - 1);
  constexpr std::array<Convert, 4> reals{nullptr, convert_halves<big>, convert<float, big>,
                                         convert<double, big>};
  constexpr std::array<Convert, 4> integers{convert<std::int8_t, big>, convert<std::int16_t, big>,
                                            convert<std::int32_t, big>, convert<std::int64_t, big>};
  constexpr std::array<Convert, 4> naturals{convert<std::uint8_t, big>, convert<std::uint16_t, big>,
                                            convert<std::uint32_t, big>,
                                            convert<std::uint64_t, big>};
  if (column.kind == BinaryKind::real) return reals[size];
  return column.kind == BinaryKind::integer ? integers[size] : naturals[size];
}

/// Appends a character in UTF-8.
void append_utf8(std::string& text, std::uint32_t c) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | (c >> 18 & 0x07));
    put(0x80 | (c >> 12 & 0x3F));
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

/// A text as NumPy stores it: filled up with zeros.
std::string text_at(const char* bytes, const BinaryColumn& column) {
  std::string text;
  if (column.kind == BinaryKind::bytes) {
    text.assign(bytes, column.width);
    text.resize(text.find_last_not_of('\0') + 1);  // npos + 1 is 0
    return text;
  }
  for (std::size_t i = 0; i < column.width; i += 4) {
    const auto c = load_number<std::uint32_t>(bytes + i, column.is_big_endian);
    if (c == 0) break;
    append_utf8(text, c);
  }
  return text;
}

/// 0, 1, 2 for "x", "y", "z".
std::optional<std::size_t> axis_of(const std::string& name) {
  if (name.size() != 1 || name[0] < 'x' || name[0] > 'z') return std::nullopt;
  return static_cast<std::size_t>(name[0] - 'x');
}

bool is_species_name(const std::string& name) {
  return name == "species" || is_atomic_number_name(name);
}

/// A column of numbers on its way into the frame.
struct NumberTask {
  const BinaryColumn* column;
  Convert convert;
  double* first;
  std::size_t stride;
};

class BinaryTableReader {
 public:
  BinaryTableReader(const BinaryTable& table, const char* first_row,
                    const ParticleFileOptions& options)
      : table_(table), first_row_(first_row), options_(options) {}

  Result<ParticleFrame> read(const ParallelFor& parallel_for) {
    if (auto done = check_room(); !done) return done.error();
    frame_.positions.resize(table_.rows);
    frame_.numbers.reserve(table_.columns.size());  // tasks point into it
    for (const BinaryColumn& column : table_.columns) add_column(column);
    if (auto done = read_numbers(parallel_for); !done) return done.error();
    take_atomic_numbers_as_species();
    take_types_as_species(frame_, true);
    return std::move(frame_);
  }

 private:
  /// A number that is not finite: its row, and its column among the tasks.
  using Place = std::pair<std::size_t, std::size_t>;

  [[nodiscard]] bool is_kept(const BinaryColumn& column) const {
    return column.name == "type" || is_species_name(column.name) ||
           is_wanted(options_.wanted, column.name);
  }

  void take_atomic_numbers_as_species() {
    for (const NumberColumn& column : frame_.numbers) {
      if (frame_.species || !is_atomic_number_name(column.name)) continue;
      TextColumn species = texts_of(column);
      if (take_atomic_numbers(species)) frame_.species = std::move(species);
    }
  }

  [[nodiscard]] Status check_room() const {
    std::size_t row = 0;
    for (const BinaryColumn& column : table_.columns) {
      if (!axis_of(column.name) && !is_kept(column)) continue;
      row += column.is_text() ? sizeof(std::uint32_t) : sizeof(double);
    }
    return check_memory(std::uint64_t{row} * table_.rows,
                        "reading " + std::to_string(table_.rows) + " particles needs");
  }

  void add_column(const BinaryColumn& column) {
    const auto axis = axis_of(column.name);
    if (!axis && !is_kept(column)) return frame_.unread.push_back(column.name);
    if (column.is_text()) return read_texts(column);
    NumberTask task{&column, nullptr, nullptr, 1};
    task.convert = column.is_big_endian ? convert_of<true>(column) : convert_of<false>(column);
    if (axis) {
      Vec3d* const first = frame_.positions.data();
      if (first != nullptr) task.first = std::array{&first->x, &first->y, &first->z}[*axis];
      task.stride = 3;
    } else {
      NumberColumn& numbers = frame_.numbers.emplace_back(NumberColumn{column.name, {}});
      numbers.values.resize(table_.rows);
      task.first = numbers.values.data();
    }
    tasks_.push_back(task);
  }

  void read_texts(const BinaryColumn& column) {
    const bool first_species = is_species_name(column.name) && !frame_.species;
    TextColumn& texts = first_species ? frame_.species.emplace() : frame_.texts.emplace_back();
    texts.name = column.name;
    texts.indices.resize(table_.rows);
    std::map<std::string, std::uint32_t> known;
    const char* at = first_row_ + column.offset;
    const char* last = nullptr;
    for (std::size_t row = 0; row < table_.rows; ++row, at += table_.row_bytes) {
      if (last != nullptr && std::memcmp(at, last, column.width) == 0) {
        texts.indices[row] = texts.indices[row - 1];
        continue;
      }
      last = at;
      const auto next = static_cast<std::uint32_t>(texts.texts.size());
      const auto [found, is_new] = known.try_emplace(text_at(at, column), next);
      if (is_new) texts.texts.push_back(found->first);
      texts.indices[row] = found->second;
    }
  }

  /// Reads the rows of a column from `begin` to `end` and lowers `worst` to the first number in
  /// them that is not finite.
  void read_run(std::size_t task_index, std::size_t begin, std::size_t end, Place& worst) const {
    const NumberTask& task = tasks_[task_index];
    const BinaryColumn& column = *task.column;
    double* const to = task.first + begin * task.stride;
    const char* const from = first_row_ + begin * table_.row_bytes + column.offset;
    task.convert({from, table_.row_bytes, to, task.stride, end - begin}, column.divisor);
    const bool is_position = task.stride == 3;
    if (column.kind != BinaryKind::real || (options_.lenient && !is_position)) return;
    for (std::size_t row = begin; row < end; ++row) {
      const double number = to[(row - begin) * task.stride];
      if (std::isfinite(number) || (std::isnan(number) && !is_position)) continue;
      worst = std::min(worst, {row, task_index});
      return;
    }
  }

  /// Few rows at a time, so that they stay in the cache for all columns.
  Status read_numbers(const ParallelFor& parallel_for) {
    constexpr std::size_t chunk = std::size_t{1} << 16, few = std::size_t{1} << 10;
    Place worst{table_.rows, 0};
    std::mutex mutex;
    parallel_for((table_.rows + chunk - 1) / chunk, [&](std::size_t part) {
      const std::size_t end = std::min(table_.rows, (part + 1) * chunk);
      Place bad{table_.rows, 0};
      for (std::size_t begin = part * chunk; begin < end; begin += few) {
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
          read_run(i, begin, std::min(end, begin + few), bad);
        }
      }
      const std::scoped_lock lock(mutex);
      worst = std::min(worst, bad);
    });
    if (worst.first == table_.rows) return {};
    return Diagnostic::about(tasks_[worst.second].column->name,
                             "row " + std::to_string(worst.first) + ": must be finite");
  }

  const BinaryTable& table_;
  const char* first_row_;
  const ParticleFileOptions& options_;
  ParticleFrame frame_;
  std::vector<NumberTask> tasks_;
};

}  // namespace

Status check_binary_columns(const BinaryTable& table) {
  std::map<std::string_view, bool> is_text;
  for (const BinaryColumn& column : table.columns) {
    if (!is_text.try_emplace(column.name, column.is_text()).second) {
      return Diagnostic::about(column.name, "two columns have the name " + quote(column.name));
    }
  }
  for (const char* axis : {"x", "y", "z"}) {
    const auto found = is_text.find(axis);
    if (found != is_text.end() && !found->second) continue;
    return Diagnostic::about(axis, std::string("there is no column of positions for ") + axis);
  }
  return {};
}

Result<ParticleFrame> read_binary_table(const BinaryTable& table, const char* first_row,
                                        const ParticleFileOptions& options,
                                        const ParallelFor& parallel_for) {
  return BinaryTableReader(table, first_row, options).read(parallel_for);
}

}  // namespace boule
