#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/molecule/gro_rows.h"
#include "render/files/particle_file/text/frame_places.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

/// Where a frame is in the text.
struct GroFrame {
  std::size_t title = 0;       ///< first byte of the first line
  std::size_t begin = 0;       ///< of the rows,
  std::size_t end = 0;         ///< which end before this byte, where the box begins
  std::uint64_t count = 0;     ///< of rows
  std::uint64_t row_line = 0;  ///< line of the first row
};

/// True if nothing but blank lines is left. A title may be blank too.
bool is_over(TextLines lines) {
  lines.skip_blank_lines();
  return lines.at_end();
}

/// The frame whose title is the next line. An error where the file ends before it does.
Result<GroFrame> next_gro_frame(TextLines& lines) {
  GroFrame frame{.title = lines.offset()};
  lines.skip(1);
  const std::uint64_t count_line = lines.line();
  const std::string_view line = lines.next();
  const auto count = count_in(without_blanks(line));
  if (!count) {
    return error_at_line(
        count_line, "expected a count of atoms below the title, found " + quote(line), "count");
  }
  frame.count = *count;
  frame.begin = lines.offset();
  frame.row_line = lines.line();
  const std::uint64_t rows = lines.skip(*count);
  frame.end = lines.offset();
  if (lines.skip(1) == 1) return frame;
  return error_at_line(count_line,
                       "it promises " + std::to_string(*count) +
                           " atoms and a box, the file ends after " + std::to_string(rows) +
                           " lines",
                       "count");
}

/// Where the file ends in an error behind a whole frame, it was cut off.
Result<FramePlaces<GroFrame>> find_gro_frames(std::string_view text) {
  FramePlaces<GroFrame> found;
  TextLines lines(text);
  while (!is_over(lines)) {
    auto frame = next_gro_frame(lines);
    if (!frame && (found.frames.empty() || !lines.at_end())) return frame.error();
    if (!frame) {
      found.whole = frame.error();
    } else if (lines.at_end() && !found.frames.empty() &&
               has_cut_row(text.substr(frame.value().end),
                           TextLines(text.substr(found.frames.back().end)).next())) {
      found.whole = error_at_line(frame.value().row_line + frame.value().count,
                                  "the file ends in its box", "box");
    } else if (auto done = add_frame_place(found.frames, frame.value()); !done) {
      return done.error();
    }
  }
  if (found.frames.empty()) return Diagnostic::of("it holds no frames");
  return found;
}

/// What stands behind "t=" in a title, if that is a number.
std::optional<double> time_of(std::string_view title) {
  const std::size_t at = title.find("t=");
  if (at == std::string_view::npos || (at > 0 && !is_blank(title[at - 1]))) return std::nullopt;
  const auto words = words_of(title.substr(at + 2));
  const auto time = words.empty() ? std::nullopt : number_in(words.front());
  return time && std::isfinite(*time) ? time : std::nullopt;
}

/// The box of a line of numbers: the lengths of its edges, or v1x v2y v3z v1y v1z v2x v2z v3x v3y.
/// No box if all are 0.
Result<std::optional<ParticleCell>> box_of(std::string_view line, std::uint64_t line_number) {
  std::vector<double> n;
  for (const std::string_view word : words_of(line)) {
    const auto number = number_in(word);
    if (!number || !std::isfinite(*number)) {
      return error_at_word(line_number, line, word,
                           "expected a finite number, found " + quote(word), "box");
    }
    n.push_back(*number);
  }
  if (n.size() != 3 && n.size() != 9) {
    return error_at_line(
        line_number, "expected a box of 3 or 9 numbers, found " + std::to_string(n.size()), "box");
  }
  if (std::all_of(n.begin(), n.end(), [](double x) { return x == 0; })) {
    return std::optional<ParticleCell>();
  }
  n.resize(9);
  return std::optional(ParticleCell{.a = {n[0], n[3], n[4]},
                                    .b = {n[5], n[1], n[6]},
                                    .c = {n[7], n[8], n[2]},
                                    .origin = {},
                                    .periodic = {true, true, true}});
}

class GroReader : public PlacedReader<GroFrame> {
 public:
  using PlacedReader::PlacedReader;

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    const GroFrame& place = places_.frames[frame];
    const std::string_view text = bytes_.text();
    ParticleFrame read;
    read.length_in_angstrom = 10;
    read.time = time_of(TextLines(text.substr(place.title)).next());
    const auto box = box_of(TextLines(text.substr(place.end)).next(), place.row_line + place.count);
    if (!box) return box.error();
    read.cell = box.value();
    if (place.count == 0) return read;
    const GroRows rows{.text = text.substr(place.begin, place.end - place.begin),
                       .rows = static_cast<std::size_t>(place.count),
                       .first_line = place.row_line,
                       .lenient = options_.lenient};
    if (auto done = read_gro_rows(rows, options_.wanted, read, parallel_for); !done)
      return done.error();
    return read;
  }
};

Result<std::unique_ptr<ParticleReader>> open_gro(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  return placed_reader<GroReader>(find_gro_frames(bytes.text()), std::move(bytes), options);
}

/// A title, a count, and a row of fixed columns.
bool starts_like_gro(std::string_view start) {
  TextLines lines(start);
  lines.next();
  const auto count = count_in(without_blanks(lines.next()));
  if (!count || *count == 0 || lines.at_end()) return false;
  const std::string_view row = lines.next();
  const auto residue = words_of(row.substr(0, 5));
  return residue.size() == 1 && number_in(residue.front()) && gro_width(row);
}

}  // namespace

constinit const ParticleFormat gro_format = {.name = "gro",
                                             .endings = {"gro"},
                                             .starts_like = starts_like_gro,
                                             .open = open_gro,
                                             .is_trajectory = true,
                                             .names_columns = true};

}  // namespace boule
