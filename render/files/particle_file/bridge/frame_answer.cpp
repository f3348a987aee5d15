#include "render/files/particle_file/bridge/frame_answer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "render/files/particle_file/frame/frame_check.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are read as they are");

constexpr std::size_t longest_line = 1 << 16;
constexpr std::size_t most_lines = 1 << 14;

/// A column that an answer announces.
struct ColumnLine {
  enum class Kind { number, text, species, bonds } kind = Kind::number;
  std::uint64_t texts = 0, bytes = 0;  ///< of texts; of bonds, which have 8 bytes each
  std::string name;
};

/// The lines of an answer to the request of a frame.
struct FrameLines {
  std::uint64_t particles = 0;
  bool has_positions = false;
  std::vector<ColumnLine> columns;
};

Diagnostic not_understood(std::string_view line) {
  return Diagnostic::of("the answer of boule-read is not understood: " + quote(line));
}

/// The first word of a line, which is removed from it.
std::string_view take_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

/// Finite numbers, as many as are wanted; none if the line is another.
std::optional<std::vector<double>> numbers_in(std::string_view line, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(line)) {
    const auto number = number_in(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

bool read_cell(std::string_view line, ParticleFrame& frame) {
  const auto n = numbers_in(line, 12);
  if (!n) return false;
  const auto edge = [&](std::size_t i) { return Vec3d{(*n)[i], (*n)[i + 1], (*n)[i + 2]}; };
  frame.cell = {.a = edge(0), .b = edge(3), .c = edge(6), .origin = edge(9)};
  return true;
}

bool read_periodic(std::string_view line, ParticleFrame& frame) {
  const auto along = numbers_in(line, 3);
  if (!along || !frame.cell) return false;
  for (std::size_t i = 0; i < 3; ++i) frame.cell->periodic.at(i) = (*along)[i] != 0;
  return true;
}

bool read_column(std::string_view kind, std::string_view line, FrameLines& lines) {
  ColumnLine column;
  if (kind != "number") {
    column.kind = kind == "text" ? ColumnLine::Kind::text : ColumnLine::Kind::species;
    const auto texts = count_in(take_word(line)), bytes = count_in(take_word(line));
    if (!texts || !bytes || *texts > *bytes) return false;  // each text ends with a byte
    column.texts = *texts;
    column.bytes = *bytes;
  }
  column.name = line;
  lines.columns.push_back(std::move(column));
  return true;
}

bool read_bonds(std::string_view line, FrameLines& lines) {
  const auto count = count_in(line);
  if (!count || *count > UINT64_MAX / 64) return false;
  lines.columns.push_back(
      {ColumnLine::Kind::bonds, *count, *count * 2 * sizeof(std::uint32_t), {}});
  return true;
}

/// One line of an answer; false if it is none.
bool read_fact(std::string_view line, FrameLines& lines, ParticleFrame& frame) {
  const std::string_view word = take_word(line);
  if (word == "number" || word == "text" || word == "species") {
    return read_column(word, line, lines);
  }
  if (word == "bonds") return read_bonds(line, lines);
  if (word == "positions") return lines.has_positions = true;
  if (word == "cell") return read_cell(line, frame);
  if (word == "periodic") return read_periodic(line, frame);
  if (word == "note" || word == "unread") {
    (word == "note" ? frame.notes : frame.unread).emplace_back(line);
    return true;
  }
  if (word == "particles") {
    const auto count = count_in(line);
    lines.particles = count.value_or(0);
    return count.has_value();
  }
  const auto number = numbers_in(line, 1);
  if (!number) return false;
  if (word == "time") frame.time = number->front();
  if (word == "angstrom") frame.length_in_angstrom = number->front();
  return word == "time" || (word == "angstrom" && frame.length_in_angstrom > 0);
}

/// An error if what is promised takes more memory than there is.
Status check_promise(const FrameLines& lines) {
  std::uint64_t each = sizeof(Vec3d), rest = 0;
  const auto add = [](std::uint64_t a, std::uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
  };
  for (const ColumnLine& column : lines.columns) {
    if (column.kind == ColumnLine::Kind::bonds) {
      rest = add(rest, column.bytes * 2);
      continue;
    }
    each += column.kind == ColumnLine::Kind::number ? sizeof(double) : sizeof(std::uint32_t);
    rest = add(rest, column.bytes > UINT64_MAX / 64 ? UINT64_MAX : column.bytes * 64);
  }
  const std::uint64_t all =
      lines.particles > UINT64_MAX / each ? UINT64_MAX : lines.particles * each;
  return check_memory(add(all, rest), std::to_string(lines.particles) + " particles need");
}

/// Reads the blocks of an answer.
class Blocks {
 public:
  Blocks(ChildProcess& process, const FrameLines& lines, const ParticleFileOptions& options,
         ParticleFrame& frame)
      : process_(process), lines_(lines), options_(options), frame_(frame) {}

  Status read() {
    frame_.positions.resize(count());
    if (lines_.has_positions) {
      if (auto done = process_.read(frame_.positions.data(), count() * sizeof(Vec3d)); !done)
        return done;
    }
    for (const ColumnLine& column : lines_.columns) {
      if (auto done = read_column_of(column); !done) return done;
    }
    return {};
  }

 private:
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(lines_.particles); }

  Status read_column_of(const ColumnLine& line) {
    if (line.kind == ColumnLine::Kind::number) return read_numbers(line);
    return line.kind == ColumnLine::Kind::bonds ? read_bonded(line) : read_texts(line);
  }

  /// They are all that there are.
  Status read_bonded(const ColumnLine& line) {
    std::vector<ParticleBond> bonds(static_cast<std::size_t>(line.texts));
    static_assert(sizeof(ParticleBond) == 2 * sizeof(std::uint32_t));
    if (auto done = process_.read(bonds.data(), bonds.size() * sizeof(ParticleBond)); !done)
      return done;
    const bool are_right = std::all_of(bonds.begin(), bonds.end(), [&](const ParticleBond& bond) {
      return bond.a < count() && bond.b < count();
    });
    if (!are_right) return not_understood("bonds");
    if (count() > options_.most_bonded) return {};
    frame_.bonds = std::move(bonds);
    frame_.lists_all_bonds = true;
    put_in_order(frame_.bonds);
    return {};
  }

  Status read_numbers(const ColumnLine& line) {
    NumberColumn column{line.name, std::vector<double>(count())};
    if (auto done = process_.read(column.values.data(), count() * sizeof(double)); !done)
      return done;
    if (!is_free_name(frame_, line.name)) return {};
    if (is_wanted(options_.wanted, line.name)) {
      frame_.numbers.push_back(std::move(column));
    } else {
      frame_.unread.push_back(line.name);
    }
    return {};
  }

  /// Texts are kept, wanted or not: they may tell the elements.
  Status read_texts(const ColumnLine& line) {
    std::string bytes(static_cast<std::size_t>(line.bytes), '\0');
    TextColumn column{line.name, {}, std::vector<std::uint32_t>(count())};
    if (auto done = process_.read(bytes.data(), bytes.size()); !done) return done;
    if (auto done = process_.read(column.indices.data(), count() * sizeof(std::uint32_t)); !done)
      return done;
    for (std::string_view rest = bytes; !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
      column.texts.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end + 1);
    }
    const auto& indices = column.indices;
    const bool are_right = std::all_of(indices.begin(), indices.end(), [&](std::uint32_t index) {
      return index < column.texts.size();
    });
    if (column.texts.size() != line.texts || !are_right) return not_understood(line.name);
    if (line.kind == ColumnLine::Kind::species) {
      frame_.species = std::move(column);
    } else if (is_free_name(frame_, line.name)) {
      frame_.texts.push_back(std::move(column));
    }
    return {};
  }

  ChildProcess& process_;
  const FrameLines& lines_;
  const ParticleFileOptions& options_;
  ParticleFrame& frame_;
};

