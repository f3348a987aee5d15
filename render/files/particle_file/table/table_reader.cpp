#include "render/files/particle_file/table/table_reader.h"
#include "render/files/particle_file/frame/particle_format.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "render/files/particle_file/table/table_head.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_pieces.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

/// The name under which readers look for a column. Others stay as they are.
std::string usual_name(const std::string& name) {
  struct Spelling {
    std::string_view small, usual;
  };
  constexpr std::array spellings{Spelling{"x", "x"},
                                 Spelling{"y", "y"},
                                 Spelling{"z", "z"},
                                 Spelling{"points:0", "x"},
                                 Spelling{"points:1", "y"},
                                 Spelling{"points:2", "z"},
                                 Spelling{"points_0", "x"},
                                 Spelling{"points_1", "y"},
                                 Spelling{"points_2", "z"},
                                 Spelling{"r", "radius"},
                                 Spelling{"radius", "radius"},
                                 Spelling{"diameter", "diameter"},
                                 Spelling{"vx", "vx"},
                                 Spelling{"vy", "vy"},
                                 Spelling{"vz", "vz"},
                                 Spelling{"type", "type"},
                                 Spelling{"species", "species"},
                                 Spelling{"element", "element"}};
  const std::string small = ascii_lower(name);
  const auto found = std::find_if(spellings.begin(), spellings.end(),
                                  [&](const Spelling& s) { return s.small == small; });
  return found == spellings.end() ? name : std::string(found->usual);
}

/// The names of the columns as the frame has them. A name that the file also spells as usual stays.
std::vector<std::string> usual_names(const std::vector<std::string>& names) {
  std::vector<std::string> usual;
  for (const std::string& name : names) {
    const std::string other = usual_name(name);
    usual.push_back(std::count(names.begin(), names.end(), other) == 0 ? other : name);
  }
  return usual;
}

bool is_a_number(std::string_view text, const TableHead& head) {
  return number_in(head.decimal_comma ? with_decimal_point(text) : std::string(text)).has_value();
}

/// The names of a table without a header: a text before x, y, z is the species.
std::vector<std::string> default_names(const TableHead& head) {
  const auto& first_row = head.first_row;
  std::vector<std::string> names{"x", "y", "z", "radius"};
  if (!is_a_number(first_row.front(), head)) names.insert(names.begin(), "species");
  for (std::size_t i = names.size(); i < first_row.size(); ++i) {
    names.push_back("c" + std::to_string(i + 1));
  }
  names.resize(first_row.size());
  return names;
}

/// Each name once.
Status check_names(const std::vector<std::string>& names) {
  const auto repeated = find_repeated(names);
  if (!repeated) return {};
  return Diagnostic::about(*repeated, "two columns have the name " + quote(*repeated));
}

/// An error about names is one about the header line, else about the names that were given.
Status at_names(Status status, const TableHead& head) {
  if (status) return status;
  status.error().line = place_number(head.names_line);
  if (head.names_line == 0) status.error().key = "columns";
  return status;
}

class TableReader : public ParticleReader {
 public:
  TableReader(MappedText bytes, ParticleFileOptions options, TableHead head, std::size_t rows,
              std::string note)
      : bytes_(std::move(bytes)),
        options_(std::move(options)),
        head_(std::move(head)),
        rows_(rows),
        note_(std::move(note)),
        examples_(example_texts(bytes_.text(), head_)) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }

  Result<ParticleFrame> read(std::size_t, const ParallelFor& parallel_for) override {
    for (;;) {
      auto frame = read_once(parallel_for);
      if (frame || !take_as_texts(frame.error().key)) return frame;
    }
  }

 private:
  /// What stands in a column; "0" where nothing that is there tells it. Such columns are of numbers
  /// until one of their texts is none.
  [[nodiscard]] std::string example(std::size_t i) const {
    if (i >= examples_.size()) return "0";
    const std::string_view text = examples_[i];
    if (is_missing_text(text) || texts_.contains(head_.names[i])) {
      return texts_.contains(head_.names[i]) ? "text" : "0";
    }
    return head_.decimal_comma ? with_decimal_point(text) : std::string(text);
  }

  /// Makes a column of texts of one that was of numbers for want of any; false if it was not.
  bool take_as_texts(const std::string& name) {
    for (std::size_t i = 0; i < std::min(examples_.size(), head_.names.size()); ++i) {
      if (head_.names[i] != name || !is_missing_text(examples_[i])) continue;
      return texts_.insert(name).second;
    }
    return false;
  }

  /// What the columns are.
  [[nodiscard]] Status plan(NamedColumns& columns) const {
    for (std::size_t i = 0; i < head_.names.size(); ++i) {
      if (head_.names[i].empty()) {
        columns.add_skipped("column " + std::to_string(i + 1));
      } else {
        columns.add(head_.names[i], example(i));
      }
    }
    return at_names(columns.check_positions(), head_);
  }

  Result<ParticleFrame> read_once(const ParallelFor& parallel_for) const {
    ParticleFrame frame;
    NamedColumns columns(options_.wanted, frame);
    if (auto done = plan(columns); !done) return done.error();
    const TextRows rows{.text = bytes_.text().substr(head_.begin),
                        .rows = rows_,
                        .first_line = head_.line,
                        .comments = head_.separator == 0,
                        .is_table = true,
                        .separator = head_.separator,
                        .decimal_comma = head_.decimal_comma,
                        .lenient = options_.lenient,
                        .positive = options_.positive,
                        .file = &bytes_};
    if (auto done = read_text_rows(rows, columns.columns(), frame, parallel_for); !done)
      return done.error();
    columns.finish();
    if (head_.decimal_comma) frame.notes.emplace_back("its numbers have decimal commas");
    if (!note_.empty()) frame.notes.push_back(note_);
    return frame;
  }

  MappedText bytes_;
  ParticleFileOptions options_;
  TableHead head_;
  std::size_t rows_;
  std::string note_;
  std::vector<std::string_view> examples_;  ///< as example_texts(); views of the bytes
  std::set<std::string> texts_;             ///< columns that turned out to be of texts
};

