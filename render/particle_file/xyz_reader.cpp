#include "render/particle_file/xyz_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "render/particle_file/frame_places.h"
#include "render/particle_file/named_columns.h"
#include "render/particle_file/text_lines.h"
#include "render/particle_file/text_number.h"
#include "render/particle_file/text_rows.h"
#include "render/particle_file/xyz_comment.h"

namespace boule {
namespace {

/// Where a frame is in the text.
struct XyzFrame {
  std::size_t comment = 0;     ///< first byte of the second line
  std::size_t begin = 0;       ///< of the rows,
  std::size_t end = 0;         ///< which end before this byte
  std::uint64_t count = 0;     ///< of rows
  std::uint64_t row_line = 0;  ///< line of the first row
};

/// The count of particles that a frame's first line is.
/// Skips so many lines, or as many as there are, and returns how many. What is behind is let go.
std::uint64_t skip_rows(std::uint64_t count, TextLines& lines, const MappedText& bytes) {
  constexpr std::uint64_t portion = std::uint64_t{1} << 16;
  std::uint64_t skipped = 0;
  while (skipped < count) {
    const std::size_t begin = lines.offset();
    const std::uint64_t more = lines.skip(std::min(portion, count - skipped));
    if (more == 0) break;
    skipped += more;
    bytes.let_go(bytes.text().substr(begin, lines.offset() - begin));
  }
  return skipped;
}

Result<std::vector<XyzFrame>> find_xyz_frames(const MappedText& bytes) {
  std::vector<XyzFrame> frames;
  const std::string_view text = bytes.text();
  TextLines lines(text);
  for (lines.skip_blank_lines(); !lines.at_end(); lines.skip_blank_lines()) {
    const std::uint64_t first_line = lines.line();
    const std::string_view line = lines.next();
    const auto count = count_in(without_blanks(line));
    if (!count) {
      return error_at_line(first_line, "expected a count of particles, found " + quote(line),
                           "count");
    }
    XyzFrame frame{.comment = lines.offset(), .count = *count};
    const bool has_comment = lines.skip(1) == 1;
    frame.begin = lines.offset();
    frame.row_line = lines.line();
    const std::uint64_t rows = skip_rows(*count, lines, bytes);
    frame.end = lines.offset();
    if (!has_comment || rows < *count) {
      return error_at_line(first_line,
                           "it promises " + std::to_string(*count) +
                               " particles, the file ends after " + std::to_string(rows),
                           "count");
    }
    if (auto no_room = add_frame_place(frames, frame)) return *no_room;
  }
  if (frames.empty()) return Diagnostic::of("it holds no frames");
  return frames;
}

bool is_velocity(const std::string& name) {
  constexpr std::array names{"vel", "velo", "velocity", "velocities"};
  return std::count(names.begin(), names.end(), name) > 0;
}

/// The names of the columns that a property of several columns has.
std::vector<std::string> names_of(const XyzProperty& property) {
  if (property.count == 1) return {property.name};
  if (property.count == 3 && is_velocity(property.name)) return {"vx", "vy", "vz"};
  if (property.count == 3 && property.name == "color") return {"red", "green", "blue"};
  std::vector<std::string> names;
  constexpr std::array axes{"_x", "_y", "_z"};
  for (std::size_t i = 0; i < property.count; ++i) {
    names.push_back(property.name +
                    (property.count == 3 ? std::string(axes[i]) : "_" + std::to_string(i + 1)));
  }
  return names;
}

bool is_species(const XyzProperty& property) {
  constexpr std::array names{"species", "element", "symbol", "symbols"};
  return property.type == 'S' && property.count == 1 &&
         std::count(names.begin(), names.end(), property.name) > 0;
}

void add_property(const XyzProperty& property, NamedColumns& columns) {
  constexpr std::array axes{"x", "y", "z"};
  if (is_species(property)) return columns.add_species(property.name);
  if (property.count == 3 && (property.name == "pos" || property.name == "positions")) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns.add_position(property.name + "_" + axes[axis], axis);
    }
    return;
  }
  for (std::size_t axis = 0; property.count == 1 && axis < 3; ++axis) {
    if (property.name == axes[axis]) return columns.add_position(property.name, axis);
  }
  const ColumnUse use = property.type == 'S'   ? ColumnUse::text
                        : property.type == 'L' ? ColumnUse::logical
                                               : ColumnUse::number;
  for (const std::string& name : names_of(property)) columns.add_kept(name, use);
}