/// The next line; "error TEXT" gives that error, and the empty line behind it is read.
struct Line {
  Result<std::string> text;
  bool is_told = false;  ///< the error is boule-read's own
};

Line next_line(ChildProcess& process) {
  auto line = process.read_line(longest_line);
  if (!line || !line.value().starts_with("error ")) return {std::move(line)};
  const auto end = process.read_line(longest_line);
  return {Diagnostic::of(printable(line.value().substr(6), 600)), end && end.value().empty()};
}

}  // namespace

Result<BridgeHead> read_head(ChildProcess& process) {
  BridgeHead head;
  auto first = next_line(process);
  if (!first.text) return first.text.error();
  if (first.text.value() != "boule-read 1") return not_understood(first.text.value());
  for (std::size_t i = 0; i < most_lines; ++i) {
    const auto line = next_line(process).text;
    if (!line) return line.error();
    std::string_view rest = line.value();
    if (rest.empty()) return head;
    const std::string_view word = take_word(rest);
    const auto count = count_in(rest);
    if (word == "library") {
      head.library = printable(rest, 100);
    } else if (word == "frames" && count && *count <= std::numeric_limits<int>::max()) {
      head.frames = static_cast<std::size_t>(*count);
    } else {
      return not_understood(line.value());
    }
  }
  return not_understood("too many lines");
}

BridgeAnswer<ParticleFrame> read_frame(ChildProcess& process, const ParticleFileOptions& options) {
  FrameLines lines;
  ParticleFrame frame;
  for (std::size_t i = 0;; ++i) {
    const auto line = next_line(process);
    if (!line.text) return {line.text.error(), line.is_told};
    if (line.text.value().empty()) break;
    if (i == most_lines || !read_fact(line.text.value(), lines, frame))
      return {not_understood(line.text.value())};
  }
  if (auto done = check_promise(lines); !done) return {done.error()};
  Blocks blocks(process, lines, options, frame);
  if (auto done = blocks.read(); !done) return {done.error()};
  if (auto done = check_values(frame, options.lenient); !done) return {done.error(), true};
  if (!lines.has_positions && options.places_matter) {
    return {Diagnostic::of("it has no positions: it is a topology (--topology) of other files"),
            true};
  }
  return {std::move(frame), true};
}

}  // namespace boule