/// The names that the caller gives, else those of the header, else these.
Status choose_names(const std::vector<std::string>& given, std::vector<std::string> usual,
                    TableHead& head) {
  if (!given.empty()) {
    if (given.size() != head.first_row.size()) {
      return Diagnostic::about("columns", "names " + std::to_string(given.size()) +
                                              " columns, the file has " +
                                              std::to_string(head.first_row.size()));
    }
    head.names = given;
  } else if (head.names.empty()) {
    head.names = std::move(usual);
  } else {
    head.names = usual_names(head.names);
  }
  return at_names(check_names(head.names), head);
}

std::unique_ptr<ParticleReader> make_reader(MappedText bytes, const ParticleFileOptions& options,
                                            TableHead head, std::string note,
                                            const ParallelFor& parallel_for) {
  const auto rows = static_cast<std::size_t>(
      count_table_rows(bytes.text().substr(head.begin), parallel_for, &bytes));
  return std::make_unique<TableReader>(std::move(bytes), options, std::move(head), rows,
                                       std::move(note));
}

Result<std::unique_ptr<ParticleReader>> open_table(MappedText bytes,
                                                   const ParticleFileOptions& options,
                                                   const ParallelFor& parallel_for) {
  auto head = parse_table_head(bytes.text());
  if (!head) return head.error();
  if (auto done = choose_names(options.columns, default_names(head.value()), head.value()); !done) {
    return done.error();
  }
  return make_reader(std::move(bytes), options, std::move(head).value(), {}, parallel_for);
}

}  // namespace

bool looks_like_points(std::string_view text) {
  const auto head = parse_table_head(text);
  if (!head) return false;
  const auto names = usual_names(head.value().names);
  const bool names_positions = std::count(names.begin(), names.end(), "x") > 0;
  if (head.value().names_line != 0 && !names_positions) return false;  // a line of something else
  const auto& row = head.value().first_row;
  const std::size_t first = !row.empty() && !is_a_number(row.front(), head.value()) ? 1 : 0;
  if (row.size() < first + 3) return false;
  return std::all_of(row.begin() + static_cast<std::ptrdiff_t>(first),
                     row.begin() + static_cast<std::ptrdiff_t>(first + 3),
                     [&](std::string_view word) { return is_a_number(word, head.value()); });
}

Result<std::unique_ptr<ParticleReader>> open_points(MappedText bytes,
                                                    const ParticleFileOptions& options,
                                                    const ParallelFor& parallel_for) {
  auto head = parse_table_head(bytes.text());
  if (!head) return head.error();
  std::vector<std::string> names = default_names(head.value());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "radius") names[i] = "c" + std::to_string(i + 1);
  }
  if (auto done = choose_names(options.columns, std::move(names), head.value()); !done)
    return done.error();
  return make_reader(std::move(bytes), options, std::move(head).value(),
                     "it has no count of particles: each of its lines is one", parallel_for);
}

// Any text could be a table: only the ending tells.
constinit const ParticleFormat table_format = {
    .name = "table", .endings = {"csv", "tsv", "txt"}, .open = open_table};

}  // namespace boule
