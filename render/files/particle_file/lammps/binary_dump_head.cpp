#include "render/files/particle_file/lammps/binary_dump_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/text.h"
#include "render/files/file/load_number.h"
#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

constexpr std::int64_t longest_format_name = 64;

Diagnostic error_at_byte(std::size_t byte, const std::string& message, std::string key = {}) {
  return Diagnostic::about(std::move(key),
                           "LAMMPS dump, byte " + std::to_string(byte) + ": " + message);
}

bool is_marker(std::int64_t step) { return step < 0 && step >= -longest_format_name; }

/// Whether the bytes at the start of a frame are big-endian: by the marker of new formats, else by
/// the count of atoms, which is small in the right order only.
bool is_big_endian_frame(std::string_view bytes) {
  if (bytes.size() < 16) return false;
  if (is_marker(load_number<std::int64_t>(bytes.data(), false))) return false;
  if (is_marker(load_number<std::int64_t>(bytes.data(), true))) return true;
  const char* const atoms = bytes.data() + 8;
  return load_number<std::uint64_t>(atoms, true) < load_number<std::uint64_t>(atoms, false);
}

/// Takes numbers from bytes. Behind the end of these all are 0, and `ended()` is true.
class DumpBytes {
 public:
  DumpBytes(std::string_view bytes, std::size_t at, bool is_big_endian)
      : bytes_(bytes), at_(at), is_big_endian_(is_big_endian) {}

  template <class T>
  T take() {
    const std::string_view number = text(sizeof(T));
    return ended_ ? T{} : load_number<T>(number.data(), is_big_endian_);
  }
  std::string_view text(std::size_t size) {
    last_ = at_;
    if (ended_ || size > bytes_.size() - at_) {
      ended_ = true;
      return {};
    }
    at_ += size;
    return bytes_.substr(last_, size);
  }

  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  /// An error about what was taken last.
  [[nodiscard]] Diagnostic wrong(const std::string& message, std::string key = {}) const {
    if (!ended_) return error_at_byte(last_, message, std::move(key));
    return error_at_byte(last_, "the file ends in the head of a frame");
  }

 private:
  std::string_view bytes_;
  std::size_t at_, last_ = 0;
  bool is_big_endian_, ended_ = false;
};

class BinaryHeadReader {
 public:
  BinaryHeadReader(std::string_view bytes, std::size_t begin)
      : bytes_(bytes, begin, is_big_endian_frame(bytes.substr(begin))) {
    head_.is_big_endian = is_big_endian_frame(bytes.substr(begin));
  }

  Result<BinaryDumpHead> read() {
    Status read = take_format();
    if (read) read = take_atoms();
    if (read) read = take_box();
    if (read) read = take_width();
    if (read && revision_ > 1) read = take_names();
    if (read) read = take_chunks();
    if (!read) return read.error();
    return std::move(head_);
  }

  /// Whether the bytes end in the head.
  [[nodiscard]] bool is_cut() const { return bytes_.ended(); }

 private:
  /// A negative number in place of the time step tells the length of the format's name.
  Status take_format() {
    const auto step = bytes_.take<std::int64_t>();
    if (bytes_.ended() || step >= 0) return {};
    if (!is_marker(step))
      return bytes_.wrong("expected a time step, found " + std::to_string(step));
    const std::string_view name = bytes_.text(static_cast<std::size_t>(-step));
    if (name != "DUMPATOM" && name != "DUMPCUSTOM") {
      return bytes_.wrong("expected DUMPATOM or DUMPCUSTOM, found " + quote(name));
    }
    const auto order = bytes_.take<std::int32_t>();
    if (order != 1)
      return bytes_.wrong("its order of bytes is unknown, expected 1, found " +
                          std::to_string(order));
    revision_ = bytes_.take<std::int32_t>();
    if (revision_ != 1 && revision_ != 2) {
      return bytes_.wrong("its revision is unknown, expected 1 or 2, found " +
                          std::to_string(revision_));
    }
    if (bytes_.take<std::int64_t>() < 0) return bytes_.wrong("the time step is below 0");
    return {};
  }

  Status take_atoms() {
    const auto atoms = bytes_.take<std::int64_t>();
    if (atoms < 0) return bytes_.wrong("it has " + std::to_string(atoms) + " particles");
    head_.atoms = static_cast<std::uint64_t>(atoms);
    return {};
  }

  Status take_box() {
    const auto kind = bytes_.take<std::int32_t>();
    if (kind < 0 || kind > 2) {
      return bytes_.wrong("expected a box of kind 0, 1 or 2, found " + std::to_string(kind),
                          "BOX BOUNDS");
    }
    std::array<bool, 3> periodic{};
    for (bool& is_periodic : periodic) {
      for (int side = 0; side < 2; ++side) {
        const auto boundary = bytes_.take<std::int32_t>();
        if (boundary < 0 || boundary > 3) {
          return bytes_.wrong("expected a boundary from 0 to 3, found " + std::to_string(boundary),
                              "BOX BOUNDS");
        }
        is_periodic = boundary == 0;
      }
    }
    auto cell = kind == 2 ? take_edges() : take_bounds(kind == 1);
    if (bytes_.ended()) return bytes_.wrong({});
    if (!cell) return cell.error();
    if (!is_finite(cell.value())) return bytes_.wrong("the box is no finite one", "BOX BOUNDS");
    head_.cell = cell.value();
    head_.cell->periodic = periodic;
    return {};
  }

