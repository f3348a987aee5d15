#include "render/files/particle_file/text/text_lines.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "render/files/particle_file/text/text_number.h"

namespace boule {

std::string_view TextLines::next() {
  if (at_end()) return {};
  const std::size_t end = std::min(text_.find('\n', offset_), text_.size());
  std::string_view line = text_.substr(offset_, end - offset_);
  offset_ = std::min(end + 1, text_.size());
  ++line_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::uint64_t TextLines::skip(std::uint64_t count) {
  const char* at = text_.data() + offset_;
  const char* const end = text_.data() + text_.size();
  std::uint64_t skipped = 0;
  for (; skipped < count && at < end; ++skipped) {
    const void* const found = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    at = found == nullptr ? end : static_cast<const char*>(found) + 1;
  }
  offset_ = static_cast<std::size_t>(at - text_.data());
  line_ += skipped;
  return skipped;
}

void TextLines::skip_blank_lines() {
  while (!at_end()) {
    const std::string_view line = peek();
    if (!std::all_of(line.begin(), line.end(), is_blank)) return;
    next();
  }
}

int place_number(std::uint64_t value) {
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(value, most));
}

Diagnostic error_at_line(std::uint64_t line, std::string message, std::string key) {
  return {.message = std::move(message),
          .key = std::move(key),
          .line = place_number(line),
          .column = line > 0 ? 1 : 0};
}

Diagnostic error_at_word(std::uint64_t line, std::string_view line_text, std::string_view word,
                         std::string message, std::string key) {
  Diagnostic error = error_at_line(line, std::move(message), std::move(key));
  error.column = place_number(static_cast<std::uint64_t>(word.data() - line_text.data()) + 1);
  return error;
}

}  // namespace boule
