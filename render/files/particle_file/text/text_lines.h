#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace boule {

/// Goes through a text line by line and knows where it is. Lines end with '\n'; the last one may
/// lack it.
class TextLines {
 public:
  /// `line` is the number of the first one.
  explicit TextLines(std::string_view text, std::uint64_t line = 1) : text_(text), line_(line) {}

  [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
  /// Of the next line: its first byte, and its number.
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t line() const { return line_; }

  /// The next line without its end, '\r' included. Empty at the end of the text.
  std::string_view next();
  /// The same, without going on.
  [[nodiscard]] std::string_view peek() const { return TextLines(*this).next(); }

  /// Skips so many lines, or as many as there are, and returns how many.
  std::uint64_t skip(std::uint64_t count);

  /// Skips lines of blanks.
  void skip_blank_lines();

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  std::uint64_t line_;
};

/// An error at the start of a line (0: it has no place), or at a word of it: `word` is a view of
/// `line_text`.
Diagnostic error_at_line(std::uint64_t line, std::string message, std::string key = {});
Diagnostic error_at_word(std::uint64_t line, std::string_view line_text, std::string_view word,
                         std::string message, std::string key = {});

/// Lines and columns as a Diagnostic counts them; the largest number where there are more.
int place_number(std::uint64_t value);

}  // namespace boule
