#include "render/files/particle_file/lammps/lammps_data_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

std::vector<std::string_view> comment_words(std::string_view line) {
  const std::size_t hash = line.find('#');
  return words_of(hash == std::string_view::npos ? std::string_view() : line.substr(hash + 1));
}

/// "C", "Fe": what chemistry writes, and types seldom do.
bool looks_like_element(std::string_view word) {
  if (word.empty() || word.size() > 2 || word[0] < 'A' || word[0] > 'Z') return false;
  return word.size() == 1 || (word[1] >= 'a' && word[1] <= 'z');
}

/// "units = real", as LAMMPS writes it into the first line.
double units_of(std::string_view first_line) {
  const auto words = words_of(first_line);
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    if (words[i] != "units" || words[i + 1] != "=") continue;
    return lammps_length_in_angstrom(words[i + 2].substr(0, words[i + 2].find(',')));
  }
  return 1;
}

/// A line of the header that tells something of the box: so many numbers, then this word.
struct BoxLine {
  std::string_view keyword;
  std::size_t numbers;
};
constexpr std::array box_lines{BoxLine{"xlo", 2},  BoxLine{"ylo", 2},  BoxLine{"zlo", 2},
                               BoxLine{"xy", 3},   BoxLine{"avec", 3}, BoxLine{"bvec", 3},
                               BoxLine{"cvec", 3}, BoxLine{"abc", 3}};
constexpr std::size_t tilts_line = 3, first_edge_line = 4, origin_line = 7;

std::size_t box_line_of(std::string_view word) {
  const auto* const found = std::find_if(box_lines.begin(), box_lines.end(),
                                         [&](const BoxLine& l) { return l.keyword == word; });
  return static_cast<std::size_t>(found - box_lines.begin());
}

class SectionFinder {
 public:
  explicit SectionFinder(std::string_view text) : text_(text), lines_(text) {}

  Result<DataSections> run() {
    found_.length_in_angstrom = units_of(lines_.next());
    while (!lines_.at_end() && !at_section()) {
      if (auto done = header_line(); !done) return done.error();
    }
    if (auto done = keep_box(); !done) return done.error();
    while (!lines_.at_end()) {
      if (auto done = section(); !done) return done.error();
    }
    if (!has_count_) {
      return error_at_line(lines_.line(), "it has no line with the count of atoms, \"N atoms\"",
                           "atoms");
    }
    if (!found_.atom_rows.exists() && found_.atoms > 0) {
      return error_at_line(lines_.line(), "the file ends without a section Atoms", "Atoms");
    }
    if (elements_.size() == found_.types) found_.elements = std::move(elements_);
    return std::move(found_);
  }

 private:
  /// Names of sections start with a letter, all other lines with numbers.
  [[nodiscard]] bool at_section() const {
    const auto words = words_of(without_comment(lines_.peek()));
    return !words.empty() && is_letter(words.front().front());
  }

  Status header_line() {
    const std::uint64_t number = lines_.line();
    const std::string_view line = lines_.next();
    const auto words = words_of(without_comment(line));
    const auto keyword = std::find_if(words.begin(), words.end(), [](std::string_view word) {
      return box_line_of(word) < box_lines.size();
    });
    if (keyword != words.end()) {
      return box_line(number, line, {words.begin(), keyword}, box_line_of(*keyword));
    }
    const std::size_t names = static_cast<std::size_t>(
        std::find_if(words.begin(), words.end(), [](auto w) { return is_letter(w.front()); }) -
        words.begin());
    if (names == words.size()) return {};
    const std::string name(words[names]);
    if (name == "atoms" || (name == "atom" && words.size() == names + 2)) {
      const auto count = names == 1 ? count_in(words[0]) : std::nullopt;
      const std::string key = name == "atoms" ? "atoms" : "atom types";
      if (!count) return error_at_line(number, "expected a count before " + quote(key), key);
      (name == "atoms" ? found_.atoms : found_.types) = *count;
      has_count_ = has_count_ || name == "atoms";
    }
    if (name == "bonds" && names == 1) found_.bonds = count_in(words[0]).value_or(0);
    return {};  // else a count of angles, and the like
  }

  Status box_line(std::uint64_t number, std::string_view line,
                  const std::vector<std::string_view>& words, std::size_t which) {
    const std::string name(box_lines[which].keyword);
    const std::size_t count = box_lines[which].numbers;
    Vec3d found;
    const std::array<double*, 3> numbers{&found.x, &found.y, &found.z};
    for (std::size_t i = 0; i < std::min(count, words.size()); ++i) {
      const auto value = number_in(words[i]);
      if (!value || !std::isfinite(*value)) {
        return error_at_word(number, line, words[i],
                             "expected a finite number, found " + quote(words[i]), name);
      }
      *numbers[i] = *value;
    }
    if (words.size() != count) {
      return error_at_line(
          number, "expected " + std::to_string(count) + " numbers before " + quote(name), name);
    }
    if (which < tilts_line && found.y < found.x) {
      return error_at_line(number, "the box has a negative length along " + name.substr(0, 1),
                           name);
    }
    has_box_line_[which] = true;
    take_box_line(which, found);
    return {};
  }

