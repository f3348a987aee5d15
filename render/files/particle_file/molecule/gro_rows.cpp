#include "render/files/particle_file/molecule/gro_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/float_environment.h"
#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_pieces.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

constexpr std::size_t head = 20;  // bytes before the positions

/// A field of every row.
struct GroField {
  std::string name;
  std::size_t begin = 0, width = 5;  ///< bytes of the line
  double* numbers = nullptr;         ///< where its numbers go, `stride` apart,
  std::size_t stride = 1;            ///< 3 of positions, which are never missing
  std::uint32_t* texts = nullptr;    ///< or its texts,
  std::size_t interner = 0;          ///< by this interner
  bool optional = false;             ///< a blank number is 0
};

struct GroPlan {
  std::vector<GroField> fields;
  std::size_t end = 0;  ///< of a row; what follows must be blank
};

/// Makes room in `frame`; the plan's pointers go there.
class GroPlanner {
 public:
  GroPlanner(std::size_t rows, std::size_t width,
             const std::optional<std::vector<std::string>>& wanted, ParticleFrame& frame)
      : rows_(rows), width_(width), wanted_(wanted), frame_(frame) {}

  GroPlan plan(bool velocities) {
    add_number({.name = "resid"});
    add_text("resname", 5);
    add_text("name", 10);
    add_number({.name = "id", .begin = 15});
    add_positions();
    for (std::size_t axis = 0; velocities && axis < 3; ++axis) {
      add_number({.name = std::string("v") + static_cast<char>('x' + axis),
                  .begin = head + (3 + axis) * width_,
                  .width = width_,
                  .optional = true});
    }
    return {std::move(fields_), head + (velocities ? 6 : 3) * width_};
  }

 private:
  void add_number(GroField field) {
    if (!is_wanted(wanted_, field.name)) {
      frame_.unread.push_back(field.name);
      return;
    }
    frame_.numbers.push_back({field.name, std::vector<double>(rows_)});
    field.numbers = frame_.numbers.back().values.data();
    fields_.push_back(std::move(field));
  }

  void add_text(const std::string& name, std::size_t begin) {
    frame_.texts.push_back({name, {}, std::vector<std::uint32_t>(rows_)});
    fields_.push_back({.name = name,
                       .begin = begin,
                       .texts = frame_.texts.back().indices.data(),
                       .interner = frame_.texts.size() - 1});
  }

  void add_positions() {
    frame_.positions.resize(rows_);
    Vec3d& first = frame_.positions.front();
    const std::array<double*, 3> targets{&first.x, &first.y, &first.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fields_.push_back({.name = std::string(1, static_cast<char>('x' + axis)),
                         .begin = head + axis * width_,
                         .width = width_,
                         .numbers = targets[axis],
                         .stride = 3});
    }
  }

  std::size_t rows_;
  std::size_t width_;
  const std::optional<std::vector<std::string>>& wanted_;
  ParticleFrame& frame_;
  std::vector<GroField> fields_;
};

class GroPieceReader {
 public:
  GroPieceReader(const GroRows& rows, const GroPlan& plan, TextPiece& piece)
      : rows_(rows), plan_(plan), piece_(piece) {}

  /// Reads all rows, up to the first that is wrong.
  void read() {
    TextLines lines(piece_.text);
    for (row_ = piece_.first_row; !lines.at_end() && row_ < rows_.rows; ++row_) {
      line_ = lines.next();
      if (!read_row()) return;
    }
    piece_.end_row = row_;
  }

 private:
  bool read_row() {
    for (const GroField& field : plan_.fields) {
      const std::size_t begin = std::min(field.begin, line_.size());
      const std::string_view text = line_.substr(begin, field.width);
      if (field.texts != nullptr) {
        field.texts[row_] = piece_.interners[field.interner].index_of(without_blanks(text));
      } else if (!read_number(field, text)) {
        return false;
      }
    }
    if (line_.size() <= plan_.end) return true;
    const std::string_view rest = without_blanks(line_.substr(plan_.end));
    return rest.empty() || fail(rest, "the row goes on with " + quote(rest) + " behind column " +
                                          std::to_string(plan_.end));
  }

  bool read_number(const GroField& field, std::string_view text) {
    double& value = field.numbers[row_ * field.stride];
    const std::string_view token = without_blanks(text);
    const char* const end = token.data() + token.size();
    if (number_at(token.data(), end, value) == end && !token.empty()) return true;
    if (token.empty() && field.optional) return value = 0, true;
    if (token.empty()) {
      return fail(text,
                  "expected a number in columns " + std::to_string(field.begin + 1) + " to " +
                      std::to_string(field.begin + field.width) + ", found none",
                  field.name);
    }
    const auto number = number_in(token);
    const bool is_missing = number ? std::isnan(*number) : rows_.lenient;
    if (field.stride == 1 && (is_missing || (number && rows_.lenient))) {
      return value = number.value_or(std::numeric_limits<double>::quiet_NaN()), true;
    }
    if (!number) return fail(token, "expected a number, found " + quote(token), field.name);
    if (!std::isfinite(*number)) {
      return fail(token, "expected a finite number, found " + quote(token), field.name);
    }
    value = *number;
    return true;
  }

  bool fail(std::string_view place, std::string message, const std::string& key = {}) {
    piece_.status = error_at_word(rows_.first_line + row_, line_, place, std::move(message), key);
    return false;
  }

  const GroRows& rows_;
  const GroPlan& plan_;
  TextPiece& piece_;
  std::string_view line_;
  std::size_t row_ = 0;
};

}  // namespace

std::optional<std::size_t> gro_width(std::string_view row) {
  constexpr std::size_t widest = 64;
  std::size_t first = row.find('.', head);
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = row.find('.', first + 1), third = row.find('.', second + 1);
  if (second == std::string_view::npos || third == std::string_view::npos) return std::nullopt;
  const std::size_t width = second - first;
  if (third - second != width || width > widest || first >= head + width) return std::nullopt;
  return width;
}

Status read_gro_rows(const GroRows& rows, const std::optional<std::vector<std::string>>& wanted,
                     ParticleFrame& frame, const ParallelFor& parallel_for) {
  const std::string_view first_row = TextLines(rows.text).next();
  const auto width = gro_width(first_row);
  if (!width) {
    return error_at_line(rows.first_line,
                         "expected three positions of the same width from column 21 on");
  }
  const bool velocities = first_row.size() > head + 3 * *width &&
                          !without_blanks(first_row.substr(head + 3 * *width)).empty();
  const std::uint64_t row_bytes = 3 * sizeof(std::uint32_t) + 8 * (velocities ? 8 : 5);
  if (auto room = check_memory(row_bytes * rows.rows, std::to_string(rows.rows) + " atoms need");
      !room) {
    return room;
  }
  const GroPlan plan = GroPlanner(rows.rows, *width, wanted, frame).plan(velocities);
  std::vector<TextPiece> pieces = cut_rows(rows.text, frame.texts.size(), parallel_for);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const FloatEnvironment environment;
    GroPieceReader(rows, plan, pieces[i]).read();
  });
  if (auto done = check_pieces(pieces, rows.rows); !done) return done;
  for (std::size_t i = 0; i < frame.texts.size(); ++i) {
    merge_texts(pieces, i, frame.texts[i], parallel_for);
  }
  guess_species(frame);
  leave_out_unwanted(wanted, frame);
  return {};
}

}  // namespace boule