  Result<ParticleCell> take_edges() {
    ParticleCell cell;
    for (Vec3d* const edge : {&cell.a, &cell.b, &cell.c, &cell.origin}) {
      for (double* const to : {&edge->x, &edge->y, &edge->z}) *to = bytes_.take<double>();
    }
    return cell;
  }

  Result<ParticleCell> take_bounds(bool is_tilted) {
    LammpsBox box;
    for (double* const to : {&box.lo.x, &box.hi.x, &box.lo.y, &box.hi.y, &box.lo.z, &box.hi.z}) {
      *to = bytes_.take<double>();
    }
    if (is_tilted) {
      for (double* const to : {&box.xy, &box.xz, &box.yz}) *to = bytes_.take<double>();
      box = box_in_bounds(box);
    }
    if (auto cell = cell_of_dump(box, 0))
      return cell;
    else
      return bytes_.wrong(cell.error().message, cell.error().key);
  }

  Status take_width() {
    const auto width = bytes_.take<std::int32_t>();
    if (width < 1 || static_cast<std::size_t>(width) > most_text_columns) {
      return bytes_.wrong("expected 1 to " + std::to_string(most_text_columns) +
                          " columns, found " + std::to_string(width));
    }
    head_.columns = static_cast<std::size_t>(width);
    return {};
  }

  /// A text behind its length.
  Result<std::string_view> take_text() {
    const auto length = bytes_.take<std::int32_t>();
    if (length < 0) return bytes_.wrong("it has a text of " + std::to_string(length) + " bytes");
    return bytes_.text(static_cast<std::size_t>(length));
  }

  Status take_names() {
    const auto units = take_text();
    if (!units) return units.error();
    if (!units.value().empty()) {
      if (!is_lammps_units(units.value())) {
        return bytes_.wrong("expected units such as lj or real, found " + quote(units.value()),
                            "UNITS");
      }
      head_.length_in_angstrom = lammps_length_in_angstrom(units.value());
    }
    const std::string_view has_time = bytes_.text(1);
    if (!has_time.empty() && has_time.front() != 0) {
      head_.time = bytes_.take<double>();
      if (!std::isfinite(*head_.time)) return bytes_.wrong("expected a finite time", "TIME");
    }
    const auto names = take_text();
    if (!names) return names.error();
    const auto words = words_of(names.value());
    if (words.size() != head_.columns) {
      return bytes_.wrong("it names " + std::to_string(words.size()) + " columns, it has " +
                          std::to_string(head_.columns));
    }
    head_.names.assign(words.begin(), words.end());
    return {};
  }

  Status take_chunks() {
    const auto chunks = bytes_.take<std::int32_t>();
    if (chunks < 1) return bytes_.wrong("it is of " + std::to_string(chunks) + " processes");
    head_.chunks = static_cast<std::uint32_t>(chunks);
    head_.first_chunk = bytes_.at();
    return {};
  }

  DumpBytes bytes_;
  BinaryDumpHead head_;
  std::int32_t revision_ = 0;
};

}  // namespace

Result<BinaryDumpHead> read_binary_dump_head(std::string_view bytes, std::size_t begin,
                                             bool* is_cut) {
  BinaryHeadReader reader(bytes, begin);
  auto head = reader.read();
  if (is_cut != nullptr && !head && reader.is_cut()) *is_cut = true;
  return head;
}

Result<std::size_t> skip_chunks(std::string_view bytes, const BinaryDumpHead& head,
                                std::vector<BinaryDumpChunk>* chunks, bool* is_cut) {
  constexpr std::uint64_t most_rows = std::uint64_t{1} << 16;
  std::size_t at = head.first_chunk;
  std::uint64_t rows = 0;
  for (std::uint32_t chunk = 0; chunk < head.chunks; ++chunk) {
    const auto ends = [&] {
      if (is_cut != nullptr) *is_cut = true;
      return error_at_byte(at, "the file ends in the particles of a frame");
    };
    if (bytes.size() - at < 4) return ends();
    const auto numbers = load_number<std::int32_t>(bytes.data() + at, head.is_big_endian);
    if (numbers < 0 || static_cast<std::size_t>(numbers) % head.columns != 0) {
      return error_at_byte(at, "a process has " + std::to_string(numbers) +
                                   " numbers, expected some for each of " +
                                   std::to_string(head.columns) + " columns");
    }
    at += 4;
    const std::size_t size = std::size_t{8} * static_cast<std::size_t>(numbers);
    if (bytes.size() - at < size) return ends();
    const std::uint64_t its = static_cast<std::size_t>(numbers) / head.columns;
    for (std::uint64_t row = 0; chunks != nullptr && row < its; row += most_rows) {
      chunks->push_back({at + 8 * head.columns * row, std::min(most_rows, its - row)});
    }
    rows += its;
    at += size;
  }
  if (rows == head.atoms) return at;
  return error_at_byte(head.first_chunk, "its processes have " + std::to_string(rows) +
                                             " particles, its head promises " +
                                             std::to_string(head.atoms));
}

}  // namespace boule
