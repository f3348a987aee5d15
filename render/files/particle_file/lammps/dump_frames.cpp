#include "render/files/particle_file/lammps/dump_frames.h"

#include <optional>
#include <string>
#include <utility>

#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/text/frame_places.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

constexpr std::string_view item = "ITEM: ";

enum class Item { timestep, count, box, time, units, atoms, other };
constexpr std::size_t items = 7;

Item item_of(std::string_view header) {
  const std::string_view name = header.substr(item.size());
  if (name.starts_with("TIMESTEP")) return Item::timestep;
  if (name.starts_with("NUMBER OF ATOMS")) return Item::count;
  if (name.starts_with("BOX BOUNDS")) return Item::box;
  if (name.starts_with("TIME")) return Item::time;
  if (name.starts_with("UNITS")) return Item::units;
  if (name.starts_with("ATOMS")) return Item::atoms;
  return Item::other;
}

class DumpFrameFinder {
 public:
  explicit DumpFrameFinder(std::string_view text) : text_(text), lines_(text) {}

  Result<DumpFrames> run() {
    Status read;
    for (lines_.skip_blank_lines(); read && !lines_.at_end(); lines_.skip_blank_lines()) {
      read = section();
    }
    if (read) read = find_cut_row();
    if (read) read = finish_frame();
    if (!read && !is_cut(read.error())) return read.error();
    found_.whole = std::move(read);
    return std::move(found_);
  }

 private:
  /// An error at the end of the file is of a frame that was cut off, if there is a whole one
  /// before.
  bool is_cut(const Diagnostic& wrong) {
    if (!lines_.at_end() || is_no_item_) return false;
    const bool is_whole =
        frame_.atoms.exists() && wrong.line >= place_number(frame_.atoms.end_line());
    if (is_whole && !finish_frame()) return false;
    return !found_.frames.empty();
  }

  /// The last row of the last frame may be a part of one.
  Status find_cut_row() const {
    const DumpSection& atoms = frame_.atoms;
    if (found_.frames.empty() || !atoms.exists() || atoms.rows == 0) return {};
    const std::size_t like = atoms.rows > 1 ? atoms.begin : found_.frames.back().atoms.begin;
    const std::string_view rows = text_.substr(atoms.begin, atoms.end - atoms.begin);
    if (atoms.end < text_.size() || !has_cut_row(rows, TextLines(text_.substr(like)).next())) {
      return {};
    }
    return error_at_line(atoms.end_line() - 1, "the file ends in the last row of its atoms");
  }

  Status section() {
    DumpSection section{.header = lines_.offset()};
    const std::uint64_t header_line = lines_.line();
    const std::string_view header = lines_.next();
    if (!header.starts_with(item)) {
      is_no_item_ = !item.starts_with(header);
      return error_at_line(header_line, "expected ITEM: and its name, found " + quote(header));
    }
    const Item kind = item_of(header);
    bool& seen = seen_[static_cast<std::size_t>(kind)];
    if (seen && kind != Item::other) {
      if (auto done = finish_frame(); !done) return done;
    }
    seen = true;
    if (kind == Item::other && lines_.at_end() && !text_.ends_with('\n')) {
      return error_at_line(header_line, "the file ends in this header");
    }
    section.begin = lines_.offset();
    section.line = lines_.line();
    if (auto done = skip_rows(kind, header_line, section); !done) return done;
    section.end = lines_.offset();
    return keep(kind, section);
  }

  /// Skips the lines of a section: as many as it must have, else up to the next "ITEM: ".
  Status skip_rows(Item kind, std::uint64_t header_line, DumpSection& section) {
    std::optional<std::uint64_t> expected;
    if (kind == Item::atoms) expected = count_;
    if (kind == Item::box) expected = 3;
    if (kind == Item::timestep || kind == Item::count || kind == Item::time ||
        kind == Item::units) {
      expected = 1;
    }
    if (expected) {
      section.rows = lines_.skip(*expected);
    } else {
      for (; !lines_.at_end() && !lines_.peek().starts_with(item); ++section.rows) lines_.skip(1);
    }
    if (!expected || section.rows == *expected) return {};
    return error_at_line(header_line, "it needs " + std::to_string(*expected) +
                                          " lines below, the file ends after " +
                                          std::to_string(section.rows));
  }

  Status keep(Item kind, const DumpSection& section) {
    const std::string_view line = TextLines(text_.substr(section.begin)).next();
    if (kind == Item::count) {
      const auto words = words_of(line);
      count_ = words.size() == 1 ? count_in(words.front()) : std::nullopt;
      if (!count_) {
        return error_at_line(section.line, "expected a count of atoms, found " + quote(line),
                             "NUMBER OF ATOMS");
      }
    } else if (kind == Item::units) {
      const auto words = words_of(line);
      if (words.size() != 1 || !is_lammps_units(words.front())) {
        return error_at_line(
            section.line,
            "expected lj, real, metal, si, cgs, electron, micro or nano, found " + quote(line),
            "UNITS");
      }
      found_.length_in_angstrom = lammps_length_in_angstrom(words.front());
    } else if (kind == Item::box) {
      frame_.box = section;
    } else if (kind == Item::time) {
      frame_.time = section;
    } else if (kind == Item::atoms) {
      frame_.atoms = section;
    }
    return {};
  }

  Status finish_frame() {
    if (!frame_.atoms.exists()) {
      return error_at_line(lines_.line() - (lines_.at_end() ? 0 : 1),
                           "the frame ends here and has no ITEM: ATOMS");
    }
    if (count_ && *count_ != frame_.atoms.rows) {
      return error_at_line(frame_.atoms.line,
                           "it has " + std::to_string(frame_.atoms.rows) +
                               " atoms, NUMBER OF ATOMS says " + std::to_string(*count_),
                           "NUMBER OF ATOMS");
    }
    if (auto done = add_frame_place(found_.frames, frame_); !done) return done;
    frame_ = {};
    count_.reset();
    for (bool& seen : seen_) seen = false;
    return {};
  }

  std::string_view text_;
  TextLines lines_;
  DumpFrames found_;
  DumpFramePlace frame_;
  std::optional<std::uint64_t> count_;
  bool seen_[items] = {};
  bool is_no_item_ = false;  ///< an error is of a line that is no part of "ITEM: " either
};

}  // namespace

Result<DumpFrames> find_dump_frames(std::string_view text) { return DumpFrameFinder(text).run(); }

}  // namespace boule