class XyzReader : public ParticleReader {
 public:
  XyzReader(MappedText bytes, ParticleFileOptions options, std::vector<XyzFrame> places)
      : bytes_(std::move(bytes)), options_(std::move(options)), places_(std::move(places)) {}

  [[nodiscard]] std::size_t frames() const override { return places_.size(); }

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    const XyzFrame& place = places_[frame];
    const std::string_view text = bytes_.text();
    auto comment = parse_xyz_comment(TextLines(text.substr(place.comment)).next());
    if (!comment) {
      Diagnostic error = comment.error();
      error.line = place_number(place.row_line - 1);
      return error;
    }
    ParticleFrame read;
    read.cell = comment.value().cell;
    read.time = comment.value().time;
    const std::string_view rows = text.substr(place.begin, place.end - place.begin);
    NamedColumns columns(options_.wanted, read);
    if (auto wrong = plan(comment.value(), TextLines(rows).next(), columns)) {
      wrong->line = place_number(place.row_line);
      return *wrong;
    }
    if (auto wrong = columns.check_positions()) {
      wrong->line = place_number(place.row_line - 1);
      return *wrong;
    }
    const TextRows source{.text = rows,
                          .rows = static_cast<std::size_t>(place.count),
                          .first_line = place.row_line,
                          .positive = options_.positive,
                          .file = &bytes_};
    if (auto wrong = read_text_rows(source, columns.columns(), read, parallel_for)) return *wrong;
    columns.finish();
    return read;
  }

 private:
  Status plan(const XyzComment& comment, std::string_view first_row, NamedColumns& columns) const {
    for (const XyzProperty& property : comment.properties) add_property(property, columns);
    if (!comment.properties.empty()) return std::nullopt;
    const auto words = words_of(first_row);
    if (words.size() > most_text_columns) return too_many_columns();
    const std::size_t count = std::max<std::size_t>(words.size(), words.size() == 3 ? 3 : 4);
    std::vector<std::string> names = options_.columns;
    if (names.empty()) {
      names = {"species", "x", "y", "z"};
      if (count == 3) names.erase(names.begin());
      for (std::size_t i = names.size(); i < count; ++i) names.push_back("c" + std::to_string(i));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      columns.add(names[i], i < words.size() ? words[i] : std::string_view("0"));
    }
    return std::nullopt;
  }

  MappedText bytes_;
  ParticleFileOptions options_;
  std::vector<XyzFrame> places_;
};

Result<std::unique_ptr<ParticleReader>> open_xyz(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  auto places = find_xyz_frames(bytes);
  if (!places) return places.error();
  return std::unique_ptr<ParticleReader>(
      std::make_unique<XyzReader>(std::move(bytes), options, std::move(places).value()));
}

/// A count, a comment, and a row of a name and three numbers.
bool starts_like_xyz(std::string_view start) {
  TextLines lines(start);
  const auto count = count_in(without_blanks(lines.next()));
  lines.next();
  if (!count || *count == 0 || lines.at_end()) return false;
  const auto words = words_of(lines.next());
  return words.size() >= 4 && number_in(words[1]) && number_in(words[2]) && number_in(words[3]);
}

}  // namespace

constinit const ParticleFormat xyz_format = {"xyz", {"xyz", "extxyz"}, starts_like_xyz, open_xyz};

}  // namespace boule
