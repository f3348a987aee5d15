#include "render/files/particle_file/table/xyz_comment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

struct XyzEntry {
  std::string_view key;
  std::string_view value;  ///< without its quotes or braces
  bool closed = true;      ///< false: the line ends before they do
};

/// What closes a value that starts with this character; 0 for a bare value.
char closing(char c) {
  switch (c) {
    case '"':
    case '\'':
      return c;
    case '{':
      return '}';
    case '[':
      return ']';
    default:
      return 0;
  }
}

class CommentParser {
 public:
  explicit CommentParser(std::string_view line) : line_(line) {}

  std::vector<XyzEntry> entries() {
    std::vector<XyzEntry> found;
    for (skip_blanks(); at_ < line_.size(); skip_blanks()) {
      const std::size_t begin = at_;
      while (at_ < line_.size() && !is_blank(line_[at_]) && line_[at_] != '=') ++at_;
      XyzEntry entry{line_.substr(begin, at_ - begin), {}};
      if (at_ < line_.size() && line_[at_] == '=') {
        ++at_;
        take_value(entry);
        found.push_back(entry);
      }
    }
    return found;
  }

 private:
  void skip_blanks() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
  }

  void take_value(XyzEntry& entry) {
    const char open = at_ < line_.size() ? line_[at_] : '\0';
    const char close = closing(open);
    if (close == 0) {
      const std::size_t begin = at_;
      while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
      entry.value = line_.substr(begin, at_ - begin);
      return;
    }
    const std::size_t begin = ++at_;
    std::size_t depth = 1;
    for (; at_ < line_.size(); ++at_) {
      const char c = line_[at_];
      if (c == '\\' && open == close) {
        ++at_;
      } else if (c == close && --depth == 0) {
        break;
      } else if (c == open && open != close) {
        ++depth;
      }
    }
    at_ = std::min(at_, line_.size());
    entry.closed = at_ < line_.size();
    entry.value = line_.substr(begin, at_ - begin);
    if (entry.closed) ++at_;
  }

  std::string_view line_;
  std::size_t at_ = 0;
};

/// The words of a value; lists may be written with brackets and commas too.
std::vector<std::string_view> items_of(std::string_view value) {
  constexpr std::string_view between = " \t\r,[]{}";
  std::vector<std::string_view> items;
  for (std::size_t begin = value.find_first_not_of(between); begin != std::string_view::npos;) {
    const std::size_t end = std::min(value.find_first_of(between, begin), value.size());
    items.push_back(value.substr(begin, end - begin));
    begin = value.find_first_not_of(between, end);
  }
  return items;
}

class CommentReader {
 public:
  explicit CommentReader(std::string_view line) : line_(line) {}

  Result<XyzComment> read() {
    for (const XyzEntry& entry : CommentParser(line_).entries()) {
      if (auto done = read_entry(entry); !done) return done.error();
    }
    if (cell_) {
      cell_->origin = origin_;
      cell_->periodic = periodic_;
    }
    read_.cell = cell_;
    return std::move(read_);
  }

 private:
  Status read_entry(const XyzEntry& entry) {
    const bool is_time = entry.key == "Time" || entry.key == "time";
    const bool is_known = is_time || entry.key == "Properties" || entry.key == "Lattice" ||
                          entry.key == "Origin" || entry.key == "pbc";
    if (!is_known) return {};
    if (!entry.closed) return wrong(entry, entry.value, "the line ends before the value does");
    if (is_time) return read_time(entry);
    if (entry.key == "Properties") return read_properties(entry);
    if (entry.key == "pbc") return read_periodic(entry);
    return entry.key == "Lattice" ? read_lattice(entry) : read_origin(entry);
  }

  Status wrong(const XyzEntry& entry, std::string_view word, std::string message) const {
    return error_at_word(0, line_, word, std::move(message), std::string(entry.key));
  }

  /// Other programs may mean something else by a time, so one that is no number is no error.
  Status read_time(const XyzEntry& entry) {
    const auto time = number_in(entry.value);
    if (time && std::isfinite(*time)) read_.time = *time;
    return {};
  }

  template <std::size_t count>
  Status read_numbers(const XyzEntry& entry, std::array<double, count>& numbers) const {
    const auto items = items_of(entry.value);
    if (items.size() != count) {
      return wrong(
          entry, entry.value,
          "expected " + std::to_string(count) + " numbers, found " + std::to_string(items.size()));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = number_in(items[i]);
      if (!number || !std::isfinite(*number)) {
        return wrong(entry, items[i], "expected a finite number, found " + quote(items[i]));
      }
      numbers[i] = *number;
    }
    return {};
  }

  Status read_lattice(const XyzEntry& entry) {
    std::array<double, 9> n{};
    if (auto done = read_numbers(entry, n); !done) return done;
    cell_.emplace();
    cell_->a = {n[0], n[1], n[2]};
    cell_->b = {n[3], n[4], n[5]};
    cell_->c = {n[6], n[7], n[8]};
    return {};
  }

  Status read_origin(const XyzEntry& entry) {
    std::array<double, 3> n{};
    if (auto done = read_numbers(entry, n); !done) return done;
    origin_ = {n[0], n[1], n[2]};
    return {};
  }

  Status read_periodic(const XyzEntry& entry) {
    const auto items = items_of(entry.value);
    if (items.size() != 3) {
      return wrong(entry, entry.value, "expected three of T and F, found " + quote(entry.value));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = logical_in(items[i]);
      const bool one = items[i] == "1";
      if (!value && !one && items[i] != "0") {
        return wrong(entry, items[i], "expected T or F, found " + quote(items[i]));
      }
      periodic_[i] = value ? *value != 0 : one;
    }
    return {};
  }

  Status read_properties(const XyzEntry& entry) {
    std::string_view rest = entry.value;
    const auto next = [&rest] {
      const std::size_t end = std::min(rest.find(':'), rest.size());
      const std::string_view field = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      return field;
    };
    while (!rest.empty()) {
      const std::string_view name = next(), type = next(), count = next();
      constexpr std::size_t most = 1000;
      if (name.empty()) return wrong(entry, name, "expected NAME:TYPE:COUNT, found no name");
      if (type.size() != 1 || std::string_view("RISL").find(type) == std::string_view::npos) {
        return wrong(entry, name,
                     "expected NAME:TYPE:COUNT of the types R, I, S and L, found " +
                         quote(std::string(name) + ":" + std::string(type)));
      }
      const auto number = count_in(count);
      if (!number || *number == 0 || *number > most) {
        return wrong(entry, name,
                     "expected a count of columns from 1 to 1000, found " + quote(count));
      }
      columns_ += static_cast<std::size_t>(*number);
      if (columns_ > most_text_columns) return wrong(entry, name, too_many_columns().message);
      read_.properties.push_back(
          {std::string(name), type.front(), static_cast<std::size_t>(*number)});
    }
    if (read_.properties.empty()) return wrong(entry, entry.value, "it names no columns");
    return {};
  }

  std::string_view line_;
  XyzComment read_;
  std::size_t columns_ = 0;  ///< that Properties has named so far
  std::optional<ParticleCell> cell_;
  Vec3d origin_;
  std::array<bool, 3> periodic_{true, true, true};
};

}  // namespace

Result<XyzComment> parse_xyz_comment(std::string_view line) { return CommentReader(line).read(); }

}  // namespace boule
