#include "render/particle_file/table_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/base/ascii.h"
#include "render/particle_file/named_columns.h"
#include "render/particle_file/table_head.h"
#include "render/particle_file/text_lines.h"
#include "render/particle_file/text_number.h"
#include "render/particle_file/text_pieces.h"
#include "render/particle_file/text_rows.h"

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

/// The names of a table without a header: a text before x, y, z is the species.
std::vector<std::string> default_names(const std::vector<std::string_view>& first_row) {
  std::vector<std::string> names{"x", "y", "z", "radius"};
  if (!number_in(first_row.front())) names.insert(names.begin(), "species");
  for (std::size_t i = names.size(); i < first_row.size(); ++i) {
    names.push_back("c" + std::to_string(i + 1));
  }
  names.resize(first_row.size());
  return names;
}

/// Each name once.
Status check_names(const std::vector<std::string>& names) {
  const auto repeated = find_repeated(names);
  if (!repeated) return std::nullopt;
  return Diagnostic::about(*repeated, "two columns have the name " + quote(*repeated));
}

/// An error about names is one about the header line, else about the names that were given.
Status at_names(Status error, const TableHead& head) {
  if (!error) return error;
  error->line = place_number(head.names_line);
  if (head.names_line == 0) error->key = "columns";
  return error;
}

class TableReader : public ParticleReader {
 public:
  TableReader(MappedText bytes, ParticleFileOptions options, TableHead head, std::size_t rows)
      : bytes_(std::move(bytes)),
        options_(std::move(options)),
        head_(std::move(head)),
        rows_(rows) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }

  /// What the columns are; the same for each read.
  [[nodiscard]] Status plan(NamedColumns& columns) const {
    for (std::size_t i = 0; i < head_.names.size(); ++i) {
      if (head_.names[i].empty()) {
        columns.add_skipped("column " + std::to_string(i + 1));
      } else {
        const bool exists = i < head_.first_row.size();
        columns.add(head_.names[i], exists ? head_.first_row[i] : std::string_view("0"));
      }
    }
    return at_names(columns.check_positions(), head_);
  }

  Result<ParticleFrame> read(std::size_t, const ParallelFor& parallel_for) override {
    ParticleFrame frame;
    NamedColumns columns(options_.wanted, frame);
    if (auto wrong = plan(columns)) return *wrong;
    const TextRows rows{.text = bytes_.text().substr(head_.begin),
                        .rows = rows_,
                        .first_line = head_.line,
                        .comments = head_.separator == 0,
                        .is_table = true,
                        .separator = head_.separator,
                        .positive = options_.positive,
                        .file = &bytes_};
    if (auto wrong = read_text_rows(rows, columns.columns(), frame, parallel_for)) return *wrong;
    columns.finish();
    return frame;
  }

 private:
  MappedText bytes_;
  ParticleFileOptions options_;
  TableHead head_;
  std::size_t rows_;
};

/// The names that the caller gives, else those of the header, else the usual ones.
Status choose_names(const std::vector<std::string>& given, TableHead& head) {
  if (!given.empty()) {
    if (given.size() != head.first_row.size()) {
      return Diagnostic::about("columns", "names " + std::to_string(given.size()) +
                                              " columns, the file has " +
                                              std::to_string(head.first_row.size()));
    }
    head.names = given;
  } else if (head.names.empty()) {
    head.names = default_names(head.first_row);
  } else {
    head.names = usual_names(head.names);
  }
  return at_names(check_names(head.names), head);
}

Result<std::unique_ptr<ParticleReader>> open_table(MappedText bytes,
                                                   const ParticleFileOptions& options,
                                                   const ParallelFor& parallel_for) {
  auto head = parse_table_head(bytes.text());
  if (!head) return head.error();
  if (auto wrong = choose_names(options.columns, head.value())) return *wrong;
  const std::uint64_t rows =
      count_table_rows(bytes.text().substr(head.value().begin), parallel_for, &bytes);
  return std::unique_ptr<ParticleReader>(std::make_unique<TableReader>(
      std::move(bytes), options, std::move(head).value(), static_cast<std::size_t>(rows)));
}

}  // namespace

// Any text could be a table: only the ending tells.
constinit const ParticleFormat table_format = {"table", {"csv", "tsv", "txt"}, nullptr, open_table};

}  // namespace boule