  void take_box_line(std::size_t which, const Vec3d& numbers) {
    constexpr std::array axes{&Vec3d::x, &Vec3d::y, &Vec3d::z};
    constexpr std::array edges{&ParticleCell::a, &ParticleCell::b, &ParticleCell::c};
    if (which < tilts_line) {
      box_.lo.*axes[which] = numbers.x;
      box_.hi.*axes[which] = numbers.y;
    } else if (which == tilts_line) {
      box_.xy = numbers.x, box_.xz = numbers.y, box_.yz = numbers.z;
    } else if (which == origin_line) {
      general_.origin = numbers;
    } else {
      general_.*edges[which - first_edge_line] = numbers;
    }
  }

  [[nodiscard]] bool has_any(std::size_t first, std::size_t count) const {
    return std::any_of(has_box_line_.begin() + static_cast<std::ptrdiff_t>(first),
                       has_box_line_.begin() + static_cast<std::ptrdiff_t>(first + count),
                       [](bool has) { return has; });
  }

  /// Makes the cell of the box, by its edges or by its bounds. What the header leaves out is as
  /// LAMMPS takes it.
  Status keep_box() {
    const bool by_edges = has_any(first_edge_line, 4);
    if (!by_edges && !has_any(0, 3)) return {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string bound(1, static_cast<char>('x' + axis));
      const std::string edge(1, static_cast<char>('a' + axis));
      if (by_edges && !has_box_line_[first_edge_line + axis]) {
        found_.notes.push_back("it has no line " + edge + "vec, taken as 1 along " + bound);
      } else if (!by_edges && !has_box_line_[axis]) {
        found_.notes.push_back("it has no line " + bound + "lo " + bound + "hi, taken as -0.5 0.5");
      }
    }
    found_.cell = by_edges ? general_ : cell_of(box_);
    if (is_finite(*found_.cell)) return {};
    return error_at_line(lines_.line(), "the box is larger than the largest number", "xlo");
  }

  Status section() {
    const std::uint64_t number = lines_.line();
    const std::string_view line = lines_.next();
    const auto words = words_of(without_comment(line));
    if (words.empty()) return {};
    if (!is_letter(words.front().front())) {
      return error_at_line(number, "expected the name of a section, found " + quote(line));
    }
    skip_comments();
    if (words.size() == 1 && words[0] == "Atoms") {
      const auto style = comment_words(line);
      if (!style.empty()) found_.atom_rows.style = std::string(style.front());
      return rows("Atoms", number, found_.atom_rows);
    }
    if (words.size() == 1 && words[0] == "Velocities") {
      return rows("Velocities", number, found_.velocity_rows);
    }
    if (words.size() == 1 && words[0] == "Masses") return masses(number);
    if (words.size() == 1 && words[0] == "Bonds") bonds();
    while (!lines_.at_end() && !at_section()) lines_.skip(1);
    return {};
  }

  void skip_comments() {
    while (!lines_.at_end() && words_of(without_comment(lines_.peek())).empty()) lines_.skip(1);
  }

  static Status too_short(const std::string& name, std::uint64_t line, std::uint64_t expected,
                          std::uint64_t rows) {
    return error_at_line(line,
                         "the header promises " + std::to_string(expected) +
                             " rows, the file ends after " + std::to_string(rows),
                         name);
  }

  Status rows(const std::string& name, std::uint64_t line, DataSection& section) {
    if (section.exists()) return error_at_line(line, "the section is there twice", name);
    if (!has_count_) return error_at_line(line, "the header has no count of atoms", "atoms");
    const std::size_t begin = lines_.offset();
    section.line = lines_.line();
    section.rows = lines_.skip(found_.atoms);
    section.text = text_.substr(begin, lines_.offset() - begin);
    if (section.rows == found_.atoms) return {};
    return too_short(name, line, found_.atoms, section.rows);
  }

  /// Few files are read for their bonds: what is wrong with them shows then.
  void bonds() {
    const std::size_t begin = lines_.offset();
    DataSection& section = found_.bond_rows;
    section = {.line = lines_.line()};
    while (section.rows < found_.bonds && !lines_.at_end() && !at_section()) {
      lines_.skip(1);
      ++section.rows;
    }
    section.text = text_.substr(begin, lines_.offset() - begin);
  }

  Status masses(std::uint64_t line) {
    for (std::uint64_t i = 0; i < found_.types; ++i) {
      if (lines_.at_end()) return too_short("Masses", line, found_.types, i);
      const auto words = comment_words(lines_.next());
      if (!words.empty() && looks_like_element(words.front())) {
        elements_.emplace_back(words.front());
      }
    }
    return {};
  }

  std::string_view text_;
  TextLines lines_;
  DataSections found_;
  std::vector<std::string> elements_;
  LammpsBox box_;
  ParticleCell general_{
      .a = {1, 0, 0}, .b = {0, 1, 0}, .c = {0, 0, 1}, .origin = {}, .periodic = {true, true, true}};
  std::array<bool, box_lines.size()> has_box_line_{};
  bool has_count_ = false;  ///< of atoms
};

}  // namespace

Result<DataSections> find_data_sections(std::string_view text) { return SectionFinder(text).run(); }

}  // namespace boule
